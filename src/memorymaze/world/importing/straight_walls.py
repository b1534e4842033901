"""Straight walls from a ragged outline: lines fitted to it, along the building's directions."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from shapely import LinearRing, Polygon

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import moved

SAME_DIRECTION = math.radians(5)
"""Walls that stray less from one of the building's directions run along it."""
LONG = 1.5
"""Metres of a wall that tells of the building's directions."""
LEAST_SHARE = 0.08
"""Of all long walls that make a direction the building's."""
SHARP = math.radians(15)
"""Least angle at which two walls meet in a corner."""
QUARTER = math.pi / 2


@dataclass(frozen=True)
class _StraightWall:
    """A straight line along a stretch of an outline."""

    middle: tuple[float, float]
    heading: float
    """Radians, along the outline."""
    length: float
    end: tuple[float, float]
    """Where the outline goes on to the next wall."""
    is_along: bool = False
    """Whether it runs along one of the building's directions."""


def straight_walls(outline: Polygon, tolerance: float) -> Polygon:
    """Return an outline with straight walls that stray from it by a tolerance in metres."""
    rings = [_walls(ring, tolerance) for ring in (outline.exterior, *outline.interiors)]
    directions = _directions([wall for walls in rings for wall in walls])
    drawn = [
        _ring(
            _joined([_turned(wall, directions) for wall in walls], tolerance), tolerance
        )
        for walls in rings
    ]
    shell, *holes = [Polygon(ring) for ring in drawn if len(ring) >= 3]
    floor = shell.buffer(0) - shapely.union_all([hole.buffer(0) for hole in holes])
    return max(shapely.get_parts(floor).tolist(), key=lambda part: part.area)


def _walls(ring: LinearRing, tolerance: float) -> list[_StraightWall]:
    """Return a ring in straight stretches."""
    points = np.asarray(ring.coords)[:-1]
    # What is farthest from the middle is a corner.
    start = int(np.linalg.norm(points - points.mean(axis=0), axis=1).argmax())
    points = np.roll(points, -start, axis=0)
    points = np.concatenate([points, points[:1]])
    rough = shapely.get_coordinates(shapely.LineString(points).simplify(tolerance))
    marks = [0]
    for corner in rough[1:]:
        rest = points[marks[-1] + 1 :]
        marks.append(marks[-1] + 1 + int((np.abs(rest - corner).sum(axis=1)).argmin()))
    marks[-1] = len(points) - 1
    return [_fitted(points[a : b + 1], tolerance) for a, b in pairwise(marks)]


def _fitted(points: FloatArray, tolerance: float) -> _StraightWall:
    """Return the line along points, least affected by the corners at their ends."""
    first, last = points[0], points[-1]
    length = math.dist(first, last)
    inner = points[
        (np.linalg.norm(points - first, axis=1) > 2 * tolerance)
        & (np.linalg.norm(points - last, axis=1) > 2 * tolerance)
    ]
    if len(inner) < 4:
        inner = points
    middle = inner.mean(axis=0)
    direction = np.linalg.svd(inner - middle)[2][0]
    if direction @ (last - first) < 0:
        direction = -direction
    heading = math.atan2(direction[1], direction[0])
    return _StraightWall(tuple(middle.tolist()), heading, length, tuple(last.tolist()))


def _directions(walls: Sequence[_StraightWall]) -> list[float]:
    """Return the building's directions, modulo right angles, the commonest first."""
    long = [wall for wall in walls if wall.length >= LONG]
    headings = np.array([wall.heading for wall in long])
    lengths = np.array([wall.length for wall in long])
    least = LEAST_SHARE * lengths.sum()
    found: list[float] = []
    while len(headings):
        apart = headings[:, None] - headings[None]
        near = np.abs(apart - QUARTER * np.round(apart / QUARTER)) < SAME_DIRECTION
        commonest = near[int((near * lengths).sum(axis=1).argmax())]
        if lengths[commonest].sum() < least:
            break
        turned = (lengths * np.exp(4j * headings))[commonest].sum()
        found.append(float(np.angle(turned)) / 4)
        headings, lengths = headings[~commonest], lengths[~commonest]
    return found


def _off(heading: float, direction: float) -> float:
    """Return how far a heading is from a direction or one square to it."""
    return abs(math.remainder(heading - direction, QUARTER))


