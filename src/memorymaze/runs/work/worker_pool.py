"""Workers that run one episode after another, and may die doing so.

Holds what a worker must be able to do and the pool that gives workers their tasks.
Workers are processes of this machine (`local_workers.py`) or of a Ray cluster
(`ray_workers.py`); the pool and the driver know neither.

Unlike the pools of the standard library, this one outlives its workers: a worker that is
killed or crashes costs the task it had in hand, which is reported as lost, and is
replaced.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Protocol, runtime_checkable

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.work.episode_worker import (
    EpisodeOutcome,
    EpisodeTask,
    EpisodeWorker,
    Lost,
)

STARTS = 3
"""Workers of one place that may die in a row before they are ready; then the run ends."""

LOOKING_PERIOD = 1.0
"""Seconds between looks at whether workers live: where a child of a dead worker holds
its pipe open, nothing else tells."""

LEAVING_TIME = 5.0
"""Seconds that an idle worker has for closing what it opened."""


class WorkerDied(Exception):
    """A worker is gone; the message says how, as far as anything is known."""


class Worker(Protocol):
    """One process that does one task after another, somewhere."""

    def send(self, task: EpisodeTask) -> None:
        """Give it a task; that it is dead is noticed when something is received."""
        ...

    def receive(self) -> EpisodeOutcome | Literal["ready"] | None:
        """Take what it says: that it is ready, its task's outcome, or nothing of note.

        Raises:
            WorkerDied: Nothing will come any more.
            MemoryMazeError: It cannot be prepared.
        """
        ...

    def end(self, *, at_once: bool) -> None:
        """End it, whatever it does, or in its own way where it is idle."""
        ...

    def join(self) -> None:
        """Wait until it is gone; one that takes longer than `LEAVING_TIME` is killed."""
        ...


class WorkerSource(Protocol):
    """Starts workers that are prepared for one run."""

    @property
    def count(self) -> int:
        """Workers there shall be; 0 where there is nothing to do."""
        ...

    @property
    def starting_limit(self) -> float:
        """Seconds to wait for the first worker."""
        ...

    @property
    def advice(self) -> str:
        """What to do where workers do not start."""
        ...

    def start(self) -> Worker:
        """Start one; it says when it is ready."""
        ...

    def wait(self, workers: Sequence[Any], seconds: float) -> Sequence[Worker]:
        """Return those of its workers that have something to say, waiting for one."""
        ...


@runtime_checkable
class Workforce(Protocol):
    """Where the workers of a run come from."""

    def __str__(self) -> str:
        """Say how many there are, and where."""
        ...

    def check(self, settings: RunDefinition) -> None:
        """Refuse, before anything is written, what these workers cannot do.

        Raises:
            SettingsError: Says what, and what to do instead.
        """
        ...

    def source(
        self, prepare: EpisodeWorker, folder: Path, episodes: int
    ) -> WorkerSource:
        """Return where workers for so many episodes come from that prepare so."""
        ...


@dataclass
class _Place:
    """A worker, and those that died in its place in a row before they were ready."""

    worker: Worker
    deaths: int
    ready: bool = False
    task: EpisodeTask | None = None
    began: float = 0.0
    """When it was given its task, by the monotonic clock."""


class WorkerPool:
    """Some workers of one source; used in a `with`, which ends them."""

    def __init__(self, source: WorkerSource, patience: float) -> None:
        """Remember what to start, and the seconds a task may take."""
        self._source = source
        self._patience = patience
        self._places: list[_Place] = []

    def __enter__(self) -> "WorkerPool":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End all workers: idle ones in their own way, all others at once."""
        for place in self._places:
            idle = place.ready and place.task is None
            place.worker.end(at_once=not idle)
        for place in self._places:
            place.worker.join()
        self._places.clear()

    def run(
        self, choose: Callable[[int], EpisodeTask | None]
    ) -> Iterator[tuple[EpisodeTask, EpisodeOutcome]]:
        """Work until no worker has a task and there is none to give.

        Args:
            choose: Gives the next task for a worker (numbered from 0), or None when
                there is none now. It is asked again after every outcome.

        Yields:
            Every task given, once, with what came of it, in the order of completion;
            `Lost` where its worker died, was ended because it took too long, or raised.

        Raises:
            MemoryMazeError: Workers could not be started or prepared.
        """
        for _ in range(self._source.count):
            self._places.append(_Place(self._source.start(), deaths=0))
        latest = time.monotonic()
        while self._places and self._set_to_work(choose):
            busy = [p for p in self._places if p.task is not None or not p.ready]
            there = self._source.wait([p.worker for p in busy], LOOKING_PERIOD)
            for place in busy:
                if place.worker in there:
                    yield from self._receive(place)
                elif self._is_overdue(place):
                    reason = f"took longer than the {self._patience:g} s a task may"
                    lost = Lost(f"the worker process {reason}", overdue=True)
                    yield from self._replace(place, lost)
            if any(place.ready for place in self._places):
                latest = time.monotonic()
            elif time.monotonic() - latest > self._source.starting_limit:
                raise MemoryMazeError(
                    f"no worker could be started in {self._source.starting_limit:g} s; "
                    + self._source.advice
                )

    def _set_to_work(self, choose: Callable[[int], EpisodeTask | None]) -> bool:
        """Give tasks to all who are free; tell whether there is anything to wait for.

        A task is only given to a worker that is ready: others may wait long for a core.
        """
        nothing_left = False
        for number, place in enumerate(self._places):
            if place.ready and place.task is None:
                place.task = choose(number)
                if place.task is None:
                    nothing_left = True
                else:
                    place.began = time.monotonic()
                    place.worker.send(place.task)
        busy = any(place.task is not None for place in self._places)
        return busy or not nothing_left

    def _is_overdue(self, place: _Place) -> bool:
        working = place.task is not None
        return working and time.monotonic() - place.began > self._patience

    def _receive(self, place: _Place) -> Iterator[tuple[EpisodeTask, EpisodeOutcome]]:
        try:
            said = place.worker.receive()
        except WorkerDied as death:
            yield from self._replace(place, Lost(str(death)))
            return
        if said == "ready":
            place.ready = True
        elif said is not None and place.task is not None:
            task, place.task = place.task, None
            yield task, said

    def _replace(
        self, place: _Place, lost: Lost
    ) -> Iterator[tuple[EpisodeTask, EpisodeOutcome]]:
        """Put another worker in the place of one that died or is to."""
        place.worker.end(at_once=True)
        place.worker.join()
        if not place.ready and place.deaths + 1 == STARTS:
            raise MemoryMazeError(
                f"workers do not start: the last {STARTS} of one place ended early, the "
                f"latest because {lost.reason}; {self._source.advice}"
            )
        deaths = 0 if place.ready else place.deaths + 1
        fresh = _Place(self._source.start(), deaths)
        self._places[self._places.index(place)] = fresh
        if place.task is not None:
            yield place.task, lost
