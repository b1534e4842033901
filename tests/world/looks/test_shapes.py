import numpy as np
import pytest

from memorymaze.world.looks.shapes import Shape, box, plate

SHAPES = {
    "box": (box((0, 1), (0, 2), (0, 3)), 6.0),
    "turned-round spans": (box((1, 0), (2, 0), (3, 0)), 6.0),
    "plate": (plate((0, 0.1), (0, 2), (0, 1)), 0.2),
    "turned": (box((0, 1), (0, 2), (0, 3)).turned(30), 6.0),
}


def volume(shape: Shape) -> float:
    a, b, c = shape.vertices[shape.faces].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


@pytest.mark.parametrize("name", SHAPES)
def test_shapes_enclose_their_volume_with_outward_faces(name: str):
    shape, expected = SHAPES[name]
    assert volume(shape) == pytest.approx(expected, rel=3e-3)


def test_a_bevel_takes_a_little_off_the_edges():
    assert 5.5 < volume(box((0, 1), (0, 2), (0, 3), 0.1)) < 6.0