def _turned(wall: _StraightWall, directions: Sequence[float]) -> _StraightWall:
    """Return a wall along the nearest of the directions, if one is near."""
    nearest = min(directions, key=lambda each: _off(wall.heading, each), default=None)
    # A short wall's heading is known less well.
    slack = SAME_DIRECTION * (1.0 if wall.length >= LONG else 3.0)
    if nearest is None or _off(wall.heading, nearest) > slack:
        return wall
    heading = wall.heading - math.remainder(wall.heading - nearest, QUARTER)
    return replace(wall, heading=heading, is_along=True)


def _joined(walls: list[_StraightWall], tolerance: float) -> list[_StraightWall]:
    """Return walls, those in one line made one, without bits between them."""
    settled = 0
    while settled < 2:
        before = len(walls)
        # Begun at another wall each time, as the first and the last are neighbours.
        walls = walls[before // 2 :] + walls[: before // 2]
        drawn: list[_StraightWall] = []
        for wall in walls:
            drawn.append(wall)
            while (fewer := _fewer(drawn[-3:], tolerance)) is not None:
                drawn[-3:] = fewer
        walls = drawn
        settled = settled + 1 if len(walls) == before else 0
    return walls


def _fewer(
    walls: Sequence[_StraightWall], tolerance: float
) -> list[_StraightWall] | None:
    """Return up to three neighbours as fewer walls, where that changes little."""
    for index, (wall, after) in enumerate(pairwise(walls)):
        one = _one_wall(wall, after, tolerance)
        if one is not None:
            return [*walls[:index], one, *walls[index + 2 :]]
    if len(walls) < 3:
        return None
    wall, bit, beyond = walls
    past = _one_wall(wall, beyond, tolerance)
    if past is not None:
        return [past]
    if not bit.is_along and bit.length < 3.0 * tolerance:
        corner = _crossing(wall, beyond, 3.0 * tolerance)
        return [wall, beyond] if corner else None
    return None


def _one_wall(
    wall: _StraightWall, after: _StraightWall, tolerance: float
) -> _StraightWall | None:
    """Return two walls as one where they lie in one line."""
    bend = math.remainder(after.heading - wall.heading, 2 * math.pi)
    if abs(bend) > (1e-6 if wall.is_along and after.is_along else SAME_DIRECTION / 2):
        return None
    whole = wall.length + after.length
    share = after.length / whole
    heading = wall.heading if wall.is_along else wall.heading + share * bend
    heading = after.heading if after.is_along else heading
    gap = np.subtract(after.middle, wall.middle)
    if abs(gap[1] * math.cos(heading) - gap[0] * math.sin(heading)) > tolerance:
        return None
    x, y = np.add(wall.middle, share * gap)
    along = wall.is_along or after.is_along
    return _StraightWall((float(x), float(y)), heading, whole, after.end, along)


def _ring(
    walls: Sequence[_StraightWall], tolerance: float
) -> list[tuple[float, float]]:
    """Return the corners between walls; two where a wall steps to the side."""
    corners: list[tuple[float, float]] = []
    for wall, after in zip(walls, [*walls[1:], walls[0]], strict=True):
        corner = _crossing(wall, after, 4 * tolerance)
        corners += [corner] if corner else [_foot(wall), _foot(after, wall.end)]
    return corners


def _crossing(
    wall: _StraightWall, other: _StraightWall, slack: float
) -> tuple[float, float] | None:
    """Return where two walls' lines cross, if that is near the end of the first."""
    bend = math.sin(other.heading - wall.heading)
    if abs(bend) < math.sin(SHARP):
        return None
    gap = np.subtract(other.middle, wall.middle)
    along = (gap[0] * math.sin(other.heading) - gap[1] * math.cos(other.heading)) / bend
    place = moved(wall.middle, wall.heading, along)
    return place if math.dist(place, wall.end) <= slack else None


def _foot(
    wall: _StraightWall, place: tuple[float, float] | None = None
) -> tuple[float, float]:
    """Return the point of a wall's line nearest to a place, or to its end."""
    gap = np.subtract(place or wall.end, wall.middle)
    along = float(gap[0] * math.cos(wall.heading) + gap[1] * math.sin(wall.heading))
    return moved(wall.middle, wall.heading, along)
