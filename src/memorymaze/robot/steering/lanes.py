"""The line a robot really drives: along a straight way and round things; and keeping to it.

`LaneFollower` steers by PID; it is pure arithmetic on plain numbers, called 20 times a
second. The errors are taken over distance, not time, so the robot steers the same way at
any speed: P on the sideways offset, I on its integral, D on the angle to the lane, which
is the derivative of the offset.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.steering.detours import SPACING, FreeSpace, make_detours
from memorymaze.robot.steering.floor import StraightWay

LaneEnd = Literal["wall", "obstacle", "done"]
"""What is behind the last station of a lane."""
SLANTED_END_GAP = 0.45
"""As `END_GAP`, measured square to a wall that the way meets at a slant."""
MIN_CLEARANCE = ROBOT_RADIUS + 0.07
"""Distance in metres that a lane keeps from walls and obstacles wherever it can."""
LEAST_CLEARANCE = ROBOT_RADIUS + 0.05
"""Distance in metres that a lane keeps from them everywhere."""
TIGHT_SPEED = 0.4
"""Metres per second where there is less room than `MIN_CLEARANCE`."""
OBSTACLE_GAP = 0.25
"""Metres left between the robot's shell and an obstacle it cannot pass, at least."""
END_OBSTACLE_DEPTH = 1.2
"""An obstacle whose front is this near to the end wall is part of it, metres."""
SIDEWAYS_ACCELERATION = 0.8
"""Greatest acceleration in bends, metres per second squared."""
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


class Station(NamedTuple):
    """A place on a lane."""

    x: float
    y: float
    heading: float
    """Of the lane towards the next station, radians."""
    curvature: float
    """1 / metres, left positive."""
    s: float
    """Metres from the lane's start."""
    speed: float
    """Greatest speed for its curvature and the room beside it, metres per second."""
    course: float
    """Heading of the straight way beside it, radians."""
    way_x: float
    way_y: float
    """Point of the straight way beside it."""


@dataclass(frozen=True, slots=True)
class Lane:
    """A line to drive along, from where the robot is."""

    stations: tuple[Station, ...]
    """At least one."""
    end: LaneEnd
    """What is behind its last station."""

    @property
    def length(self) -> float:
        """Metres."""
        return self.stations[-1].s


def plan_lane(
    way: StraightWay, pose: Pose, clearance: FreeSpace, max_speed: float
) -> Lane:
    """Plan the drive along a straight way: onto it, round obstacles, up to its end.

    Where an obstacle cannot be passed within 2 m to either side of the way, the lane
    ends before it.
    """
    base, courses = _stations_of(way)
    open_ahead = clearance.to_walls(base) >= SLANTED_END_GAP
    count = 1 + int(np.flatnonzero(open_ahead)[-1]) if open_ahead.any() else 1
    if way.halt < 0.01 or count < 2:
        here = np.array([pose[:2]])
        return _lane(here, base, courses, np.array([max_speed]), "wall")
    base, courses = base[:count], courses[:count]
    least = np.full(count, LEAST_CLEARANCE)
    driven, speeds, reached = _round_things(base, pose[:2], least, clearance, max_speed)
    end: LaneEnd = "wall"
    if reached < count:
        beyond = base[reached : reached + round(1.0 / SPACING)]
        to_wall = polyline.length(way.points) - reached * SPACING
        walls_alone = clearance.to_walls(beyond)
        if to_wall > END_OBSTACLE_DEPTH and (walls_alone >= MIN_CLEARANCE).all():
            end = "obstacle"
    return _lane(driven, base, courses, speeds, end)


def lane_along(points: FloatArray, max_speed: float) -> Lane:
    """Return the lane along a given line (N, 2), its corners rounded a little."""
    base = polyline.smoothed_rows(polyline.resample(points, SPACING), 2)
    speeds = np.full(len(base), max_speed)
    return _lane(base, base, _headings(base), speeds, "done")


