import math

import numpy as np
import pytest

from memorymaze.perception.turning_points.local_map import CELL
from memorymaze.perception.turning_points.ways import (
    SensedWay,
    Surroundings,
    crossing,
    reach_along,
)

MIDDLE = 64


def floor_of(*boxes: tuple[float, float, float, float]) -> Surroundings:
    """Free floor of boxes (west, south, east, north), metres from the middle."""
    free = np.zeros((2 * MIDDLE + 1, 2 * MIDDLE + 1), dtype=bool)
    for bounds in boxes:
        west, south, east, north = (round(each / CELL) + MIDDLE for each in bounds)
        free[west : east + 1, south : north + 1] = True
    return Surroundings(free)


def test_the_middle_is_where_the_room_is_greatest() -> None:
    corridor = floor_of((-8, -1.5, 8, 1.5))
    x, y = corridor.middle((MIDDLE + 5, MIDDLE - 5))
    assert abs(y - MIDDLE) <= 1
    assert abs(x - MIDDLE - 5) * CELL <= 1.2


def test_mouths_lie_where_ways_leave() -> None:
    t = floor_of((-8, -1.2, 8, 1.2), (-1.2, -8, 1.2, 0))
    mouths = t.mouths((MIDDLE, MIDDLE))
    bearings = sorted(round(math.degrees(each.bearing)) for each in mouths)
    assert bearings[0] == pytest.approx(-90, abs=3)
    assert len(bearings) == 3
    for each in mouths:
        assert each.width == pytest.approx(2.4, abs=0.3)
        headings = np.array([each.bearing, each.bearing + math.pi / 2])
        deep, shallow = t.depths(each, headings)
        assert deep > 4
        assert shallow < 2


def test_beside_the_free_floor_there_are_no_mouths() -> None:
    assert floor_of((-8, -1.2, 8, 1.2)).mouths((MIDDLE, MIDDLE + 40)) == []


def test_lines_meet_in_one_place_and_parallel_ones_at_the_middle() -> None:
    east, west = SensedWay(5, 1, 0, 2), SensedWay(-5, 1, math.pi, 2)
    north = SensedWay(2, 6, math.pi / 2, 2)
    assert crossing([east, west, north], (0, 0)) == pytest.approx((2, 1), abs=0.1)
    assert crossing([east, west], (0.5, 1.2)) == pytest.approx((0.5, 1), abs=0.1)


def test_a_turning_point_reaches_to_the_edges_of_its_ways() -> None:
    hall, lane = SensedWay(5, 0, 0, 6), SensedWay(0, 5, math.pi / 2, 2.4)
    assert reach_along(hall, [hall, lane], 3.0) == pytest.approx(1.2)
    assert reach_along(lane, [hall, lane], 3.0) == pytest.approx(3.0)
    bend = SensedWay(0, 5, math.radians(20), 4)
    assert reach_along(hall, [hall, bend], 2.1) == pytest.approx(2.1)
