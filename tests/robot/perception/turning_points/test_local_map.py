import math

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.perception.turning_points.local_map import (
    CELL,
    LocalMap,
    WallDirections,
)

ANGLES = np.radians(np.arange(-180.0, 180.0))


def room_ranges(pose: Pose, half_length: float, half_width: float) -> np.ndarray:
    """Ranges in a rectangular room around the origin."""
    headings = ANGLES + pose.heading
    with np.errstate(divide="ignore"):
        to_ends = (half_length * np.copysign(1, np.cos(headings)) - pose.x) / np.cos(
            headings
        )
        to_sides = (half_width * np.copysign(1, np.sin(headings)) - pose.y) / np.sin(
            headings
        )
    return np.minimum(to_ends, to_sides)


def is_free(known: LocalMap, x: float, y: float) -> bool:
    return bool(known.free[known.cell(x, y)])


@pytest.mark.parametrize("heading", [0.0, 0.7, -2.5])
def test_what_rays_pass_is_free_and_walls_and_beyond_are_not(heading: float) -> None:
    known, pose = LocalMap(), Pose(1.0, 0.5, heading)
    known.add(pose, ANGLES, room_ranges(pose, 5.0, 2.0), 0.0)
    for x, y in ((1, 0.5), (4.7, 1.7), (-4.7, -1.7), (0, 0)):
        assert is_free(known, x, y)
    for x, y in ((5.08, 0), (0, 2.08), (0, 3), (-7, 0)):
        assert not is_free(known, x, y)


def test_the_map_moves_along_and_keeps_what_it_saw() -> None:
    known = LocalMap()
    for x in np.arange(-4, 4.5, 0.5):
        pose = Pose(float(x), 0.0, 0.0)
        known.add(pose, ANGLES, room_ranges(pose, 6.0, 2.0), 0.5)
    assert is_free(known, -4, 1.5)
    assert not is_free(known, -4, 2.1)
    column, row = known.cell(3.0, 0.0)
    x, y = known.place(column, row)
    assert abs(x - 3.0) <= CELL
    assert abs(y) <= CELL


def test_a_thing_that_has_gone_is_forgotten() -> None:
    known, pose = LocalMap(), Pose(0, 0, 0)
    blocked = room_ranges(pose, 5.0, 2.0)
    blocked[175:186] = 2.0
    for _ in range(10):
        known.add(pose, ANGLES, blocked, 0.0)
    assert not is_free(known, 3, 0)
    for _ in range(10):
        known.add(pose, ANGLES, room_ranges(pose, 5.0, 2.0), 0.0)
    assert is_free(known, 2, 0)
    assert is_free(known, 3, 0)


def test_single_rays_without_return_open_no_walls() -> None:
    known, pose = LocalMap(), Pose(0, 0, 0)
    ranges = room_ranges(pose, 5.0, 2.0)
    ranges[[20, 90, 91, 200]] = math.inf
    known.add(pose, ANGLES, ranges, 0.0)
    assert not is_free(known, 0, -3)
    # Where a whole bundle gives none, there is nothing up to the sensor's range.
    ranges[170:190] = math.inf
    known.add(pose, ANGLES, ranges, 0.0)
    known.add(pose, ANGLES, ranges, 0.0)
    assert is_free(known, 7, 0)


def between_walls(direction: float, noise: float = 0.0) -> WallDirections:
    """Scan at the origin, 1.2 m from two long walls along a direction, degrees."""
    walls = WallDirections()
    sine = np.abs(np.sin(ANGLES - math.radians(direction)))
    with np.errstate(divide="ignore"):
        ranges = np.where(sine > 0.1, 1.2 / sine, math.inf)
    ranges += np.random.default_rng(0).normal(0, noise, len(ranges))
    walls.add(Pose(0, 0, 0), ANGLES, ranges)
    return walls


@pytest.mark.parametrize("direction", [0, 24, 90, 150])
@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_the_direction_of_walls_is_told_along_the_heading(
    direction: float, noise: float
) -> None:
    walls = between_walls(direction, noise)
    for off in (-25, 0, 25):
        for way in (direction, direction + 180):
            found = walls.along(0, 0, 3.0, math.radians(way + off))
            assert math.degrees(found[0]) == pytest.approx(way, abs=2)


def test_walls_across_and_walls_elsewhere_tell_nothing() -> None:
    walls = between_walls(0)
    assert len(walls.along(0, 0, 3.0, math.pi / 2)) == 0
    assert len(walls.along(30, 0, 3.0, 0.0)) == 0


def test_things_apart_make_no_wall() -> None:
    walls = WallDirections()
    ranges = np.where(np.arange(360) % 12 == 0, 3.0, math.inf)
    walls.add(Pose(0, 0, 0), ANGLES, ranges)
    assert len(walls.along(0, 0, 5.0, 0.0)) == 0
