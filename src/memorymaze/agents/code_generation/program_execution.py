"""One run of one program, stepped from API call to API call, within its limits.

What crosses between program and robot, arguments in and results out, is checked here.
"""

import dataclasses
import functools
import inspect
import math
import re
import time
from collections import namedtuple
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Any, TypeGuard

from pydantic_monty import (
    FunctionSnapshot,
    FutureSnapshot,
    MontyComplete,
    MontySession,
    MontyTypingError,
    NameLookupSnapshot,
    SourceRange,
    SyncSnapshot,
)

from memorymaze.agents.code_generation.program_check import (
    FORBIDDEN_BUILTINS,
    first_error,
    read_findings,
)
from memorymaze.basics.errors import (
    CommandError,
    EpisodeOver,
    ProgramError,
    SettingsError,
)
from memorymaze.basics.failures import LINE_LENGTH
from memorymaze.robot.api import asking
from memorymaze.robot.api.asking import AskingRobot, Question, can_ask
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.specification import API_NAMES, ASKING_NAMES, QUESTIONS

SOURCE_NAME = "<python-input-"
"""How the interpreter names the program's own text, followed by a number."""
_ENDINGS = frozenset({"exit", "quit"})
_DUNDER = re.compile(r"__\w+__")


LONGEST_COMPUTING_TIME = 60.0
"""The highest computing time that can be allowed, seconds."""


@dataclass(frozen=True, slots=True)
class ProgramLimits:
    """How much a program may use; the robot's own budgets come on top."""

    computing_time: float = 5.0
    """Seconds of its own computing and of checking it, and as many of this side's for what
    it hands to the API; the robot's time is not in it."""
    memory: int = 64 * 2**20
    """Bytes; checking a program takes about 10 MiB of them."""
    recursion_depth: int = 200
    """Function calls inside one another."""
    calls: int = 100_000
    """Calls of the API, of which many take the robot no time."""
    printed_characters: int = 10_000
    """Characters of its printing that are kept; the rest is dropped, and said to be."""
    text_characters: int = 1_000
    """Characters in a text given to the API."""
    program_characters: int = 50_000
    """Characters of the program itself."""

    def __post_init__(self) -> None:
        """Check the limits."""
        for name in self.__slots__:
            value = getattr(self, name)
            if not value > 0:
                raise SettingsError(f"{name} must be greater than 0, not {value}")
        if self.computing_time > LONGEST_COMPUTING_TIME:
            raise SettingsError(
                f"computing_time must be at most {LONGEST_COMPUTING_TIME:g} s, "
                f"not {self.computing_time:g}"
            )


DEFAULT_LIMITS = ProgramLimits()


def read_arguments(
    call: str, args: tuple[Any, ...], kwargs: dict[str, Any], text_limit: int
) -> dict[str, Any]:
    """Return a call's arguments by name, of the types the API asks for."""
    signature = _signatures()[call]
    try:
        arguments = signature.bind(*args, **kwargs).arguments
    except TypeError as error:
        raise TypeError(f"{call}(): {error}") from None
    return {
        name: _read(f"{call}(): {name}", signature.parameters[name], value, text_limit)
        for name, value in arguments.items()
    }


def to_sandbox(value: Any) -> Any:
    """Turn a robot's result into what a program can hold.

    Records become named tuples: attributes by the same names, immutable, hashable.
    """
    match value:
        case None | bool() | str():
            return value
        case Integral():
            return int(value)
        case Real():
            return float(value)
        case list():
            return [to_sandbox(item) for item in value]
        case tuple():
            return tuple(to_sandbox(item) for item in value)
        case _ if dataclasses.is_dataclass(value) and not isinstance(value, type):
            record = _record_type(type(value))
            return record(
                *(to_sandbox(getattr(value, name)) for name in record._fields)
            )
        case _:
            raise TypeError(
                f"a robot returned {type(value).__name__}, which is not part of its API"
            )


