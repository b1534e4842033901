"""Which turning point the robot is in, how it got in, and where one can go from there.

`TurningPointSource` is the role. `AnnotatedTurningPoints` plays it from the site plan, as
in the paper (Sec. III-B), `LidarTurningPoints` from what the robot measures.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import shapely
from shapely import Point

from memorymaze.errors import SettingsError
from memorymaze.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.perception.turning_points import SensedWay, TurningPointFinder
from memorymaze.simulation.motion.straight_ways import WayOut, counter_clockwise
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.lidar import Lidar
from memorymaze.simulation.senses.odometry import Odometry
from memorymaze.sites.records import Exit, TurningPoint

XY = tuple[float, float]

WAY_BACK_TOLERANCE = math.radians(75)
"""Greatest angle between an exit and straight back for it to be the way it came."""
OTHER_FLOOR_PENALTY = 0.5
"""Radians added to that angle when the exit leads to other floor than it came from."""
SAME_LINE = math.radians(20)
"""Ways that meet at less than this angle count as one line."""
SCAN_PERIOD = 0.2
"""Simulated seconds from one scan to the next."""
FIRST_SCANS = 3
"""Scans before the robot sets out, so that it knows where it stands."""
FARTHEST_MEETING = 2.5
"""Metres from the middle of a turning point within which ways can meet."""


class Stay(ABC):
    """A stay in one turning point."""

    turned: bool
    """Whether it has turned here."""
    came_by: WayOut | None
    """The way it came by; None when none lies behind it."""

    @property
    @abstractmethod
    def ways(self) -> Sequence[WayOut]:
        """All ways, the one it came by included."""

    @abstractmethod
    def meeting_point(self, way: WayOut, place: XY, course: float) -> XY:
        """Return where to turn into a way from a line through a place, on a course."""

    def onward(self) -> list[WayOut]:
        """Return every way but the one it came by."""
        return [each for each in self.ways if each is not self.came_by]

    def choices(self) -> Sequence[WayOut]:
        """Return the ways it can turn into: all, once it has turned here."""
        return self.ways if self.turned else self.onward()


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

        `travel` is the way it moves, or faces when it has not moved yet, radians; None
        while it only turns.
        """
        ...

    def note_turn(self) -> None:
        """Take note that the robot has turned where it is."""
        ...


def where_lines_meet(place: XY, course: float, through: XY, direction: XY) -> XY | None:
    """Return where a line meets a way; None where they are about one line.

    The line goes through a place on a course; the way through another, along a unit
    vector.
    """
    ux, uy = direction
    vx, vy = math.cos(course), math.sin(course)
    sine = vx * uy - vy * ux
    if abs(sine) <= math.sin(SAME_LINE):
        return None
    along = ((through[0] - place[0]) * uy - (through[1] - place[1]) * ux) / sine
    return place[0] + along * vx, place[1] + along * vy


