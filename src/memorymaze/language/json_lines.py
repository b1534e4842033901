"""JSONL files, one record per line, with messages that name file and line."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from memorymaze.errors import ProgramFileError

PROBLEMS_SHOWN = 20


def lines_of(path: str | Path) -> list[tuple[str, str]]:
    """Return the lines of a file that are not blank, each with its place, `file:line`.

    Raises:
        ProgramFileError: The file cannot be read, is not UTF-8, or has no line.
    """
    path = Path(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        reason = error.strerror or str(error)
        raise ProgramFileError(f"{path}: cannot be read ({reason})") from None
    except UnicodeDecodeError as error:
        raise ProgramFileError(
            f"{path}: expected UTF-8, got byte {error.object[error.start]:#04x} at offset "
            f"{error.start}; save the file as UTF-8"
        ) from None
    lines = enumerate(text.split("\n"), start=1)
    found = [(f"{path}:{number}", line) for number, line in lines if line.strip()]
    if not found:
        raise ProgramFileError(
            f"{path}: expected one JSON record per line, the file is empty"
        )
    return found


def json_record(line: str) -> dict[str, Any]:
    """Read one line.

    Raises:
        ValueError: It is no JSON record; says what is there.
    """
    try:
        record = json.loads(line)
    except RecursionError:
        raise ValueError("expected one JSON record, got one nested too deep") from None
    except ValueError:
        raise ValueError(
            f"expected one JSON record, got text that is not JSON: {shown(line)}"
        ) from None
    if not isinstance(record, dict):
        raise ValueError(f"expected one JSON record {{…}}, got {shown(line)}")
    return record


def shown(value: object) -> str:
    """Return what came, cut to a length that fits a message."""
    text = repr(value)
    cut = text if len(text) <= 60 else text[:57] + "…"
    return cut.encode("utf-8", "backslashreplace").decode()


def some(names: Sequence[str], most: int = 10) -> str:
    """Return names in a line, the first few and how many more there are."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")


def listed(problems: Sequence[str]) -> ProgramFileError:
    """Return the error that lists problems, the first 20 in full."""
    more = len(problems) - PROBLEMS_SHOWN
    lines = [*problems[:PROBLEMS_SHOWN], *([f"… and {more} more"] if more > 0 else [])]
    noun = "problem" if len(problems) == 1 else "problems"
    return ProgramFileError(f"{len(problems)} {noun}:\n" + "\n".join(lines))
