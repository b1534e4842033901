"""Processes that work through tasks, and may die doing so.

Unlike the pools of the standard library, this one outlives its workers: a worker that
is killed or crashes costs the task it had in hand, which is reported as lost, and is
replaced. It knows nothing of episodes.
"""

import contextlib
import math
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Generic, TypeVar

from memorymaze.errors import MemoryMazeError
from memorymaze.evaluation.agent_failures import failure_line

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

# Children that begin afresh hold no locks or threads of the parent's libraries.
PROCESSES = multiprocessing.get_context("spawn")

STARTS = 3
"""Processes that may die in a row before they are ready; then the run ends."""


LOOKING_PERIOD = 1.0
"""Seconds between looks at whether workers live: where a child of a dead worker holds
its pipe open, nothing else tells."""

LEAVING_TIME = 5.0
"""Seconds that an idle worker has for closing what it opened."""


@dataclass(frozen=True, slots=True)
class Lost:
    """A task of which nothing came: its worker died, or the working function raised."""

    reason: str
    """Such as `the worker process was killed by SIGKILL`."""
    overdue: bool = False
    """Whether it was ended because it took longer than a task may."""


@dataclass
class _Worker(Generic[Task]):
    process: BaseProcess
    connection: Connection
    deaths: int
    """Processes in this place that died in a row before they were ready."""
    ready: bool = False
    task: Task | None = None
    began: float = 0.0
    """When it could begin its task, by the monotonic clock."""


class WorkerPool(Generic[Task, Outcome]):
    """Some processes, each with its own working function; use it in a `with`.

        with WorkerPool(prepare, 2) as pool:
            for task, outcome in pool.run(choose):
                ...

    Args:
        prepare: Called once in every process, and makes the function that does tasks
            there; must be picklable. A `MemoryMazeError` it raises ends the run.
        count: Number of processes, at least 1.
        patience: Real seconds a task may take; then its worker is ended.
    """

    def __init__(
        self,
        prepare: Callable[[], Callable[[Task], Outcome]],
        count: int,
        patience: float = math.inf,
    ) -> None:
        """Remember what to start; processes start in `run`."""
        self._prepare = prepare
        self._count = count
        self._patience = patience
        self._workers: dict[int, _Worker[Task]] = {}

    def __enter__(self) -> "WorkerPool[Task, Outcome]":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End all processes: those with a task at once, idle ones in their own way."""
        for worker in self._workers.values():
            if worker.task is None:
                worker.connection.close()
            else:
                worker.process.kill()
        for worker in self._workers.values():
            worker.process.join(LEAVING_TIME)
            worker.process.kill()
            worker.process.join()
            worker.connection.close()
        self._workers.clear()

    def run(
        self, choose: Callable[[int], Task | None]
    ) -> Iterator[tuple[Task, Outcome | Lost]]:
        """Work until no worker has a task and there is none to give.

        Args:
            choose: Gives the next task for a worker (numbered from 0), or None when
                there is none now. It is asked again after every outcome.

        Yields:
            Every task given, once, with what came of it, in the order of completion.

        Raises:
            MemoryMazeError: A worker could not be prepared.
        """
        while True:
            for number in range(self._count):
                worker = self._workers.get(number)
                if worker is None or worker.task is None:
                    task = choose(number)
                    if task is not None:
                        worker = worker or self._start(number, deaths=0)
                        _give(worker, task)
            busy = [w for w in self._workers.values() if w.task is not None]
            if not busy:
                return
            wait([worker.connection for worker in busy], LOOKING_PERIOD)
            for number, worker in list(self._workers.items()):
                if worker.task is None:
                    continue
                if worker.connection.poll():
                    yield from self._receive(number, worker, worker.task)
                elif not worker.process.is_alive():
                    yield from self._bury(number, worker, worker.task)
                elif self._is_overdue(worker):
                    worker.process.kill()
                    yield from self._bury(number, worker, worker.task)

    def _is_overdue(self, worker: _Worker[Task]) -> bool:
        return worker.ready and time.monotonic() - worker.began > self._patience

    def _start(self, number: int, deaths: int) -> _Worker[Task]:
        ours, theirs = PROCESSES.Pipe()
        process = PROCESSES.Process(target=_work, args=(theirs,))
        # Ctrl-C reaches every process of the terminal; the parent decides what it
        # means. A blocked signal stays blocked in the child, from its first moment.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            process.start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        theirs.close()
        worker = _Worker[Task](process, ours, deaths)
        self._workers[number] = worker
        return worker

    def _receive(
        self, number: int, worker: _Worker[Task], task: Task
    ) -> Iterator[tuple[Task, Outcome | Lost]]:
        """Read what a worker says: that it lives, is ready, or has done its task."""
        try:
            said, content = worker.connection.recv()
        except (EOFError, OSError):
            yield from self._bury(number, worker, task)
            return
        if said == "hello":
            # Sent only now, when the child is there to read it: it may be too much
            # for the pipe to hold, and others shall start meanwhile.
            _send(worker, self._prepare)
        elif said == "ready":
            worker.ready = True
            _give(worker, task)
        elif said == "failed":
            raise content
        else:
            worker.task = None
            yield task, content

    def _bury(
        self, number: int, worker: _Worker[Task], task: Task
    ) -> Iterator[tuple[Task, Outcome | Lost]]:
        """Replace a worker that died; its task is lost if it can have begun it."""
        worker.process.join()
        worker.connection.close()
        reason = _how_it_ended(worker.process.exitcode)
        if worker.ready:
            del self._workers[number]
            if self._is_overdue(worker):
                reason = f"took longer than the {self._patience:g} s a task may"
                yield task, Lost(f"the worker process {reason}", overdue=True)
            else:
                yield task, Lost(f"the worker process {reason}")
            return
        if worker.deaths + 1 == STARTS:
            raise MemoryMazeError(
                f"worker processes do not start: the last {STARTS} of one place ended "
                f"early, this one {reason}; with little memory, try fewer --workers"
            )
        _give(self._start(number, worker.deaths + 1), task)


def _give(worker: _Worker[Task], task: Task) -> None:
    """Set a worker its task; it begins when it is ready."""
    worker.task = task
    worker.began = time.monotonic()
    if worker.ready:
        _send(worker, task)


def _send(worker: _Worker[Task], content: object) -> None:
    # A dead worker's end of the pipe is noticed when we read from it.
    with contextlib.suppress(OSError):
        worker.connection.send(content)


def _how_it_ended(code: int | None) -> str:
    if code is not None and code < 0:
        return f"was killed by {signal.Signals(-code).name}"
    return f"ended with exit code {code}"


def _work(connection: Connection) -> None:
    """Do the tasks that come; the life of a worker process."""
    # What is printed while working is no result of the parent's.
    with contextlib.suppress(OSError):
        os.dup2(2, 1)
    threading.Thread(target=_die_with_parent, daemon=True).start()
    try:
        connection.send(("hello", None))
        do = connection.recv()()
        connection.send(("ready", None))
        while True:
            task = connection.recv()
            try:
                outcome = do(task)
            except BaseException as error:
                connection.send(("done", Lost(failure_line(error))))
            else:
                connection.send(("done", outcome))
    except MemoryMazeError as error:
        connection.send(("failed", error))
    except (EOFError, BrokenPipeError):
        return


def _die_with_parent() -> None:
    """End this process when its parent is gone, however that came."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
