import math

import numpy as np
import pytest

from memorymaze.geometry.pose import Pose
from memorymaze.perception.turning_points.walls import WallDirections

ANGLES = np.radians(np.arange(-180.0, 180.0))


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
