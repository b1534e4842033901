"""Turning points from LiDAR scans and odometry alone, followed over time.

Related work finds junctions on local LiDAR maps by skeleton and convex hull
(PathFinder), by a detector on grid images (Corridor-Walker) or by clustered crossings
of a skeleton (WanderGuide).
"""

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.perception.turning_points.local_map import LocalMap
from memorymaze.perception.turning_points.walls import WallDirections
from memorymaze.perception.turning_points.ways import (
    REACH,
    Mouth,
    SensedWay,
    Surroundings,
    crossing,
    reach_along,
)

__all__ = ["SensedTurningPoint", "TurningPointFinder"]

FloatArray = NDArray[np.float64]

BEND = math.radians(15)
"""A way that bends less goes straight on: alone it makes no turning point."""
SAME_WAY = math.radians(35)
"""Ways seen at less than this angle from each other are one."""
SAME_PLACE = 2.0
"""Metres between two sightings of one turning point."""
WAY_BACK = math.radians(75)
"""Greatest angle between a way and where the robot was for it to be the way it came."""
MARGIN = 0.3
"""Metres a turning point reaches beyond where its ways' edges cross."""
LINGER = 0.3
"""Further metres within which a robot that was in it is in it still."""
FROM_AFAR = 0.25
"""Weight of what is seen from outside against what is seen from inside."""
MEMORY = 0.9
"""Share of a sighting's weight that is left at the next sighting."""
SURE = 1.5
"""Weight of sightings from which on a turning point is told of."""
WALLS_NEAR = 2.5
"""Metres around a way's mouth within which walls tell its direction; more where it is
wider."""
SAME_DEPTH = 0.7
"""Share of the greatest depth that a direction must have to be thought of."""
WIDEST = math.radians(130)
ROOM = 1.0
THROUGH = 0.8
TRAIL_SPACING = 0.2
TRAIL = 100
"""Kept places of the trail: the last 20 m."""


@dataclass(frozen=True, slots=True)
class SensedTurningPoint:
    """The turning point a robot is in, in the odometry's frame."""

    number: int
    """In the order of first stays, from 1."""
    x: float
    """Of the place where its ways meet, metres."""
    y: float
    """Of that place, metres."""
    onward: tuple[SensedWay, ...]
    """Every way but the one it came by."""
    back: SensedWay | None
    """The way it came by; None when there is none."""


@dataclass(slots=True)
class _Belief:
    """A way as the sightings so far tell it."""

    way: SensedWay
    weight: float


@dataclass(slots=True)
class _Junction:
    """A turning point, or what may become one."""

    x: float
    y: float
    radius: float
    weight: float = 0.0
    beliefs: list[_Belief] = field(default_factory=list[_Belief])
    number: int | None = None

    def ways(self) -> list[SensedWay]:
        return [each.way for each in self.beliefs if each.weight > 0.5 * self.weight]

    def see(
        self,
        x: float,
        y: float,
        radius: float,
        ways: Sequence[SensedWay],
        weight: float,
    ) -> None:
        self.weight = self.weight * MEMORY + weight
        share = weight / self.weight
        self.x += share * (x - self.x)
        self.y += share * (y - self.y)
        self.radius += share * (radius - self.radius)
        for each in self.beliefs:
            each.weight *= MEMORY
        left = list(self.beliefs)
        for way in ways:
            same = min(
                left,
                key=lambda each: abs(turn_between(each.way.heading, way.heading)),
                default=None,
            )
            if (
                same is None
                or abs(turn_between(same.way.heading, way.heading)) > SAME_WAY
            ):
                self.beliefs.append(_Belief(way, weight))
                continue
            left.remove(same)
            same.weight += weight
            same.way = same.way.moved_towards(way, weight / same.weight)
        self.beliefs = [each for each in self.beliefs if each.weight > 0.05]

    def holds(self, x: float, y: float, margin: float) -> bool:
        """Whether a place lies where the ways' strips cross."""
        ways = self.ways()
        dx, dy = x - self.x, y - self.y
        if math.hypot(dx, dy) > SAME_PLACE + self.radius:
            return False
        return all(
            dx * math.cos(way.heading) + dy * math.sin(way.heading)
            <= reach_along(way, ways, self.radius) + margin
            for way in ways
        )


