"""Corridors: the widest rectangles that fit on the floor along legs."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import networkx as nx
import shapely
from shapely import LineString, MultiPolygon, Point, Polygon, STRtree

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, moved, turn_between
from memorymaze.world.importing.line_graph import BEND, LineLeg
from memorymaze.world.importing.shapes import furthest, strip

_Floor = Polygon | MultiPolygon

EASE = 0.01
"""Metres a corridor may reach into a wall, so that a rough wall does not narrow it."""
NARROWEST = 0.6
"""Metres of the narrowest corridor."""
SHORTEST = 0.5
"""Metres."""
ASKEW = math.radians(6)
"""Walls beside a line that are turned against it by less say its true direction."""
IN_LINE, OFF_LINE = math.radians(3), 0.1
"""Legs that bend less, and stray by fewer metres from a line, are one corridor."""
SAME_WIDTH = 1.1
"""Ratio of two widths that still are one corridor's."""
AS_WIDE = 0.97
"""Share of the width of its parts that a corridor through junctions keeps."""
LONGER_THAN_WIDE = 1.1
"""What is shorter than so many widths has no direction of its own and is an area."""


@dataclass(frozen=True)
class PlannedCorridor:
    """A corridor with four corners."""

    polygon: Polygon
    name: str | None


def corridors_along(
    legs: Sequence[LineLeg], floor: _Floor, nodes: Mapping[XY, Sequence[LineLeg]]
) -> Iterator[PlannedCorridor]:
    """Yield a rectangle along each step of the legs, where one fits on the floor."""
    eased = floor.buffer(EASE, join_style="mitre")
    shapely.prepare(eased)
    walls = STRtree([
        LineString(wall)
        for ring in shapely.get_rings(floor)
        for wall in pairwise(ring.coords)
    ])

    def widest(step: tuple[XY, XY], leg: LineLeg) -> Polygon | None:
        reaches = [_reach_beyond(end, leg, nodes) for end in step]
        fits = [
            fit
            for line in (step, _along_walls(step, leg.width, walls))
            for inset in (0.0, leg.width / 2)
            if (fit := _fitting(eased, line, leg.width, inset, reaches)) is not None
        ]
        return max(fits, key=lambda fit: fit.area, default=None)

    for street in _streets(legs, nodes):
        through = widest(street.ends, street.leg) if len(street.legs) > 1 else None
        parts = [
            (part, leg)
            for leg in street.legs
            for step in pairwise(leg.points)
            if (part := widest(step, leg)) is not None
        ]
        if through is not None and all(
            _width(through) >= AS_WIDE * _width(part) for part, _ in parts
        ):
            parts = [(through, street.leg)]
        for part, leg in parts:
            yield PlannedCorridor(part, leg.name)


@dataclass(frozen=True)
class _Street:
    """Legs in line, one after the other through junctions."""

    legs: tuple[LineLeg, ...]
    ends: tuple[XY, XY]

    @property
    def leg(self) -> LineLeg:
        """All of them as one."""
        return LineLeg(self.ends, self.legs[0].width, self.legs[0].name)


def _streets(
    legs: Sequence[LineLeg], nodes: Mapping[XY, Sequence[LineLeg]]
) -> Iterator[_Street]:
    """Yield the legs, those together that go straight on with one width and name."""
    graph: nx.Graph[LineLeg] = nx.Graph()
    graph.add_nodes_from(legs)
    for node, leaving in nodes.items():
        graph.add_edges_from(
            (leg, other)
            for leg, other in combinations(leaving, 2)
            if leg in graph and other in graph and _goes_on(node, leg, other)
        )
    for group in nx.connected_components(graph):
        street = sorted(group, key=legs.index)
        places = [end for leg in street for end in leg.ends]
        ends = max(combinations(places, 2), key=lambda pair: math.dist(*pair))
        chord = LineString(ends)
        if all(chord.distance(Point(place)) <= OFF_LINE for place in places):
            yield _Street(tuple(street), ends)
        else:
            yield from (_Street((leg,), leg.ends) for leg in street)


def _goes_on(node: XY, leg: LineLeg, other: LineLeg) -> bool:
    """Tell whether one leg is the other, gone on straight from a node."""
    headings = [heading_to(node, each.points_from(node)[1]) for each in (leg, other)]
    return (
        leg.name == other.name
        and len(leg.points) == len(other.points) == 2
        and max(leg.width, other.width) <= SAME_WIDTH * min(leg.width, other.width)
        and math.pi - abs(turn_between(*headings)) < IN_LINE
    )


def _width(rectangle: Polygon) -> float:
    ring = rectangle.exterior.coords
    return math.dist(ring[0], ring[3])


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


def _reach_beyond(
    end: XY, leg: LineLeg, nodes: Mapping[XY, Sequence[LineLeg]]
) -> float:
    """Return how far a corridor may go on beyond the end of a step."""
    if end not in leg.ends:
        return leg.width * math.tan(BEND / 2)
    others = [each.width for each in nodes[end] if each is not leg]
    return max(others) / 2 if others else leg.width


def _fitting(
    floor: _Floor,
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
    left = furthest(lambda side: free(side, 0.0), most)
    right = furthest(lambda side: free(0.0, side), most)
    if left + right < NARROWEST + 2 * EASE:
        return None

    def free_beyond(more: float) -> bool:
        return floor.covers(strip(end, heading, more, left, right))

    def free_behind(more: float) -> bool:
        return floor.covers(strip(start, heading + math.pi, more, right, left))

    back = furthest(free_behind, inset + reaches[0])
    ahead = furthest(free_beyond, inset + reaches[1])
    # Back from the eased walls to the true ones.
    left, right, back, ahead = (side - EASE for side in (left, right, back, ahead))
    whole = back + length + ahead
    if whole < max(SHORTEST, LONGER_THAN_WIDE * (left + right)):
        return None
    return strip(moved(start, heading, -back), heading, whole, left, right)
