"""From a layout to floor polygons and turning points."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

from shapely import LineString, MultiPoint, Point, Polygon, set_precision

from memorymaze.construction.layout import (
    Layout,
    MadeHall,
    Street,
    UnsuitableFloor,
)
from memorymaze.construction.skeleton import IN_LINE, Skeleton, SkeletonLeg
from memorymaze.geometry.points import XY
from memorymaze.geometry.pose import heading_to, moved, turn_between
from memorymaze.sites.records import floor_pieces

THROUGH = math.radians(20)
"""Legs that bend less than this are one street at a junction."""
SHARPEST_MITRE = math.radians(60)
"""Where a street bends more, the turning point is where both its pieces overlap."""
POINT_DEPTH = 2.4
"""Metres of a dead end, or of a hall's mouth, that are a turning point."""
OPEN_AHEAD = 4.0
"""Metres of hall that make a direction one can leave in."""
OVERLAP = 0.3
"""Square metres that two turning points may share."""


@dataclass(frozen=True)
class MadeExit:
    """A way out of a turning point."""

    to: str
    """Id of a corridor or hall."""
    heading: float
    """Radians."""


@dataclass(frozen=True)
class MadeTurningPoint:
    """Where a walker can change streets."""

    id: str
    node: int
    polygon: Polygon
    shape: str
    exits: tuple[MadeExit, ...]


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
    def turning_points(self) -> tuple[MadeTurningPoint, ...]:
        """All turning points.

        Raises:
            UnsuitableFloor: Two overlap.
        """
        found = [
            point
            for node in self.skeleton.graph
            if (point := self._turning_point(node)) is not None
        ]
        for index, point in enumerate(found):
            for other in found[:index]:
                if point.polygon.intersection(other.polygon).area > OVERLAP:
                    raise UnsuitableFloor(f"{point.id} and {other.id} overlap")
        return tuple(found)

    def hall_around(self, place: XY) -> int | None:
        """Return the number of the hall that a place lies in."""
        for number, polygon in enumerate(self.halls):
            if polygon.contains(Point(place)):
                return number
        return None

    def hall_called(self, name: str) -> tuple[int, MadeHall]:
        """Return a hall and its number."""
        return next(
            (number, hall)
            for number, hall in enumerate(self.layout.halls)
            if hall.name == name
        )

    def _turning_point(self, node: int) -> MadeTurningPoint | None:
        legs = self.skeleton.legs(node)
        polygon = self._outline(node, legs)
        if polygon is None:
            return None
        exits = [MadeExit(self._leads_to(leg), leg.heading) for leg in legs]
        hall = self.hall_around(self.skeleton.places[node])
        ways_in_hall = (
            list(self._ways_into(hall, polygon, legs)) if hall is not None else []
        )
        shape = ("dead_end", "corner", "t_junction", "crossing")[len(legs) - 1]
        if ways_in_hall or any(leg.street is None for leg in legs):
            shape = "opening"
        return MadeTurningPoint(
            f"tp_{node + 1}", node, rounded(polygon), shape, tuple(exits + ways_in_hall)
        )

    def _leads_to(self, leg: SkeletonLeg) -> str:
        if leg.street is not None:
            return corridor_id(leg.street, leg.piece)
        return hall_id(self.hall_called(leg.hall or "")[0])

    def _ways_into(
        self, hall: int, polygon: Polygon, legs: Sequence[SkeletonLeg]
    ) -> Iterator[MadeExit]:
        """Yield the ways into a hall beside those that the legs lead."""
        middle = polygon.centroid
        reach = math.sqrt(polygon.area) / 2 + OPEN_AHEAD
        taken = [leg.heading for leg in legs]
        for quarter in range(4):
            heading = legs[0].heading + quarter * math.pi / 2
            if min(abs(turn_between(heading, each)) for each in taken) < 1.0:
                continue
            end = moved((middle.x, middle.y), heading, reach)
            if self.halls[hall].contains(LineString([(middle.x, middle.y), end])):
                taken.append(heading)
                yield MadeExit(hall_id(hall), heading)

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