def lane_round_things(
    points: FloatArray,
    place: tuple[float, float],
    max_speed: float,
    clearance: FreeSpace,
) -> Lane:
    """Return the lane from a place to a line, along it and round what stands on it.

    The place is beside the line's beginning. It ends as `obstacle` where the rest of
    the line (N, 2) cannot be reached.
    """
    base = polyline.smoothed_rows(polyline.resample(points, SPACING), 2)
    # Lines may lead along walls more closely than lanes do; there they are kept to.
    least = np.minimum(LEAST_CLEARANCE, clearance.to_walls(base) - 1e-3)
    driven, speeds, reached = _round_things(base, place, least, clearance, max_speed)
    end: LaneEnd = "done" if reached == len(base) else "obstacle"
    return _lane(driven, base, _headings(base), speeds, end)


def _round_things(
    base: FloatArray,
    place: tuple[float, float],
    least: FloatArray,
    clearance: FreeSpace,
    max_speed: float,
) -> tuple[FloatArray, FloatArray, int]:
    """Lead from a place onto a line and round what stands on it, as far as one gets.

    Returns where to drive (N, 2) and how fast (N,), with a gap before what cannot be
    passed; and how many stations of the line can be reached.
    """
    normals = polyline.left_normals(base)
    aside = float((np.array(place) - base[0]) @ normals[0])
    offsets = _joining_profile(len(base), aside)
    usable = reached = len(base)
    room = clearance.to_anything(base + offsets[:, None] * normals)
    if (room < MIN_CLEARANCE).any():
        # Whoever starts in a tight place may leave it as tightly.
        least[:8] = np.minimum(least[:8], max(float(room[0]) - 1e-3, ROBOT_RADIUS))
        offsets, reached = make_detours(
            base, normals, offsets, MIN_CLEARANCE, least, clearance
        )
        if reached < usable:
            usable = max(1, reached - round(OBSTACLE_GAP / SPACING))
    driven = (base + offsets[:, None] * normals)[:usable]
    tight = clearance.to_anything(driven) < MIN_CLEARANCE - 1e-6
    return driven, np.where(tight, TIGHT_SPEED, max_speed), reached


def _stations_of(way: StraightWay) -> tuple[FloatArray, FloatArray]:
    """Return points at even steps along the way up to its halt, and its courses."""
    along = polyline.arc_lengths(way.points)
    at = np.linspace(0.0, way.halt, max(2, math.ceil(way.halt / SPACING) + 1))
    points = np.asarray(way.points)
    base = np.column_stack([np.interp(at, along, points[:, k]) for k in (0, 1)])
    piece = np.clip(np.searchsorted(along, at, side="right") - 1, 0, len(points) - 2)
    if len(way.courses) > 1:
        base = polyline.smoothed_rows(base, 8)
    return base, np.asarray(way.courses)[piece]


def _joining_profile(count: int, offset: float) -> FloatArray:
    """Return offsets that lead smoothly from the robot's place onto the way."""
    distance = max(1.0, 4 * abs(offset))
    part = np.minimum(np.arange(count) * SPACING / distance, 1.0)
    return offset * (1 - part * part * (3 - 2 * part))


def _headings(points: FloatArray) -> FloatArray:
    """Return the heading from each point to the next; the last repeats."""
    steps = np.diff(points, axis=0)
    headings = np.arctan2(steps[:, 1], steps[:, 0])
    return np.append(headings, headings[-1])


def _lane(
    driven: FloatArray,
    base: FloatArray,
    courses: FloatArray,
    speeds: FloatArray,
    end: LaneEnd,
) -> Lane:
    base, courses = base[: len(driven)], courses[: len(driven)]
    if len(driven) == 1:
        (x, y), (way_x, way_y) = driven[0].tolist(), base[0].tolist()
        course, speed = float(courses[0]), float(speeds[0])
        station = Station(x, y, course, 0.0, 0.0, speed, course, way_x, way_y)
        return Lane((station,), end)
    headings = _headings(driven)
    s = polyline.arc_lengths(driven)
    bends = np.array([turn_between(a, b) for a, b in pairwise(headings.tolist())])
    curvature = np.append(bends / np.diff(s), 0.0)
    tightness = np.maximum(np.abs(curvature), np.abs(np.roll(curvature, 1)))
    in_bends = np.sqrt(SIDEWAYS_ACCELERATION / np.maximum(tightness, 1e-6))
    columns = (
        *(driven[:, 0], driven[:, 1], headings, curvature, s),
        *(np.minimum(in_bends, speeds), courses, base[:, 0], base[:, 1]),
    )
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return Lane(tuple(Station(*row) for row in rows), end)


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
