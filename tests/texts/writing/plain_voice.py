"""The plain voice: a plan in plain English that leaves nothing out.

It exists to hold readers to account: whoever reads what it tells of a canonical plan must
come back to that plan. The other voices sound like people: they leave out, round and
hedge; `docs/texts.md` lists what is lost in them.
"""

from collections.abc import Iterator

from tests.texts.writing.canonical_plans import (
    ORDINALS,
    SECOND,
    STEP,
    why_not_canonical,
)

from memorymaze.basics.errors import PlanFileError
from memorymaze.language.plans import (
    Arrival,
    Junction,
    Leg,
    Length,
    Mention,
    Passing,
    Place,
    RoutePlan,
    Side,
    Way,
)

_NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
_SIDES: dict[Side, str] = {
    "left": "on the left",
    "right": "on the right",
    "ahead": "straight ahead",
    "behind": "behind you",
}
_WAYS: dict[Way, str] = {
    "left": "turn left",
    "right": "turn right",
    "slight_left": "turn slightly left",
    "slight_right": "turn slightly right",
    "either": "take the turning",
    "around": "turn around",
}
_JUNCTIONS: dict[Junction, str] = {
    "t": "at the T junction",
    "crossing": "at the crossing",
    "corner": "at the corner",
}
_AT_THE_TURN: dict[Place, str] = {
    "turn": "at",
    "beside": "next to",
    "before_turn": "after",
    "after_turn": "before",
    "opposite": "opposite",
}
_VAGUE = {
    4.0: "a little",
    6.0: "a short way",
    12.0: "for a while",
    25.0: "for a long way",
}
_DOUBTS = {0.0: "", 0.4: "I think ", 0.7: "maybe "}


def tell_plainly(plan: RoutePlan) -> str:
    """Return a canonical plan in plain English, one short sentence for each thing said.

    >>> from memorymaze.language.plans import Turn
    >>> legs = (Leg(Turn("left", ordinal=2)), Leg(Turn("right", at_end=True)))
    >>> tell_plainly(RoutePlan(legs=legs, arrival=Arrival(("library",), side="left")))
    'Go straight. Take the second left. Go straight. At the end, turn right. Go straight. \
Your destination is the library. It is on the left.'

    Raises:
        PlanFileError: The plan is not canonical (`memorymaze.language.plans.why_not_canonical`).
    """
    problem = why_not_canonical(plan)
    if problem is not None:
        raise PlanFileError(
            f"expected a canonical plan to tell plainly, got one in which {problem}"
        )
    return " ".join(f"{each[0].upper()}{each[1:]}." for each in _sentences(plan))


def _sentences(plan: RoutePlan) -> Iterator[str]:
    if plan.totals.turns is not None:
        yield f"it is {_counted(plan.totals.turns, 'turn')} in all"
    if plan.totals.metres is not None:
        yield f"it is {_counted(plan.totals.metres, 'metre')} in all"
    if plan.start.from_:
        yield f"come from the {plan.start.from_}"
    for leg in plan.legs:
        yield from _stretch(leg)
        yield _turn(leg)
        for name in leg.too_far:
            yield f"if you see the {name}, you have gone too far"
        for name in leg.wrong_way:
            yield f"if you see the {name}, you went the wrong way"
    yield from _arrival(plan.arrival)


def _stretch(part: Leg | Arrival) -> Iterator[str]:
    if not part.on_the_spot:
        yield f"go straight{_length(part.length)}"
    for mention in part.mentions:
        if mention.ignored:
            yield f"ignore the {mention.phrase}"
        elif mention.place == "passed":
            yield f"go past {_thing(mention)}"
        elif mention.place == "along":
            yield f"you see {_thing(mention)}"
    yield from map(_passing, part.passings)


def _turn(leg: Leg) -> str:
    turn = leg.turn
    at_the_turn = [each for each in leg.mentions if each.place in _AT_THE_TURN]
    where = ["at the end"] if turn.at_end else []
    where += [_JUNCTIONS[turn.junction]] if turn.junction else []
    where += [f"{_AT_THE_TURN[each.place]} {_thing(each)}" for each in at_the_turn]
    if turn.forced:
        side = "" if turn.way == "either" else f" to the {turn.way}"
        told = f"the way bends{side}"
    elif turn.ordinal is not None:
        other = f" or {_ordinal(turn.or_ordinal)}" if turn.or_ordinal else ""
        told = f"take the {_ordinal(turn.ordinal)}{other} {turn.way}"
    else:
        told = _WAYS[turn.way]
    told = f"immediately {told}" if turn.immediate else told
    targets = [each for each in leg.mentions if each.place == "target"]
    beyond = "".join(f" into {_thing(each)}" for each in targets)
    return ", ".join([*where, f"{_DOUBTS[turn.doubt]}{told}{beyond}"])


def _arrival(arrival: Arrival) -> Iterator[str]:
    yield from _stretch(arrival)
    if arrival.at_end:
        yield "go to the end"
    (name,) = arrival.destinations
    which = f"{_ordinal(arrival.nth)} " if arrival.nth else ""
    yield f"your destination is the {which}{name}"
    if arrival.side:
        yield f"it is {_SIDES[arrival.side]}"


def _length(length: Length | None) -> str:
    if length is None:
        return ""
    if length.unit == "vague":
        return f" {_VAGUE[length.metres]}"
    if length.unit == "places":
        return f" {_counted(length.count or 1, 'block')}"
    if length.unit == "steps":
        return f" for {_counted(round(length.metres / STEP), 'step')}"
    if length.unit == "time":
        return f" for {_counted(round(length.metres / SECOND), 'second')}"
    return f" for {_counted(length.metres, 'metre')}"


def _counted(number: float, noun: str) -> str:
    return f"{number:g} {noun}" if number == 1 else f"{number:g} {noun}s"


def _thing(mention: Mention) -> str:
    which = f"{_ordinal(mention.nth)} " if mention.nth else ""
    side = f" {_SIDES[mention.side]}" if mention.side else ""
    return f"the {which}{mention.phrase}{side}"


def _passing(passing: Passing) -> str:
    count = "all" if passing.count is None else _NUMBERS[passing.count - 1]
    side = f" {_SIDES[passing.side]}" if passing.side else ""
    return f"pass {count} {passing.what}{side}"


def _ordinal(number: int) -> str:
    return "last" if number < 0 else ORDINALS[number - 1]
