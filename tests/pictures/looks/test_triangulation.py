import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.pictures.looks.triangulation import triangles_of


def area(outline: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = outline[triangles].transpose(1, 0, 2)
    first, second = b - a, c - a
    return float((first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]).sum() / 2)


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
