"""What a worker process is given, what it does with it, and what comes of it."""

import pickle
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cloudpickle
import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.basics.errors import SettingsError, SpendingLimitReached
from memorymaze.basics.failures import WorkerLost, failure_line
from memorymaze.robot.api.control import Robot
from memorymaze.runs.episodes.agent_catalogue import chosen_again
from memorymaze.runs.episodes.arena import arenas_of
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.episodes.trace import trace_content
from memorymaze.texts.corpus.records import Episode
from memorymaze.world.sites import Site


@dataclass(frozen=True, slots=True)
class EpisodeDone:
    """What came of an episode; the driver alone writes it into the run folder."""

    result: EpisodeResult
    trace: bytes
    """Content of the trace's file."""


@dataclass(frozen=True, slots=True)
class LimitReached:
    """An episode that was broken off because the run has spent what it may."""

    reason: str


@dataclass(frozen=True, slots=True)
class Lost:
    """A task of which nothing came: its worker died, or the working function raised."""

    reason: str
    """Such as `the worker process was killed by SIGKILL`."""
    overdue: bool = False
    """Whether it was ended because it took longer than a task may."""


EpisodeOutcome = EpisodeDone | LimitReached | Lost


@dataclass(frozen=True, slots=True)
class EpisodeTask:
    """An episode to run."""

    episode: Episode
    tries: int = 0
    """Times a worker was lost over it."""
    lost: str | None = None
    """When set, the episode is not tried again but recorded as a crash, with this."""


@dataclass(frozen=True, slots=True)
class EpisodeWorker:
    """Makes, in a worker process, the function that runs one episode after another."""

    settings: RunDefinition
    sites: dict[str, Site]
    agent: bytes | None = None
    """The agent itself or its class, pickled, where it was handed over."""
    kept_from: tuple[Path, ...] = ()
    """Files and folders that an isolated agent may not read."""

    @classmethod
    def of(cls, plan: RunPlan) -> "EpisodeWorker":
        """Return the worker of a plan.

        Raises:
            SettingsError: The agent was handed over and cannot be sent to a process.
        """
        handed = plan.agent.handed
        try:
            packed = None if handed is None else cloudpickle.dumps(handed)
        except Exception as error:
            raise SettingsError(
                f"agent {plan.settings.agent.name!r}: expected one that can be sent to "
                f"worker processes, got one that cannot ({error}); hand over "
                "its class, with Options, or make in follow what cannot be sent"
            ) from error
        return cls(plan.settings, plan.sites, packed, plan.kept_from)

    def __call__(self) -> Callable[[EpisodeTask], EpisodeOutcome]:
        """Make the agent; return the function."""
        handed = None if self.agent is None else pickle.loads(self.agent)
        ready = chosen_again(self.settings.agent, handed).make(
            isolate=self.settings.isolate, kept_from=self.kept_from
        )
        # Another machine than the plan's may lack what they need.
        arenas = arenas_of(self.settings, self.sites)

        def run(task: EpisodeTask) -> EpisodeOutcome:
            episode = task.episode
            arena = arenas[episode.instruction.site]
            try:
                agent = ready.in_episode(episode)
                if task.lost is not None:
                    agent = _LostAgent(ready.name, task.lost)
                done = run_episode(
                    agent,
                    episode,
                    arena,
                    self.settings,
                    captions=ready.captions,
                    name=ready.name,
                )
            except SpendingLimitReached as limit:
                return LimitReached(str(limit))
            except BaseException as error:
                return Lost(failure_line(error))
            return EpisodeDone(done.result, trace_content(done.trace))

        return run


@dataclass(frozen=True, slots=True)
class _LostAgent:
    """Stands in for an agent over which worker processes were lost twice."""

    name: str
    reason: str

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        raise WorkerLost(self.reason)
