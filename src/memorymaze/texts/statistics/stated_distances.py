"""How far stated distances are from true ones.

A description is parsed into legs; where its turns follow each other as the route's do,
leg by leg the stated length stands beside the true one.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from shapely import Point

from memorymaze.language.plans import Length, RoutePlan
from memorymaze.texts.corpus.records import Instruction
from memorymaze.world.sites.records import Route, Site

SIDES = {
    "left": "left",
    "slight_left": "left",
    "right": "right",
    "slight_right": "right",
}
VAGUE = "vague"
"""The unit of words without a number, to which the parser gives a fixed length."""
ON_THE_TURN = 0.25
"""Metres that a turn on the route's line may lie outside its turning point."""


@dataclass(frozen=True, slots=True)
class StatedDistance:
    """One leg of a route with the length that someone gave it."""

    instruction: Instruction
    leg: int
    """From 0, along the route."""
    unit: str
    """What was counted: `metres`, `steps`, `time`, `vague`."""
    stated: float
    """Metres; a step is 0.7 m, a second of walking 1 m."""
    true: float
    """Metres along the route's middle line."""

    @property
    def ratio(self) -> float:
        """Stated over true."""
        return self.stated / self.true


def route_legs(site: Site, route: Route) -> list[tuple[float, str]] | None:
    """Return a route's legs: metres, and the side of the turn that ends each.

    The last leg ends at the goal, with the side `""`. None where a turn of the plan does
    not lie on the route's line.
    """
    areas = {place.id: place.polygon for place in site.turning_points}
    points = [(float(x), float(y)) for x, y, *_ in route.line.coords]
    along = [0.0, *np.cumsum([math.dist(a, b) for a, b in pairwise(points)])]
    legs: list[tuple[float, str]] = []
    start, vertex = 0.0, 0
    for turn in route.turns:
        area = areas[turn.at].buffer(ON_THE_TURN)
        inside = [
            number
            for number in range(vertex + 1, len(points) - 1)
            if area.contains(Point(points[number]))
        ]
        if not inside:
            return None
        vertex = max(inside, key=lambda number: _bend(points, number))
        legs.append((float(along[vertex]) - start, SIDES[turn.direction]))
        start = float(along[vertex])
    return [*legs, (float(along[-1]) - start, "")]


def _bend(points: Sequence[tuple[float, float]], number: int) -> float:
    (ax, ay), (bx, by), (cx, cy) = points[number - 1 : number + 2]
    change = math.atan2(cy - by, cx - bx) - math.atan2(by - ay, bx - ax)
    return abs(math.remainder(change, math.tau))


def stated_distances(
    instruction: Instruction, plan: RoutePlan, site: Site
) -> list[StatedDistance]:
    """Return the stated lengths of an instruction whose turns agree with the route's.

    The sides of all described turns, in order, must be those of the route that it
    describes; the route's slight turns may be left out, as people leave out bends that
    leave no choice, and the legs around them are then one. Otherwise nothing can be
    said of which leg is meant, and nothing is returned; neither for texts with errors.
    """
    if instruction.failures:
        return []
    route = site.find_route(instruction.reference_route)
    legs = route_legs(site, route)
    if legs is None:
        return []
    said = _described(plan)
    sides = [side for side, _ in said]
    if [side for _, side in legs] != sides:
        slight = {
            number
            for number, turn in enumerate(route.turns)
            if turn.direction.startswith("slight")
        }
        legs = _without(legs, slight)
        if [side for _, side in legs] != sides:
            return []
    return [
        StatedDistance(instruction, number, length.unit, length.metres, true)
        for number, ((true, _), (_, length)) in enumerate(zip(legs, said, strict=True))
        if length is not None and length.unit != "places" and true > 0
    ]


def _described(plan: RoutePlan) -> list[tuple[str, Length | None]]:
    """Return side and length of every described leg; the last one's side is `""`."""
    turns = [(SIDES.get(leg.turn.way, leg.turn.way), leg.length) for leg in plan.legs]
    return [*turns, ("", plan.arrival.length)]


def _without(
    legs: Sequence[tuple[float, str]], slight: set[int]
) -> list[tuple[float, str]]:
    kept: list[tuple[float, str]] = []
    carried = 0.0
    for number, (metres, side) in enumerate(legs):
        carried += metres
        if number not in slight:
            kept.append((carried, side))
            carried = 0.0
    return kept


def by_unit(
    distances: Iterable[StatedDistance],
) -> dict[tuple[str, str], list[StatedDistance]]:
    """Return lengths by study and unit; `numbers` is all that was said as a number."""
    groups: dict[tuple[str, str], list[StatedDistance]] = {}
    for each in distances:
        for unit in (each.unit, *([] if each.unit == VAGUE else ["numbers"])):
            groups.setdefault((each.instruction.study, unit), []).append(each)
    order = {"metres": 0, "steps": 1, "time": 2, "numbers": 3, VAGUE: 4}
    return {
        key: groups[key] for key in sorted(groups, key=lambda k: (k[0], order[k[1]]))
    }


def summarise_distances(legs: Sequence[StatedDistance]) -> dict[str, float]:
    """Return median and quartiles of stated over true lengths, and how they spread.

    The `factor` is the exponential of the logarithms' standard deviation; 1 when there
    is no spread.
    """
    ratios = np.array([leg.ratio for leg in legs])
    low, middle, high = np.quantile(ratios, [0.25, 0.5, 0.75]).tolist()
    return {
        "legs": len(legs),
        "texts": len({leg.instruction.id for leg in legs}),
        "median": middle,
        "low": low,
        "high": high,
        "factor": math.exp(float(np.log(ratios).std())),
    }
