"""Runs an untrusted program against a robot's control API and nothing else.

The program runs in a process of its own, in an interpreter without files, network or
operating system (`pydantic-monty`). It halts at each API call; the call is made on
this side and the program let on, or not: when the episode is over it is simply not
continued, so nothing in it can catch the end.
"""

import re
from collections.abc import Callable
from typing import Any

from pydantic_monty import (
    MontyCrashedError,
    MontyError,
    MontyRuntimeError,
    MontySyntaxError,
    ResourceLimits,
)

from memorymaze.agents.code_generation.program_check import FORBIDDEN_BUILTINS
from memorymaze.agents.code_generation.program_execution import (
    DEFAULT_LIMITS,
    SOURCE_NAME,
    ProgramExecution,
    ProgramLimits,
    reaching_out,
)
from memorymaze.agents.code_generation.sandbox_workers import open_session
from memorymaze.basics.errors import (
    EpisodeOver,
    InterpreterLostError,
    ProgramError,
)
from memorymaze.basics.failures import LINE_LENGTH
from memorymaze.robot.api.asking import can_ask
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.specification import api_stub

_HIDDEN_ATTRIBUTE = re.compile(r"has no attribute '(__\w+__)'")
_CALLED_BACK = re.compile(r"external function '(\w+)' cannot suspend")
_INTERRUPTED = re.compile(r"SIGINT|SIGTERM|SIGHUP")
_TIME_IS_UP = "time limit exceeded"


def run_program(
    program: str,
    robot: Robot,
    limits: ProgramLimits = DEFAULT_LIMITS,
    on_event: Callable[[dict[str, Any]], None] | None = None,
) -> None:
    """Run a program until its last line, or until it calls `exit()`.

    Before it runs it is type-checked against the control API, to which the questions
    belong where the robot can ask people.

    Args:
        program: Python source in which the API's functions are in scope.
        robot: What the API's functions drive.
        limits: How much the program may use.
        on_event: Told what the robot does not know of, as dicts with a `kind`:
            `print` (`text`); `refused_call` (`line`, `call`, `message`) for arguments
            that the API does not take; `doubts` (`doubts`) for what the type checker
            holds against the program without its being refused for that.

    Raises:
        EpisodeOver: `agent` when the program called `stop()`; `budget` when it
            computed for too long or made too many calls; or what the robot said.
        ProgramError: The program is wrong or failed; `unsafe` when it reached for
            something outside the API.
        InterpreterLostError: Its process died, whoever did that.
        SettingsError: The interpreter is not installed, or this process was forked
            from one that had used it.
        KeyboardInterrupt: Somebody ended the interpreter's process.
    """
    _check_text(program, limits)
    execution = ProgramExecution(program, robot, limits, on_event or _ignore)
    interpreter_limits: ResourceLimits = {
        "max_feed_duration_secs": limits.computing_time,
        "max_memory": limits.memory,
        "max_recursion_depth": limits.recursion_depth,
        # Calls are counted on this side; a few look-ups of names come between them.
        "max_suspensions": 10 * limits.calls + 1_000,
    }
    try:
        stub = api_stub(with_people=can_ask(robot))
        with open_session(interpreter_limits, stub) as session:
            execution.run(session)
    except MontyError as error:
        outcome = _outcome(error)
        if outcome is not None:
            raise outcome from None


def _ignore(event: dict[str, Any]) -> None:
    """Take no notice."""


def _check_text(program: str, limits: ProgramLimits) -> None:
    if len(program) > limits.program_characters:
        raise ProgramError(
            f"the program has {len(program)} characters; "
            f"at most {limits.program_characters} are allowed"
        )
    try:
        program.encode()
    except UnicodeEncodeError as error:
        line = program.count("\n", 0, error.start) + 1
        raise ProgramError(
            f"line {line}: the program holds characters that are no text", line=line
        ) from None


def _outcome(error: MontyError) -> BaseException | None:
    """Return what an interpreter's error means; None for a program that just exits."""
    if isinstance(error, MontyCrashedError):
        if error.timed_out:
            return EpisodeOver("budget")
        if _INTERRUPTED.search(str(error)):
            return KeyboardInterrupt()
        return InterpreterLostError(
            "the process that ran the program died; did the program bring it down?"
        )
    if not isinstance(error, MontyRuntimeError | MontySyntaxError):
        return ProgramError(f"the program cannot be run: {error}")
    cause = error.exception()
    text = str(cause).partition("\n")[0]
    lines = [
        frame.line
        for frame in error.traceback()
        if frame.filename.startswith(SOURCE_NAME)
    ]
    line = lines[-1] if lines else None
    if isinstance(cause, SystemExit):
        return None
    if isinstance(cause, TimeoutError) and line is None and _TIME_IS_UP in text:
        return EpisodeOver("budget")
    outside = _outside(cause, text)
    if outside is not None:
        return reaching_out(outside[:LINE_LENGTH], line)
    what = f"{type(cause).__name__}: {text}" if text else type(cause).__name__
    what = what[:LINE_LENGTH]
    return ProgramError(what if line is None else f"line {line}: {what}", line=line)


def _outside(cause: BaseException, text: str) -> str | None:
    """Return what outside the API a failed program reached for, if it did."""
    match cause:
        case ImportError():
            return text
        case AttributeError():
            hidden = _HIDDEN_ATTRIBUTE.search(text)
            return hidden and hidden[1]
        case NotImplementedError():
            called = _CALLED_BACK.search(text)
            return called[1] if called and called[1] in FORBIDDEN_BUILTINS else None
        case _:
            return None
