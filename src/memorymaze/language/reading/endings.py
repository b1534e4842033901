"""How a description ends: a last turn that is the side of the destination."""

from dataclasses import replace

from memorymaze.language.plans import Side
from memorymaze.language.reading.partial_legs import PartialLeg

_BESIDE_A_DOOR = 8.0
"""Metres: after so few, a side is that of a door rather than of one more turn."""


def ended_on_a_side(done: list[PartialLeg], draft: PartialLeg) -> PartialLeg:
    """Return the last leg; a turn that is only a side of its end is taken back.

    `Room 2347, left.`: the last word tells the side of the destination. So it does in
    `the office is at the end, left`.
    """
    if not done:
        return draft
    if not draft.is_new:
        return _ended_at_a_door(done, draft)
    last = done[-1]
    turn = last.turn
    if turn is None or turn.ordinal is not None:
        return draft
    if turn.at_end and not (last.told_at_end and last.bare_turn):
        return draft
    if last.leaves and draft.side is not None:
        return draft  # "it is to your left, and you find it on the right"
    aside = last.aside_turn and draft.side is None
    if turn.way not in {"left", "right"} or not (
        aside or turn.at_end or (last.plain_last and last.mentions)
    ):
        return draft
    done.pop()
    side: Side = "left" if turn.way == "left" else "right"
    if last.mentions and last.mentions[-1].place in {"turn", "along"}:
        last.mentions[-1] = replace(last.mentions[-1], side=side, place="along")
    else:
        last.side = side
    last.turn = None
    return last


def _ended_at_a_door(done: list[PartialLeg], draft: PartialLeg) -> PartialLeg:
    """`After 5 m, left: 2347.`: a few steps and a side, and then a door."""
    last = done[-1]
    way = last.turn.way if last.turn else "either"
    metres = sum(each.metres for each in last.lengths)
    if way not in {"left", "right"} or not last.bare_turn or last.mentions:
        return draft
    if 0 < metres <= _BESIDE_A_DOOR and draft.has_only_a_door and not last.at_end:
        draft.lengths = last.lengths
        draft.side = "left" if way == "left" else "right"
        done.pop()
    return draft
