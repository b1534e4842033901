"""Who does the episodes of a run: processes of this machine, or whoever else can."""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from memorymaze.evaluation.episode_worker import (
    EpisodeDone,
    EpisodeTask,
    EpisodeWorker,
    LimitReached,
)
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.settings import RunSettings
from memorymaze.evaluation.worker_pool import Lost, WorkerPool

EpisodeOutcome = EpisodeDone | LimitReached | Lost


def available_cores() -> int:
    """Return how many processor cores this process may use."""
    return len(os.sched_getaffinity(0))


class EpisodePool(Protocol):
    """Workers that do one episode after another; used in a `with`, which ends them."""

    def __enter__(self) -> "EpisodePool":
        """Return itself."""
        ...

    def __exit__(self, *_: object) -> None:
        """End all workers, also in the middle of an episode."""
        ...

    def run(
        self, choose: Callable[[int], EpisodeTask | None]
    ) -> Iterator[tuple[EpisodeTask, EpisodeOutcome]]:
        """Work until no worker has a task and there is none to give.

        Args:
            choose: Gives the next task for a worker (numbered from 0), or None when
                there is none now. It is asked again after every outcome.

        Yields:
            Every task given, once, with what came of it; `Lost` where its worker died,
            was ended because it took too long, or raised.

        Raises:
            MemoryMazeError: Workers could not be prepared.
        """
        ...


class Workforce(Protocol):
    """Where the workers of a run come from."""

    def __str__(self) -> str:
        """Say how many there are, and where."""
        ...

    def check(self, settings: RunSettings) -> None:
        """Refuse, before anything is written, what these workers cannot do.

        Raises:
            SettingsError: Says what, and what to do instead.
        """
        ...

    def pool(
        self, plan: RunPlan, folder: Path, episodes: int, wall_limit: float
    ) -> EpisodePool:
        """Return workers for a plan; they start when they are needed."""
        ...


@dataclass(frozen=True, slots=True)
class LocalWorkforce:
    """Processes on this machine."""

    workers: int = 0
    """0 for one per core."""

    def __str__(self) -> str:
        """Say how many there are."""
        count = self.workers or available_cores()
        return f"{count} worker{'' if count == 1 else 's'}"

    def check(self, settings: RunSettings) -> None:
        """Refuse nothing: this machine made the plan."""

    def pool(
        self, plan: RunPlan, folder: Path, episodes: int, wall_limit: float
    ) -> EpisodePool:
        """Return processes for a plan; no more of them than there are episodes."""
        count = min(self.workers or available_cores(), max(1, episodes))
        # Threads of a model wait for each other: one without a core holds up all.
        threads = max(1, available_cores() // count - 1)
        agent = plan.settings.agent
        asking = replace(
            agent.asking,
            # Absolute, because an agent may change its process's folder.
            shared_folder=str(folder.absolute()),
            threads=threads,
        )
        settings = replace(plan.settings, agent=replace(agent, asking=asking))
        prepare = EpisodeWorker(settings, plan.sites)
        return WorkerPool[EpisodeTask, EpisodeDone | LimitReached](
            prepare, count, wall_limit
        )
