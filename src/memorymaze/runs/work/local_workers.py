"""Workers that are processes of this machine."""

import contextlib
import gc
import math
import os
import signal
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Literal

from memorymaze.basics.errors import MemoryMazeError, SettingsError
from memorymaze.basics.processes import (
    PROCESSES,
    available_cores,
    die_with_parent,
    main_left_out,
    start_server,
)
from memorymaze.basics.wording import counted
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.work.episode_worker import (
    EpisodeOutcome,
    EpisodeTask,
    EpisodeWorker,
)
from memorymaze.runs.work.worker_pool import LEAVING_TIME, WorkerDied


@dataclass(frozen=True, slots=True)
class LocalWorkforce:
    """Processes on this machine."""

    workers: int = 0
    """0 for one per core; for one alone where robots have a body of a user's own."""

    def __post_init__(self) -> None:
        """Refuse what is no number of processes."""
        if type(self.workers) is not int or self.workers < 0:
            raise SettingsError(
                "workers: expected a whole number of processes, 0 for one per core, got "
                f"{self.workers!r}"
            )

    def __str__(self) -> str:
        """Say how many there are."""
        return counted(self.workers or available_cores(), "worker")

    def check(self, settings: RunDefinition) -> None:
        """Refuse nothing: this machine made the plan."""

    def number(self, settings: RunDefinition) -> int:
        """Return how many work on a run.

        One simulator, or one robot of steel, serves one episode at a time.
        """
        one_alone = settings.robot is not None
        return self.workers or (1 if one_alone else available_cores())

    def source(
        self, prepare: EpisodeWorker, folder: Path, episodes: int
    ) -> "LocalSource":
        """Return processes for a run; no more of them than there are episodes."""
        count = min(self.number(prepare.settings), episodes)
        # Threads of a model wait for each other: one without a core holds up all.
        threads = max(1, available_cores() // max(1, count) - 1)
        agent = prepare.settings.agent
        model = replace(
            agent.language_model,
            # Absolute, because an agent may change its process's folder.
            shared_folder=str(folder.absolute()),
            threads=agent.language_model.threads or threads,
        )
        settings = replace(prepare.settings, agent=replace(agent, language_model=model))
        return LocalSource(replace(prepare, settings=settings), count)


@dataclass(frozen=True, slots=True)
class LocalSource:
    """Starts processes that prepare themselves in the same way."""

    prepare: EpisodeWorker
    count: int
    starting_limit: float = math.inf
    advice: str = "with little memory, try fewer --workers"

    def start(self) -> "LocalWorker":
        """Start a process."""
        return LocalWorker(self.prepare)

    def wait(
        self, workers: Sequence["LocalWorker"], seconds: float
    ) -> list["LocalWorker"]:
        """Return those that something has come from, and those that ended."""
        there = wait([worker.connection for worker in workers], seconds)
        return [w for w in workers if w.connection in there or not w.is_alive()]


class LocalWorker:
    """A process of this machine, and the connection to it."""

    def __init__(self, prepare: EpisodeWorker) -> None:
        """Start the process."""
        self._prepare = prepare
        self.connection, theirs = PROCESSES.Pipe()
        # Handed over as a connection is: the server has what was there when it began.
        stderr = Connection(os.dup(2), readable=False)
        given = (theirs, stderr, {**os.environ})
        self._process = PROCESSES.Process(target=_work, args=given)
        start_server(EpisodeWorker.__module__)
        with main_left_out():
            self._process.start()
        theirs.close()
        stderr.close()

    def send(self, task: EpisodeTask) -> None:
        """Give it a task."""
        self._write(task)

    def receive(self) -> EpisodeOutcome | Literal["ready"] | None:
        """Take what it says."""
        try:
            if not self.connection.poll():
                raise EOFError
            said, content = self.connection.recv()
        except (EOFError, OSError):
            self._process.join()
            ending = _how_it_ended(self._process.exitcode)
            raise WorkerDied(f"the worker process {ending}") from None
        if said == "hello":
            # Sent only now, when the child is there to read it: it may be too much
            # for the pipe to hold, and others shall start meanwhile.
            self._write(self._prepare)
            return None
        if said == "failed":
            raise content
        return content

    def is_alive(self) -> bool:
        """Tell whether the process runs."""
        return self._process.is_alive()

    def end(self, *, at_once: bool) -> None:
        """Kill the process, or have it find nobody at the other end."""
        if at_once:
            self._process.kill()
        else:
            self.connection.close()

    def join(self) -> None:
        """Wait for its end."""
        self._process.join(LEAVING_TIME)
        self._process.kill()
        self._process.join()
        self.connection.close()

    def _write(self, content: object) -> None:
        # A dead worker's end of the pipe is noticed when we read from it.
        with contextlib.suppress(OSError):
            self.connection.send(content)


def _how_it_ended(code: int | None) -> str:
    if code is not None and code < 0:
        return f"was killed by {signal.Signals(-code).name}"
    return f"ended with exit code {code}"


def _work(
    connection: Connection, stderr: Connection, environment: Mapping[str, str]
) -> None:
    """Do the tasks that come; the life of a worker process."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    os.environ.clear()
    os.environ.update(environment)
    # What is printed while working is no result of the parent's.
    for stream in (1, 2):
        os.dup2(stderr.fileno(), stream)
    stderr.close()
    die_with_parent()
    try:
        connection.send(("hello", None))
        prepare: Callable[[], Callable[[EpisodeTask], EpisodeOutcome]]
        prepare = connection.recv()
        do = prepare()
        # An episode makes few cycles of objects; looking for them takes 2 % of its time.
        gc.set_threshold(20_000)
        connection.send(("ready", "ready"))
        while True:
            connection.send(("done", do(connection.recv())))
    except MemoryMazeError as error:
        connection.send(("failed", error))
    except (EOFError, BrokenPipeError):
        return
