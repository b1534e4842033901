"""The canonical form of a plan: what plain English can say whole, and in one way only."""

import re
from collections.abc import Iterator

from memorymaze.language.plans.records import Arrival, Leg, Length, Mention, RoutePlan

NAME = re.compile(r"[a-z]+(?: [a-z]+)*")
PLACES_AT_THE_TURN = ("turn", "beside", "before_turn", "after_turn", "opposite")
VAGUE_METRES = (4.0, 6.0, 12.0, 25.0)
"""A little, a short way, a while, a long way."""
STEP, SECOND, PLACE = 0.7, 1.0, 8.0
"""Metres of a step, of a second of walking, and from one place to turn to the next."""
DOUBTS = (0.0, 0.4, 0.7)
"""Nothing said, `I think`, `maybe`."""
NOUN = "opening"
"""What one passes and does not take."""


def why_not_canonical(plan: RoutePlan) -> str | None:
    """Return what of a plan is not canonical; None for a canonical plan.

    A canonical plan says of each thing what plain English has one way to say. It leaves
    out what is a reader's own (`unclear`), and what people say in so many ways, or so
    seldom, that no one way is plain:

    - Names are words of small letters, in the singular, that say of themselves what the
      thing is (its `kind`), and of signs what they say (`sign that says library`);
      floors, walls, sounds, smells and people are no things in it, and no word of a name
      may be one that directions use, such as `left hall`.
    - There is a destination, one, with its side; nothing is said of doubt about it, nor
      of what is met beyond it. The last stretch is not counted in places,
      nor is a thing on it counted.
    - Nothing is said of what one faces, before the start or after a turn; what a turn
      leads to has no side, and follows no turning back.
    - Only plain left and right turns are counted or left open; a turn that is counted
      from a thing has that thing as its last one `before_turn`. Only these turns are
      `immediate`, and only they and turns without a side are `forced`.
    - A T is at the end of the way.
    - On the spot is the first turn alone, and nothing is said of it but its way, its
      doubt, and what it leads to.
    - Lengths in steps, seconds and places are whole numbers of them; vague ones are a
      little, a short way, a while, or a long way. No thing is `after_metres`.
    - On a stretch, things passed come before those seen and those to be ignored, which
      have neither side nor number; one thing at most is at the turn, and one is what it
      leads to. Doubt is about turns only, and is none, `I think` or `maybe`.
    - Openings are called so, and one stretch has one passing of them at most.
    - Each thing is named once, apart from one that counting starts from.
    """
    return next(_problems(plan), None)


def _problems(plan: RoutePlan) -> Iterator[str]:
    if plan.start.facing is not None:
        yield "start.facing is told"
    for number, leg in enumerate(plan.legs):
        for problem in (*_of_turn(leg, number), *_of_stretch(leg)):
            yield f"legs.{number}: {problem}"
    for problem in (*_of_arrival(plan.arrival), *_of_stretch(plan.arrival)):
        yield f"arrival: {problem}"
    names = _names(plan)
    yield from (
        f"{name!r} is no plain name" for name in names if not NAME.fullmatch(name)
    )
    if len(set(names)) < len(names):
        yield "a thing is named twice"


def _names(plan: RoutePlan) -> list[str]:
    parts = (*plan.legs, plan.arrival)
    return [
        *filter(None, [plan.start.from_]),
        *(each.phrase for part in parts for each in part.mentions),
        *(name for part in parts for name in (*part.too_far, *part.wrong_way)),
        *plan.arrival.destinations,
    ]


def _of_turn(leg: Leg, number: int) -> Iterator[str]:
    turn = leg.turn
    plain = turn.way in {"left", "right"}
    counted = turn.ordinal is not None
    before = [each.phrase for each in leg.mentions if each.place == "before_turn"]
    if turn.doubt not in DOUBTS:
        yield f"turn.doubt is none of {DOUBTS}"
    if (counted or turn.immediate) and (not plain or turn.forced):
        yield "a turn is counted or immediate that is not plainly left or right"
    if turn.forced and not (plain or turn.way == "either"):
        yield "a slight turn, or one back, is forced"
    if turn.junction == "t" and not turn.at_end:
        yield "at a T one can go straight on"
    if turn.immediate and not number:
        yield "the first turn is immediate"
    if counted and not -1 <= (turn.ordinal or 0) <= len(ORDINALS):
        yield "a turn is counted too far"
    if turn.or_ordinal is not None and not (
        turn.ordinal is not None and 0 < turn.ordinal < turn.or_ordinal <= len(ORDINALS)
    ):
        yield "or_ordinal is told without a lower ordinal"
    if turn.counted_after != (before[-1] if before and counted else None):
        yield "counted_after is not the last thing before a counted turn"
    if turn.way == "around" and any(each.place == "target" for each in leg.mentions):
        yield "turning back leads to a thing"
    if leg.on_the_spot and (
        number or counted or turn.at_end or turn.junction or turn.forced
    ):
        yield "a turn on the spot is not the first, or more is said of it"
    if leg.unclear:
        yield "unclear is told"


