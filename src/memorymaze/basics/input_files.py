"""Reading what users name: files of a bounded size, text, JSON and its records.

One refusal for all rooms; writing is in `durable_files.py`.
"""

import gzip
import hashlib
import json
import re
import tomllib
import zlib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

from memorymaze.basics.errors import MemoryMazeError, did_you_mean

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError

_Model = TypeVar("_Model", bound="BaseModel")

LARGEST_FILE = 2**28
"""Bytes; what is longer, such as an endless device, is refused."""
PROBLEMS_SHOWN = 20
LONGEST_SHOWN = 60
"""Characters of a wrong value that a message shows."""


@dataclass(frozen=True, slots=True)
class FileStamp:
    """A file as it was when it was read."""

    name: str
    sha256: str


def stamp_file(path: str | Path, name: str | None = None) -> FileStamp:
    """Return a file's name and fingerprint."""
    path = Path(path)
    return FileStamp(name or path.name, hashlib.sha256(path.read_bytes()).hexdigest())


def read_file(path: str | Path, error: type[MemoryMazeError]) -> bytes:
    """Return the content of a file, a pipe or a device; unpacked where it ends in `.gz`.

    What cannot be read, or is too long, raises an error of the kind given.
    """
    try:
        opened = gzip.open if Path(path).suffix == ".gz" else open
        with opened(path, "rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except (OSError, EOFError, ValueError, zlib.error) as problem:
        reason = getattr(problem, "strerror", None) or problem
        raise error(
            f"{path}: cannot be read ({reason})",
            is_missing=isinstance(problem, FileNotFoundError | NotADirectoryError),
        ) from None
    if len(content) > LARGEST_FILE:
        raise error(
            f"{path}: expected a file of at most {LARGEST_FILE // 2**20} MiB, got a "
            "longer one"
        )
    return content


def read_text(path: str | Path, error: type[MemoryMazeError]) -> str:
    """Return the text of a file in UTF-8, with or without a byte order mark."""
    return decoded(read_file(path, error), path, error)


def decoded(content: bytes, path: str | Path, error: type[MemoryMazeError]) -> str:
    """Return the text that a file's content is, as `read_text` does."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as problem:
        raise error(
            f"{path}: expected UTF-8, got byte {problem.object[problem.start]:#04x} at "
            f"offset {problem.start}; save the file as UTF-8"
        ) from None


def read_lines(path: str | Path, error: type[MemoryMazeError]) -> list[tuple[str, str]]:
    """Return the lines of a file that are not blank, each with its place, `file:line`."""
    lines = enumerate(read_text(path, error).split("\n"), start=1)
    found = [(f"{path}:{number}", line) for number, line in lines if line.strip()]
    if not found:
        raise error(f"{path}: expected one JSON record per line, the file is empty")
    return found


def parse_json(text: str | bytes) -> Any:
    """Return what JSON says.

    What is no JSON, has a name twice in one object, or more brackets or digits than can be
    read raises `ValueError`, which says where.
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


def parse_record(line: str | bytes) -> dict[str, Any]:
    """Return the record that a line of JSON is; `ValueError` says what else it is."""
    record = parse_json(line)
    if not isinstance(record, dict):
        raise ValueError(f"expected one JSON record {{…}}, got {shown(record)}")
    return cast(dict[str, Any], record)


def parse_toml(
    text: str, path: str | Path, error: type[MemoryMazeError]
) -> dict[str, Any]:
    """Return what the TOML of a file says; no TOML raises an error of the kind given."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as mistake:
        raise error(f"{path}: expected TOML, got a mistake: {mistake}") from None


def read_toml(
    path: Path,
    model: type[_Model],
    error: type[MemoryMazeError],
    known: Collection[str],
) -> tuple[str, _Model]:
    """Return the text of a TOML file, and what it says as a model.

    What is wrong raises an error of the kind given, which names the line of each field; one
    that there is not may be meant for a `known` one.
    """
    from pydantic import ValidationError

    text = read_text(path, error)
    content = parse_toml(text, path, error)
    try:
        return text, model.model_validate(content)
    except ValidationError as wrong:
        problems: list[str] = []
        for where, said in mistakes(wrong):
            if "Extra inputs" in said:
                meant = did_you_mean(where.rpartition(".")[2], known)
                said = f"expected no field of this name{meant}"
            problems.append(field_problem(path, text, where, said))
        raise refusal(problems, error) from None


def field_problem(path: Path, text: str, where: str, said: str) -> str:
    """Return what is wrong with a field of a TOML text, with the line of it."""
    field = f"field {where!r}: " if where else ""
    return f"{field_place(path, text, where)}: {field}{said}"


def field_place(path: Path, text: str, where: str) -> str:
    """Return file and line of a field; of the table that lacks it, where it is missing."""
    lines = field_lines(text)
    while where and where not in lines:
        where = where[: max(where.rfind("."), where.rfind("["), 0)]
    return f"{path}:{lines.get(where, 1)}"


def field_lines(text: str) -> dict[str, int]:
    """Return the line of each field of a TOML text, by places such as `routes[1].video`."""
    lines: dict[str, int] = {}
    counts: dict[str, int] = {}
    table, quotes = "", ""
    for number, line in enumerate(text.splitlines(), start=1):
        if quotes:
            quotes = "" if quotes in line else quotes
            continue
        if line.lstrip().startswith("#"):
            continue
        header = re.match(r"\s*(\[\[?)\s*([\w.-]+)\s*\]", line)
        field = re.match(r"\s*([\w-]+)\s*=", line)
        if header:
            name = re.sub(r"^(\w+)(?=\.)", lambda m: _latest(m[1], counts), header[2])
            if header[1] == "[[":
                counts[name] = counts.get(name, -1) + 1
            table = _latest(name, counts)
            lines[table] = number
        elif field:
            lines[f"{table}.{field[1]}".lstrip(".")] = number
        for mark in ('"""', "'''"):
            if line.count(mark) % 2:
                quotes = mark
    return lines


def _latest(name: str, counts: dict[str, int]) -> str:
    return f"{name}[{counts[name]}]" if name in counts else name


def unknown_fields(record: Mapping[str, Any], known: Iterable[str]) -> list[str]:
    """Return the names in a record that its format does not know.

    One that looks like a misspelt name that the record lacks raises `ValueError`.
    """
    known = list(known)
    unknown = [name for name in record if name not in known]
    lacking = [name for name in known if name not in record]
    for name in unknown:
        meant = did_you_mean(name, lacking, cutoff=0.75)
        if meant:
            raise ValueError(f"field {name!r} is unknown{meant}")
    return unknown


def mistakes(error: "ValidationError") -> Iterator[tuple[str, str]]:
    """Yield where each mistake in a record is, and what was expected and came there.

    The place is as in `exits[0].to`, empty for the whole record.
    """
    for detail in error.errors(include_url=False):
        where = ""
        for step in detail["loc"]:
            where += f"[{step}]" if isinstance(step, int) else f".{step}"
        where = where.lstrip(".")
        if detail["type"] == "missing":
            yield where, "expected this member, got none; add it"
            continue
        wanted = _KINDS.get(detail["type"], detail["msg"])
        for opening, instead in _OPENINGS.items():
            if wanted.startswith(opening):
                wanted = instead + wanted.removeprefix(opening)
        yield where, f"expected {wanted}, got {shown(detail['input'])}"


_KINDS = {
    "dataclass_type": "a record {…}",
    "dict_type": "a record {…}",
    "list_type": "a list",
    "model_type": "a record {…}",
    "tuple_type": "a list",
}
_OPENINGS = {
    "Input should be ": "",
    "List should have ": "a list with ",
    "String should have ": "a text with ",
    "Tuple should have ": "a list with ",
    "Value error, expected ": "",
}


def writable(text: str) -> str:
    """Return a text that can be written as UTF-8."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise ValueError("expected text without halves of characters") from None
    return text


def shown(value: object) -> str:
    """Return what came, cut to a length that fits a message."""
    try:
        text = (
            value
            if isinstance(value, str)
            else json.dumps(value, ensure_ascii=False, default=repr)
        )
    except RecursionError:
        return "something nested too deep to show"
    cut = text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 3] + "…"
    return (
        (repr(cut) if isinstance(value, str) else cut)
        .encode("utf-8", "backslashreplace")
        .decode()
    )


def refusal(
    problems: Sequence[object], error: type[MemoryMazeError]
) -> MemoryMazeError:
    """Return the error that lists problems, the first 20 in full."""
    more = len(problems) - PROBLEMS_SHOWN
    lines = [str(problem) for problem in problems[:PROBLEMS_SHOWN]]
    lines += [f"… and {more} more"] if more > 0 else []
    noun = "problem" if len(problems) == 1 else "problems"
    return error(f"{len(problems)} {noun}:\n" + "\n".join(lines))


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    record = dict(pairs)
    if len(record) != len(pairs):
        names = [name for name, _ in pairs]
        repeated = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"field {repeated!r}: expected it once, got it twice")
    return record
