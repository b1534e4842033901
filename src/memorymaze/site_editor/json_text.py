"""A JSON text made to say something else, with all that stays the same as it was written."""

import json
import re
from collections.abc import Iterable
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
    items: tuple["Item", ...] = ()
    """Of an object or a list."""


class Verbatim(str):
    """A value that is text already."""


@dataclass(frozen=True, slots=True)
class Item:
    """A member of an object, or an element of a list."""

    name: str | None
    lead: str
    """The blanks before it."""
    start: int
    content: Written


def read_written(text: str, start: int = 0) -> Written:
    """Return what is written from a place on, in a text that is known to be JSON."""
    start = _past_blanks(text, start)
    if text[start] not in "{[":
        value, end = DECODER.raw_decode(text, start)
        return Written(value, start, end)
    items: list[Item] = []
    before = start + 1
    at = _past_blanks(text, before)
    while text[at] not in "}]":
        begin, name = at, None
        if text[start] == "{":
            name, at = DECODER.raw_decode(text, at)
            at = _past_blanks(text, at) + 1  # the colon
        content = read_written(text, at)
        items.append(Item(name, text[before:begin], begin, content))
        at = _past_blanks(text, content.end)
        if text[at] == ",":
            before = at + 1
            at = _past_blanks(text, before)
    values = [item.content.value for item in items]
    value = dict(zip([item.name for item in items], values, strict=True))
    return Written(value if text[start] == "{" else values, start, at + 1, tuple(items))


def rewritten(text: str, old: Written, new: Any) -> str:
    """Return the text of a new value that stands in the place of an old one."""
    if isinstance(new, Verbatim):
        return new
    if is_same(old.value, new):
        return text[old.start : old.end]
    if isinstance(old.value, dict) and isinstance(new, dict):
        kept = [
            (
                item.lead,
                text[item.start : item.content.start]
                + rewritten(text, item.content, new[item.name]),
            )
            for item in old.items
            if item.name in new
        ]
        added = [
            (None, f"{dumped(name)}: {dumped(value)}")
            for name, value in new.items()
            if name not in old.value
        ]
        return assembled(text, old, [*kept, *added])
    if (
        isinstance(old.value, list)
        and isinstance(new, list)
        and len(old.items) == len(new)
    ):
        pairs = zip(old.items, new, strict=True)
        parts = [(i.lead, rewritten(text, i.content, value)) for i, value in pairs]
        return assembled(text, old, parts)
    return dumped(new)


def assembled(
    text: str, old: Written, parts: Iterable[tuple[str | None, str]], lead: str = " "
) -> str:
    """Return an object or list of parts, each after its blanks.

    A part without blanks of its own gets those of the others, or `lead`.
    """
    leads = [item.lead for item in old.items] or [lead]
    first, others = leads[0], leads[-1]
    if len(leads) == 1 and "\n" not in first:
        others = lead
    written = ",".join(
        ((own or others) if number else first) + part
        for number, (own, part) in enumerate(parts)
    )
    tail = old.items[-1].content.end if old.items else old.start + 1
    return text[old.start] + written + text[tail : old.end]


def is_same(old: Any, new: Any) -> bool:
    """Tell whether values are the same to a browser: 5 is 5.0, and numbers are floats."""
    match old, new:
        case bool() | None, _:
            return old is new
        case _, bool() | None:
            return False
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
