import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import Polygon

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.basics.geometry.shortest_walk import ShortestWalks


@pytest.mark.parametrize(
    ("start", "end", "metres"),
    [
        pytest.param((1, 1), (1, 1), 0, id="nowhere"),
        pytest.param((1, 1), (7, 1), 6, id="straight"),
        pytest.param((3, 8), (5, 8), 6 + 2 + 6, id="along the walls of the block"),
        pytest.param(
            (0, 6), (8, 6), 2 * np.hypot(3, 4) + 2, id="round two corners of the block"
        ),
    ],
)
def test_walks_have_the_length_worked_by_hand(
    u_floor: Polygon,
    start: tuple[float, float],
    end: tuple[float, float],
    metres: float,
) -> None:
    assert ShortestWalks(u_floor).distance(start, end) == pytest.approx(metres)


def test_a_pillar_is_passed_on_the_nearer_side(pillar_floor: Polygon) -> None:
    walks = ShortestWalks(pillar_floor)
    assert walks.distance((0, 4), (10, 4)) == pytest.approx(2 * np.hypot(3, 1) + 4)


places = st.tuples(st.floats(0, 10), st.floats(0, 2.9)).map(np.array)


@given(places, places, places)
def test_walks_are_symmetric_never_shorter_than_straight_and_obey_the_triangle(
    pillar_grid: FloorGrid, a: np.ndarray, b: np.ndarray, c: np.ndarray
) -> None:
    b = b[::-1]
    walk = pillar_grid.distance
    assert walk(a, b) == pytest.approx(walk(b, a))
    assert walk(a, b) >= np.hypot(*(a - b)) - 1e-9
    assert walk(a, c) <= walk(a, b) + walk(b, c) + 1e-5


def test_many_points_have_the_distances_each_has(pillar_floor: Polygon) -> None:
    walks = ShortestWalks(pillar_floor)
    points = [(0, 4), (5, 2), (10, 10)]
    assert walks.distances_to((9, 5), points).tolist() == [
        walks.distance(point, (9, 5)) for point in points
    ]


def test_two_floors_without_a_way_between_are_not_joined() -> None:
    apart = shapely.union_all([shapely.box(0, 0, 2, 2), shapely.box(5, 0, 7, 2)])
    with pytest.raises(UndefinedMetricError, match="no walk on the floor joins"):
        ShortestWalks(apart).distance((1, 1), (6, 1))


def test_a_place_off_the_floor_is_refused(u_floor: Polygon) -> None:
    with pytest.raises(UndefinedMetricError, match=r"1\.00 m off the floor"):
        ShortestWalks(u_floor).distance((1, 1), (4, 7))


def test_a_floor_without_inner_corners_has_only_straight_walks() -> None:
    assert ShortestWalks(shapely.box(0, 0, 3, 4)).distance((0, 0), (3, 4)) == 5
