"""Plans in plain words, for traces and reports."""

from collections.abc import Sequence

from memorymaze.language.plans.records import (
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Start,
    Turn,
)

_WAYS = {
    "left": "turn left",
    "right": "turn right",
    "slight_left": "bear left",
    "slight_right": "bear right",
    "either": "turn where the way leads",
    "around": "turn around",
}
_ORDINALS = {1: "first", 2: "second", 3: "third", -1: "last"}
_JUNCTIONS = {"t": "a T junction", "crossing": "a crossing", "corner": "a corner"}
_PLACES = {
    "turn": "at",
    "beside": "next to",
    "opposite": "opposite",
    "before_turn": "after",
    "after_turn": "before",
    "along": "with",
    "passed": "past",
    "target": "into",
}


def describe(plan: RoutePlan) -> list[str]:
    """Return one line for each leg and one for the arrival.

    >>> turn = Leg(Turn("left", ordinal=2), mentions=(Mention("clock", "object", "turn"),))
    >>> arrival = Arrival(("office",), side="right", length=Length(10, "metres"))
    >>> for line in describe(RoutePlan(legs=(turn,), arrival=arrival)):
    ...     print(line)
    1. turn left (second; at clock)
    2. arrive at office (after 10 m; on the right)
    """
    start = _start_notes(plan.start)
    firsts = [start, *[[] for _ in plan.legs]]
    parts = [_leg(leg, first) for leg, first in zip(plan.legs, firsts, strict=False)]
    parts.append(_arrival(plan.arrival, firsts[-1]))
    return [f"{number}. {part}" for number, part in enumerate(parts, start=1)]


def _start_notes(start: Start) -> list[str]:
    facing = [f"facing {start.facing}"] if start.facing else []
    return [*facing, *([f"from {start.from_}"] if start.from_ else [])]


def _leg(leg: Leg, first: Sequence[str]) -> str:
    notes = [*first, *_turn_notes(leg.turn)]
    if leg.on_the_spot:
        notes.append("where one stands")
    notes += _way_notes(leg.length, leg.passings)
    notes += _thing_notes(leg.mentions, leg.too_far, leg.wrong_way)
    return _with_notes(_WAYS[leg.turn.way], notes)


def _arrival(arrival: Arrival, first: Sequence[str]) -> str:
    notes = [*first, *_way_notes(arrival.length, arrival.passings)]
    if arrival.at_end:
        notes.append("at the end")
    if arrival.nth is not None:
        notes.append(f"the {_ordinal(arrival.nth)}")
    if arrival.side in {"left", "right"}:
        notes.append(f"on the {arrival.side}")
    elif arrival.side is not None:
        notes.append(arrival.side)
    others = [m for m in arrival.mentions if m.phrase not in arrival.destinations]
    notes += _thing_notes(others, arrival.too_far, arrival.wrong_way)
    names = " or ".join(arrival.destinations) or "a place not named"
    return _with_notes(f"arrive at {names}", notes)


def _turn_notes(turn: Turn) -> list[str]:
    notes: list[str] = []
    if turn.ordinal is not None:
        after = f" after {turn.counted_after}" if turn.counted_after else ""
        other = f" or {_ordinal(turn.or_ordinal)}" if turn.or_ordinal else ""
        notes.append(f"{_ordinal(turn.ordinal)}{other}{after}")
    if turn.junction is not None:
        notes.append(f"at {_JUNCTIONS[turn.junction]}")
    if turn.at_end:
        notes.append("at the end")
    if turn.immediate:
        notes.append("at once")
    if turn.forced:
        notes.append("by itself")
    if turn.doubt:
        notes.append("perhaps")
    return notes


def _way_notes(length: Length | None, passings: Sequence[Passing]) -> list[str]:
    notes: list[str] = []
    if length is not None:
        places = length.unit == "places"
        far = f"{length.count or 1:g} places" if places else f"{length.metres:.0f} m"
        most = "at most " if length.at_most else ""
        whole = f" of {length.stretches} stretches" if length.stretches > 1 else ""
        since = f" from {length.after} on" if length.after else ""
        notes.append(f"after {most}{far}{whole}{since}")
    for passing in passings:
        count = "all" if passing.count is None else str(passing.count)
        what = f" {passing.what}" if passing.what else ""
        side = f" on the {passing.side}" if passing.side else ""
        notes.append(f"pass {count}{what}{side}")
    return notes


def _thing_notes(
    mentions: Sequence[Mention], too_far: Sequence[str], wrong_way: Sequence[str]
) -> list[str]:
    notes: list[str] = []
    for mention in mentions:
        side = f" {mention.side}" if mention.side else ""
        notes.append(f"{_PLACES[mention.place]} {mention.phrase}{side}")
    notes += [f"too far: {phrase}" for phrase in too_far]
    return [*notes, *(f"wrong way: {phrase}" for phrase in wrong_way)]


def _ordinal(number: int) -> str:
    return _ORDINALS.get(number, f"{number}th")


def _with_notes(words: str, notes: Sequence[str]) -> str:
    return f"{words} ({'; '.join(notes)})" if notes else words
