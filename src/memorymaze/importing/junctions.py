"""Turning points: where legs meet, bend, or come into the open, and the ways out."""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

import networkx as nx
import shapely
from shapely import LineString, MultiPolygon, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import nearest_points

from memorymaze.geometry.points import XY
from memorymaze.geometry.pose import heading_to, moved, turn_between
from memorymaze.importing.imported import (
    ImportNotes,
)
from memorymaze.importing.line_graph import BEND, LineLeg, nodes_of
from memorymaze.importing.shapes import convex_region, strip
from memorymaze.sites.floor_rules import SAME_EXIT, TOUCH

SMALLEST_POINT = 0.5
"""Square metres of the smallest turning point."""
OPEN_AHEAD = 2.0
"""Metres of floor beyond the wall that would end a way, where it ends in the open."""
ONE_PLACE, ONE_PLACE_LEAST = 0.75, 1.2
"""Nodes nearer than so many widths of the way, or metres, are one turning point."""
OPEN_REACH = 4.0
"""Metres of open floor that make a direction one can leave in."""
COURSE = 3.0
"""Metres of a leg that tell in which direction it leaves a node."""
ASIDE_DEG = (0, 5, -5, 10, -10, 15, -15, 20, -20, 30, -30, 40, -40)
"""Degrees to look aside from a leg for floor to leave over."""


@dataclass(frozen=True)
class LineJunction:
    """A convex piece of floor where one can change direction."""

    polygon: Polygon
    leaving: tuple[tuple[XY, LineLeg], ...]
    """The legs that leave it, each with the node it begins at."""
    is_open: bool
    """Whether it lies at an open area."""


@dataclass(frozen=True)
class _WayOut:
    """A direction in which one can leave a turning point."""

    to: str
    heading: float
    """Radians."""


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


def ways_out(
    junction: LineJunction, floor: Polygon | MultiPolygon, parts: Mapping[str, Polygon]
) -> list[_WayOut]:
    """Return the directions in which one can leave, each to a part that touches.

    Two that cannot be told apart are one, and one that a wall ends at once is none.
    """
    neighbours = {
        name: part
        for name, part in parts.items()
        if part is not junction.polygon and part.distance(junction.polygon) <= TOUCH
    }
    found: list[_WayOut] = []
    for node, leg in junction.leaving:
        line = LineString(leg.points_from(node)).difference(junction.polygon)
        if line.is_empty:
            continue
        beyond = cast(LineString, shapely.get_parts(line)[-1])
        probe = LineString([
            beyond.interpolate(0), beyond.interpolate(min(COURSE / 2, beyond.length))
        ])  # fmt: skip
        to = _led_to(probe, neighbours)
        if to is None:
            continue
        heading = _free_heading(junction.polygon, _course(node, leg), floor)
        if heading is None or any(
            abs(turn_between(heading, each.heading)) < SAME_EXIT for each in found
        ):
            continue
        found.append(_WayOut(to, heading))
    if junction.is_open:
        found += _ways_into_the_open(junction, floor, neighbours, found)
    return sorted(found, key=lambda each: each.heading % (2 * math.pi))


def _ways_into_the_open(
    junction: LineJunction,
    floor: Polygon | MultiPolygon,
    neighbours: Mapping[str, Polygon],
    found: Sequence[_WayOut],
) -> Iterator[_WayOut]:
    """Yield the ways into an area ahead and to the sides, beside those that legs lead."""
    middle = junction.polygon.centroid
    start = (middle.x, middle.y)
    reach = math.sqrt(junction.polygon.area) / 2 + OPEN_REACH
    course = _course(*junction.leaving[0])
    for quarter in range(1, 4):
        heading = course + quarter * math.pi / 2
        if any(abs(turn_between(heading, each.heading)) < 1.0 for each in found):
            continue
        line = LineString([start, moved(start, heading, reach)])
        to = _led_to(line.difference(junction.polygon), neighbours)
        if to is not None and to.startswith("area") and floor.contains(line):
            yield _WayOut(to, heading)


def shape_of(junction: LineJunction, ways: Sequence[_WayOut]) -> str:
    """Return the word of the format for a turning point with so many ways out."""
    if junction.is_open:
        return "opening"
    return ("dead_end", "corner", "t_junction", "crossing")[min(len(ways), 4) - 1]


def _led_to(probe: BaseGeometry, neighbours: Mapping[str, Polygon]) -> str | None:
    """Return the part that a way leads into: a corridor before an area before others."""
    for kind in ("corridor", "area", "tp"):
        shares = {
            name: probe.intersection(part).length
            for name, part in neighbours.items()
            if name.startswith(kind)
        }
        if shares and max(shares.values()) > probe.length / 3:
            return max(shares, key=lambda name: shares[name])
    return None


def _free_heading(
    polygon: Polygon, course: float, floor: Polygon | MultiPolygon
) -> float | None:
    """Return a heading near a leg's on which there is floor, as the rule measures it."""
    middle = polygon.centroid
    start = (middle.x, middle.y)
    reach = 0.75 * math.sqrt(polygon.area) + 0.8 + TOUCH
    for aside in ASIDE_DEG:
        heading = course + math.radians(aside)
        if floor.contains(LineString([start, moved(start, heading, reach)])):
            return heading
    return None


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
