"""Turning points from LiDAR scans and odometry alone, followed over time.

Related work finds junctions on local LiDAR maps by skeleton and convex hull
(PathFinder), by a detector on grid images (Corridor-Walker) or by clustered crossings
of a skeleton (WanderGuide).
"""

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.robot.perception.turning_points.junctions import (
    SAME_DIRECTION,
    SAME_JUNCTION,
    SCAN_REACH,
    FreeSurroundings,
    Mouth,
    SensedJunction,
    SensedWay,
    crossing,
    is_turning_point,
    is_worth_telling,
)
from memorymaze.robot.perception.turning_points.local_map import (
    LocalMap,
    WallDirections,
)

WAY_BACK = math.radians(75)
"""Greatest angle between a way and where the robot was for it to be the way it came."""
MARGIN = 0.3
"""Metres a turning point reaches beyond where its ways' edges cross."""
LINGER = 0.3
"""Further metres within which a robot that was in it is in it still."""
CLOSE = 1.0
"""Metres from where ways meet at which a sighting counts a third of one from there."""
FROM_AFAR = 0.1
"""Weight of a sighting from farther off."""
SURE = 1.5
"""Weight of sightings from which on a turning point is told of."""
WALLS_NEAR = 2.5
"""Metres around a way's mouth within which walls tell its direction; more where it is
wider."""
SAME_DEPTH = 0.7
"""Share of the greatest depth that a direction must have to be thought of."""
WIDEST = math.radians(150)
"""Angle under which a mouth is seen from which on the place is open on that side, and
tells no ways."""
WEDGE = 1.5
"""Metres by which two ways lead farther than the direction between them."""
THROUGH = 0.8
"""Metres beside the middle of a mouth at which the robot drove through it."""
TRAIL_SPACING = 0.2
"""Metres from one kept place of the trail to the next."""
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


class TurningPointFinder:
    """Finds turning points as a robot drives; scans and odometry in, ways out."""

    def __init__(self) -> None:
        """Begin knowing nothing."""
        self._map = LocalMap()
        self._walls = WallDirections()
        self._junctions: list[SensedJunction] = []
        self._numbers = 0
        self._pose: Pose | None = None
        self._trail: deque[tuple[float, float]] = deque(maxlen=TRAIL)
        self._inside: SensedJunction | None = None
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
        surroundings = FreeSurroundings(self._map.free)
        cell = self._map.cell(pose.x, pose.y)
        middle = surroundings.middle(cell)
        centre = self._map.place(*middle)
        radius = float(surroundings.room[middle])
        mouths = surroundings.mouths(middle)
        if any(each.spread > WIDEST for each in mouths):
            return
        ways = _one_per_heading([
            way for mouth in mouths for way in self._ways(surroundings, mouth, radius)
        ])
        meeting = crossing(ways, centre)
        known = self._known_near(meeting)
        if is_turning_point(ways):
            if known is None:
                known = SensedJunction(*meeting, radius)
                self._junctions.append(known)
            weight = math.exp(-((math.dist(meeting, centre) / CLOSE) ** 2))
            known.see(*meeting, radius, ways, max(weight, FROM_AFAR))
        elif known is not None and math.dist((known.x, known.y), centre) < CLOSE:
            # Where the lines of a straight way meet tells nothing of a place.
            known.see(known.x, known.y, known.radius, ways, 1.0)

    def _known_near(self, place: tuple[float, float]) -> SensedJunction | None:
        nearest = min(
            self._junctions,
            key=lambda each: math.dist((each.x, each.y), place),
            default=None,
        )
        if nearest is None or math.dist((nearest.x, nearest.y), place) > SAME_JUNCTION:
            return None
        return nearest

    def _ways(
        self, surroundings: FreeSurroundings, mouth: Mouth, radius: float
    ) -> list[SensedWay]:
        """Look along what begins at a mouth: no way, one, or two at a slant.

        A way runs along the walls there. Of several directions that lead about as far
        it is the one with most wall; a second is another way when what lies between
        them is blocked.
        """
        x, y = self._map.place(mouth.x, mouth.y)
        headings = self._walls.along(x, y, max(WALLS_NEAR, mouth.width), mouth.bearing)
        if not len(headings):
            headings = np.array([mouth.bearing])
        depths = surroundings.depths(mouth, headings)
        first = int((depths >= SAME_DEPTH * depths.max()).argmax())
        enough = max(SCAN_REACH, radius)
        if depths[first] < enough and not self._came_through(x, y):
            return []
        ways = [SensedWay(x, y, wrap_angle(float(headings[first])), mouth.width)]
        between = (headings + headings[first]) / 2
        wedge = depths - surroundings.depths(mouth, between)
        for other in np.flatnonzero((depths >= enough) & (wedge > WEDGE)):
            if abs(headings[other] - headings[first]) > SAME_DIRECTION:
                heading = wrap_angle(float(headings[other]))
                ways.append(SensedWay(x, y, heading, mouth.width))
        return ways

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
                and is_turning_point(each.ways())
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
        if is_worth_telling(onward, back):
            self._current = SensedTurningPoint(
                inside.number, inside.x, inside.y, onward, back
            )

    def _direction_of_trail(self, junction: SensedJunction) -> float:
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
            abs(turn_between(way.heading, each.heading)) > SAME_DIRECTION
            for each in kept
        ):
            kept.append(way)
    return kept
