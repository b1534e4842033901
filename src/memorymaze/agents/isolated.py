"""An agent in a process of its own, which has no building and cannot fetch one.

The process has the text and a robot whose calls go to the process that has the
simulation, one at a time. There it is refused to load the rooms that know answers, and
to read plans, corpora and the run's folder. That keeps an agent from seeing answers by
mistake; it is no prison for one that wants out.
"""

import contextlib
import multiprocessing
import os
import pickle
import sys
from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple, cast

import cloudpickle
import numpy as np

from memorymaze.agents.agent import (
    AMOUNTS,
    COUNTS,
    Agent,
    Asking,
    FairLimits,
    Journal,
    asking_of,
)
from memorymaze.agents.notes import TracebackNote
from memorymaze.basics.errors import (
    EpisodeOver,
    LanguageModelError,
    MemoryMazeError,
    SettingsError,
)
from memorymaze.basics.failures import failure_line, failure_traceback
from memorymaze.basics.processes import begin_worker, main_left_out
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    stages_answered,
    takes_pictures,
)
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.steps import SteppingRobot

ROOMS_WITH_ANSWERS = (
    "front",
    "gym",
    "robot.carla",
    "robot.simulation",
    "runs",
    "testing",
    "texts",
    "web",
    "world",
)
"""What the process may not load."""

_PACKAGE = Path(__file__).parents[1]
_PROCESSES = multiprocessing.get_context("spawn")


class IsolatedAgentError(MemoryMazeError):
    """Stands for what an agent raised in its own process; the message is its line."""


class _Told(NamedTuple):
    """What a model says of itself."""

    name: str
    takes_pictures: bool
    stages_answered: frozenset[str]

    @classmethod
    def of(cls, model: LanguageModel) -> "_Told":
        return cls(
            model.name,
            takes_pictures(model),
            stages_answered(model),
        )