class AnnotatedTurningPoints:
    """Turning points as the site plan tells them; implements `TurningPointSource`."""

    def __init__(self, scene: Scene) -> None:
        """Begin outside all turning points."""
        self._scene = scene
        site = scene.site
        # Called 20 times a simulated second: plain numbers, the boxes first.
        self._boxes = [
            (*point.polygon.bounds, _outline(point)) for point in site.turning_points
        ]
        self._floors = {
            each.id: each.polygon
            for each in (*site.corridors, *site.areas, *site.turning_points)
        }
        self._visits: dict[int, Visit] = {}
        self._numbers: dict[str, int] = {}
        self._current: Visit | None = None

    @property
    def current(self) -> "Visit | None":
        """The stay that counts now: of overlapping ones, where the centre is nearest."""
        return self._current

    @property
    def number(self) -> int | None:
        """See `TurningPointSource.number`."""
        current = self._current
        return None if current is None else self._numbers[current.point.id]

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `TurningPointSource.update`."""
        if travel is None:
            return
        x, y, _ = pose
        visits = self._visits
        nearest, least = None, math.inf
        for index, (west, south, east, north, outline) in enumerate(self._boxes):
            if west <= x <= east and south <= y <= north and outline.covers(x, y):
                if index not in visits:
                    point = outline.point
                    came_by = self._way_back(point, x, y, travel)
                    visits[index] = Visit(point, self._scene, came_by)
                distance = (x - outline.centre_x) ** 2 + (y - outline.centre_y) ** 2
                if distance < least:
                    nearest, least = visits[index], distance
            elif index in visits:
                del visits[index]
        self._current = nearest
        if nearest is not None and nearest.point.id not in self._numbers:
            self._numbers[nearest.point.id] = len(self._numbers) + 1

    def note_turn(self) -> None:
        """See `TurningPointSource.note_turn`."""
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


@dataclass(slots=True)
class Visit(Stay):
    """A stay in a turning point of the site plan."""

    point: TurningPoint
    scene: Scene
    came_by: WayOut | None = None
    turned: bool = False

    @property
    def ways(self) -> Sequence[Exit]:
        """See `Stay.ways`."""
        return self.point.exits

    def meeting_point(self, way: WayOut, place: XY, course: float) -> XY:
        """Return where the robot's line meets the centre line of the way it chose.

        Where they meet elsewhere, the place on the chosen way nearest to the centre. An
        exit into an open area has no centre line: its line goes through the centre.
        """
        point = self.point
        centre = point.polygon.centroid
        direction = math.cos(way.heading), math.sin(way.heading)
        through = (centre.x, centre.y)
        axis = self.scene.straight_ways.axis_through(point, way)
        if axis is not None:
            direction = axis.ux, axis.uy
            through = axis.at(axis.local(*through)[0])
        meeting = where_lines_meet(place, course, through, direction)
        for wish in (meeting, through):
            if wish is not None and point.polygon.covers(Point(wish)):
                return wish
        return (centre.x, centre.y)


@dataclass(frozen=True, slots=True)
class _Outline:
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


def _outline(point: TurningPoint) -> _Outline:
    centre = point.polygon.centroid
    return _Outline(point, counter_clockwise(point.polygon), centre.x, centre.y)


class LidarTurningPoints:
    """Turning points found by a LiDAR as the robot drives.

    Implements `TurningPointSource`. It knows of the building what the scans show, in
    the odometry's frame; ways are turned into the building's frame only to steer by.
    """

    def __init__(self, lidar: Lidar, odometry: Odometry, start: Pose) -> None:
        """Look around from the start; the LiDAR has to have one beam."""
        if lidar.settings.beams != 1:
            raise SettingsError(
                "turning points by LiDAR: expected a LiDAR with 1 beam, got "
                f"{lidar.settings.beams}"
            )
        self._lidar = lidar
        self._odometry = odometry
        self._finder = TurningPointFinder()
        self._truth = start
        self._due = 0.0
        self._turned_in: int | None = None
        for _ in range(FIRST_SCANS):
            self._scan(0.0)

    @property
    def number(self) -> int | None:
        """See `TurningPointSource.number`."""
        current = self._finder.current
        return None if current is None else current.number

    @property
    def current(self) -> "_SensedStay | None":
        """See `TurningPointSource.current`."""
        current = self._finder.current
        if current is None:
            return None
        ways = tuple(self._way_out(way) for way in current.onward)
        back = None if current.back is None else self._way_out(current.back)
        return _SensedStay(
            self._in_building(current.x, current.y),
            ways if back is None else (*ways, back),
            back,
            self._turned_in == current.number,
        )

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `TurningPointSource.update`."""
        self._truth = pose
        self._odometry.update(pose)
        if time >= self._due - 1e-9:
            self._scan(time)
            if self.number != self._turned_in:
                self._turned_in = None

    def note_turn(self) -> None:
        """See `TurningPointSource.note_turn`."""
        self._turned_in = self.number

    def _scan(self, time: float) -> None:
        scan = self._lidar.scan(self._truth, time)
        self._finder.update(self._odometry.pose, scan.angles, scan.ranges)
        self._due = time + SCAN_PERIOD

    def _way_out(self, way: SensedWay) -> "_WayOut":
        turn = turn_between(self._odometry.pose.heading, way.heading)
        heading = wrap_angle(self._truth.heading + turn)
        return _WayOut(heading, self._in_building(way.x, way.y))

    def _in_building(self, x: float, y: float) -> XY:
        believed, truth = self._odometry.pose, self._truth
        turn = turn_between(believed.heading, truth.heading)
        dx, dy = x - believed.x, y - believed.y
        return (
            truth.x + dx * math.cos(turn) - dy * math.sin(turn),
            truth.y + dx * math.sin(turn) + dy * math.cos(turn),
        )


class _WayOut(NamedTuple):
    heading: float
    mouth: XY
    to: str | None = None


@dataclass(slots=True)
class _SensedStay(Stay):
    """A stay as it was known at one moment, in the building's frame."""

    centre: XY
    sensed: tuple[_WayOut, ...]
    came_by: WayOut | None
    turned: bool

    @property
    def ways(self) -> Sequence[_WayOut]:
        return self.sensed

    def meeting_point(self, way: WayOut, place: XY, course: float) -> XY:
        x, y = next(each.mouth for each in self.sensed if each is way)
        ux, uy = math.cos(way.heading), math.sin(way.heading)
        meeting = where_lines_meet(place, course, (x, y), (ux, uy))
        if meeting is None:
            along = (self.centre[0] - x) * ux + (self.centre[1] - y) * uy
            meeting = (x + along * ux, y + along * uy)
        if math.dist(meeting, self.centre) > FARTHEST_MEETING:
            return self.centre
        return meeting
