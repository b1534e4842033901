"""Find the words of a text that tell to turn, where that is certain."""

import re
from collections.abc import Sequence
from typing import NamedTuple

COMMAND = re.compile(
    r"\b(?:turn(?:ing)?|go(?:ing)?|bear(?:ing)?|make|take|taking|keep|then|and|at the end,?)"
    r"(?: (?:a|the|another|your|slight|slightly|sharp|first|second|third|next|to the|"
    r"immediately|directly|straight))* (?P<side>left|right)\b"
    r"(?! (?:hand|side|away|after|now|in front|ahead|there is|here))",
    re.IGNORECASE,
)
ANY_SIDE = re.compile(r"\b(?:left|right)\b", re.IGNORECASE)
BESIDE = re.compile(
    r"\b(?:on|to|at|from|by|along) (?:the|your|its|my|our|either) (?P<side>left|right)\b"
    r"|\b(?P<hand>left|right)[- ](?:hand|side)\b",
    re.IGNORECASE,
)
NO_TURN = re.compile(
    r"\b(?P<side>right)\b(?= (?:after|away|now|there|here|before|next|behind|beside|"
    r"opposite|across|ahead|in front)\b|\?)"
    r"|(?:all|that's|that is|is that|am I|I'm|quite) (?P<same>right)\b",
    re.IGNORECASE,
)
"""A `right` that is no turn."""
AMBIGUOUS = re.compile(
    r"right (?:at|by|in|into|on|to|where|when|up|down|through|past|along)\b",
    re.IGNORECASE,
)
"""A `right` that may mean `just`."""
BEGINS = re.compile(
    r"(?:^|[.!?\n:;,)]|\b(?:first|second|third|next|then|and)) *$", re.IGNORECASE
)
"""What stands before a `right` that begins a clause or is counted."""


class ToldSide(NamedTuple):
    """A word that tells to turn."""

    side: str
    start: int
    """Character of the text."""
    end: int


def commands(text: str) -> list[ToldSide]:
    """Return the words that plainly tell to turn.

    >>> [each.side for each in commands("Turn left, pass the bench on your right.")]
    ['left']
    """
    return [
        ToldSide(found["side"].lower(), found.start("side"), found.end("side"))
        for found in COMMAND.finditer(text)
    ]


def certain_sides(text: str, sides: Sequence[str]) -> list[ToldSide] | None:
    """Return which word tells which turn, or None where that is not certain.

    It is certain where every `left` and `right` that does not plainly say something else
    can only be a turn, and these are as many as the turns of the route and go the same
    ways as `sides`.
    """
    other: set[int] = set()
    for beside in BESIDE.finditer(text):
        other.add(beside.start("side" if beside["side"] else "hand"))
    other.update(
        found.start("side" if found["side"] else "same")
        for found in NO_TURN.finditer(text)
    )
    plain = {each.start for each in commands(text)}
    found: list[ToldSide] = []
    for each in ANY_SIDE.finditer(text):
        if each.start() in other:
            continue
        ambiguous = AMBIGUOUS.match(text, each.start()) is not None
        begins = BEGINS.search(text[: each.start()]) is not None
        if ambiguous and each.start() not in plain and not begins:
            return None
        found.append(ToldSide(each[0].lower(), each.start(), each.end()))
    return found if [each.side for each in found] == list(sides) else None
