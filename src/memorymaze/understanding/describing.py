"""Plans in plain words, for traces and reports."""

from collections.abc import Sequence

from memorymaze.routes.plan import (
    Arrival,
    Leg,
    Length,
    Mention,
    Outlook,
    Passing,
    RoutePlan,
    Turn,
)

_WAYS = {
    "left": "turn left",
    "right": "turn right",
    "slight_left": "bear left",
    "slight_right": "bear right",
    "forward": "go straight on",
    "forward_or_side": "turn where the way leads",
    "facing": "turn to what comes next",
    "around": "turn around",
}
_ORDINALS = {1: "first", 2: "second", 3: "third", -1: "last"}
_JUNCTIONS = {"t": "a T junction", "crossing": "a crossing", "corner": "a corner"}
_PLACES = {
    "turn": "at",
    "beside": "next to",
    "before_turn": "after",
    "after_turn": "before",
    "along": "with",
    "passed": "past",
    "target": "into",
}


def describe(plan: RoutePlan) -> list[str]:
    """Return one line for each leg and one for the arrival.

    >>> from memorymaze.understanding import parse_route_description
    >>> text = "Take the second left at the clock. After 10 m the office is on the right."
    >>> for line in describe(parse_route_description(text)):
    ...     print(line)
    1. turn left (second; at clock)
    2. arrive at office (after 10 m; on the right)
    """
    lines = [f"{n}. {_leg(leg)}" for n, leg in enumerate(plan.legs, start=1)]
    return [*lines, f"{len(lines) + 1}. {_arrival(plan.arrival)}"]


def _leg(leg: Leg) -> str:
    notes = [*_turn_notes(leg.turn), *_outlook_notes(leg.outlook)]
    notes += _way_notes(leg.length, leg.passings)
    notes += _thing_notes(leg.mentions, leg.too_far)
    return _with_notes(_WAYS[leg.turn.way], notes)


def _arrival(arrival: Arrival) -> str:
    notes = _outlook_notes(arrival.outlook)
    notes += _way_notes(arrival.length, arrival.passings)
    if arrival.at_end:
        notes.append("at the end")
    if arrival.nth is not None:
        notes.append(f"the {_ordinal(arrival.nth)}")
    if arrival.side in {"left", "right"}:
        notes.append(f"on the {arrival.side}")
    elif arrival.side is not None:
        notes.append(arrival.side)
    others = [m for m in arrival.mentions if m.phrase not in arrival.destinations]
    notes += _thing_notes(others, arrival.too_far)
    names = " or ".join(arrival.destinations) or "a place not named"
    return _with_notes(f"arrive at {names}", notes)


def _turn_notes(turn: Turn) -> list[str]:
    notes: list[str] = []
    if turn.ordinal is not None:
        notes.append(_ordinal(turn.ordinal))
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


def _outlook_notes(outlook: Outlook) -> list[str]:
    notes = [f"along {phrase}" for phrase in outlook.ahead]
    notes += [f"away from {phrase}" for phrase in outlook.behind]
    return [*notes, *(f"wall {side}" for side in outlook.walls)]


def _way_notes(length: Length | None, passings: Sequence[Passing]) -> list[str]:
    notes: list[str] = []
    if length is not None and length.count is not None:
        notes.append(f"after {length.count:g} segments")
    elif length is not None:
        notes.append(f"after {length.metres:.0f} m")
    for passing in passings:
        count = "all" if passing.count is None else str(passing.count)
        side = f" on the {passing.side}" if passing.side else ""
        notes.append(f"pass {count}{side}")
    return notes


def _thing_notes(mentions: Sequence[Mention], too_far: Sequence[str]) -> list[str]:
    notes: list[str] = []
    for mention in mentions:
        side = f" {mention.side}" if mention.side else ""
        notes.append(f"{_PLACES[mention.place]} {mention.phrase}{side}")
    return [*notes, *(f"too far: {phrase}" for phrase in too_far)]


def _ordinal(number: int) -> str:
    return _ORDINALS.get(number, f"{number}th")


def _with_notes(words: str, notes: Sequence[str]) -> str:
    return f"{words} ({'; '.join(notes)})" if notes else words
