import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point, Polygon, box

from memorymaze.robot.simulation.motion.clearance import CLEARANCE_RANGE, Clearance

FLOOR = Polygon(box(0, 0, 10, 8).exterior.coords, [box(4, 3, 5, 5).exterior.coords])
CRATE = box(7, 1, 8, 2)
CLEARANCE = Clearance(FLOOR, [CRATE])


@given(x=st.floats(-1, 11), y=st.floats(-1, 9))
def test_distances_are_exact(x: float, y: float) -> None:
    point = Point(x, y)
    on_floor = FLOOR.contains(point)
    wall = FLOOR.boundary.distance(point) if on_floor else 0.0
    anything = min(wall, CRATE.distance(point))
    points = np.array([(x, y)])
    assert CLEARANCE.to_walls(points)[0] == pytest.approx(min(wall, CLEARANCE_RANGE))
    assert CLEARANCE.to_anything(points)[0] == pytest.approx(
        min(anything, CLEARANCE_RANGE)
    )


def test_a_ray_tells_where_it_leaves_the_floor_and_comes_back() -> None:
    assert CLEARANCE.wall_crossings((1, 4), (1, 0)) == pytest.approx([3, 4, 9])
    assert CLEARANCE.wall_crossings((1, 4), (-1, 0)) == pytest.approx([1])


@pytest.mark.parametrize("angle", [math.atan2(3, 4), math.atan2(-3, 4)])
def test_a_ray_through_a_corner_crosses_once(angle: float) -> None:
    clearance = Clearance(box(-1, -3, 4, 3), [])
    ray = (math.cos(angle), math.sin(angle))
    assert clearance.wall_crossings((0, 0), ray) == pytest.approx([5])


def test_a_disc_needs_room_on_its_way() -> None:
    assert CLEARANCE.is_free([(1, 1), (1, 7)], 0.9)
    assert not CLEARANCE.is_free([(1, 1), (1, 7)], 1.1)
    assert not CLEARANCE.is_free([(6, 1.5), (9, 1.5)], 0.1)
    assert CLEARANCE.is_within_walls([(6, 1.5), (9, 1.5)])
    assert not CLEARANCE.is_within_walls([(3, 4), (6, 4)])
