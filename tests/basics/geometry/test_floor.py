import numpy as np
import pytest
import shapely
from shapely import Polygon

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.floor import Floor


@pytest.fixture(scope="module")
def floor(pillar_floor: Polygon) -> Floor:
    return Floor(pillar_floor)


def test_the_edge_is_part_of_the_floor(floor: Floor) -> None:
    xs, ys = np.array([0.0, 3.0, 5.0, -0.1]), np.array([0.0, 5.0, 5.0, 5.0])
    assert floor.contains(xs, ys).tolist() == [True, True, False, False]


def test_lines_beside_a_wall_stay_on_the_floor_and_lines_through_it_do_not(
    floor: Floor,
) -> None:
    starts = np.array([(3.0, 1.0), (2.9, 5.0), (0.0, 0.0)])
    ends = np.array([(3.0, 9.0), (7.1, 5.0), (10.0, 0.0)])
    assert floor.joins(starts, ends).tolist() == [True, False, True]


def test_a_slit_that_rounding_left_between_two_pieces_is_no_wall() -> None:
    pieces = shapely.union_all([
        shapely.box(0, 0, 5, 2),
        shapely.box(5 + 1e-9, 0, 9, 2),
    ])
    across = Floor(pieces).joins(np.array([(1.0, 1.0)]), np.array([(8.0, 1.0)]))
    assert across.tolist() == [True]


def test_a_point_just_off_the_floor_is_moved_to_its_edge(floor: Floor) -> None:
    moved = floor.onto([(5, -0.3), (3.2, 5), (1, 1)], 0.5)
    assert moved.tolist() == [[5, 0], [3, 5], [1, 1]]


def test_a_point_far_off_the_floor_is_named(floor: Floor) -> None:
    with pytest.raises(
        UndefinedMetricError, match=r"point 1 at \(5.000, -0.600\) is 0.60 m off"
    ):
        floor.onto([(1, 1), (5, -0.6)], 0.5)


def test_a_point_that_is_not_finite_is_named(floor: Floor) -> None:
    with pytest.raises(UndefinedMetricError, match="point 1 is not finite"):
        floor.onto([(1, 1), (np.nan, 1)], 0.5)


def test_points_have_two_coordinates(floor: Floor) -> None:
    with pytest.raises(ValueError, match=r"\(K, 2\)"):
        floor.onto([(1, 1, 1)], 0.5)


@pytest.mark.parametrize(
    ("polygon", "message"),
    [
        (Polygon(), "empty"),
        (Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]), "Self-intersection"),
    ],
)
def test_what_is_no_floor_is_refused(polygon: Polygon, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Floor(polygon)
