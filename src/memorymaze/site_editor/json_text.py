"""A JSON text made to say something else, with all that stays the same as it was written."""

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

DECODER = json.JSONDecoder()
BLANK = re.compile(r"[ \t\n\r]*")


@dataclass(frozen=True, slots=True)
class Written:
    """A value, and where it is written."""

    value: Any
    start: int
    end: int
    parts: tuple["Written", ...] = ()
    """Elements of a list, or values of an object in the order of its names."""


def read_written(text: str, start: int = 0) -> Written:
    """Return what is written from a place on, in a text that is known to be JSON."""
    start = _past_blanks(text, start)
    if text[start] not in "{[":
        value, end = DECODER.raw_decode(text, start)
        return Written(value, start, end)
    names: list[str] = []
    parts: list[Written] = []
    at = _past_blanks(text, start + 1)
    while text[at] not in "}]":
        if text[start] == "{":
            name, at = DECODER.raw_decode(text, at)
            names.append(name)
            at = _past_blanks(text, at) + 1  # the colon
        parts.append(read_written(text, at))
        at = _past_blanks(text, parts[-1].end)
        if text[at] == ",":
            at = _past_blanks(text, at + 1)
    values = [part.value for part in parts]
    value = dict(zip(names, values, strict=True)) if text[start] == "{" else values
    return Written(value, start, at + 1, tuple(parts))


def rewritten(text: str, old: Written, new: Any) -> str:
    """Return the text of a new value that stands in the place of an old one."""
    match old.value, new:
        case _ if is_same(old.value, new):
            return text[old.start : old.end]
        case dict(), dict() if old.value.keys() == new.keys():
            values = [new[name] for name in old.value]
        case list(), list() if len(old.value) == len(new):
            values = new
        case _:
            return dumped(new)
    pairs = zip(old.parts, values, strict=True)
    return refilled(text, old, [rewritten(text, part, value) for part, value in pairs])


def refilled(text: str, old: Written, contents: Iterable[str]) -> str:
    """Return the text of an object or list with other contents, one for each part."""
    pieces: list[str] = []
    at = old.start
    for part, content in zip(old.parts, contents, strict=True):
        pieces += [text[at : part.start], content]
        at = part.end
    return "".join([*pieces, text[at : old.end]])


def relisted(text: str, old: Written, contents: Sequence[str]) -> str:
    """Return the text of a list with other elements, which may not have been there."""
    if len(contents) == len(old.parts) and old.end:
        return refilled(text, old, contents)
    if not contents or not old.parts:
        return "[" + ",".join(f"\n    {each}" for each in contents) + "\n  ]"
    first, last = old.parts[0], old.parts[-1]
    lead, tail = text[old.start : first.start], text[last.end : old.end]
    others = [
        text[a.end : b.start] for a, b in zip(old.parts, old.parts[1:], strict=False)
    ]
    return lead + (others[-1] if others else f",{lead[1:]}").join(contents) + tail


def is_same(old: Any, new: Any) -> bool:
    """Tell whether values are the same to a browser: 5 is 5.0, and numbers are floats."""
    match old, new:
        case (bool() | None, _) | (_, bool() | None):
            return old is new
        case ((int() | float()), (int() | float())):
            return float(old) == float(new)
        case dict(), dict():
            return old.keys() == new.keys() and all(
                is_same(value, new[name]) for name, value in old.items()
            )
        case list(), list():
            pairs = zip(old, new, strict=False)
            return len(old) == len(new) and all(is_same(*pair) for pair in pairs)
        case _:
            return bool(old == new)


def dumped(value: Any) -> str:
    """Return a value as one line."""
    text = json.dumps(value, ensure_ascii=False)
    # Halves of characters can be written in JSON, but not in UTF-8.
    return text if text.isprintable() else json.dumps(value)


def _past_blanks(text: str, at: int) -> int:
    found = BLANK.match(text, at)
    assert found is not None
    return found.end()
