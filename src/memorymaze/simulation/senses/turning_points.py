"""Which turning point the robot is in, how it got in, and where one can go from there.

`TurningPointSource` is the role; here it is played from the annotations of the site plan, as in
the paper (Sec. III-B), in `lidar_turning_points.py` by what the robot measures.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import shapely
from shapely import Point

from memorymaze.geometry.pose import Pose, turn_between
from memorymaze.simulation.motion.straight_ways import StraightWays
from memorymaze.simulation.scene import Scene
from memorymaze.sites.records import Exit, Site, TurningPoint

XY = tuple[float, float]
WAY_BACK_TOLERANCE = math.radians(75)
"""Greatest angle between an exit and straight back for it to be the way it came."""
OTHER_FLOOR_PENALTY = 0.5
"""Radians added to that angle when the exit leads to other floor than it came from."""
SAME_LINE = math.radians(20)
"""Ways that meet at less than this angle count as one line."""


class WayOut(Protocol):
    """A way that leads out of a turning point."""

    @property
    def heading(self) -> float:
        """Outward, radians."""
        ...

    @property
    def to(self) -> str | None:
        """Id of the corridor or area it leads to; None where that is not known."""
        ...


class Stay(Protocol):
    """A stay in one turning point."""

    def onward(self) -> Sequence[WayOut]:
        """Return every way but the one it came by."""
        ...

    def choices(self) -> Sequence[WayOut]:
        """Return the ways it can turn into: all, once it has turned here."""
        ...

    def everywhere(self) -> Sequence[WayOut]:
        """Return all ways, the one it came by included."""
        ...

    def meeting_point(self, chosen: int, place: XY, course: float) -> XY:
        """Return where to turn into a way, metres.

        Args:
            chosen: Index of the way in `choices`.
            place: A place on the line the robot comes along, metres.
            course: The way that line goes, radians.
        """
        ...


class TurningPointSource(Protocol):
    """Follows one robot in and out of turning points."""

    @property
    def number(self) -> int | None:
        """Of the turning point it is in, by order of first stays, from 1; or None."""
        ...

    @property
    def current(self) -> Stay | None:
        """The stay that goes on; None outside turning points."""
        ...

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """Take note of where the robot is.

        Args:
            pose: Of the robot.
            travel: The way it moves, or faces when it has not moved yet, radians; None
                while it only turns.
            time: Simulated seconds.
        """
        ...

    def note_turn(self) -> None:
        """Take note that the robot has turned where it is."""
        ...


@dataclass(slots=True)
class Visit:
    """A stay in one turning point."""

    point: TurningPoint
    came_by: Exit | None
    """The exit it came in by; None when none lies behind it."""
    turned: bool = False
    """Whether it has turned here."""

    def onward(self) -> list[Exit]:
        """Return every exit except the one it came by."""
        return [each for each in self.point.exits if each is not self.came_by]


class TurningPointVisits:
    """Follows a robot in and out of turning points and numbers them as it meets them."""

    def __init__(self, site: Site) -> None:
        """Begin outside all turning points."""
        # Called 20 times a simulated second: plain numbers, the boxes first.
        self._boxes = [
            (*point.polygon.bounds, _shape(point)) for point in site.turning_points
        ]
        self._floors = {
            each.id: each.polygon
            for each in (*site.corridors, *site.areas, *site.turning_points)
        }
        self._visits: dict[int, Visit] = {}
        self._numbers: dict[str, int] = {}
        self._current: Visit | None = None

    @property
    def current(self) -> Visit | None:
        """The stay that counts now: of overlapping ones, where the centre is nearest."""
        return self._current

    @property
    def number(self) -> int | None:
        """Number of the current turning point in the order of first visits, from 1."""
        current = self._current
        return None if current is None else self._numbers[current.point.id]

    def update(self, x: float, y: float, travel: float) -> None:
        """Take note of where the robot is.

        Args:
            x: Metres.
            y: Metres.
            travel: The way it moves, or faces when it has not moved yet, radians.
        """
        visits = self._visits
        nearest, least = None, math.inf
        for index, (west, south, east, north, shape) in enumerate(self._boxes):
            if west <= x <= east and south <= y <= north and shape.covers(x, y):
                if index not in visits:
                    visits[index] = Visit(
                        shape.point, self._way_back(shape.point, x, y, travel)
                    )
                distance = (x - shape.centre_x) ** 2 + (y - shape.centre_y) ** 2
                if distance < least:
                    nearest, least = visits[index], distance
            elif index in visits:
                del visits[index]
        self._current = nearest
        if nearest is not None and nearest.point.id not in self._numbers:
            self._numbers[nearest.point.id] = len(self._numbers) + 1

    def note_turn(self) -> None:
        """Take note that the robot has turned where it is."""
        for visit in self._visits.values():
            visit.turned = True

    def _way_back(
        self, point: TurningPoint, x: float, y: float, travel: float
    ) -> Exit | None:
        best, least = None, WAY_BACK_TOLERANCE
        here = Point(x, y)
        for each in point.exits:
            angle = abs(turn_between(travel + math.pi, each.heading))
            if shapely.distance(self._floors[each.to], here) > 0.3:
                angle += OTHER_FLOOR_PENALTY
            if angle < least:
                best, least = each, angle
        return best


def meeting_point(
    point: TurningPoint,
    chosen: Exit,
    place: XY,
    course: float,
    ways: StraightWays,
) -> XY:
    """Return where in a turning point to turn into an exit.

    Where the line the robot comes along meets the centre line of the way it chose;
    where they meet elsewhere, the place on the chosen way nearest to the centre. An
    exit into an open area has no centre line: its line goes through the centre.

    Args:
        point: The turning point the robot is in.
        chosen: One of its exits.
        place: A place on the line the robot comes along, metres.
        course: The way that line goes, radians.
        ways: Centre lines of this site.
    """
    centre = point.polygon.centroid
    ux, uy = math.cos(chosen.heading), math.sin(chosen.heading)
    through = (centre.x, centre.y)
    axis = ways.axis_through(point, chosen)
    if axis is not None:
        ux, uy = axis.ux, axis.uy
        through = axis.at(axis.local(*through)[0])
    vx, vy = math.cos(course), math.sin(course)
    sine = vx * uy - vy * ux
    if abs(sine) > math.sin(SAME_LINE):
        dx, dy = through[0] - place[0], through[1] - place[1]
        along = (dx * uy - dy * ux) / sine
        meeting = (place[0] + along * vx, place[1] + along * vy)
        if point.polygon.covers(Point(meeting)):
            return meeting
    if point.polygon.covers(Point(through)):
        return through
    return (centre.x, centre.y)


@dataclass(frozen=True, slots=True)
class _Shape:
    """A turning point's polygon as plain numbers."""

    point: TurningPoint
    corners: tuple[XY, ...]
    centre_x: float
    centre_y: float

    def covers(self, x: float, y: float) -> bool:
        px, py = self.corners[-1]
        for qx, qy in self.corners:
            if (qx - px) * (y - py) - (qy - py) * (x - px) < -1e-9:
                return False
            px, py = qx, qy
        return True


