import math

import numpy as np
import pytest
import shapely
from shapely import Polygon, box
from shapely.affinity import rotate

from memorymaze.world.importing.shapes import polygons
from memorymaze.world.importing.straight_walls import straight_walls

L_SHAPE = box(0, 0, 20, 3) | box(0, 0, 3, 15)
RING = box(0, 0, 20, 12) - box(3, 3, 17, 9)


def ragged(floor: Polygon, by: float = 0.02) -> Polygon:
    """Return a floor as a map's cells outline it."""
    rng = np.random.default_rng(5)
    rings = [
        np.asarray(shapely.segmentize(ring, 0.2).coords)[:-1]
        for ring in (floor.exterior, *floor.interiors)
    ]
    shell, *holes = [ring + rng.normal(0, by, ring.shape) for ring in rings]
    return polygons(Polygon(shell, holes))[0]


@pytest.mark.parametrize("degrees", [0, 12, 45, 80])
@pytest.mark.parametrize("floor", [L_SHAPE, RING])
def test_walls_come_out_straight_however_the_building_stands(
    floor: Polygon, degrees: float
) -> None:
    floor = rotate(floor, degrees, origin=(0, 0))

    straight = straight_walls(ragged(floor), 0.12)

    corners = len(floor.simplify(0.01).exterior.coords)
    assert len(straight.exterior.coords) <= corners + 1
    assert straight.symmetric_difference(floor).area < 0.01 * floor.area


def test_walls_of_one_direction_are_parallel() -> None:
    corners = shapely.get_coordinates(straight_walls(ragged(L_SHAPE), 0.12))

    headings = [math.atan2(y, x) for x, y in np.diff(corners, axis=0)]
    spread = [math.remainder(each - headings[0], math.pi / 2) for each in headings]
    assert max(map(abs, spread)) < 1e-6


def test_a_wall_askew_stays_askew() -> None:
    floor = Polygon([(0, 0), (20, 0), (20, 10), (12, 10), (0, 5)])

    straight = straight_walls(ragged(floor), 0.12)

    assert len(straight.exterior.coords) == 6
    assert straight.hausdorff_distance(floor) < 0.15


def test_a_step_in_a_wall_is_kept_where_it_is_larger_than_the_tolerance() -> None:
    floor = box(0, 0, 10, 3) | box(10, 0, 20, 3.4)

    assert straight_walls(floor, 0.12).area == pytest.approx(floor.area)
    assert len(straight_walls(floor, 0.12).exterior.coords) == 7
    assert len(straight_walls(floor, 0.5).exterior.coords) == 5
