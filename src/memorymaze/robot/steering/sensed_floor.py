"""What LiDAR and odometry alone tell steering of the floor: no plan, no map.

Everything is in the odometry's frame, and forgotten after a few metres, so that drift does
not matter. What counts as in the way is what the LiDAR's plane meets.
"""

import math
from collections import deque
from collections.abc import Sequence
from functools import cached_property
from typing import Literal

import numpy as np
from scipy.spatial import KDTree

from memorymaze.basics.geometry.points import XY, FloatArray
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.perception.turning_points import WallDirections, without_drop_outs
from memorymaze.robot.steering.detours import CLEARANCE_RANGE
from memorymaze.robot.steering.floor import END_GAP, LANE_STEP, StraightWay
from memorymaze.robot.steering.lanes import MIN_CLEARANCE
from memorymaze.robot.steering.turning_points import LidarTurningPoints

PATIENCE = 15.0
"""Seconds a move waits for what came in the way before it reports an obstacle."""
SCAN_PERIOD = 0.1
"""Seconds from one look for what is in the way to the next."""
KEPT_EVERY = 0.4
"""Metres driven from one scan that is remembered to the next."""
KEPT = 10
"""Remembered scans: the last 4 m; what stands behind a corner is in them."""
SEEN_THROUGH = 0.15
"""Metres by which a ray must go on behind a remembered place to say that nothing is there
any more."""
CLOSED = 1.0
"""Metres between the ends of neighbouring rays below which nothing passes between."""
FILLED_EVERY = 0.1
"""Metres between the places that stand for such a closed piece."""
AHEAD = 6.0
"""Metres that a way is planned ahead."""
HORIZON = 1.0
"""Metres after which it is planned anew."""
JOINED = math.radians(30)
"""Greatest angle between the robot's course and walls it turns to follow."""
BENT = math.radians(15)
"""The same for a robot on its way: sharper bends are turning points."""
WALLS_WITHIN = 4.0
"""Metres around the robot within which walls tell where a way runs."""
PARALLEL = math.radians(8)
"""Greatest angle to the way at which a wall is one of its sides."""
WIDEST = 3.5
"""Metres from the robot within which a side wall is looked for; halls are wider."""
SIDE_BIN = 0.1
"""Metres by which the places of side walls are told apart."""
LEAST_SIDE = 1.0
"""Metres of wall, seen once or several times, that make a side."""
ACROSS = 1.5
"""Metres across the way from which on what blocks it is a wall and no thing."""
TOUCHING = 0.35
"""Metres between places of one wall or thing."""
DEEP = 1.2
"""Metres behind the front of what is in the way within which a passage is looked for."""
TOO_CLOSE = ROBOT_RADIUS + 0.01
"""Metres to what is in the way of a lane at which the robot cannot pass."""
STAND_OFF = 0.25
"""Metres before the first such place at which it halts."""
STEP_GAP = 0.65
"""Metres from its centre to what is ahead at which a single step ends."""


class SensedSpace:
    """Room around points, by places where something is; implements `FreeSpace`."""

    def __init__(self, places: FloatArray) -> None:
        """Take places (N, 2), metres."""
        self._tree = KDTree(places) if len(places) else None

    def to_walls(self, points: FloatArray) -> FloatArray:
        """See `FreeSpace.to_walls`; ways end before walls, so none is told of here."""
        return np.full(len(points), CLEARANCE_RANGE)

    def to_anything(self, points: FloatArray) -> FloatArray:
        """See `FreeSpace.to_anything`."""
        if self._tree is None:
            return np.full(len(points), CLEARANCE_RANGE)
        distances, _ = self._tree.query(points, distance_upper_bound=CLEARANCE_RANGE)
        return np.minimum(distances, CLEARANCE_RANGE)

    def is_free(self, line: Sequence[XY], radius: float) -> bool:
        """See `FreeSpace.is_free`; the line has two ends."""
        begin, end = np.array(line[0]), np.array(line[-1])
        count = math.ceil(math.dist(begin, end) / FILLED_EVERY) + 1
        points = begin + np.linspace(0, 1, count)[:, np.newaxis] * (end - begin)
        return bool((self.to_anything(points) >= radius).all())


