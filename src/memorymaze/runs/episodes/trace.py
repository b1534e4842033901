"""What happened in an episode, entry by entry, as compressed lines of JSON."""

import gzip
import hashlib
import json
import math
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from pydantic import ValidationError

from memorymaze.agents.notes import LeftOutNote
from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.failures import LINE_LENGTH
from memorymaze.runs.episodes.shards import parts_in
from memorymaze.runs.episodes.trace_entries import (
    CallEntry,
    NoteEntry,
    TraceEntry,
    line_of,
    note_entry,
    read_entry,
)

NAME_LIMIT = 150
"""Longest file stem made of an episode id; longer ones are cut and numbered."""

LARGEST_TRACE = 2**26
"""Bytes, unpacked; a hundred times what an episode of usual length leaves."""

LARGEST_ENTRY = 2**20
"""Bytes of a note, or of a call and its result."""

_AGAIN = "delete its line in episodes.jsonl, and --resume runs the episode again"

DEEPEST = 50
"""Lists and objects inside one another that are written; circles end here."""


def trace_path(folder: Path, episode_id: str) -> Path:
    """Return the file of an episode's trace in a run folder, or in that of its part.

    Characters that do not belong into file names are written as `%2F`.
    """
    stem = quote(episode_id, safe="")
    if len(stem) > NAME_LIMIT:
        digest = hashlib.sha256(episode_id.encode()).hexdigest()[:12]
        stem = f"{stem[:NAME_LIMIT]}-{digest}"
    place = Path("traces") / f"{stem}.jsonl.gz"
    if not (folder / "traces").is_dir():
        for part in parts_in(folder):
            if (part / place).exists():
                return part / place
    return folder / place


def trace_content(entries: Iterable[TraceEntry]) -> bytes:
    """Return what the file of a trace holds; equal entries give equal bytes."""
    return gzip.compress(trace_lines(entries), mtime=0)


def keep_trace(folder: Path, episode_id: str, content: bytes) -> None:
    """Write the file of a trace; it is there in full or not at all."""
    write_whole(trace_path(folder, episode_id), content)


def trace_lines(entries: Iterable[TraceEntry]) -> bytes:
    """Return trace entries as lines of JSON; what JSON does not know as its `repr`.

    What is written can be read again: what is too long of notes and calls, and what is too
    much of them, is left out, and told of in its place. All calls are there.
    """
    listed = list(entries)
    lines = [_bounded(entry) for entry in listed]
    if sum(map(len, lines)) > LARGEST_TRACE:
        lines = _least(listed, lines)
    return b"".join(lines)


def plain_entries(entries: Iterable[TraceEntry]) -> tuple[dict[str, Any], ...]:
    """Return trace entries as their lines of JSON are read."""
    return tuple(_plain(line_of(entry)) for entry in entries)


def read_trace(folder: Path, episode_id: str) -> Iterator[TraceEntry]:
    """Read an episode's trace, entry by entry."""
    path = trace_path(folder, episode_id)
    try:
        with gzip.open(path, "rb") as file:
            content = file.read(LARGEST_TRACE + 1)
        if len(content) > LARGEST_TRACE:
            raise RunFolderError(
                f"{path}: the trace of episode {episode_id!r} is too long: expected at most "
                f"{LARGEST_TRACE // 2**20} MiB unpacked, got more; {_AGAIN}"
            )
        for number, line in enumerate(content.splitlines(), start=1):
            yield _entry_in(line, f"{path}:{number}")
    except FileNotFoundError:
        raise RunFolderError(
            f"{path}: expected the trace of episode {episode_id!r}, got no such file"
        ) from None
    except (OSError, EOFError, ValueError, RecursionError, zlib.error) as error:
        raise RunFolderError(
            f"{path}: the trace of episode {episode_id!r} is damaged ({error}); {_AGAIN}"
        ) from None


