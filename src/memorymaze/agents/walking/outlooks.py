"""What was said of the ways out of a crossing, and how well what is seen there fits.

A plan says of a turn what it leads to: a `target` ahead, behind, or a wall on a side.
That is the outlook of the next stretch; the outlook of the first is what is said of the
start.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from memorymaze.agents.walking.floor_map import SEES_FAR, FloorMap
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.language.plans import (
    Arrival,
    Junction,
    Leg,
    Length,
    Mention,
    RoutePlan,
    Side,
)
from memorymaze.language.reading import ANY_FLOOR, is_floor

OTHER_FLOOR = 2.8
"""The way has another floor than the one said."""
FLOOR_BEYOND = 0.8
"""The same where it begins farther along that way."""
NOT_AHEAD = 1.6
"""What was said to lie that way is not to be seen, by one who sees far."""
MAYBE_AHEAD = 0.3
"""The same by one who sees only what is near."""
NO_WALL = 2.4
"""There is a way where a wall was said to be."""
INTO_WALL = 1.0
"""One is to go at first, and faces a wall."""
FIRST_THING = 0.5
"""Share that counts of a thing where the first leg ends; it may lie round a corner."""
SAME_HEADING = math.radians(35)
"""Ways to face that differ by less are one."""
LEG_METRES = 15.0
"""Expected length of a leg whose length was not said."""
AT_ONCE = Length(4.0, "vague")
OPEN = math.radians(60)
"""A way that differs less from a direction lies there."""

_SIDES: dict[Side, float] = {
    "ahead": 0.0,
    "left": math.pi / 2,
    "behind": math.pi,
    "right": -math.pi / 2,
}


_JUNCTIONS: dict[str, Junction] = {
    "t junction": "t",
    "crossing": "crossing",
    "corner": "corner",
}
"""Places that are no things to look for, where one arrives or turns."""


@dataclass(frozen=True, slots=True)
class LegOutlook:
    """What one sees, or has around oneself, facing along a stretch before walking it."""

    ahead: tuple[str, ...] = ()
    """Floors of the way, and things that lie that way."""
    behind: tuple[str, ...] = ()
    """Things that lie the other way."""
    walls: tuple[Side, ...] = ()
    """Sides on which there is no way."""


def outlook_of(plan: RoutePlan, leg: int) -> LegOutlook:
    """Return what was said of the beginning of a leg, or of the last stretch."""
    if leg == 0:
        return _outlook_of_start(plan)
    told = [each for each in plan.legs[leg - 1].mentions if _is_outlook(each)]
    things = [each for each in told if each.kind != "wall"]
    return LegOutlook(
        tuple(each.phrase for each in things if each.side == "ahead"),
        tuple(each.phrase for each in things if each.side == "behind"),
        tuple(each.side for each in told if each.kind == "wall" and each.side),
    )


def _outlook_of_start(plan: RoutePlan) -> LegOutlook:
    ahead = plan.start.facing.split(" and ") if plan.start.facing else []
    behind = plan.start.from_.split(" and ") if plan.start.from_ else []
    first = plan.legs[0] if plan.legs else plan.arrival
    walls: list[Side] = [
        each.side
        for each in first.mentions
        if each.kind == "wall" and each.place == "along" and each.side
    ]
    if "wall" in ahead:
        walls.append("ahead")
    if "wall" in behind:
        walls.append("behind")
    return LegOutlook(
        tuple(each for each in ahead if each != "wall"),
        tuple(each for each in behind if each != "wall"),
        tuple(walls),
    )


def _is_outlook(mention: Mention) -> bool:
    if mention.place != "target":
        return False
    return mention.side in {"ahead", "behind"} or (
        mention.kind == "wall" and mention.side is not None
    )


def things_on(plan: RoutePlan, leg: int) -> tuple[Mention, ...]:
    """Return the things on a stretch and at its turn, without what is an outlook.

    What the turn before leads to is on the stretch, as is the floor after it.
    """
    entered = plan.legs[leg - 1].mentions if leg else ()
    part = plan.legs[leg] if leg < len(plan.legs) else plan.arrival
    return (
        *(
            replace(each, place="target")
            for each in entered
            if _is_led_to(each) and _is_thing(each)
        ),
        *(each for each in part.mentions if not _is_led_to(each) and _is_thing(each)),
    )


def _is_led_to(mention: Mention) -> bool:
    of_floor = mention.place == "after_turn" and is_floor(mention.phrase)
    return mention.place == "target" or of_floor


def _is_thing(mention: Mention) -> bool:
    return not _is_outlook(mention) and _junction_of(mention) is None


def length_of(leg: Leg) -> Length | None:
    """Return the length of a leg; a turn made at once follows after a little way."""
    if (
        leg.length is None
        and leg.turn.immediate
        and all(each.place == "target" for each in leg.mentions)
    ):
        return AT_ONCE
    return leg.length


def junction_at_the_end(arrival: Arrival) -> Junction | None:
    """Return the kind of junction where one arrives, if that is said."""
    for mention in arrival.mentions:
        junction = _junction_of(mention)
        if junction is not None:
            return junction
    return None


def _junction_of(mention: Mention) -> Junction | None:
    if mention.kind != "place" or mention.place != "turn":
        return None
    return _JUNCTIONS.get(mention.phrase)


def faces(plan: RoutePlan, leg: int) -> bool:
    """Tell whether of a turn only what lies that way is said: `turn to the clock`."""
    return plan.legs[leg].turn.way == "either" and bool(outlook_of(plan, leg + 1).ahead)


def outlook_cost(
    outlook: LegOutlook, floor: FloorMap, at: int, exit: int | None
) -> float:
    """Compare what was said to lie along a way out of a crossing with what is seen there.

    The exit is None for a wall.
    """
    view = floor.views.get((at, exit)) if exit is not None else None
    if view is None:
        return 0.5 * bool(outlook.ahead) if exit is None else 0.0
    cost = 0.0
    for phrase in outlook.ahead:
        if phrase not in view.asked:
            continue
        if is_floor(phrase):
            if view.floor is not None:
                beyond = phrase in view.distances
                other = FLOOR_BEYOND if beyond else OTHER_FLOOR
                cost += -1.0 if view.has_floor(phrase) else other
        elif phrase in view.distances:
            cost -= 1.2
        else:
            cost += NOT_AHEAD if floor.farthest > SEES_FAR else MAYBE_AHEAD
    cost += NOT_AHEAD * sum(phrase in view.distances for phrase in outlook.behind)
    return cost


def walls_cost(
    outlook: LegOutlook, exits: Sequence[float], closed: set[int], heading: float
) -> float:
    """Compare the sides that were said to be walls with the ways out of a crossing."""
    cost = 0.0
    for side in outlook.walls:
        there = wrap_angle(heading + _SIDES[side])
        is_open = any(
            abs(wrap_angle(each - there)) < OPEN
            for index, each in enumerate(exits)
            if index not in closed
        )
        cost += NO_WALL if is_open else -0.6
    return cost


def crossing_has_floor(phrase: str, floor: FloorMap, at: int) -> bool | None:
    """Tell whether a way out of a crossing has a floor; None where one cannot tell."""
    views = [view for view in floor.views_from(at) if phrase in view.asked]
    if any(view.has_floor(phrase) for view in views):
        return True
    told = [view for view in views if view.floor is not None]
    return False if len(told) > 1 or (told and len(views) == len(told)) else None


def first_heading_cost(
    plan: RoutePlan, floor: FloorMap, at: int, heading: float
) -> float:
    """Compare a way to face at the start with what a description begins with."""
    crossing = floor.crossings[at]
    exit = crossing.find_exit(heading)
    outlook = outlook_of(plan, 0)
    cost = walls_cost(outlook, crossing.exits, crossing.closed, heading)
    cost += outlook_cost(outlook, floor, at, exit)
    first = plan.legs[0] if plan.legs else plan.arrival
    if exit is None:
        return cost + INTO_WALL * (not first.on_the_spot)
    things = tuple(
        mention.phrase
        for mention in things_on(plan, 0)
        if mention.place in {"turn", "passed"} and not is_floor(mention.phrase)
    )
    seen = outlook_cost(LegOutlook(things[:1]), floor, at, exit)
    return cost + FIRST_THING * seen


def looks_of(plan: RoutePlan) -> tuple[str, ...]:
    """Return what to look for along every way; nothing where no way is told by looks."""
    parts = range(len(plan.legs) + 1)
    outlooks = [outlook_of(plan, number) for number in parts]
    ahead = [phrase for outlook in outlooks for phrase in outlook.ahead]
    things = [each for number in parts for each in things_on(plan, number)]
    named = [each.phrase for each in things if is_floor(each.phrase)]
    floors = [phrase for phrase in (*ahead, *named) if is_floor(phrase)]
    turns = any(faces(plan, number) for number in range(len(plan.legs)))
    if not floors and not turns:
        return ()
    return tuple(dict.fromkeys([*([ANY_FLOOR] if floors else []), *ahead, *floors]))


def phrases_at_start(plan: RoutePlan) -> list[str]:
    """Return what was said to be in sight from where one sets off."""
    outlook = outlook_of(plan, 0)
    named = [mention.phrase for mention in things_on(plan, 0)]
    return [*outlook.ahead, *outlook.behind, *named]


def each_once(groups: Iterable[Iterable[str]]) -> list[str]:
    """Return the phrases of some groups in their order, without those that came before."""
    return list(dict.fromkeys(phrase for group in groups for phrase in group))


def expected_metres(plan: RoutePlan) -> float:
    """Return the length of the way told, as far as one can tell before walking it."""
    expected = sum(
        length.metres if (length := length_of(leg)) is not None else LEG_METRES
        for leg in plan.legs
    )
    return expected + (
        plan.arrival.length.metres if plan.arrival.length else LEG_METRES
    )


def headings_to_begin(exits: Sequence[float]) -> list[float]:
    """Return all ways to face where ways lead out: along each of them, or off it."""
    headings = list(exits)
    for exit in exits:
        for angle in (math.pi / 2, math.pi, -math.pi / 2):
            heading = wrap_angle(exit + angle)
            if all(abs(wrap_angle(heading - h)) > SAME_HEADING for h in headings):
                headings.append(heading)
    return headings