def _of_stretch(part: Leg | Arrival) -> Iterator[str]:
    order = [_rank(each) for each in part.mentions]
    if part.on_the_spot and (
        part.length or part.passings or any(rank < _TARGET for rank in order)
    ):
        yield "something is said of a stretch that is not walked"
    if (
        order != sorted(order)
        or order.count(_AT_THE_TURN) > 1
        or order.count(_TARGET) > 1
    ):
        yield "mentions are not in order: passed, seen, ignored, at the turn, beyond it"
    for mention in part.mentions:
        yield from _of_mention(mention)
    if len(part.passings) > 1:
        yield "more than one passing"
    for passing in part.passings:
        if passing.what != (NOUN if passing.count == 1 else f"{NOUN}s"):
            yield f"passings.what is not {NOUN}"
        if passing.count is not None and passing.count > 9:
            yield "more than nine openings are passed"
    if part.length is not None and not _is_plain(part.length):
        yield "length is no plain one"


_PASSED, _SEEN, _IGNORED, _AT_THE_TURN, _TARGET = range(5)
ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")


def _rank(mention: Mention) -> int:
    if mention.ignored:
        return _IGNORED
    if mention.place in PLACES_AT_THE_TURN:
        return _AT_THE_TURN
    return {"passed": _PASSED, "along": _SEEN, "target": _TARGET}[mention.place]


def _of_mention(mention: Mention) -> Iterator[str]:
    if mention.kind not in {"object", "sign", "door", "place"}:
        yield f"a {mention.kind} is named"
    if mention.doubt or mention.after_metres is not None:
        yield "doubt or after_metres of a thing is told"
    if mention.nth is not None and not 0 < mention.nth <= len(ORDINALS):
        yield "a thing is counted too far"
    bare = mention.ignored or mention.place == "target"
    if bare and (mention.side or mention.nth):
        yield "a thing to be ignored, or beyond a turn, has a side or number"
    if mention.ignored and mention.place != "passed":
        yield "a thing to be ignored is not passed"
    if mention.side == "behind" or (
        mention.side == "ahead" and mention.place != "along"
    ):
        yield "a thing is behind, or is ahead though it is not only seen"


def _is_plain(length: Length) -> bool:
    if length.after is not None:
        return False
    if length.unit == "places":
        count = length.count or 0.0
        return count == int(count) > 0 and length.metres == count * PLACE
    if length.count is not None:
        return False
    if length.unit == "vague":
        return length.metres in VAGUE_METRES
    if length.unit == "metres":
        return length.metres == round(length.metres, 1) > 0
    count = round(length.metres / (STEP if length.unit == "steps" else SECOND))
    return count > 0 and length.metres == count * (
        STEP if length.unit == "steps" else SECOND
    )


def _of_arrival(arrival: Arrival) -> Iterator[str]:
    if len(arrival.destinations) != 1 or arrival.side in {None, "behind"}:
        yield "there is not one destination with its side"
    if arrival.doubt or arrival.unclear or arrival.too_far or arrival.wrong_way:
        yield "doubt, or what lies beyond the destination, is told"
    if arrival.length is not None and arrival.length.unit == "places":
        yield "its length is counted in places"
    if any(each.nth for each in arrival.mentions):
        yield "a thing on the last stretch is counted"
    if arrival.nth is not None and not 0 < arrival.nth <= len(ORDINALS):
        yield "it is counted too far"
    if arrival.on_the_spot or any(_rank(each) > _IGNORED for each in arrival.mentions):
        yield "it is on the spot, or something is at a turn"
