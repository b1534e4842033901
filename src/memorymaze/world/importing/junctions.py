"""Turning points: where legs meet, bend, or come into the open, and the ways out."""

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import cast

import networkx as nx
import shapely
from shapely import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import nearest_points

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.importing.imported import ImportNotes
from memorymaze.world.importing.line_graph import BEND, LineLeg, nodes_of
from memorymaze.world.importing.shapes import convex_region, strip
from memorymaze.world.sites.exits import (
    Course,
    FloorShapes,
    exits_along,
    exits_into_the_open,
)
from memorymaze.world.sites.records import Exit

SMALLEST_POINT = 0.5
"""Square metres of the smallest turning point."""
OPEN_AHEAD = 2.0
"""Metres of floor beyond the wall that would end a way, where it ends in the open."""
ONE_PLACE, ONE_PLACE_LEAST = 0.75, 1.2
"""Nodes nearer than so many widths of the way, or metres, are one turning point."""
COURSE = 3.0
"""Metres of a leg that tell in which direction it leaves a node."""
ASIDE = tuple(
    math.radians(each)
    for each in (0, 5, -5, 10, -10, 15, -15, 20, -20, 30, -30, 40, -40)
)
"""Radians to look aside from a leg for floor to leave over."""


@dataclass(frozen=True)
class LineJunction:
    """A convex piece of floor where one can change direction."""

    polygon: Polygon
    leaving: tuple[tuple[XY, LineLeg], ...]
    """The legs that leave it, each with the node it begins at."""
    is_open: bool
    """Whether it lies at an open area."""


def junctions_of(
    legs: Sequence[LineLeg],
    floor: Polygon,
    across: Collection[LineLeg],
    notes: ImportNotes,
) -> list[LineJunction]:
    """Return a convex piece of floor wherever legs meet, bend or come into the open.

    `across` are the legs that cross open areas.
    """
    nodes = nodes_of(legs)
    alone = {
        node
        for node, leaving in nodes.items()
        if len(leaving) == 1
        and leaving[0] not in across
        and _ends_in_the_open(node, leaving[0], floor)
    }
    kept = alone | {
        node
        for node, leaving in nodes.items()
        if _changes_direction([(node, leg) for leg in leaving], across)
    }
    groups = _grouped(sorted(kept), legs)
    found: list[LineJunction] = []
    for group in groups:
        leaving = tuple(
            (node, leg)
            for node in group
            for leg in nodes[node]
            if not (set(leg.ends) <= set(group) and leg.length < _one_place(leg))
        )
        is_end = len(leaving) == 1 and group[0] in alone
        if not is_end and not _changes_direction(leaving, across):
            continue
        middle = _middle_of(group, floor)
        widest = max(leg.width for node in group for leg in nodes[node])
        spread = max(math.dist(middle, node) for node in group)
        others = [node for other in groups if other is not group for node in other]
        apart = min((math.dist(middle, node) for node in others), default=math.inf)
        radius = min(max(1.0, 0.75 * widest + 0.25) + spread, max(0.55 * apart, 0.75))
        polygon = convex_region(floor, middle, radius)
        if polygon is None or polygon.area < SMALLEST_POINT:
            notes.missing.append(
                f"a turning point at ({middle[0]:.1f}, {middle[1]:.1f}): there is no "
                "room for it"
            )
            continue
        is_open = is_end or any(leg in across for _, leg in leaving)
        found.append(LineJunction(polygon, leaving, is_open))
    return found


def exits_of(
    junction: LineJunction, floor: BaseGeometry, parts: FloorShapes
) -> list[Exit]:
    """Return the directions in which one can leave: on its legs, and into the open.

    A leg may have to be left a little aside, and one that a wall ends at once is none.
    """
    place = junction.polygon
    parts = FloorShapes(*(
        {name: part for name, part in kind.items() if part is not place}
        for kind in parts
    ))  # fmt: skip
    courses = _courses_from(junction, parts)
    found = list(exits_along(courses, place, floor, aside=ASIDE))
    if junction.is_open:
        ahead = _course(*junction.leaving[0])
        found += exits_into_the_open(ahead, place, parts, floor, found)
    return sorted(found, key=lambda each: each.heading % (2 * math.pi))


def _courses_from(junction: LineJunction, parts: FloorShapes) -> Iterator[Course]:
    """Yield the legs that go on beyond a junction, as far as tells what they lead into."""
    for node, leg in junction.leaving:
        line = LineString(leg.points_from(node)).difference(junction.polygon)
        if not line.is_empty:
            beyond = cast(LineString, shapely.get_parts(line)[-1])
            end = beyond.interpolate(min(COURSE / 2, beyond.length))
            probe = LineString([beyond.interpolate(0), end])
            yield Course(_course(node, leg), probe, parts)


def _course(node: XY, leg: LineLeg) -> float:
    """Return the heading in which a leg leaves a node."""
    line = LineString(leg.points_from(node))
    there = line.interpolate(min(COURSE, line.length))
    end = (there.x, there.y)
    # A leg may come back to where it began.
    return heading_to(node, end if end != node else leg.points_from(node)[1])


def _changes_direction(
    leaving: Sequence[tuple[XY, LineLeg]], across: Collection[LineLeg]
) -> bool:
    """Tell whether one can do other than go straight on in the same surroundings."""
    if len(leaving) != 2:
        return len(leaving) > 2
    if len({leg in across for _, leg in leaving}) > 1:
        return True
    bend = turn_between(*(_course(node, leg) for node, leg in leaving))
    return math.pi - abs(bend) > BEND


def _ends_in_the_open(node: XY, leg: LineLeg, floor: Polygon) -> bool:
    """Tell whether there is floor ahead and to both sides where a way ends."""
    heading = heading_to(leg.points_from(node)[1], node)
    ahead = leg.width / 2 + OPEN_AHEAD
    aside = leg.width / 2 + OPEN_AHEAD / 2
    return floor.covers(strip(node, heading, ahead, aside, aside))


def _one_place(leg: LineLeg) -> float:
    return max(ONE_PLACE_LEAST, ONE_PLACE * leg.width)


def _grouped(nodes: Sequence[XY], legs: Sequence[LineLeg]) -> list[list[XY]]:
    """Return the nodes in groups that short legs join."""
    graph: nx.Graph[XY] = nx.Graph()
    graph.add_nodes_from(nodes)
    graph.add_edges_from(
        leg.ends
        for leg in legs
        if leg.length < _one_place(leg) and set(leg.ends) <= set(nodes)
    )
    return sorted(sorted(group) for group in nx.connected_components(graph))


def _middle_of(group: Sequence[XY], floor: Polygon) -> XY:
    """Return the middle of nodes, or the place near one of them that is free of walls."""
    mean = (
        sum(x for x, _ in group) / len(group),
        sum(y for _, y in group) / len(group),
    )

    def clearance(place: XY) -> float:
        spot = Point(place)
        return floor.boundary.distance(spot) * (1 if floor.covers(spot) else -1)

    best = max(group, key=clearance)
    if clearance(best) < SMALLEST_POINT:
        inner = floor.buffer(-SMALLEST_POINT)
        nearest = nearest_points(Point(best), floor if inner.is_empty else inner)[1]
        return (nearest.x, nearest.y)
    return mean if clearance(mean) >= 0.8 * clearance(best) else best