class IsolatedAgent:
    """Stands for an agent in a process of its own, which starts with the first episode.

    It needs what the agent itself needs, but for what no isolated agent gets.
    """

    def __init__(
        self,
        agent: Agent,
        make: Callable[[LanguageModel | None], Agent],
        model: LanguageModel | None = None,
        kept_from: Sequence[str | Path] = (),
    ) -> None:
        """Stand for an agent that may not read some files and folders.

        `make` makes it there, with what asks the model, which stays here; `agent` is one
        that was made here.
        """
        self.name = agent.name
        self._here = agent
        self._model = model
        self._kept_from = tuple(str(Path(place).absolute()) for place in kept_from)
        self._process: Any = None
        self._connection: Connection | None = None
        try:
            self._maker = cloudpickle.dumps(make)
        except Exception as error:
            raise SettingsError(
                f"isolate: the agent {agent.name!r} cannot be sent to a process of its own "
                f"({failure_line(error)})"
            ) from error

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell what the agent will ask, as the one made here does."""
        return asking_of(self._here, instruction, limits)

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        """Let the agent follow; its calls and notes come here."""
        try:
            end, spent = self._converse(instruction, robot, journal, rng)
        except BaseException as problem:
            # What is still said is of an episode that is over.
            self._give_up()
            if isinstance(problem, EOFError | OSError):
                raise IsolatedAgentError("the agent's process ended") from None
            raise
        for name, value in spent.items():
            setattr(journal, name, value)
        _take(*end)

    def _converse(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> tuple[tuple[str, Any], dict[str, float]]:
        """Answer until the episode is over; return how it ended, and what was spent."""
        connection = self._started()
        names = frozenset(name for name in dir(robot) if not name.startswith("_"))
        connection.send((instruction, names, rng, journal.limits))
        while True:
            match connection.recv():
                case "call", content:
                    connection.send(_answer(robot, names, *content))
                case "note", content:
                    journal.add(content)
                case "ask", request:
                    connection.send(self._completed(request))
                case "completion", content:
                    stand = journal.on_completion
                    connection.send(0.0 if stand is None else stand(content))
                case "end", (end, spent):
                    return end, spent
                case other:
                    raise IsolatedAgentError(
                        f"expected a call of the robot, got {type(other).__name__}"
                    )

    def _completed(self, request: CompletionRequest) -> tuple[str, Any]:
        if self._model is None:
            raise IsolatedAgentError("the agent has no language model to ask")
        try:
            return "value", self._model.complete(request)
        except LanguageModelError as problem:
            # Its subclasses hold what a message cannot carry.
            return "error", LanguageModelError(*problem.args)

    def _give_up(self) -> None:
        if self._connection is not None:
            self._connection.close()
            self._connection = None
            self._process.kill()

    def _started(self) -> Connection:
        if self._connection is None:
            self._connection, theirs = _PROCESSES.Pipe()
            self._process = _PROCESSES.Process(
                target=_live, args=(theirs,), daemon=True
            )
            with main_left_out():
                self._process.start()
            theirs.close()
            model = self._model
            told = None if model is None else _Told.of(model)
            self._connection.send((self._maker, told, self._kept_from))
        return self._connection


def _answer(
    robot: Robot,
    names: frozenset[str],
    name: str,
    arguments: tuple[Any, ...],
    named: dict[str, Any],
) -> tuple[str, Any]:
    # Asked here too: what Python itself can be asked of a robot tells where it is.
    if name not in names:
        return "error", AttributeError(f"a robot has no {name!r}")
    try:
        return "value", getattr(robot, name)(*arguments, **named)
    except (AttributeError, TypeError) as error:
        return "error", type(error)(*error.args)
    except Exception as error:
        return _sendable(error)


def _sendable(problem: Exception, agent: object = None) -> tuple[str, Any]:
    """Return an error of ours as it is; what else was raised as its line."""
    if isinstance(problem, EpisodeOver):
        return "over", problem.stopped_by
    if isinstance(problem, MemoryMazeError):
        with contextlib.suppress(Exception):
            if type(pickle.loads(pickle.dumps(problem))) is type(problem):
                return "error", problem
    return "error", IsolatedAgentError(failure_line(problem, agent))


def _take(how: str, content: Any) -> Any:
    """Return what a call gave at the other end, or raise what it raised."""
    if how == "over":
        raise EpisodeOver(content)
    if how == "error":
        raise content
    return content


# In the agent's process.


class _FarRobot:
    """Passes every call on, and waits for the answer."""

    __slots__ = ("__connection", "__names")

    def __init__(self, connection: Connection, names: frozenset[str]) -> None:
        self.__connection = connection
        self.__names = names

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name not in self.__names:
            raise AttributeError(
                f"a robot that follows an instruction has no {name!r}: agents get "
                f"{', '.join(sorted(self.__names))}"
            )

        def call(*arguments: Any, **named: Any) -> Any:
            self.__connection.send(("call", (name, arguments, named)))
            return _take(*self.__connection.recv())

        return call


class _FarModel:
    """Passes every request on to the model, and waits for the answer."""

    def __init__(self, connection: Connection, told: _Told) -> None:
        self._connection = connection
        self.name = told.name
        self.takes_pictures = told.takes_pictures
        self.stages_answered = told.stages_answered

    def complete(self, request: CompletionRequest) -> Completion:
        self._connection.send(("ask", request))
        return _take(*self._connection.recv())


def _live(connection: Connection) -> None:
    """Make the agent and let it follow, episode after episode."""
    begin_worker()
    make, told, kept_from = connection.recv()
    model = None if told is None else _FarModel(connection, told)
    sys.addaudithook(_keeper(kept_from))
    agent: Agent | None = None
    while True:
        try:
            instruction, names, rng, limits = connection.recv()
        except (EOFError, OSError):
            return
        journal = Journal(
            listener=lambda note: connection.send(("note", note)),
            on_completion=lambda reply: _stood(connection, reply),
            limits=limits,
        )
        end: tuple[str, Any] = "value", None
        try:
            if agent is None:
                agent = cast(Agent, pickle.loads(make)(model))
            robot = cast(SteppingRobot, _FarRobot(connection, names))
            agent.follow(instruction, robot, journal, rng)
        except Exception as problem:
            end = _sendable(problem, agent)
            lines = failure_traceback(problem)
            if lines and end[0] == "error":
                journal.add(TracebackNote(lines))
        spent = {name: getattr(journal, name) for name in COUNTS | AMOUNTS}
        connection.send(("end", (end, spent)))


def _stood(connection: Connection, reply: Completion) -> float:
    connection.send(("completion", reply))
    return connection.recv()


_REACHES_FILES = frozenset({"open", "os.link", "os.rename"})
"""What Python says before it does; other processes and libraries in C do not ask."""


def _keeper(kept_from: Sequence[str]) -> Callable[[str, tuple[Any, ...]], None]:
    """Return what refuses to load rooms with answers and to read files with them."""
    data = [str(_PACKAGE / room) for room in ("world/sites/data", "texts/corpus/data")]
    # The parent's memory and open files hold the building.
    parent = f"/proc/{os.getppid()}"
    places = (parent, *map(os.path.realpath, (*data, *kept_from)))
    rooms = tuple(f"memorymaze.{room}." for room in ROOMS_WITH_ANSWERS)

    def keep(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "import":
            name = str(arguments[0])
            if f"{name}.".startswith(rooms):
                raise ImportError(
                    f"{name}: an isolated agent cannot load the rooms that know answers"
                )
        elif event in _REACHES_FILES and isinstance(
            arguments[0], str | bytes | os.PathLike
        ):
            path = os.path.realpath(os.fsdecode(arguments[0]))
            if any(path == each or path.startswith(each + os.sep) for each in places):
                raise PermissionError(
                    f"{path}: an isolated agent cannot read plans, corpora and runs"
                )

    return keep