@functools.cache
def _signatures() -> dict[str, inspect.Signature]:
    """Return each API function's signature without `self`."""
    signatures: dict[str, inspect.Signature] = {}
    for name in (*API_NAMES, *ASKING_NAMES):
        if name in QUESTIONS:
            signatures[name] = inspect.signature(getattr(asking, name))
            continue
        whole = inspect.signature(getattr(AskingRobot, name))
        signatures[name] = whole.replace(parameters=list(whole.parameters.values())[1:])
    return signatures


@functools.cache
def _record_type(record: type[Any]) -> Any:
    names = [field.name for field in dataclasses.fields(record)]
    # Its fields are known only when it is made, so there are no types to give.
    return namedtuple(  # pyright: ignore[reportUntypedNamedTuple]
        record.__name__, names, module="robot"
    )


def _read(
    name: str, parameter: inspect.Parameter, value: object, text_limit: int
) -> object:
    if parameter.annotation is float:
        return _read_number(name, value)
    if parameter.annotation is Question:
        return _read_question(name, value)
    return _read_text(name, value, text_limit)


def _read_number(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{name} must be a finite number, not {number}")
    return number


def _read_question(name: str, value: object) -> Question:
    """Return a question that the program got from one of the functions that make them."""
    kind, about = (getattr(value, each, None) for each in ("kind", "about"))
    if kind not in QUESTIONS or not isinstance(about, str):
        raise TypeError(
            f"{name} must be made by {', '.join(QUESTIONS)}, not {type(value).__name__}"
        )
    return Question(kind, about)


def _read_text(name: str, value: object, text_limit: int) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} must be text, not {type(value).__name__}")
    if len(value) > text_limit:
        raise ValueError(
            f"{name} must have at most {text_limit} characters, not {len(value)}"
        )
    return value


def _placeholder(name: str) -> Callable[..., None]:
    """Return a function that stands in the sandbox for a call to halt at."""

    def halt(*_: object) -> None:
        raise RuntimeError(f"{name} was called on the wrong side of the sandbox")

    halt.__name__ = name
    return halt


_FUNCTIONS = {
    name: _placeholder(name)
    for name in (*API_NAMES, *ASKING_NAMES, *FORBIDDEN_BUILTINS, *_ENDINGS)
}


def reaching_out(what: str, line: int | None) -> ProgramError:
    """Return the error of a program that reached for something outside the API."""
    return ProgramError(
        f"line {line}: the program reaches outside the control API: {what}",
        line=line,
        unsafe=True,
    )


