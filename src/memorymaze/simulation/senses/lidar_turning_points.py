"""Turning points as the robot's LiDAR and odometry tell them, without the site plan."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from memorymaze.errors import SettingsError
from memorymaze.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.perception.turning_points import SensedWay, TurningPointFinder
from memorymaze.simulation.motion.straight_ways import WayOut
from memorymaze.simulation.senses.lidar import Lidar
from memorymaze.simulation.senses.odometry import Odometry
from memorymaze.simulation.senses.turning_points import (
    Stay,
    where_lines_meet,
)

XY = tuple[float, float]

SCAN_PERIOD = 0.2
"""Simulated seconds from one scan to the next."""
FIRST_SCANS = 3
"""Scans before the robot sets out, so that it knows where it stands."""
FARTHEST_MEETING = 2.5
"""Metres from the middle of a turning point within which ways can meet."""


class LidarTurningPoints:
    """Turning points found by a LiDAR as the robot drives.

    Implements `TurningPointSource`. It knows of the building what the scans show, in
    the odometry's frame; ways are turned into the building's frame only to steer by.
    """

    def __init__(self, lidar: Lidar, odometry: Odometry, start: Pose) -> None:
        """Look around from the start.

        Args:
            lidar: On the robot; with one beam.
            odometry: At its beginning.
            start: Pose of the robot.

        Raises:
            SettingsError: The LiDAR scans in more than one plane.
        """
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
