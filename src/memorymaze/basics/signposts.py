"""What a sign's words say about directions."""

import re
from typing import Literal, NamedTuple

Arrow = Literal["left", "right", "ahead", "back"]

ARROWS: dict[str, Arrow] = {
    "←": "left",
    "⬅": "left",
    "→": "right",
    "➡": "right",
    "↑": "ahead",
    "⬆": "ahead",
    "↓": "back",
    "⬇": "back",
}
PHRASES: tuple[tuple[re.Pattern[str], Arrow], ...] = (
    (re.compile(r"\b(?:(?:to|on) the|turn) left\b", re.IGNORECASE), "left"),
    (re.compile(r"\b(?:(?:to|on) the|turn) right\b", re.IGNORECASE), "right"),
    (re.compile(r"\bstraight (?:on|ahead)\b", re.IGNORECASE), "ahead"),
)
ANY_ARROW = re.compile(f"[{''.join(ARROWS)}]")


class Signpost(NamedTuple):
    """Words with the way they point."""

    arrow: Arrow | None
    words: str
    arrow_first: bool
    """Whether the arrow stands to the left of the words."""


def signposts(text: str) -> tuple[Signpost, ...]:
    """Split the text of a sign into what it says about each way.

    Arrows in the text belong to the words next to them, parts being set apart by two
    spaces. Where it has none, `to the right`, `on the left` and `straight on` get an
    arrow, and commas set parts apart.

    >>> [(each.arrow, each.words) for each in signposts("← Lifts   Reception →")]
    [('left', 'Lifts'), ('right', 'Reception')]
    """
    if ANY_ARROW.search(text):
        parts = [part for part in re.split(r"\s{2,}|[|;\n]", text) if part.strip()]
        return tuple(
            _with_arrow(piece) for part in parts for piece in _one_arrow_each(part)
        )
    clauses = [clause.strip() for clause in re.split(r"[,;]", text)]
    pointing: list[Arrow | None] = [_spoken(clause) for clause in clauses]
    if None not in pointing:
        return tuple(map(_spoken_post, pointing, clauses))
    arrow = _spoken(text)
    lines = "\n".join(" ".join(line.split()) for line in text.splitlines())
    return (_spoken_post(arrow, lines),)


def _spoken_post(arrow: Arrow | None, words: str) -> Signpost:
    return Signpost(arrow, words, arrow != "right")


def _spoken(clause: str) -> Arrow | None:
    for pattern, arrow in PHRASES:
        if pattern.search(clause):
            return arrow
    return None


def _one_arrow_each(part: str) -> list[str]:
    if len(ANY_ARROW.findall(part)) < 2:
        return [part]
    leads = bool(ANY_ARROW.match(part.strip()))
    pattern = rf"(?={ANY_ARROW.pattern})" if leads else rf"(?<={ANY_ARROW.pattern})"
    return [piece for piece in re.split(pattern, part) if piece.strip()]


def _with_arrow(piece: str) -> Signpost:
    found = ANY_ARROW.search(piece)
    words = " ".join(ANY_ARROW.sub(" ", piece).split())
    if found is None:
        return Signpost(None, words, True)
    arrow = ARROWS[found.group()]
    return Signpost(arrow, words, not piece[: found.start()].strip())
