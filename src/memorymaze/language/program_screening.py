"""Checks a program as the sandbox does before it runs one, without running it."""

import re
from dataclasses import replace
from typing import Any, cast

from memorymaze.errors import EpisodeOver, ProgramError
from memorymaze.language.sandbox import DEFAULT_LIMITS, ProgramLimits, run_program
from memorymaze.robot.api import Robot

_HALT = "stop()\n"
"""Put before a program: it halts before its own first line."""
_LINE = re.compile(r"^line (\d+)")


def screen_program(program: str, limits: ProgramLimits = DEFAULT_LIMITS) -> list[str]:
    """Parse a program and check its types against the control API.

    Returns:
        What the type checker doubts, without refusing the program for it.

    Raises:
        ProgramError: The sandbox would refuse the program before it runs; `unsafe` when
            it reaches for something outside the API. What only shows while it runs is
            not found.
    """
    if len(program) > limits.program_characters:
        raise ProgramError(
            f"the program has {len(program)} characters; "
            f"at most {limits.program_characters} are allowed"
        )
    room = replace(limits, program_characters=limits.program_characters + len(_HALT))
    doubts: list[str] = []

    def keep(event: dict[str, Any]) -> None:
        doubts.extend(map(_in_the_program, event.get("doubts", ())))

    try:
        run_program(_HALT + program, cast(Robot, _Standing()), room, keep)
    except EpisodeOver as over:
        if over.stopped_by != "agent":
            raise ProgramError("the program takes too long to check") from None
    except ProgramError as error:
        line = None if error.line is None else error.line - 1
        text = _in_the_program(str(error))
        raise ProgramError(text, line=line, unsafe=error.unsafe) from None
    return doubts


class _Standing:
    """A robot that only ever stops."""

    def stop(self) -> None:
        raise EpisodeOver("agent")


def _in_the_program(text: str) -> str:
    """Return a message with the line of the program in the place of the line checked."""
    return _LINE.sub(lambda found: f"line {int(found[1]) - 1}", text)