def _entry_in(line: bytes, place: str) -> TraceEntry:
    try:
        return read_entry(json.loads(line))
    except ValidationError as error:
        wrong = error.errors()[0]
        where = ".".join(map(str, wrong["loc"])) or "line"
        raise RunFolderError(
            f"{place}: expected an entry as memorymaze writes it, got another "
            f"({where}: {wrong['msg']})"
        ) from None


def _bounded(entry: TraceEntry) -> bytes:
    """Return the line of an entry; of a long note or call what it was."""
    line = _encoded(entry)
    if len(line) > LARGEST_ENTRY:
        if isinstance(entry, NoteEntry):
            what = f"note {entry.about}"[:LINE_LENGTH]
            return _left_out(entry.time, what, 1, len(line))
        if isinstance(entry, CallEntry):
            return _shortened(entry, len(line))
    return line


def _least(entries: Sequence[TraceEntry], lines: Sequence[bytes]) -> list[bytes]:
    """Return the lines for which there is room, with one entry for all notes left out."""
    least = [_least_of(*each) for each in zip(entries, lines, strict=True)]
    room = LARGEST_TRACE - LARGEST_ENTRY - sum(map(len, least))
    kept: list[bytes] = []
    for line, short in zip(lines, least, strict=True):
        room -= len(line) - len(short)
        kept.append(line if room >= 0 else short)
    out = [
        (place, entry.time)
        for place, entry in enumerate(entries)
        if isinstance(entry, NoteEntry) and not kept[place]
    ]
    if out:
        size = sum(len(lines[place]) for place, _ in out)
        first, since = out[0]
        kept[first] = _left_out(since, "further notes", len(out), size)
    return kept


def _least_of(entry: TraceEntry, line: bytes) -> bytes:
    if isinstance(entry, NoteEntry):
        return b""
    if isinstance(entry, CallEntry):
        return min(line, _shortened(entry, len(line)), key=len)
    return line


def _shortened(entry: CallEntry, size: int) -> bytes:
    told = {"left_out": f"{size} bytes"}
    return _encoded(replace(entry, arguments={}, result=told))


def _left_out(time: float, what: str, entries: int, size: int) -> bytes:
    return _encoded(note_entry(time, LeftOutNote(what, entries, size)))


def _encoded(entry: TraceEntry) -> bytes:
    return f"{_line(line_of(entry))}\n".encode("utf-8", "backslashreplace")


def _line(entry: Mapping[str, object]) -> str:
    try:
        return _ENCODER.encode(entry)
    except (TypeError, ValueError, RecursionError):
        # Odd keys, numbers that are not finite and circles are rare, and looking for
        # them is slow.
        return _ENCODER.encode(_plain(entry))


def _plain(value: object, depth: int = 0) -> Any:
    """Return a value as JSON knows it; what JSON does not know as its description."""
    if depth > DEEPEST:
        return f"<{type(value).__name__} nested too deep to write down>"
    depth += 1
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else repr(value)
    if isinstance(value, np.generic | np.ndarray):
        return _plain(value.tolist(), depth)
    if is_dataclass(value) and not isinstance(value, type):
        parts = ((each.name, getattr(value, each.name)) for each in fields(value))
        return {name: _plain(part, depth) for name, part in parts}
    if isinstance(value, Mapping):
        return {str(key): _plain(part, depth) for key, part in value.items()}
    if isinstance(value, set | frozenset):
        return [_plain(part, depth) for part in sorted(value, key=_described)]
    if isinstance(value, Sequence) and not isinstance(value, bytes | bytearray):
        return [_plain(part, depth) for part in value]
    return _described(value)


def _described(value: object) -> str:
    try:
        return repr(value)
    except Exception as error:
        return f"<{type(value).__name__} without a description: {type(error).__name__}>"


_ENCODER = json.JSONEncoder(
    ensure_ascii=False, allow_nan=False, separators=(",", ":"), default=_plain
)
