"""Where a robot gets to that always goes straight on, and the middle of that way.

The way follows the centre line of each corridor it is in, carries on over junctions
into corridors of about the same direction, and crosses open areas in a straight line.
It ignores obstacles and ends before a wall: 0.7 m from it, or in the turning point of a
bend, whose wall is too slanted to stop anyone there.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import shapely
from shapely import LineString, Point, Polygon

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.robot.simulation.motion.clearance import Clearance
from memorymaze.robot.steering.floor import END_GAP, StraightWay
from memorymaze.robot.steering.turning_points import WayOut
from memorymaze.world.sites.records import Corridor, Exit, Site, TurningPoint

ENTRY_TOLERANCE = math.radians(30)
"""Greatest angle between the robot's course and the corridor it begins to follow."""
BEND_TOLERANCE = math.radians(15)
"""Greatest bend from one corridor into the next that still is straight on; the same
as the greatest angle that is called `forward`."""
TOWARDS_TOLERANCE = math.radians(50)
"""As `ENTRY_TOLERANCE`, for the corridor a turn was made into."""
ENTRY_DISTANCE = 2.0
"""Metres before its end at which a corridor that was turned into is followed already."""
OFFSET_TOLERANCE = 1.2
"""Greatest sideways step in metres between the middles of two corridors in line."""
MOUTH_OFFSET = 3.0
"""As `OFFSET_TOLERANCE`, across an open area from which the way goes on nowhere else."""
MOUTH_DEPTH = 2.0
"""Metres before or behind the area's wall within which such a corridor begins."""
GAP_TOLERANCE = 1.0
"""Walls up to this many metres thick, such as pillars, do not end the way."""
SCAN_STEP = 0.25
EXIT_PROBE = 3.0
EDGE_GAP = 0.3
"""Metres before the edge of a bend's turning point at which it halts there."""
LEAST_CROSSING = 1.0
"""Metres of a turning point that the way must cross for that."""
BLIND_END = 6.0
"""Floor behind a turning point that has no exit this way, up to this many metres, is a
bend's outer side and not a way."""
LONGEST_WAY = 500.0
ON_FLOOR = 0.01
"""Metres outside the corridor's edge that still count as on its floor."""


@dataclass(frozen=True, slots=True)
class _Axis:
    """A corridor's centre line with its floor."""

    corridor: str
    """Id of the corridor."""
    x: float
    """Where the line begins, metres."""
    y: float
    """Where the line begins, metres."""
    ux: float
    """Unit vector along the line."""
    uy: float
    """Unit vector along the line."""
    length: float
    """Metres."""
    corners: tuple[XY, ...]
    """Of the floor, counter-clockwise, metres."""

    @property
    def heading(self) -> float:
        """Of the line, radians."""
        return math.atan2(self.uy, self.ux)

    def reversed_if(self, reverse: bool) -> "_Axis":
        """Return the axis that runs the other way, or itself."""
        if not reverse:
            return self
        x, y = self.at(self.length)
        return _Axis(self.corridor, x, y, -self.ux, -self.uy, self.length, self.corners)

    def local(self, x: float, y: float) -> XY:
        """Return metres along the axis and to the left of it."""
        dx, dy = x - self.x, y - self.y
        return dx * self.ux + dy * self.uy, dy * self.ux - dx * self.uy

    def at(self, along: float) -> XY:
        """Return the point of the line at metres along it."""
        return self.x + along * self.ux, self.y + along * self.uy

    def covers(self, x: float, y: float) -> bool:
        """Whether a point is on the corridor's floor."""
        px, py = self.corners[-1]
        for qx, qy in self.corners:
            inward = (qx - px) * (y - py) - (qy - py) * (x - px)
            if inward < -ON_FLOOR * math.hypot(qx - px, qy - py):
                return False
            px, py = qx, qy
        return True

    def floor_ahead(self, place: XY) -> float:
        """Return how far it is along the axis from a place on it to the floor's end."""
        nearest = math.inf
        px, py = self.corners[-1]
        for qx, qy in self.corners:
            nx, ny = qy - py, px - qx  # outward normal
            speed = nx * self.ux + ny * self.uy
            if speed > 1e-12:
                gap = nx * (px - place[0]) + ny * (py - place[1])
                nearest = min(nearest, gap / speed)
            px, py = qx, qy
        return max(nearest, 0.0)


def corridor_axis(corridor: Corridor) -> _Axis:
    """Return a corridor's axis, running as its centre line does."""
    (ax, ay), (bx, by) = [point[:2] for point in corridor.centre_line.coords]
    length = math.hypot(bx - ax, by - ay)
    ux, uy = (bx - ax) / length, (by - ay) / length
    corners = counter_clockwise(corridor.polygon)
    return _Axis(corridor.id, ax, ay, ux, uy, length, corners)


