"""What is told of code that failed: a line for its result, more for its trace."""

import importlib
import sys
import traceback
from pathlib import Path

from memorymaze.basics.errors import LanguageModelError, ProgramError

LINE_LENGTH = 500
"""Characters of a failure's line, at most."""

TRACEBACK_LINES = 60
"""Lines of a traceback that are kept: the last ones."""

NOBODYS_PLACES = (
    "<",
    str(Path(importlib.__file__).parent),
    str(Path(__file__).parents[1] / "runs"),
    str(Path(__file__).parent / "own_code"),
)
"""Beginnings of the files in which no agent's fault lies: what imports and calls it."""


class WorkerLost(Exception):
    """Stands for the end of a worker process, of which nothing else is known."""


def failure_line(problem: BaseException, agent: object = None) -> str:
    """Return one printable line: what was raised, and where, in the agent's own file.

    The agent tells which file is its own; None where there is no agent yet.
    """
    place = _place(problem, agent)
    line = "".join(
        each if each.isprintable() else each.encode("unicode_escape").decode()
        for each in f"{type(problem).__name__}: {_message(problem)}"
    )
    return line[: LINE_LENGTH - len(place)] + place


def failure_traceback(problem: BaseException) -> list[str]:
    """Return where an unforeseen failure arose, as Python tells it, line by line.

    Empty for failures whose message says all there is to say.
    """
    if isinstance(problem, ProgramError | LanguageModelError | WorkerLost):
        return []
    lines = "".join(traceback.format_exception(problem)).splitlines()
    return lines[-TRACEBACK_LINES:]


def _message(problem: BaseException) -> str:
    try:
        said = str(problem)
    except Exception as error:
        said = f"a message that cannot be shown ({type(error).__name__})"
    return " ".join(said.split()) or "no message"


def _place(problem: BaseException, agent: object) -> str:
    """Return ` (own_agent.py, line 7)`, or nothing where the message says it."""
    if isinstance(problem, ProgramError):
        known = problem.line is None or f"line {problem.line}:" in str(problem)
        return "" if known else f" (line {problem.line} of the program)"
    if isinstance(problem, LanguageModelError | SyntaxError):
        return ""
    places = [
        (frame.f_code.co_filename, line)
        for frame, line in traceback.walk_tb(problem.__traceback__)
        if not frame.f_code.co_filename.startswith(NOBODYS_PLACES)
    ]
    module = sys.modules.get(type(agent).__module__)
    own_file = getattr(module, "__file__", None)
    own = [place for place in places if place[0] == own_file]
    if not places:
        return ""
    file, line = (own or places)[-1]
    return f" ({Path(file).name}, line {line})"
