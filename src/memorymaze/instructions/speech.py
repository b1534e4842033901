"""Marks of speaking from memory in a text: hedges, fillers, corrections.

Plain lists of English phrases. They count what is said, not what is meant: "sorry" is
a correction here even where someone apologises.
"""

import re
from dataclasses import dataclass
from typing import Literal

Kind = Literal["hedge", "filler", "correction"]

HEDGES = (
    r"i (?:think|guess|believe|suppose|reckon|assume|imagine|feel like)",
    r"(?:i'm|i am|am) (?:not|never) (?:\w+ ){0,2}(?:sure|certain)",
    r"not (?:\w+ )?(?:100 ?%|hundred percent) (?:sure|certain)",
    r"(?:if|as far as) i (?:remember|recall|know)(?: (?:right|rightly|correctly|well))?",
    r"i (?:don't|do not|can't|cannot) (?:quite |really |exactly )?(?:remember|recall|know)",
    r"i(?:'d| would) say",
    r"i(?:'m| am) (?:pretty|fairly|quite|almost) (?:sure|certain)",
    r"(?:maybe|perhaps|probably|possibly|presumably|apparently|supposedly)",
    r"(?:might|may|could|should) be",
    r"(?:kind|sort) of",
    r"more or less|give or take|or thereabouts",
    r"(?:or so|or something(?: like that)?|or somewhere|or whatever)",
    r"(?:something|somewhere) like",
    r"(?:roughly|approximately|around|about)(?= (?:\d|a |an |half|one|two|three|four|five|"
    r"six|seven|eight|nine|ten|eleven|twelve|thirteen|fourteen|fifteen|twenty|thirty|"
    r"forty|fifty|sixty))",
    r"it (?:seems|looks like)|seems to",
)
"""Signs of doubt, as regular expressions over small letters."""

FILLERS = (
    r"u+m+|u+h+|e+r+m*|h+m+|m+hm+|mm+|ah|oh|eh|huh|ehm|uhm",
    r"(?:ok|okay|alright|all right|yeah|yep|well|now|so|anyway|like)(?=,)",
    r"(?:you know|you see)(?=[,.?!])",
    r"let me (?:see|think)|let's see|how (?:do|can|shall) i (?:say|put)(?: (?:it|this))?",
    r"what's it called|what do you call (?:it|that)",
    r"does that make sense",
)
"""Words that fill time, as regular expressions over small letters."""

CORRECTIONS = (
    r"(?:no,? ){0,2}wait(?:,? (?:no|wait|sorry))*(?=[,.! -]|$)(?! (?:for|at|until|there|here|in)\b)",
    r"(?:no,? )?(?:i'm |so |very )*sorry",
    r"i mean(?:t)?",
    r"(?:or|well) rather|scratch that|strike that|make that|correction",
    r"hang on|hold on(?= ?[,.])",
    r"my mistake|what am i saying|i tell a lie|let me (?:correct|start (?:again|over))",
    r"no,? (?=actually)|actually(?=,? (?:no|it|the|that|you|left|right))",
    r"no,? no(?:,? no)*",
)
"""Signs that something is taken back, as regular expressions over small letters."""

_RESTARTS = (
    re.compile(r"\b(?!(?:very|left|right|straight|long|click)\b)([a-z']+) \1\b(?! \1)"),
    re.compile(
        r"\b(the|a|an|to|at|and|i|we|then|until|with|of|there|that's|go|take), \1\b"
    ),
    re.compile(r"\b[a-z]{1,6}(?:-(?= )| ?\.\.\.?(?= [a-z])|\u2026(?= [a-z]))"),
)
"""A word said twice over ("the, the door"), or broken off ("le- right")."""

_LISTS: tuple[tuple[Kind, tuple[str, ...]], ...] = (
    ("correction", CORRECTIONS),
    ("hedge", HEDGES),
    ("filler", FILLERS),
)
_PATTERNS: tuple[tuple[Kind, re.Pattern[str]], ...] = tuple(
    (kind, re.compile(rf"(?<![\w'-])(?:{'|'.join(phrases)})(?![\w'])"))
    for kind, phrases in _LISTS
)


@dataclass(frozen=True, slots=True)
class SpokenMark:
    """A mark of speaking from memory."""

    kind: Kind
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
    restarts: list[tuple[Kind, re.Pattern[str]]] = [
        ("correction", pattern) for pattern in _RESTARTS
    ]
    for kind, pattern in (*_PATTERNS, *restarts):
        for match in pattern.finditer(plain):
            start, end = match.span()
            if end > start and not any(taken[start:end]):
                taken[start:end] = [True] * (end - start)
                marks.append(SpokenMark(kind, match.group(), start))
    return sorted(marks, key=lambda mark: mark.start)