def counter_clockwise(polygon: Polygon) -> tuple[XY, ...]:
    """Return the corners of a polygon without holes, each once."""
    ring = polygon.exterior
    corners = [(x, y) for x, y, *_ in ring.coords[:-1]]
    if not ring.is_ccw:
        corners.reverse()
    return tuple(corners)


class StraightWays:
    """Finds straight ways on one site."""

    def __init__(self, site: Site, clearance: Clearance) -> None:
        """Take the centre lines of all corridors."""
        self._clearance = clearance
        self._axes = [corridor_axis(corridor) for corridor in site.corridors]
        self._turning_points = {each.id: each for each in site.turning_points}

    def way(
        self,
        position: XY,
        course: float,
        *,
        fresh: bool = True,
        towards: str | None = None,
    ) -> StraightWay:
        """Return the straight way from a place on the floor, for a robot on a course.

        A `fresh` robot has turned since it last followed a corridor: it joins one at an
        angle up to `ENTRY_TOLERANCE`. `towards` is the id of the corridor that a turn
        was made into.
        """
        tolerance = ENTRY_TOLERANCE if fresh else BEND_TOLERANCE
        place, course_now = position, course
        axis = self._corridor_at(position, course, tolerance, towards)
        followed: set[str] = set()
        if axis is not None:
            place = axis.at(axis.local(*position)[0])
            course_now = axis.heading
            tolerance = BEND_TOLERANCE
            followed.add(axis.corridor)
        points, courses = [place], list[float]()
        while True:
            ux, uy = math.cos(course_now), math.sin(course_now)
            reach = self._reach(place, (ux, uy))
            begin = 0.0 if axis is None else axis.floor_ahead(place) - 0.5
            begin = max(begin, 0.0)
            found = self._next_corridor(
                place, course_now, begin, reach, tolerance, followed
            ) or self._mouth_ahead(place, course_now, begin, reach, followed)
            if found is None:
                points.append((place[0] + reach * ux, place[1] + reach * uy))
                courses.append(course_now)
                return StraightWay(
                    tuple(points), tuple(courses), self._halt(points, courses)
                )
            at, axis = found
            followed.add(axis.corridor)
            tolerance = BEND_TOLERANCE
            new_course = axis.heading
            for point, piece_course in _transition(
                place, course_now, at, axis, new_course
            ):
                if math.dist(point, points[-1]) > 1e-6:
                    points.append(point)
                    courses.append(piece_course)
            place, course_now = points[-1], new_course

    def _mouth_ahead(
        self,
        place: XY,
        course: float,
        begin: float,
        reach: float,
        followed: set[str],
    ) -> tuple[float, _Axis] | None:
        """Find a corridor that leaves an open area beside where the line hits its wall.

        One walks through a lobby into the hallway opposite, although it lies a step or
        two to the side.
        """
        ux, uy = math.cos(course), math.sin(course)
        best: tuple[float, float, _Axis] | None = None
        for axis in self._along(course, BEND_TOLERANCE):
            at = (axis.x - place[0]) * ux + (axis.y - place[1]) * uy
            aside = abs(axis.local(place[0] + at * ux, place[1] + at * uy)[1])
            if (
                axis.corridor not in followed
                and reach - MOUTH_DEPTH <= at <= reach + MOUTH_DEPTH
                and at - begin >= MOUTH_DEPTH
                and OFFSET_TOLERANCE < aside <= MOUTH_OFFSET
                and (best is None or aside < best[0])
            ):
                leave = at - 2 * aside
                start = (place[0] + leave * ux, place[1] + leave * uy)
                if leave >= begin and self._clearance.is_within_walls([
                    start,
                    axis.at(0),
                ]):
                    best = aside, at - aside, axis
        return None if best is None else best[1:]

    def axis_through(self, point: TurningPoint, chosen: WayOut) -> _Axis | None:
        """Return the centre line of the corridor an exit leads into, outward.

        The exit may name the next turning point; then the corridor that runs out that
        way. None when it leads into an open area.
        """
        outward: _Axis | None = None
        centre = point.polygon.centroid
        for axis in self._along(chosen.heading, TOWARDS_TOLERANCE):
            if axis.corridor == chosen.to:
                return axis
            ahead = (
                centre.x + EXIT_PROBE * math.cos(chosen.heading),
                centre.y + EXIT_PROBE * math.sin(chosen.heading),
            )
            angle = turn_between(chosen.heading, axis.heading)
            if (
                abs(angle) <= BEND_TOLERANCE
                and axis.covers(*ahead)
                and chosen.to in self._turning_points
            ):
                outward = axis
        return outward

    def _halt(self, points: Sequence[XY], courses: Sequence[float]) -> float:
        line = LineString(points)
        length = line.length
        halt = length - END_GAP
        for point in self._turning_points.values():
            inside = line.intersection(point.polygon)
            if inside.length < LEAST_CROSSING:
                continue
            leaves = line.project(Point(shapely.get_coordinates(inside)[-1]))
            if leaves > length - 0.05 or length - leaves > BLIND_END:
                continue
            course = courses[_piece_at(points, leaves)]
            if not any(
                abs(turn_between(course, each.heading))
                <= (BEND_TOLERANCE if self._is_corridor(each) else ENTRY_TOLERANCE)
                for each in point.exits
            ):
                halt = min(halt, leaves - EDGE_GAP)
        return max(halt, 0.0)

    def _is_corridor(self, chosen: Exit) -> bool:
        return any(axis.corridor == chosen.to for axis in self._axes)

    def _corridor_at(
        self, position: XY, course: float, tolerance: float, towards: str | None
    ) -> _Axis | None:
        best, least = None, math.inf
        for axis in self._along(course, max(tolerance, TOWARDS_TOLERANCE)):
            along, aside = axis.local(*position)
            if axis.corridor == towards and (
                axis.covers(*position)
                or (-ENTRY_DISTANCE <= along <= 0 and abs(aside) <= OFFSET_TOLERANCE)
            ):
                return axis
            angle = abs(turn_between(course, axis.heading))
            cost = angle + 0.05 * abs(aside)
            if angle <= tolerance and cost < least and axis.covers(*position):
                best, least = axis, cost
        return best

    def _along(self, course: float, tolerance: float) -> Iterator[_Axis]:
        ux, uy, limit = math.cos(course), math.sin(course), math.cos(tolerance)
        for axis in self._axes:
            inner = axis.ux * ux + axis.uy * uy
            if abs(inner) >= limit - 1e-9:
                yield axis.reversed_if(inner < 0)

    def _reach(self, place: XY, direction: XY) -> float:
        crossings = self._clearance.wall_crossings(place, direction)
        for out, back in zip(crossings[0::2], crossings[1::2], strict=False):
            if back - out > GAP_TOLERANCE:
                return min(out, LONGEST_WAY)
        last = crossings[-1] if crossings else 0.0
        return min(last, LONGEST_WAY)

    def _next_corridor(
        self,
        place: XY,
        course: float,
        begin: float,
        reach: float,
        tolerance: float,
        followed: set[str],
    ) -> tuple[float, _Axis] | None:
        """Find the first corridor to follow from a distance along the line on."""
        ux, uy = math.cos(course), math.sin(course)
        best: tuple[float, float, _Axis] | None = None
        for axis in self._along(course, tolerance):
            if axis.corridor in followed:
                continue
            first, last = sorted(
                (x - place[0]) * ux + (y - place[1]) * uy
                for x, y in (axis.at(0), axis.at(axis.length))
            )
            at = max(begin, first - 0.5)
            stop = min(reach, last, math.inf if best is None else best[0])
            while at <= stop:
                x, y = place[0] + at * ux, place[1] + at * uy
                along, aside = axis.local(x, y)
                if (
                    abs(aside) <= OFFSET_TOLERANCE and 0 <= along <= axis.length
                ) or axis.covers(x, y):
                    if best is None or (at, abs(aside)) < best[:2]:
                        best = at, abs(aside), axis
                    break
                at += SCAN_STEP
        return None if best is None else (best[0], best[2])


def _piece_at(points: Sequence[XY], s: float) -> int:
    for piece, (a, b) in enumerate(pairwise(points)):
        s -= math.dist(a, b)
        if s <= 0:
            return piece
    return len(points) - 2


def _transition(
    place: XY, course: float, at: float, axis: _Axis, new_course: float
) -> Iterator[tuple[XY, float]]:
    """Lead from one line over to the centre line of the corridor met at a distance."""
    ux, uy = math.cos(course), math.sin(course)
    along, aside = axis.local(place[0] + at * ux, place[1] + at * uy)
    sine = ux * axis.uy - uy * axis.ux
    if abs(sine) > 0.05:
        dx, dy = axis.x - place[0], axis.y - place[1]
        meeting = (dx * axis.uy - dy * axis.ux) / sine
        if meeting >= 0 and abs(meeting - at) <= 4.0:
            yield (place[0] + meeting * ux, place[1] + meeting * uy), course
            return
    half = max(0.4, 0.9 * abs(aside))
    start = max(0.0, at - half)
    yield (place[0] + start * ux, place[1] + start * uy), course
    yield axis.at(along - (at - start) + 2 * half), new_course
