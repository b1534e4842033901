import numpy as np
import pytest
from shapely import Point

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.importing.free_space import free_space
from memorymaze.world.importing.occupancy import OccupancyGrid

CELL = 0.05


def drawn(*free: tuple[float, float, float, float]) -> OccupancyGrid:
    """Return a map of 10 m by 10 m with free rectangles; the rest is wall."""
    cells = np.zeros((200, 200), dtype=bool)
    for west, south, east, north in free:
        rows = slice(round(south / CELL), round(north / CELL))
        cells[rows, round(west / CELL) : round(east / CELL)] = True
    return OccupancyGrid(cells, ~cells, CELL, Pose(0, 0, 0))


@pytest.mark.parametrize(("gap", "area"), [(0.3, 21.1), (0.9, 25.2)])
def test_a_robot_goes_through_doors_and_not_through_slits(
    gap: float, area: float
) -> None:
    space = free_space(drawn((1, 1, 8, 4), (2, 4, 2 + gap, 4.2), (1, 4.2, 3, 6.2)))

    assert space.floor.area == pytest.approx(area, abs=0.2)


def test_specks_are_noise_and_boxes_are_not() -> None:
    grid = drawn((1, 1, 8, 4))
    grid.free[40, 40] = grid.free[50, 80] = False
    grid.free[40:50, 120:130] = False

    space = free_space(grid)

    assert space.specks == 2
    (hole,) = space.floor.interiors
    assert hole.centroid.distance(Point(6.25, 2.25)) < 0.05


def test_a_map_without_free_cells_is_refused() -> None:
    with pytest.raises(ImportFileError, match="look at the thresholds"):
        free_space(drawn())