def _shape(point: TurningPoint) -> _Shape:
    ring = point.polygon.exterior
    corners = [(x, y) for x, y, *_ in ring.coords[:-1]]
    if not ring.is_ccw:
        corners.reverse()
    centre = point.polygon.centroid
    return _Shape(point, tuple(corners), centre.x, centre.y)


class AnnotatedTurningPoints:
    """Turning points as the site plan tells them; implements `TurningPointSource`."""

    def __init__(self, scene: Scene) -> None:
        """Begin outside all turning points."""
        self._scene = scene
        self._visits = TurningPointVisits(scene.site)

    @property
    def number(self) -> int | None:
        """See `TurningPointSource.number`."""
        return self._visits.number

    @property
    def current(self) -> Stay | None:
        """See `TurningPointSource.current`."""
        visit = self._visits.current
        if visit is None:
            return None
        return _AnnotatedStay(visit, self._scene.straight_ways)

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `TurningPointSource.update`."""
        if travel is not None:
            self._visits.update(pose.x, pose.y, travel)

    def note_turn(self) -> None:
        """See `TurningPointSource.note_turn`."""
        self._visits.note_turn()


@dataclass(frozen=True, slots=True)
class _AnnotatedStay:
    visit: Visit
    ways: StraightWays

    def onward(self) -> Sequence[Exit]:
        return self.visit.onward()

    def choices(self) -> Sequence[Exit]:
        return self.everywhere() if self.visit.turned else self.onward()

    def everywhere(self) -> Sequence[Exit]:
        return self.visit.point.exits

    def meeting_point(self, chosen: int, place: XY, course: float) -> XY:
        way = self.choices()[chosen]
        return meeting_point(self.visit.point, way, place, course, self.ways)