class TurningPointFinder:
    """Finds turning points as a robot drives; scans and odometry in, ways out."""

    def __init__(self) -> None:
        """Begin knowing nothing."""
        self._map = LocalMap()
        self._walls = WallDirections()
        self._junctions: list[_Junction] = []
        self._numbers = 0
        self._pose: Pose | None = None
        self._trail: deque[tuple[float, float]] = deque(maxlen=TRAIL)
        self._inside: _Junction | None = None
        self._came_from = 0.0
        self._start_back = 0.0
        self._current: SensedTurningPoint | None = None

    @property
    def current(self) -> SensedTurningPoint | None:
        """The turning point the robot is in, or None."""
        return self._current

    def update(self, pose: Pose, angles: FloatArray, ranges: FloatArray) -> None:
        """Take note of a scan; 5 to 10 a second are enough.

        Args:
            pose: Of the robot by its odometry, metres and radians in a frame of its
                own.
            angles: Of the rays, radians from straight ahead, left positive, evenly
                round the full circle, ascending; shape (N,).
            ranges: Metres, `inf` without a return; shape (N,).
        """
        before = self._pose
        moved = 0.0 if before is None else math.dist(before[:2], pose[:2])
        self._pose = pose
        if before is None:
            self._start_back = wrap_angle(pose.heading + math.pi)
        self._map.add(pose, angles, ranges, moved)
        self._walls.add(pose, angles, ranges)
        if not self._trail or math.dist(self._trail[-1], pose[:2]) >= TRAIL_SPACING:
            self._trail.append((pose.x, pose.y))
        self._look(pose)
        self._settle(pose)

    def _look(self, pose: Pose) -> None:
        """Take the ways around the robot for a sighting of a turning point."""
        surroundings = Surroundings(self._map.free)
        cell = self._map.cell(pose.x, pose.y)
        middle = surroundings.middle(cell)
        centre = self._map.place(*middle)
        radius = float(surroundings.room[middle])
        mouths = surroundings.mouths(middle)
        if any(each.spread > WIDEST for each in mouths):
            return
        ways = _one_per_heading([
            way
            for mouth in mouths
            if (way := self._way(surroundings, mouth, radius)) is not None
        ])
        x, y = crossing(ways, centre)
        seen = _Junction(x, y, radius)
        seen.see(x, y, radius, ways, 1.0)
        known = min(
            self._junctions,
            key=lambda each: math.hypot(each.x - x, each.y - y),
            default=None,
        )
        if known is None or math.hypot(known.x - x, known.y - y) > SAME_PLACE:
            if not _is_turning_point(ways):
                return
            known = _Junction(x, y, radius)
            self._junctions.append(known)
        weight = 1.0 if seen.holds(pose.x, pose.y, MARGIN) else FROM_AFAR
        known.see(x, y, radius, ways, weight)

    def _way(
        self, surroundings: Surroundings, mouth: Mouth, radius: float
    ) -> SensedWay | None:
        """Look along a way; None where it does not lead on.

        It runs along its walls, and where these differ along those that lead farthest.
        """
        x, y = self._map.place(mouth.x, mouth.y)
        headings = self._walls.along(x, y, max(WALLS_NEAR, mouth.width), mouth.bearing)
        if not len(headings):
            headings = np.array([mouth.bearing])
        depths = surroundings.depths(mouth, headings)
        best = int((depths >= SAME_DEPTH * depths.max()).argmax())
        if depths[best] < max(REACH, radius * ROOM) and not self._came_through(x, y):
            return None
        return SensedWay(x, y, wrap_angle(float(headings[best])), mouth.width)

    def _came_through(self, x: float, y: float) -> bool:
        """Whether the robot drove through the middle of a mouth."""
        return any(math.dist(place, (x, y)) < THROUGH for place in self._trail)

    def _settle(self, pose: Pose) -> None:
        """Decide which turning point the robot is in."""
        inside = None
        for each in self._junctions:
            margin = MARGIN + (LINGER if each is self._inside else 0.0)
            if (
                each.weight >= SURE
                and _is_turning_point(each.ways())
                and each.holds(pose.x, pose.y, margin)
                and (
                    inside is None
                    or math.hypot(each.x - pose.x, each.y - pose.y)
                    < math.hypot(inside.x - pose.x, inside.y - pose.y)
                )
            ):
                inside = each
        if inside is not self._inside:
            self._inside = inside
            if inside is not None:
                self._came_from = self._direction_of_trail(inside)
        self._current = None
        if inside is None:
            return
        if inside.number is None:
            self._numbers += 1
            inside.number = self._numbers
        ways = inside.ways()
        back = min(
            ways,
            key=lambda way: abs(turn_between(self._came_from, way.heading)),
        )
        if abs(turn_between(self._came_from, back.heading)) > WAY_BACK:
            back = None
        onward = tuple(way for way in ways if way is not back)
        if _is_onward(onward, back):
            self._current = SensedTurningPoint(
                inside.number, inside.x, inside.y, onward, back
            )

    def _direction_of_trail(self, junction: _Junction) -> float:
        for x, y in reversed(self._trail):
            dx, dy = x - junction.x, y - junction.y
            if math.hypot(dx, dy) > junction.radius + 0.2:
                return math.atan2(dy, dx)
        return self._start_back


def _one_per_heading(ways: Sequence[SensedWay]) -> list[SensedWay]:
    """Return ways without narrower ones beside them, as left and right of a pillar."""
    kept: list[SensedWay] = []
    for way in sorted(ways, key=lambda each: -each.width):
        if all(
            abs(turn_between(way.heading, each.heading)) > SAME_WAY for each in kept
        ):
            kept.append(way)
    return kept


def _is_turning_point(ways: Sequence[SensedWay]) -> bool:
    """Whether ways are more than one that leads straight on, and more than an end."""
    if len(ways) != 2:
        return len(ways) > 2
    bend = turn_between(ways[0].heading + math.pi, ways[1].heading)
    return abs(bend) > BEND


def _is_onward(onward: Sequence[SensedWay], back: SensedWay | None) -> bool:
    if not onward:
        return False
    if len(onward) > 1 or back is None:
        return True
    return abs(turn_between(back.heading + math.pi, onward[0].heading)) > BEND
