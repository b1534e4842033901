import math

import numpy as np
import pytest

from memorymaze.robot.perception.turning_points.junctions import (
    FreeSurroundings,
    SensedJunction,
    SensedWay,
    crossing,
    is_turning_point,
    is_worth_telling,
    reach_along,
)
from memorymaze.robot.perception.turning_points.local_map import CELL

MIDDLE = 64


def floor_of(*boxes: tuple[float, float, float, float]) -> FreeSurroundings:
    """Free floor of boxes (west, south, east, north), metres from the middle."""
    free = np.zeros((2 * MIDDLE + 1, 2 * MIDDLE + 1), dtype=bool)
    for bounds in boxes:
        west, south, east, north = (round(each / CELL) + MIDDLE for each in bounds)
        free[west : east + 1, south : north + 1] = True
    return FreeSurroundings(free)


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


def ways(*degrees: float) -> list[SensedWay]:
    return [
        SensedWay(
            2 * math.cos(math.radians(each)),
            2 * math.sin(math.radians(each)),
            math.radians(each),
            2.4,
        )
        for each in degrees
    ]


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [
        pytest.param([], False, id="nothing"),
        pytest.param([90], False, id="dead end"),
        pytest.param([0, 180], False, id="corridor"),
        pytest.param([0, 170], False, id="hardly a bend"),
        pytest.param([0, 160], True, id="bend"),
        pytest.param([0, 90], True, id="corner"),
        pytest.param([0, 90, 180], True, id="T"),
    ],
)
def test_turning_points_are_bends_and_more(
    degrees: list[float], expected: bool
) -> None:
    assert is_turning_point(ways(*degrees)) == expected


def test_straight_on_alone_is_not_told() -> None:
    (back, on, aside) = ways(180, 5, 60)
    assert not is_worth_telling([], back)
    assert not is_worth_telling([on], back)
    assert is_worth_telling([aside], back)
    assert is_worth_telling([on, aside], back)
    assert is_worth_telling([on], None)


def test_what_most_sightings_tell_is_believed() -> None:
    junction = SensedJunction(0, 0, 1.5)
    for seen in ((0, 90, 180), (2, 88, 180), (0, 180), (-1, 91, 180, -90)):
        junction.see(0.1, -0.1, 1.5, ways(*seen), 1.0)
    headings = sorted(math.degrees(each.heading) for each in junction.ways())
    assert headings == pytest.approx([0, 90, 180], abs=2)
    assert (junction.x, junction.y) == pytest.approx((0.1, -0.1), abs=0.01)


def test_it_holds_what_lies_between_the_edges_of_its_ways() -> None:
    junction = SensedJunction(0, 0, 1.5)
    junction.see(0, 0, 1.5, ways(0, 90, 180), 1.0)
    assert junction.holds(1.1, 0, 0)
    assert not junction.holds(1.5, 0, 0)
    assert junction.holds(1.5, 0, 0.4)
    assert not junction.holds(0, 1.5, 0)
    assert not junction.holds(0, -9, 0)
