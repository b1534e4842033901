"""Corridors: the widest rectangles that fit on the floor along legs."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import shapely
from shapely import LineString, MultiPolygon, Polygon, STRtree

from memorymaze.geometry.pose import heading_to
from memorymaze.importing.imported import XY
from memorymaze.importing.line_graph import BEND, Leg
from memorymaze.importing.shapes import furthest, moved, strip

Floor = Polygon | MultiPolygon

EASE = 0.01
"""Metres a corridor may reach into a wall, so that a rough wall does not narrow it."""
NARROWEST = 0.6
"""Metres of the narrowest corridor."""
SHORTEST = 0.5
"""Metres."""
ASKEW = math.radians(6)
"""Walls beside a line that are turned against it by less say its true direction."""
LONGER_THAN_WIDE = 1.1
"""What is shorter than so many widths has no direction of its own and is an area."""


@dataclass(frozen=True)
class PlannedCorridor:
    """A corridor with four corners."""

    polygon: Polygon
    name: str | None


def corridors_along(
    legs: Sequence[Leg], floor: Floor, nodes: Mapping[XY, Sequence[Leg]]
) -> Iterator[PlannedCorridor]:
    """Yield a rectangle along each step of the legs, where one fits on the floor."""
    eased = floor.buffer(EASE, join_style="mitre")
    shapely.prepare(eased)
    walls = STRtree([
        LineString(wall)
        for ring in shapely.get_rings(floor)
        for wall in pairwise(ring.coords)
    ])
    for leg in legs:
        for step in pairwise(leg.points):
            reaches = [_reach_beyond(end, leg, nodes) for end in step]
            fits = [
                fit
                for line in (step, _along_walls(step, leg.width, walls))
                for inset in (0.0, leg.width / 2)
                if (fit := _fitting(eased, line, leg.width, inset, reaches)) is not None
            ]
            if fits:
                yield PlannedCorridor(max(fits, key=lambda fit: fit.area), leg.name)


def _along_walls(step: tuple[XY, XY], width: float, walls: STRtree) -> tuple[XY, XY]:
    """Return a step turned about its middle into the direction of the walls beside it."""
    heading, length = heading_to(*step), math.dist(*step)
    beside = LineString(step).buffer(0.75 * width, cap_style="flat")
    askew, seen = 0.0, 0.0
    for wall in walls.geometries[walls.query(beside)]:
        part = beside.intersection(wall).length
        turn = math.remainder(heading_to(*wall.coords) - heading, math.pi)
        if part > 0 and abs(turn) < ASKEW:
            askew, seen = askew + part * turn, seen + part
    if seen < length / 2:
        return step
    middle = ((step[0][0] + step[1][0]) / 2, (step[0][1] + step[1][1]) / 2)
    heading += askew / seen
    return moved(middle, heading, -length / 2), moved(middle, heading, length / 2)


def _reach_beyond(end: XY, leg: Leg, nodes: Mapping[XY, Sequence[Leg]]) -> float:
    """Return how far a corridor may go on beyond the end of a step."""
    if end not in leg.ends:
        return leg.width * math.tan(BEND / 2)
    others = [each.width for each in nodes[end] if each is not leg]
    return max(others) / 2 if others else leg.width


def _fitting(
    floor: Floor,
    step: tuple[XY, XY],
    width: float,
    inset: float,
    reaches: Sequence[float],
) -> Polygon | None:
    """Return the rectangle along a step that is as wide as the floor within its insets.

    It reaches beyond the step's ends as far as there is floor, and as it may. None where
    it is too narrow, or hardly longer than wide.
    """
    heading, length = heading_to(*step), math.dist(*step) - 2 * inset
    if length <= 0:
        return None
    start = moved(step[0], heading, inset)
    end = moved(start, heading, length)
    if not floor.covers(LineString([start, end])):
        return None

    def free(left: float, right: float) -> bool:
        return floor.covers(strip(start, heading, length, left, right))

    most = 0.6 * width + 0.2
    left = furthest(lambda side: free(side, 0.0), 0.0, most)
    right = furthest(lambda side: free(0.0, side), 0.0, most)
    if left + right < NARROWEST + 2 * EASE:
        return None

    def free_beyond(more: float) -> bool:
        return floor.covers(strip(end, heading, more, left, right))

    def free_behind(more: float) -> bool:
        return floor.covers(strip(start, heading + math.pi, more, right, left))

    back = furthest(free_behind, 0.0, inset + reaches[0])
    ahead = furthest(free_beyond, 0.0, inset + reaches[1])
    # Back from the eased walls to the true ones.
    left, right, back, ahead = (side - EASE for side in (left, right, back, ahead))
    whole = back + length + ahead
    if whole < max(SHORTEST, LONGER_THAN_WIDE * (left + right)):
        return None
    return strip(moved(start, heading, -back), heading, whole, left, right)
