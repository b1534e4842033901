"""Which words of English route descriptions do which work: read once, from `data`."""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

from memorymaze.language.plans import Kind

_DATA = files("memorymaze.language.reading") / "data"


def _table(name: str) -> dict[str, Any]:
    return tomllib.loads((_DATA / name).read_text(encoding="utf-8"))


def _joined(pattern: str, parts: Mapping[str, str]) -> str:
    """Return a pattern in one line, its parts put in."""
    joined = "".join(line.removeprefix("    ") for line in pattern.splitlines())
    for name, part in parts.items():
        joined = joined.replace(f"<<{name}>>", _joined(part, {}))
    return joined


@dataclass(frozen=True, slots=True)
class Pattern:
    """Words that do one kind of work, or that plainer words are read for."""

    name: str
    work: str
    """One letter for the kind, which `chunks.py` explains; or the plainer words."""
    regex: re.Pattern[str]
    examples: tuple[Any, ...]
    """Texts in which the words in brackets are what the pattern claims; or pairs of what
    is said and what is read for it."""
    counter_examples: tuple[str, ...]
    """Texts in which it claims nothing."""


def _read_patterns(file: str, rows: str, work: str) -> tuple[Pattern, ...]:
    table = _table(file)
    return tuple(
        Pattern(
            row["name"],
            row[work],
            re.compile(_joined(row["pattern"], table["parts"])),
            tuple(row["examples"]),
            tuple(row["counter_examples"]),
        )
        for row in table[rows]
    )


PATTERNS = _read_patterns("patterns.toml", "pattern", "kind")
"""The first that matches at a place claims the words there."""
PLAIN_WORDS = _read_patterns("plain_words.toml", "plain", "plain")

_words = _table("words.toml")


def _list(name: str) -> frozenset[str]:
    return frozenset(_words[name].split())


FILLERS = _list("fillers")
SURFACES = _list("surfaces")
UNSEEN = _list("unseen")
COMMON = _list("common")
PLAIN = _list("plain") | SURFACES
LOOKS = _list("looks")
PLURALS = _list("plurals")
SIGNS = _list("signs")
SIGN_BINDERS = _list("sign_binders")
IDLE_ENDS = _list("idle_ends")
THINGS_IN_ING = _list("things_in_ing")
OFTEN = _list("often")
ORDINALS: Mapping[str, int] = _words["ordinals"]
SPELLINGS = dict(
    pair.replace("_", " ").split("=") for pair in _words["spellings"].split()
)
CLOCK: Mapping[str, str] = {
    hour: way for way, hours in _words["clock"].items() for hour in hours.split()
}
ONES = {word: number for number, word in enumerate(_words["ones"].split(), 1)}
TENS = {word: 10 * number for number, word in enumerate(_words["tens"].split(), 2)}
QUANTITIES: Mapping[str, float] = _words["quantities"]
KINDS_OF_THINGS: Mapping[str, Kind] = {
    noun: kind for kind, nouns in _words["kinds"].items() for noun in nouns.split()
}
"""What a thing is, by the head noun of its name."""
FLOOR_WORDS = tuple(
    (re.compile(rf"\b(?:{words})\b"), look)
    for words, look in [*_words["floors"], *_words["coverings"]]
)
"""Words that describe a floor, those that tell most first, and what to look for."""
PLAIN_FLOORS = frozenset(look for _, look in _words["coverings"])
"""Floors by which nobody tells a way: one walks on them, and does not turn to them."""
