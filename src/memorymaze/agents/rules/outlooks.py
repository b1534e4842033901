"""How well what is seen along the ways out of a crossing fits what was said of them."""

import math
from collections.abc import Sequence

from memorymaze.agents.rules.floor_map import SEES_FAR, FloorMap
from memorymaze.geometry.pose import wrap_angle
from memorymaze.understanding import (
    Mention,
    Outlook,
    RoutePlan,
    Side,
    is_floor,
)

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
OPEN = math.radians(60)
"""A way that differs less from a direction lies there."""

_SIDES: dict[Side, float] = {
    "ahead": 0.0,
    "left": math.pi / 2,
    "behind": math.pi,
    "right": -math.pi / 2,
}


def outlook_cost(outlook: Outlook, floor: FloorMap, at: int, exit: int | None) -> float:
    """Compare what was said to lie along a way with what is seen along it.

    Args:
        outlook: What was said.
        floor: The map with all views.
        at: Crossing where the way begins.
        exit: Exit that leads into it; None for a wall.
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
    outlook: Outlook, exits: Sequence[float], closed: set[int], heading: float
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


def crossing_floor_cost(mention: Mention, floor: FloorMap, at: int | None) -> float:
    """Compare a floor that a crossing was said to have with the ways out of it."""
    if at is None or mention.place not in {"turn", "beside", "target"}:
        return 0.0
    views = [view for view in floor.views_from(at) if mention.phrase in view.asked]
    if any(view.has_floor(mention.phrase) for view in views):
        return -1.2
    told = [view for view in views if view.floor is not None]
    return 1.5 if len(told) > 1 or (told and len(views) == len(told)) else 0.0


def outlook_of(plan: RoutePlan, leg: int) -> Outlook:
    """Return what was said of the beginning of a leg, or of the last stretch."""
    legs = plan.legs
    return legs[leg].outlook if leg < len(legs) else plan.arrival.outlook


def first_heading_cost(
    plan: RoutePlan, floor: FloorMap, at: int, heading: float
) -> float:
    """Compare a way to face at the start with what a description begins with.

    Args:
        plan: The description.
        floor: The map, with views along the ways out of the start.
        at: Crossing where the robot starts.
        heading: Radians.
    """
    crossing = floor.crossings[at]
    exit = crossing.find_exit(heading)
    outlook = outlook_of(plan, 0)
    cost = walls_cost(outlook, crossing.exits, crossing.closed, heading)
    cost += outlook_cost(outlook, floor, at, exit)
    first = plan.legs[0] if plan.legs else plan.arrival
    if exit is None:
        return cost + INTO_WALL * first.goes
    things = tuple(
        mention.phrase
        for mention in first.mentions
        if mention.place in {"turn", "passed"} and not is_floor(mention.phrase)
    )
    seen = outlook_cost(Outlook(things[:1]), floor, at, exit)
    return cost + FIRST_THING * seen
