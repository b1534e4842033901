"""From a layout to floor polygons and turning points."""

import math
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import cast

from shapely import MultiPoint, Point, Polygon, set_precision

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, moved, turn_between
from memorymaze.world.construction.layout import (
    Layout,
    Street,
    UnsuitableFloor,
)
from memorymaze.world.construction.skeleton import IN_LINE, Skeleton, SkeletonLeg
from memorymaze.world.sites.exits import FloorShapes, exits_into_the_open, shape_of
from memorymaze.world.sites.records import Exit, TurningPoint, floor_pieces

THROUGH = math.radians(20)
"""Legs that bend less than this are one street at a junction."""
SHARPEST_MITRE = math.radians(60)
"""Where a street bends more, the turning point is where both its pieces overlap."""
POINT_DEPTH = 2.4
"""Metres of a dead end, or of a hall's mouth, that are a turning point."""
OVERLAP = 0.3
"""Square metres that two turning points may share."""


class MadeFloor:
    """The floor of a layout: corridors, halls and turning points."""

    def __init__(self, layout: Layout, skeleton: Skeleton) -> None:
        """Widen the streets of a layout, cut where `skeleton` says."""
        self.layout = layout
        self.skeleton = skeleton
        self.corridors = {
            (number, piece): rounded(Polygon(corners))
            for number, street in enumerate(layout.streets)
            for piece, corners in enumerate(_street_pieces(street))
        }
        self.halls = [rounded(hall.polygon) for hall in layout.halls]
        parts = floor_pieces([*self.corridors.values(), *self.halls])
        if len(parts) > 1:
            raise UnsuitableFloor("a floor in pieces")
        self.walkable = parts[0]

    @cached_property
    def turning_points(self) -> dict[int, TurningPoint]:
        """All turning points by their nodes.

        Raises:
            UnsuitableFloor: Two overlap.
        """
        found: dict[int, TurningPoint] = {}
        for node in self.skeleton.graph:
            point = self._turning_point(node)
            if point is None:
                continue
            for other in found.values():
                if point.polygon.intersection(other.polygon).area > OVERLAP:
                    raise UnsuitableFloor(f"{point.id} and {other.id} overlap")
            found[node] = point
        return found

    @cached_property
    def entrances(self) -> dict[int | None, str]:
        """What the entrances are called, by their nodes."""
        return {self.skeleton.node_at(end): name for end, name in self.layout.entrances}

    def hall_around(self, place: XY) -> int | None:
        """Return the number of the hall that a place lies in."""
        for number, polygon in enumerate(self.halls):
            if polygon.contains(Point(place)):
                return number
        return None

    def _turning_point(self, node: int) -> TurningPoint | None:
        legs = self.skeleton.legs(node)
        polygon = self._outline(node, legs)
        if polygon is None:
            return None
        place = self.skeleton.places[node]
        name = self.entrances.get(node)
        exits = [Exit(self._leads_to(leg), leg.heading) for leg in legs]
        number = self.hall_around(place)
        if number is not None:
            hall = self.halls[number]
            around = FloorShapes({}, {hall_id(number): hall}, {})
            exits += exits_into_the_open(legs[0].heading, polygon, around, hall, exits)
            name = name or self.layout.halls[number].name
        areas = [hall_id(number) for number in range(len(self.halls))]
        return TurningPoint(
            point_id(node),
            rounded(polygon),
            name,
            shape_of(exits, areas),
            tuple(exits),
        )

    def _leads_to(self, leg: SkeletonLeg) -> str:
        if leg.street is not None:
            return corridor_id(leg.street, leg.piece)
        return hall_id([hall.name for hall in self.layout.halls].index(leg.hall or ""))

    def _outline(self, node: int, legs: Sequence[SkeletonLeg]) -> Polygon | None:
        """Return the shape of a node's turning point, if it is one."""
        place = self.skeleton.places[node]
        in_hall = self.hall_around(place) is not None
        if len(legs) == 1:
            leg = legs[0]
            return None if in_hall else _strip(place, leg.heading, 0, POINT_DEPTH, leg)
        pair = _through_pair(legs)
        if pair is not None:
            sides = [leg for leg in legs if leg not in pair]
            wider = max(pair, key=lambda leg: leg.width)
            if not sides:
                across = [leg.street is None for leg in pair]
                if across[0] == across[1]:
                    return None
                street = pair[0] if across[1] else pair[1]
                return _strip(place, street.heading, -1.1, POINT_DEPTH - 1.1, street)
            reach = max(_mouth_reach(wider, side) for side in sides)
            return _strip(place, wider.heading, -reach, reach, wider)
        if in_hall:
            return Point(place).buffer(1.8, quad_segs=2)
        if len(legs) > 2 or legs[0].street != legs[1].street:
            raise UnsuitableFloor("a junction without a street that goes through")
        return _corner(place, legs[0], legs[1])


