import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.pictures.looks.shapes import (
    Shape,
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    plate,
    smoothed_shape,
    tapered,
    triangles_of,
)
from memorymaze.pictures.looks.tubes import (
    ellipse_ring,
    limb,
    lofted,
    tube,
)

L_SHAPE = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)]
SHAPES = {
    "box": (box((0, 1), (0, 2), (0, 3)), 6.0),
    "turned-round spans": (box((1, 0), (2, 0), (3, 0)), 6.0),
    "tapered": (tapered((0, 2), (0, 2), (0, 3), (0, 1), (0, 1)), 7.0),
    "plate": (plate((0, 0.1), (0, 2), (0, 1)), 0.2),
    "cylinder": (cylinder(1.0, (0, 2), 200), 2 * math.pi),
    "cone": (lathed([(1, 0), (0, 3)], 200), math.pi),
    "ball": (ball(1.0, 80, 60), 4 / 3 * math.pi),
    "along x": (extruded(L_SHAPE, (1, 3), "x"), 8.0),
    "along y": (extruded(L_SHAPE, (1, 3), "y"), 8.0),
    "along z": (extruded(L_SHAPE[::-1], (1, 3), "z"), 8.0),
    "tube": (tube([(0, 0, 0), (0, 0, 2)], 1.0, 200), 2 * math.pi),
    "loft": (lofted([ellipse_ring((0, 0, z), 1, 1, 200) for z in (0, 2)]), 2 * math.pi),
}


def volume(shape: Shape) -> float:
    a, b, c = shape.vertices[shape.faces].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def facing(shape: Shape) -> float:
    """Cosine between the worst normal and its face."""
    a, b, c = shape.vertices[shape.faces].transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return float(np.einsum("ij,ikj->ik", across, shape.normals[shape.faces]).min())


@pytest.mark.parametrize("name", SHAPES)
def test_shapes_enclose_their_volume_with_outward_faces(name: str):
    shape, expected = SHAPES[name]
    assert volume(shape) == pytest.approx(expected, rel=3e-3)
    assert facing(shape) > 0.3


def test_a_bevel_takes_off_the_edges_only():
    plain, bevelled = (box((0, 1), (0, 1), (0, 1), each) for each in (0.0, 0.1))
    assert bevelled.vertices.min() == 0
    assert bevelled.vertices.max() == 1
    assert 0.9 < volume(bevelled) < volume(plain)
    assert facing(bevelled) > 0.5


@given(
    st.floats(-170, 170),
    st.sampled_from("xyz"),
    st.tuples(*[st.sampled_from([-2.0, -0.5, 0.5, 3.0])] * 3),
)
def test_moved_shapes_keep_their_faces_outward(degrees, axis, factors):
    shape = box((0, 1), (0, 2), (0, 3)).turned(axis, degrees).moved(x=5)
    stretched = shape.scaled(*factors)
    expected = 6 * abs(math.prod(factors))
    assert volume(stretched) == pytest.approx(expected, rel=1e-6)
    assert facing(stretched) > 0.99


def test_a_plate_shows_its_picture_upright_to_who_stands_in_front():
    sheet = plate((0, 0.02), (-1, 1), (0, 1))
    assert sheet.uv is not None
    front = sheet.normals[:, 0] > 0.5
    # Who looks against +x has +y on the right hand.
    for point, (u, v) in zip(sheet.vertices[front], sheet.uv[front], strict=True):
        assert u == (point[1] > 0)
        assert v == (point[2] < 0.5)


def test_a_plate_reads_from_both_sides():
    sheet = plate((0, 0.02), (-1, 1), (0, 1), both_sides=True)
    assert sheet.uv is not None
    back = sheet.normals[:, 0] < -0.5
    assert [u for u, _ in sheet.uv[back]] == [
        float(point[1] < 0) for point in sheet.vertices[back]
    ]


def test_a_picture_goes_once_round_a_ball_with_its_middle_in_front():
    globe = ball(1.0, 16, 8)
    assert globe.uv is not None
    ahead = np.argmax(globe.vertices[:, 0])
    assert globe.uv[ahead] == pytest.approx((0.5, 0.5), abs=1e-6)
    top = np.argmax(globe.vertices[:, 2])
    assert globe.uv[top][1] == 0
    eastwards = globe.vertices[globe.uv[:, 0] == 0.75]
    assert eastwards[:, 1].max() > 0.9


def test_limbs_are_longer_than_their_bones():
    bone = limb([(0, 0, 0), (0, 0, 1)], [0.1, 0.2])
    assert bone.vertices[:, 2].min() == pytest.approx(-0.075)
    assert bone.vertices[:, 2].max() == pytest.approx(1.15)
    assert facing(bone) > 0.3


def test_a_closed_tube_is_a_ring_without_ends():
    angles = np.linspace(0, 2 * math.pi, 60, endpoint=False)
    hoop = tube([(math.cos(a), math.sin(a), 0.0) for a in angles], 0.1, 40, closed=True)
    assert volume(hoop) == pytest.approx(2 * math.pi * math.pi * 0.01, rel=0.02)


def area(outline: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = outline[triangles].transpose(1, 0, 2)
    first, second = b - a, c - a
    return float((first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]).sum() / 2)


def test_triangles_without_area_are_dropped():
    points = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0)])
    assert len(smoothed_shape(points, np.array([(0, 1, 2), (0, 1, 3)])).faces) == 1


@given(st.lists(st.floats(0.2, 2.0), min_size=3, max_size=24))
def test_star_shaped_polygons_are_filled_exactly(reach):
    angles = np.arange(len(reach)) * 2 * math.pi / len(reach)
    outline = np.column_stack([reach * np.cos(angles), reach * np.sin(angles)])
    triangles = triangles_of(outline)
    following = np.roll(outline, -1, axis=0)
    expected = np.sum(outline[:, 0] * following[:, 1] - outline[:, 1] * following[:, 0])
    assert len(triangles) == len(reach) - 2
    assert area(outline, triangles) == pytest.approx(expected / 2)


def test_a_polygon_that_crosses_itself_is_refused():
    with pytest.raises(ValueError, match="does not cross itself"):
        triangles_of(np.array([(0.0, 0), (1, 1), (1, 0), (0, 1), (-1, 0.5)])[::-1])
