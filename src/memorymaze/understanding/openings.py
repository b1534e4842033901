"""Openings and junctions: `the second left`, `at the crossing`, `one on the right`."""

import re
from dataclasses import dataclass

from memorymaze.routes.plan import Junction, Side
from memorymaze.understanding.clause import Clause, side_of
from memorymaze.understanding.events import Event
from memorymaze.understanding.words import ORDINALS

_TAKEN = re.compile(r"opening|turn|gap|exit|fork|branch")
"""Nouns for openings that one takes, not merely walks along."""


@dataclass(slots=True)
class _Opening:
    """The words for one opening."""

    ordinal: int | None = None
    nearest: bool = False
    count: int | None = None
    noun: str = ""
    side: Side | None = None
    stated: bool = False
    """Whether its side was said as a bare direction: `third turning is left`."""


def read_opening(
    clause: Clause, start: int, *, turned: bool
) -> tuple[list[Event], int]:
    """Read the words for an opening from an index on.

    Args:
        clause: The clause.
        start: Index of an ordinal, a junction noun, or a number before one.
        turned: Whether the clause has told a turn already.
    """
    opening, at = _words_of(clause, start)
    before, after = clause.kinds[:start], clause.kinds[at:]
    if not opening.noun and opening.side is None and after.startswith("N"):
        return [], at  # the ordinal of a thing: "the second door"
    way = Event(
        "way",
        side=opening.side,
        ordinal=opening.ordinal,
        nearest=opening.nearest,
    )
    if "P" in before and not re.search("P.*T", before):
        plural = opening.noun.endswith("s")
        count = opening.count or (None if plural else 1)
        return [Event("pass_ways", count=count, side=opening.side)], at
    if opening.side is None and opening.ordinal is None:
        return _bare(opening, before, after, turned=turned), at
    if opening.side == "left" or opening.side == "right":
        if opening.stated or _is_taken(clause, opening, start, after):
            turn = Event(
                "turn",
                way=opening.side,
                ordinal=opening.ordinal,
                nearest=opening.nearest,
                forced="K" in before,
            )
            return [turn], at
    elif turned and before.endswith("A"):
        return [_likely(way, back=True)], at
    elif re.search("[Tt]", before) and "V" not in before:
        return [_likely(way, taken=True)], at
    elif re.search("[AU]$", before):
        return [_likely(way)], at
    exists = after.startswith("B") and "L" not in clause.kinds[start:at]
    if opening.ordinal is not None and not exists and before.strip("Q") == "":
        return [_likely(way)], at
    return [way], at


def _words_of(clause: Clause, start: int) -> tuple[_Opening, int]:
    """Gather ordinal, noun and side as long as they belong together."""
    opening = _Opening()
    at = start
    kinds = clause.kinds
    while at < len(kinds):
        chunk = clause.chunks[at]
        sided = chunk.way not in {None, "forward"} and opening.side is None
        if chunk.kind == "O" and opening.ordinal is None and not opening.noun:
            opening.ordinal = int(chunk.number or 1)
            opening.nearest = chunk.text.endswith(("next", "nearest"))
            if chunk.text.split()[-1] not in ORDINALS:
                opening.noun = chunk.text
        elif chunk.kind == "n" and not opening.noun and opening.count is None:
            opening.count = int(chunk.number or 1)
        elif chunk.kind == "J":
            opening.noun = f"{opening.noun} {chunk.text}".strip()
        elif chunk.kind == "T" and not opening.noun and chunk.text.startswith("turn"):
            opening.noun = chunk.text
        elif chunk.kind == "L" and sided:
            if opening.noun:
                verb = re.search("[TG]", kinds[:start])
                if opening.ordinal is None and not verb:
                    break  # "at the crossing right": the turn comes after the place
                opening.stated = True
            opening.side = side_of(chunk)
        elif chunk.kind == "S" and sided:
            opening.side = side_of(chunk)
        elif (
            chunk.kind == "B" and opening.side is None and kinds[at + 1 : at + 2] == "L"
        ):
            opening.stated = True
        else:
            break
        at += 1
    return opening, at


def _likely(way: Event, *, taken: bool = False, back: bool = False) -> Event:
    return Event(
        "way",
        side=way.side,
        ordinal=way.ordinal,
        nearest=way.nearest,
        likely=True,
        taken=taken,
        back=back,
    )


def _is_taken(clause: Clause, opening: _Opening, start: int, after: str) -> bool:
    before = clause.kinds[:start]
    if re.search("[TtGK]", before) and not re.search("[VB]", before):
        return True
    if not opening.noun or clause.kinds[start] == "L":
        return not after.startswith("B") or opening.ordinal is None
    return re.search("[AU]$", before) is not None and opening.ordinal is not None


def _bare(opening: _Opening, before: str, after: str, *, turned: bool) -> list[Event]:
    """Read a junction noun without ordinal and side."""
    junction = _junction_of(opening.noun)
    if junction is not None:
        back = turned and before[-1:] in {"A", "Q", "J"}
        return [Event("junction", junction=junction, back=back)]
    if opening.count is not None:
        if opening.count >= 3 and re.search("[AV]", before + after):
            return [Event("junction", junction="crossing")]
        return [Event("pass_ways", count=opening.count)]
    if before.endswith("T") and not turned and _TAKEN.search(opening.noun):
        return [] if after.startswith("L") else [Event("turn")]
    if re.search("[tG]$", before):
        return [Event("straight")]
    return []


def _junction_of(noun: str) -> Junction | None:
    if re.search(r"\bt\b|t-?junction|\bfork|y-?junction", noun):
        return "t"
    if re.search(r"cross|four-way", noun):
        return "crossing"
    if re.search(r"corner|bend", noun):
        return "corner"
    return None


def read_left_alone(clause: Clause, at: int) -> tuple[Event, int]:
    """Read the words for openings that are not to be taken.

    Returns:
        A `pass_ways` event, and the index of the last word used.
    """
    count: int | None = None
    side: Side | None = None
    last = at
    while at < len(clause.kinds) and clause.kinds[at] in "OJLSn":
        chunk = clause.chunks[at]
        if chunk.kind == "O":
            count = 1
        elif chunk.kind == "n" and chunk.number is not None:
            count = int(chunk.number)
        elif chunk.kind == "J" and count is None:
            count = None if chunk.text.endswith("s") else 1
        elif chunk.way is not None:
            side = side_of(chunk)
        last = at
        at += 1
    return Event("pass_ways", count=count, side=side), last