def corridor_id(street: int, piece: int) -> str:
    """Return the id of a street's straight piece."""
    return f"corridor_{street + 1}_{piece + 1}"


def hall_id(number: int) -> str:
    """Return the id of a hall."""
    return f"hall_{number + 1}"


def point_id(node: int) -> str:
    """Return the id of a node's turning point."""
    return f"tp_{node + 1}"


def rounded(polygon: Polygon) -> Polygon:
    """Return a polygon with whole millimetres."""
    return set_precision(polygon, 0.001, mode="pointwise")


def _through_pair(
    legs: Sequence[SkeletonLeg],
) -> tuple[SkeletonLeg, SkeletonLeg] | None:
    """Return the two legs of a node that are most in line, if any are."""
    pairs = [
        (math.pi - abs(turn_between(leg.heading, other.heading)), leg, other)
        for index, leg in enumerate(legs)
        for other in legs[:index]
    ]
    bend, leg, other = min(
        pairs,
        key=lambda each: (each[0] > IN_LINE, -each[1].width - each[2].width, each[0]),
    )
    return (leg, other) if bend < (THROUGH if len(legs) > 2 else IN_LINE) else None


def _mouth_reach(through: SkeletonLeg, side: SkeletonLeg) -> float:
    """Return how far from a node along its street a side street's mouth reaches."""
    angle = abs(turn_between(through.heading, side.heading))
    slant = abs(through.width / 2 / math.tan(angle))
    return max(slant + side.width / 2 / math.sin(angle) + 0.05, 1.0)


def _strip(
    place: XY, heading: float, start: float, end: float, leg: SkeletonLeg
) -> Polygon:
    """Return a rectangle across a leg's whole width, metres along it."""
    near, far = moved(place, heading, start), moved(place, heading, end)
    side = leg.width / 2
    return Polygon([
        moved(near, heading - math.pi / 2, side),
        moved(far, heading - math.pi / 2, side),
        moved(far, heading + math.pi / 2, side),
        moved(near, heading + math.pi / 2, side),
    ])


def _corner(place: XY, leg: SkeletonLeg, other: SkeletonLeg) -> Polygon:
    """Return where a street bends: both walls' corners and the floor between."""
    between = turn_between(leg.heading, other.heading)
    turn = math.pi - abs(between)
    outward = leg.heading + between / 2 + math.pi
    side = leg.width / 2
    outer = moved(place, outward, side / math.cos(turn / 2))
    inner = moved(place, outward, -side / math.cos(turn / 2))
    reach = side * math.tan(turn / 2)
    corners = [outer]
    for each, sign in ((leg, -1.0), (other, 1.0)):
        wall = each.heading + math.copysign(math.pi / 2, sign * between)
        if turn > SHARPEST_MITRE:
            # The outer wall of one piece up to where the other's inner wall meets it.
            along = (side + side * math.cos(turn)) / math.sin(turn)
            corners += [moved(moved(place, each.heading, along), wall, side), inner]
            continue
        cut = moved(place, each.heading, reach + 1.2)
        depth = _depth_to_line(cut, wall, inner, outward)
        corners += [moved(cut, wall, side), moved(cut, wall, max(depth, -side))]
    return cast(Polygon, MultiPoint(corners).convex_hull)


def _depth_to_line(start: XY, heading: float, on: XY, normal: float) -> float:
    """Return how far a ray goes to the line through a place with a normal."""
    across = math.cos(normal), math.sin(normal)
    gap = (on[0] - start[0]) * across[0] + (on[1] - start[1]) * across[1]
    return gap / math.cos(heading - normal)


def _street_pieces(street: Street) -> Iterator[tuple[XY, XY, XY, XY]]:
    """Yield the four corners of each straight piece; neighbours share an edge."""
    points = street.points
    pieces = len(points) - 1
    headings = [heading_to(points[i], points[i + 1]) for i in range(pieces)]

    def edge(vertex: int, before: float, after: float) -> tuple[XY, XY]:
        """Return the right and left ends of the edge across a vertex."""
        bend = turn_between(before, after)
        across = before + bend / 2 + math.pi / 2
        reach = street.width / 2 / math.cos(bend / 2)
        return (
            moved(points[vertex], across, -reach),
            moved(points[vertex], across, reach),
        )

    for piece in range(pieces):
        here = headings[piece]
        before = headings[piece - 1] if piece or street.is_loop else here
        goes_on = piece + 1 < pieces or street.is_loop
        after = headings[(piece + 1) % pieces] if goes_on else here
        right, left = edge(piece, before, here)
        far_right, far_left = edge(piece + 1, here, after)
        yield right, far_right, far_left, left
