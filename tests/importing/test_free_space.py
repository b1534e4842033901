import numpy as np
import pytest
from shapely import Point, box

from memorymaze.errors import ImportFileError
from memorymaze.geometry.pose import Pose
from memorymaze.importing.free_space import free_space
from memorymaze.importing.occupancy import OccupancyGrid

CELL = 0.05


def drawn(
    *free: tuple[float, float, float, float], walls: bool = True
) -> OccupancyGrid:
    """Return a map of 10 m by 10 m with free rectangles; the rest is wall or unknown."""
    cells = np.zeros((200, 200), dtype=bool)
    for west, south, east, north in free:
        rows = slice(round(south / CELL), round(north / CELL))
        cells[rows, round(west / CELL) : round(east / CELL)] = True
    return OccupancyGrid(cells, ~cells & walls, CELL, Pose(0, 0, 0))


def test_the_floor_is_where_cells_are_free() -> None:
    space = free_space(drawn((1, 2, 8, 4)))

    assert space.floor.symmetric_difference(box(1, 2, 8, 4)).area < 0.05
    assert space.gaps == ()


def test_the_largest_of_several_floors_is_taken() -> None:
    space = free_space(drawn((1, 1, 8, 4), (1, 6, 3, 8)))

    assert space.floor.area == pytest.approx(21, abs=0.1)
    assert space.left_out == pytest.approx(4, abs=0.1)


@pytest.mark.parametrize(("gap", "area"), [(0.3, 21.1), (0.9, 25.2)])
def test_a_robot_goes_through_doors_and_not_through_slits(
    gap: float, area: float
) -> None:
    space = free_space(drawn((1, 1, 8, 4), (2, 4, 2 + gap, 4.2), (1, 4.2, 3, 6.2)))

    assert space.floor.area == pytest.approx(area, abs=0.2)


def test_a_wider_robot_stays_out_of_rooms() -> None:
    grid = drawn((1, 1, 8, 4), (2, 4, 2.9, 4.2), (1, 4.2, 3, 6.2))

    assert free_space(grid, 0.6).floor.area == pytest.approx(21.3, abs=0.3)


def test_specks_are_noise_and_boxes_are_not() -> None:
    grid = drawn((1, 1, 8, 4))
    grid.free[40, 40] = grid.free[50, 80] = False
    grid.free[40:50, 120:130] = False

    space = free_space(grid)

    assert space.specks == 2
    (hole,) = space.floor.interiors
    assert hole.centroid.distance(Point(6.25, 2.25)) < 0.05


def test_an_edge_without_a_wall_is_told() -> None:
    grid = drawn((1, 2, 8, 4))
    grid.occupied[:, 150:] = False

    (gap,) = free_space(grid).gaps

    assert gap.length == pytest.approx(2, abs=1.2)
    assert gap.distance(Point(8, 3)) < 0.1


@pytest.mark.parametrize("free", [[], [(1, 1, 1.3, 9)]])
def test_a_map_without_floor_for_a_robot_is_refused(
    free: list[tuple[float, float, float, float]],
) -> None:
    with pytest.raises(ImportFileError, match="look at the"):
        free_space(drawn(*free))
