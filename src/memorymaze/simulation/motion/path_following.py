"""PID steering along a lane; pure arithmetic on plain numbers, called 20 times a second.

The errors are taken over distance, not time, so the robot steers the same way at any
speed: P on the sideways offset, I on its integral, D on the angle to the lane, which is
the offset's derivative.
"""

import math

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.motion.lanes import Lane, Station

GAIN_P = 2.0
"""Curvature per metre of offset, 1/m^2."""
GAIN_I = 0.15
"""Curvature per square metre of summed offset, 1/m^3."""
GAIN_D = 2.6
"""Curvature per unit of sideways slope, 1/m."""
INTEGRAL_REACH = 0.1
"""Greatest offset in metres that is summed, so that joining a lane winds nothing up."""
INTEGRAL_LIMIT = 0.4
"""Square metres."""


class LaneFollower:
    """Keeps a robot on one lane; it remembers how far it has come."""

    def __init__(self, lane: Lane) -> None:
        """Begin at the lane's first station."""
        self.lane = lane
        self.offset = 0.0
        """Metres from the lane, left positive, at the last update."""
        self.remaining = lane.length
        """Metres of lane that are left, at the last update."""
        self._index = 0
        self._angle = 0.0
        self._curvature = 0.0
        self._integral = 0.0
        self._s = 0.0

    @property
    def station(self) -> Station:
        """The station last passed."""
        return self.lane.stations[self._index]

    @property
    def off_course(self) -> float:
        """Radians from the lane's direction to the robot's, at the last update."""
        return self._angle

    @property
    def speed_limit(self) -> float:
        """Greatest speed here and at the next two stations, metres per second."""
        stations, i = self.lane.stations, self._index
        return min(station.speed for station in stations[i : i + 3])

    def stations_ahead(self, count: int) -> tuple[Station, ...]:
        """Return the station last passed and those after it, `count` at most."""
        return self.lane.stations[self._index : self._index + count]

    def update(self, pose: Pose) -> None:
        """Find the robot's place beside the lane."""
        stations = self.lane.stations
        last = len(stations) - 2
        i = self._index
        x, y, heading = pose
        while True:
            here = stations[i]
            cosine, sine = math.cos(here.heading), math.sin(here.heading)
            dx, dy = x - here.x, y - here.y
            along = dx * cosine + dy * sine
            if i >= last or along < stations[i + 1].s - here.s:
                break
            i += 1
        self._index = i
        self.offset = dy * cosine - dx * sine
        # A piece has its heading in its middle and bends towards its neighbours.
        aside = 0.0
        if last >= 0:
            aside = along - (stations[i + 1].s - here.s) / 2
        self._curvature = stations[i - 1 if aside < 0 and i else i].curvature
        lane_heading = here.heading + self._curvature * aside
        self._angle = math.remainder(heading - lane_heading, 2 * math.pi)
        s = here.s + along
        advance = s - self._s
        self._s = s
        self.remaining = self.lane.length - s
        if 0 < advance < 0.2 and abs(self.offset) < INTEGRAL_REACH:
            integral = self._integral + self.offset * advance
            self._integral = max(-INTEGRAL_LIMIT, min(INTEGRAL_LIMIT, integral))

    def turn_rate(self, speed: float) -> float:
        """Return how fast to turn at a speed; radians per second, left positive."""
        curvature = (
            self._curvature
            - GAIN_P * self.offset
            - GAIN_I * self._integral
            - GAIN_D * math.sin(self._angle)
        )
        return speed * curvature