class ProgramExecution:
    """Lets a program run in an interpreter session and makes its calls."""

    def __init__(
        self,
        program: str,
        robot: Robot,
        limits: ProgramLimits,
        on_event: Callable[[dict[str, Any]], None],
    ) -> None:
        """Prepare a run; the arguments are those of `run_program`."""
        self._program = program
        self._encoded = program.encode()
        self._robot = robot
        self._names = (*API_NAMES, *(ASKING_NAMES if can_ask(robot) else ()))
        self._limits = limits
        self._on_event = on_event
        self._calls = 0
        self._crossing_time = limits.computing_time
        self._printed: list[str] = []
        self._printing_room = limits.printed_characters

    def run(self, session: MontySession) -> None:
        """Check the program and run it until it ends."""
        try:
            snapshot: SyncSnapshot | None = self._start(session)
            while not (snapshot is None or isinstance(snapshot, MontyComplete)):
                self._tell_printed()
                snapshot = self._answer(snapshot)
        finally:
            self._tell_printed()

    def _start(self, session: MontySession) -> SyncSnapshot:
        """Check the program and run it to its first halt."""
        try:
            snapshot = self._feed(session, check=True)
            if _asks_for_stubs(snapshot):
                snapshot = snapshot.resume_not_handled()
            return snapshot
        except MontyTypingError as error:
            findings = read_findings(error.display(), self._names)
        refusal = first_error(findings)
        if refusal is not None:
            raise refusal
        if findings:
            doubts = [f"line {finding.line}: {finding.message}" for finding in findings]
            self._on_event({"kind": "doubts", "doubts": doubts})
        return self._feed(session, check=False)

    def _feed(self, session: MontySession, *, check: bool) -> SyncSnapshot:
        return session.feed_start(
            self._program,
            inputs={
                name: _FUNCTIONS[name]
                for name in (*self._names, *FORBIDDEN_BUILTINS, *_ENDINGS)
            },
            print_callback=self._keep_printed,
            skip_type_check=not check,
        )

    def _answer(
        self, snapshot: FunctionSnapshot | NameLookupSnapshot | FutureSnapshot
    ) -> SyncSnapshot | None:
        """Do what the program halted for; None when that ends the program."""
        line = self._line(snapshot.position)
        if isinstance(snapshot, FutureSnapshot):
            raise ProgramError(
                f"line {line}: the program waits for what never comes", line=line
            )
        if isinstance(snapshot, NameLookupSnapshot):
            if _DUNDER.fullmatch(snapshot.variable_name):
                raise reaching_out(snapshot.variable_name, line)
            return self._let_on(snapshot.resume)
        name = snapshot.function_name
        if snapshot.is_os_function or name in FORBIDDEN_BUILTINS:
            raise reaching_out(name, line)
        if name in self._names:
            return self._call(snapshot, name, line)
        if name in _ENDINGS:
            return None
        unknown = NameError(f"name {name!r} is not defined")
        return self._let_on(lambda: snapshot.resume({"exception": unknown}))

    def _let_on(self, resume: Callable[[], SyncSnapshot]) -> SyncSnapshot:
        """Let the program on, unless it has handed over too much by now."""
        if self._crossing_time < 0:
            raise EpisodeOver("budget")
        with self._crossing():
            return resume()

    @contextmanager
    def _crossing(self) -> Generator[None]:
        """Count the time of this side alone, which does not depend on what else runs."""
        began = time.thread_time()
        try:
            yield
        finally:
            self._crossing_time -= time.thread_time() - began

    def _call(
        self, snapshot: FunctionSnapshot, name: str, line: int | None
    ) -> SyncSnapshot:
        """Make an API call; arguments it does not take are the program's exception."""
        self._calls += 1
        if self._calls > self._limits.calls:
            raise EpisodeOver("budget")
        try:
            with self._crossing():
                arguments = read_arguments(
                    name, snapshot.args, snapshot.kwargs, self._limits.text_characters
                )
        except (TypeError, ValueError) as error:
            return self._refuse(snapshot, name, line, error)
        try:
            made_by = asking if name in QUESTIONS else self._robot
            result = getattr(made_by, name)(**arguments)
        except CommandError as error:
            return self._refuse(snapshot, name, line, ValueError(str(error)))
        if name == "stop":
            raise EpisodeOver("agent")
        given = to_sandbox(result)
        return self._let_on(lambda: snapshot.resume({"return_value": given}))

    def _refuse(
        self,
        snapshot: FunctionSnapshot,
        name: str,
        line: int | None,
        error: TypeError | ValueError,
    ) -> SyncSnapshot:
        # It quotes what the program made.
        message = str(error)[:LINE_LENGTH]
        self._on_event({
            "kind": "refused_call",
            "line": line,
            "call": name,
            "message": message,
        })
        refused = type(error)(message)
        return self._let_on(lambda: snapshot.resume({"exception": refused}))

    def _line(self, position: SourceRange) -> int | None:
        """Return the line of a place in the program; None in text that it made."""
        if not position.filename.startswith(SOURCE_NAME):
            return None
        return self._encoded.count(b"\n", 0, position.start) + 1

    def _keep_printed(self, stream: str, text: str) -> None:
        """Keep what is printed until the next halt, as far as there is room."""
        if self._printing_room <= 0:
            return
        self._printed.append(text[: self._printing_room])
        self._printing_room -= len(text)
        if self._printing_room <= 0:
            limit = self._limits.printed_characters
            self._printed.append(f"\n[printing beyond {limit} characters is dropped]\n")

    def _tell_printed(self) -> None:
        if self._printed:
            self._on_event({"kind": "print", "text": "".join(self._printed)})
            self._printed.clear()


def _asks_for_stubs(snapshot: SyncSnapshot) -> TypeGuard[FunctionSnapshot]:
    """Whether the type checker has met a module it does not know."""
    return (
        isinstance(snapshot, FunctionSnapshot)
        and snapshot.is_os_function
        and snapshot.function_name == "import_stubs"
    )
