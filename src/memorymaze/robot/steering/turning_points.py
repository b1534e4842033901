"""Which turning point the robot is in, how it got in, and where one can go from there.

`TurningPointSource` is the role. `LidarTurningPoints` plays it from what the robot
measures; from a site plan the simulation does.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.perception.turning_points import SensedWay, TurningPointFinder

SAME_LINE = math.radians(20)
"""Ways that meet at less than this angle count as one line."""
SCAN_PERIOD = 0.2
"""Seconds from one scan to the next."""
FIRST_SCANS = 3
"""Scans before the robot sets out, so that it knows where it stands."""
FARTHEST_MEETING = 2.5
"""Metres from the middle of a turning point within which ways can meet."""


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


class LidarTurningPoints:
    """Turning points found by a LiDAR as the robot drives.

    Implements `TurningPointSource`. It knows of the building what the scans show, in
    the odometry's frame; ways are turned into the frame of the robot's steering, which may
    be another one, only to steer by.
    """

    def __init__(
        self,
        scan: Callable[[Pose, float], LidarScan],
        start: Pose,
        odometry: Callable[[Pose], Pose] | None = None,
    ) -> None:
        """Look around from the start.

        `scan` measures at a pose and a time, with one beam. `odometry` says where the robot
        believes it is when steering says where it is; None where both are the same.
        """
        self._measure = scan
        self._odometry = odometry
        self._finder = TurningPointFinder()
        self._steered = self._believed = start
        if odometry is not None:
            self._believed = odometry(start)
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
            self._where_steered(current.x, current.y),
            ways if back is None else (*ways, back),
            back,
            self._turned_in == current.number,
        )

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `TurningPointSource.update`."""
        self._steered = self._believed = pose
        if self._odometry is not None:
            self._believed = self._odometry(pose)
        if time >= self._due - 1e-9:
            self._scan(time)
            if self.number != self._turned_in:
                self._turned_in = None

    def note_turn(self) -> None:
        """See `TurningPointSource.note_turn`."""
        self._turned_in = self.number

    def _scan(self, time: float) -> None:
        scan = self._measure(self._steered, time)
        if scan.ranges.ndim != 1:
            raise SettingsError(
                "turning points by LiDAR: expected a LiDAR with 1 beam, got "
                f"{len(scan.ranges)}"
            )
        self._finder.update(self._believed, scan.angles, scan.ranges)
        self._due = time + SCAN_PERIOD

    def _way_out(self, way: SensedWay) -> "_SensedWayOut":
        turn = turn_between(self._believed.heading, way.heading)
        heading = wrap_angle(self._steered.heading + turn)
        return _SensedWayOut(heading, self._where_steered(way.x, way.y))

    def _where_steered(self, x: float, y: float) -> XY:
        believed, steered = self._believed, self._steered
        turn = turn_between(believed.heading, steered.heading)
        dx, dy = x - believed.x, y - believed.y
        return (
            steered.x + dx * math.cos(turn) - dy * math.sin(turn),
            steered.y + dx * math.sin(turn) + dy * math.cos(turn),
        )


class _SensedWayOut(NamedTuple):
    heading: float
    mouth: XY
    to: str | None = None


@dataclass(slots=True)
class _SensedStay(Stay):
    """A stay as it was known at one moment, in the frame of steering."""

    centre: XY
    sensed: tuple[_SensedWayOut, ...]
    came_by: WayOut | None
    turned: bool

    @property
    def ways(self) -> Sequence[_SensedWayOut]:
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
