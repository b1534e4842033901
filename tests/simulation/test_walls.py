import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point, Polygon, box
from shapely.affinity import rotate, translate

from memorymaze.simulation.walls import WALL_THICKNESS, Wall, walls_around


def footprint(wall: Wall) -> Polygon:
    lying = box(
        -wall.half_length, -wall.half_thickness, wall.half_length, wall.half_thickness
    )
    turned = rotate(lying, wall.heading, origin=(0, 0), use_radians=True)
    return translate(turned, wall.x, wall.y)


L_SHAPE = Polygon([(0, 0), (6, 0), (6, 2), (2, 2), (2, 5), (0, 5)])
RING = Polygon(box(0, 0, 9, 9).exterior.coords, [box(3, 3, 6, 6).exterior.coords])
OVAL = Polygon([
    (4 * math.cos(angle), 3 * math.sin(angle))
    for angle in np.linspace(0, 2 * math.pi, 24, endpoint=False)
])


@pytest.mark.parametrize("floor", [L_SHAPE, RING, OVAL], ids=["L", "ring", "oval"])
def test_walls_stand_outside_the_floor_and_touch_all_of_its_edge(
    floor: Polygon,
) -> None:
    walls = [footprint(wall) for wall in walls_around(floor)]
    for wall in walls:
        assert wall.intersection(floor).area < 1e-9
        assert wall.area > 0.9 * WALL_THICKNESS * (wall.length / 2 - WALL_THICKNESS)
    edge = floor.boundary
    for wall in walls:
        edge = edge.difference(wall.buffer(1e-6))
    assert edge.length < 1e-6


@given(angle=st.floats(0, 2 * math.pi))
def test_no_ray_leaves_between_two_walls(angle: float) -> None:
    walls = [footprint(wall) for wall in walls_around(L_SHAPE)]
    from shapely import LineString

    ray = LineString([
        (1, 1),
        (1 + 20 * math.cos(angle), 1 + 20 * math.sin(angle)),
    ])
    assert any(wall.intersects(ray) for wall in walls)
    nearest = min(
        (wall.intersection(ray).distance(Point(1, 1)), number)
        for number, wall in enumerate(walls)
        if wall.intersects(ray)
    )[0]
    beyond = (1 + nearest * math.cos(angle), 1 + nearest * math.sin(angle))
    assert L_SHAPE.buffer(1e-6).covers(Point(beyond))


def test_walls_know_which_hole_they_stand_around() -> None:
    rings = [wall.ring for wall in walls_around(RING)]
    assert rings == [0, 0, 0, 0, 1, 1, 1, 1]
