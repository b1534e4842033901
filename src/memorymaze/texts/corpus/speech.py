"""Marks of speaking from memory in a text: hedges, fillers, corrections.

The phrases are in `data/speech.toml`. They count what is said, not what is meant: "sorry"
is a correction here even where someone apologises.
"""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Literal

_Kind = Literal["hedge", "filler", "correction"]
_Row = dict[str, Any]

PHRASES: dict[str, list[_Row]] = tomllib.loads(
    (files("memorymaze.texts.corpus") / "data/speech.toml").read_text(encoding="utf-8")
)
"""Rows of a pattern with examples and counter-examples, by kind."""


def words_like(rows: Sequence[_Row]) -> re.Pattern[str]:
    """Return a pattern of what any of some rows finds, as whole words."""
    either = "|".join(row["pattern"] for row in rows)
    return re.compile(rf"(?<![\w'-])(?:{either})(?![\w'])")


_PATTERNS: tuple[tuple[_Kind, re.Pattern[str]], ...] = (
    ("correction", words_like(PHRASES["correction"])),
    ("hedge", words_like(PHRASES["hedge"])),
    ("filler", words_like(PHRASES["filler"])),
    *(("correction", re.compile(row["pattern"])) for row in PHRASES["restart"]),
)


@dataclass(frozen=True, slots=True)
class SpokenMark:
    """A mark of speaking from memory."""

    kind: _Kind
    words: str
    """As said, in small letters."""
    start: int
    """Of the mark in the text, characters."""


def spoken_marks(text: str) -> list[SpokenMark]:
    """Find hedges, fillers and corrections in a text, in the order said.

    A stretch of text is counted once: as a correction before a hedge, as a hedge
    before a filler. Words said twice over and words broken off are corrections
    (restarts), after all others.

    >>> [(m.kind, m.words) for m in spoken_marks("Um, left, no wait, right, I think.")]
    [('filler', 'um'), ('correction', 'no wait'), ('hedge', 'i think')]
    """
    plain = text.lower().replace("\u2019", "'")
    taken = [False] * len(plain)
    marks: list[SpokenMark] = []
    for kind, pattern in _PATTERNS:
        for match in pattern.finditer(plain):
            start, end = match.span()
            if end > start and not any(taken[start:end]):
                taken[start:end] = [True] * (end - start)
                marks.append(SpokenMark(kind, match.group(), start))
    return sorted(marks, key=lambda mark: mark.start)