class SensedFloor:
    """The floor as a body's LiDAR sees it; implements `KnownFloor` and `Surroundings`."""

    horizon = HORIZON
    patience = PATIENCE

    def __init__(self, body: SensorsAndMotion) -> None:
        """Look around from where the body stands."""
        self._body = body
        self._pose = body.odometry().pose
        self.turning_points = LidarTurningPoints(
            lambda _pose, _time: body.lidar_scan(), self._pose
        )
        self._walls = WallDirections()
        self._kept: deque[FloatArray] = deque(maxlen=KEPT)
        self._kept_at: Pose | None = None
        self._due = 0.0
        self._look()

    @property
    def surroundings(self) -> "SensedFloor":
        """See `Floor.surroundings`: anything may come in the way."""
        return self

    @property
    def clearance(self) -> SensedSpace:
        """See `Floor.clearance`."""
        return self._seen.space

    def clearance_now(self, place: XY) -> SensedSpace:
        """See `Surroundings.clearance_now`."""
        return self._seen.space

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `Floor.update`."""
        self._pose = pose
        self.turning_points.update(pose, travel, time)
        if time >= self._due - 1e-9:
            self._due = time + SCAN_PERIOD
            self._look()

    def _look(self) -> None:
        pose, scan = self._pose, self._body.lidar_scan()
        self._walls.add(pose, scan.angles, scan.ranges)
        self._seen = _Seen(pose, scan, tuple(self._kept))
        kept_at = self._kept_at
        if kept_at is None or math.dist(kept_at[:2], pose[:2]) >= KEPT_EVERY:
            self._kept_at = pose
            self._kept.append(self._seen.hits)

    def straight_way(
        self, position: XY, course: float, *, fresh: bool, towards: str | None
    ) -> StraightWay:
        """See `Floor.straight_way`: the middle between the walls, up to one across.

        Where no walls run along, as in a hall, it goes straight on.
        """
        course = self._along_walls(position, course, JOINED if fresh else BENT)
        aside = self._middle(position, course)
        ux, uy = math.cos(course), math.sin(course)
        x, y = position[0] - aside * uy, position[1] + aside * ux
        reach = self._reach((x, y), course)
        end = (x + reach * ux, y + reach * uy)
        halt = reach if reach >= AHEAD else max(reach - END_GAP, 0.0)
        return StraightWay(((x, y), end), (course,), halt)

    def room_ahead(
        self, places: Sequence[tuple[float, float, float]], speed: float
    ) -> float | None:
        """See `Surroundings.room_ahead`; by the last scan alone."""
        tree = self._seen.now
        if tree is None:
            return None
        distances, _ = tree.query(
            np.array(places)[:, :2], distance_upper_bound=TOO_CLOSE
        )
        (blocked,) = np.nonzero(np.isfinite(distances))
        # Where the robot is now it cannot help.
        blocked = blocked[blocked > 1]
        if not len(blocked):
            return None
        return max(0.0, float(blocked[0] - 1) * LANE_STEP - STAND_OFF)

    def is_blocked_ahead(self, pose: Pose, course: float) -> bool:
        """See `Floor.is_blocked_ahead`."""
        along, aside = _seen_along(self._seen.hits, pose[:2], course)
        before = (along > 0) & (along < STEP_GAP) & (np.abs(aside) < TOO_CLOSE)
        return bool(before.any())

    def what_blocks(self) -> Literal["wall", "obstacle"]:
        """See `Floor.what_blocks`: walls are seen, and not run into."""
        return "obstacle"

    def _along_walls(self, place: XY, course: float, tolerance: float) -> float:
        headings = self._walls.along(*place, WALLS_WITHIN, course)
        near = [
            each for each in headings if abs(turn_between(course, each)) < tolerance
        ]
        return float(near[0]) if near else course

    def _middle(self, place: XY, course: float) -> float:
        """Return how far to the left the middle between two walls is, metres."""
        x, y, headings, lengths = self._walls.hits
        along, aside = _seen_along(np.column_stack([x, y]), place, course)
        off = (headings - course + math.pi / 2) % math.pi - math.pi / 2
        sides = (np.abs(off) < PARALLEL) & (np.abs(along) < WALLS_WITHIN)
        left = _side(aside[sides], lengths[sides])
        right = _side(-aside[sides], lengths[sides])
        if left is None or right is None:
            return 0.0
        return (left - right) / 2

    def _reach(self, place: XY, course: float) -> float:
        """Return how far it is along a line to a wall across it, at most `AHEAD`."""
        along, aside = _seen_along(self._seen.places, place, course)
        ahead = (along > 0) & (along < AHEAD + DEEP) & (np.abs(aside) < ACROSS)
        along, aside = along[ahead], aside[ahead]
        reach = 0.0
        while True:
            front = along[(along > reach) & (np.abs(aside) < MIN_CLEARANCE)]
            if not len(front) or (reach := float(front.min())) >= AHEAD:
                return AHEAD
            if _is_wall(along, aside, reach):
                return reach
            reach += DEEP


class _Seen:
    """What one scan shows, with what is remembered of those before."""

    def __init__(self, pose: Pose, scan: LidarScan, kept: Sequence[FloatArray]) -> None:
        self._pose, self._scan, self._kept = pose, scan, kept
        self.hits = _filled(pose, scan)
        """Places where something is now, (N, 2), metres."""

    @cached_property
    def now(self) -> KDTree | None:
        """Those places, to be looked up."""
        return KDTree(self.hits) if len(self.hits) else None

    @cached_property
    def places(self) -> FloatArray:
        """Those places, and remembered ones that no ray has gone through since."""
        if not self._kept:
            return self.hits
        before = np.concatenate(self._kept)
        dx, dy = (before - np.array(self._pose[:2])).T
        angles, ranges = self._scan.angles, without_drop_outs(self._scan.ranges)
        step = 2 * math.pi / len(angles)
        turns = (np.arctan2(dy, dx) - self._pose.heading - angles[0]) / step
        ray = np.floor(turns).astype(np.intp) % len(angles)
        seen = np.minimum(ranges, np.roll(ranges, -1))[ray]
        stays = np.hypot(dx, dy) > seen - SEEN_THROUGH
        return np.concatenate([self.hits, before[stays]])

    @cached_property
    def space(self) -> SensedSpace:
        """The room around them."""
        return SensedSpace(self.places)


def _filled(pose: Pose, scan: LidarScan) -> FloatArray:
    """Return where rays ended, and places between two ends that nothing passes."""
    headings = scan.angles + pose.heading
    with np.errstate(invalid="ignore"):
        x = pose.x + scan.ranges * np.cos(headings)
        y = pose.y + scan.ranges * np.sin(headings)
        dx, dy = np.roll(x, -1) - x, np.roll(y, -1) - y
        length = np.hypot(dx, dy)
    places = [np.column_stack([x, y])[np.isfinite(scan.ranges)]]
    (gaps,) = np.nonzero((length > FILLED_EVERY) & (length < CLOSED))
    for part in np.arange(FILLED_EVERY, CLOSED, FILLED_EVERY):
        inside = gaps[length[gaps] > part]
        share = part / length[inside]
        places.append(
            np.column_stack([
                x[inside] + share * dx[inside],
                y[inside] + share * dy[inside],
            ])
        )
    return np.concatenate(places)


def _seen_along(
    places: FloatArray, place: XY, course: float
) -> tuple[FloatArray, FloatArray]:
    """Return metres along a line and to the left of it."""
    dx, dy = (places - np.array(place)).T
    ux, uy = math.cos(course), math.sin(course)
    return dx * ux + dy * uy, dy * ux - dx * uy


def _side(aside: FloatArray, lengths: FloatArray) -> float | None:
    """Return how far the side wall is, of pieces of wall so far aside; None for none."""
    bins = np.arange(ROBOT_RADIUS, WIDEST + SIDE_BIN, SIDE_BIN)
    walls, _ = np.histogram(aside, bins, weights=lengths)
    walls = np.convolve(walls, [0.5, 1.0, 0.5], mode="same")
    best = int(walls.argmax())
    if walls[best] < LEAST_SIDE:
        return None
    middle = (bins[best] + bins[best + 1]) / 2
    close = np.abs(aside - middle) < 1.5 * SIDE_BIN
    return float(np.average(aside[close], weights=lengths[close]))


def _is_wall(along: FloatArray, aside: FloatArray, front: float) -> bool:
    """Whether what begins so far ahead bars the way, or is as wide as walls are.

    Things one can pass leave a gap beside them or are narrower.
    """
    here = (along > front - TOUCHING) & (along < front + DEEP)
    across = np.sort(aside[here])
    gaps = np.diff(across, prepend=-ACROSS, append=ACROSS)
    if gaps.max() < 2 * MIN_CLEARANCE:
        return True
    # The piece without gaps that the robot would meet.
    (cuts,) = np.nonzero(np.diff(across) > TOUCHING)
    pieces = np.split(across, cuts + 1)
    met = max(
        (float(np.ptp(each)) for each in pieces if np.abs(each).min() < MIN_CLEARANCE),
        default=0.0,
    )
    return met >= ACROSS
