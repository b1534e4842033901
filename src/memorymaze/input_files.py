"""Reading what users name: files of a bounded size, text, and JSON.

One refusal for all rooms; writing is in `durable_files.py`.
"""

import json
from pathlib import Path
from typing import Any

from memorymaze.errors import MemoryMazeError

LARGEST_FILE = 2**28
"""Bytes; what is longer, such as an endless device, is refused."""


def read_file(path: str | Path, error: type[MemoryMazeError]) -> bytes:
    """Return the content of a file, a pipe or a device.

    Args:
        path: What a user named.
        error: What to raise.

    Raises:
        MemoryMazeError: Of the kind given: it cannot be read, or is too long.
    """
    try:
        with Path(path).open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", None) or problem
        raise error(f"{path}: cannot be read ({reason})") from None
    if len(content) > LARGEST_FILE:
        raise error(
            f"{path}: expected a file of at most {LARGEST_FILE // 2**20} MiB, got a "
            "longer one"
        )
    return content


def read_text(path: str | Path, error: type[MemoryMazeError]) -> str:
    """Return the text of a file in UTF-8, with or without a byte order mark.

    Raises:
        MemoryMazeError: Of the kind given: it cannot be read, or is not UTF-8.
    """
    try:
        return read_file(path, error).decode("utf-8-sig")
    except UnicodeDecodeError as problem:
        raise error(
            f"{path}: expected UTF-8, got byte {problem.object[problem.start]:#04x} at "
            f"offset {problem.start}; save the file as UTF-8"
        ) from None


def parse_json(text: str | bytes) -> Any:
    """Return what JSON says.

    Raises:
        ValueError: It is no JSON, has a name twice in one object, or more brackets or
            digits than can be read; says where.
    """
    try:
        return json.loads(text, object_pairs_hook=_without_repeats)
    except json.JSONDecodeError as error:
        line = f"line {error.lineno}, " if error.lineno > 1 else ""
        raise ValueError(
            f"expected JSON, got a mistake in {line}column {error.colno}: {error.msg}"
        ) from None
    except UnicodeDecodeError as error:
        raise ValueError(
            f"expected JSON, got other bytes at offset {error.start}"
        ) from None
    except RecursionError:
        raise ValueError("expected JSON, got one nested too deep") from None


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    record = dict(pairs)
    if len(record) != len(pairs):
        names = [name for name, _ in pairs]
        repeated = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"field {repeated!r}: expected it once, got it twice")
    return record
