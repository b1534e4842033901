import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.world.looks.visibility import Sightlines

WALL = Sightlines(np.array([[5.0, -1.0, 5.0, 1.0]]))


@pytest.mark.parametrize(
    ("x", "y", "radius", "seen"),
    [
        pytest.param(4.0, 0.0, 0.3, True, id="before the wall"),
        pytest.param(8.0, 0.0, 0.3, False, id="behind the wall"),
        pytest.param(8.0, 3.0, 0.3, True, id="beside the wall"),
        pytest.param(8.0, 2.0, 0.6, True, id="half behind the wall"),
        pytest.param(-3.0, 0.0, 0.3, False, id="behind the eye"),
        pytest.param(-0.2, 0.0, 0.5, True, id="round the eye"),
        pytest.param(5.0, 0.0, 0.3, True, id="in the wall"),
    ],
)
def test_walls_hide_what_is_behind(
    x: float, y: float, radius: float, seen: bool
) -> None:
    outlook = WALL.outlook(0.0, 0.0, 0.0, math.pi / 4, 50.0)
    shown = outlook.sees(np.array([[x, y]]), np.array([radius]))
    assert shown.tolist() == [seen]


def test_all_round_sees_across_the_seam() -> None:
    outlook = WALL.outlook(0.0, 0.0, 0.0, math.pi, 50.0)
    shown = outlook.sees(
        np.array([[-3.0, 0.0], [-3.0, 0.01], [8.0, 0.0]]), np.array([0.2, 0.2, 0.2])
    )
    assert shown.tolist() == [True, True, False]


@given(
    x=st.floats(-20, 20),
    y=st.floats(-20, 20),
    radius=st.floats(0.05, 3),
    share=st.floats(0, 0.99),
    angle=st.floats(0, 2 * math.pi),
)
def test_a_thing_with_a_visible_point_is_seen(
    x: float, y: float, radius: float, share: float, angle: float
) -> None:
    # Any point of it that a straight line reaches makes it seen.
    px = x + share * radius * math.cos(angle)
    py = y + share * radius * math.sin(angle)
    if px < 0.01 or abs(py) > px * 0.999:
        return  # outside the picture
    if px > 5 and abs(py / px * 5) <= 1:
        return  # behind the wall
    outlook = WALL.outlook(0.0, 0.0, 0.0, math.pi / 4, 60.0)
    assert outlook.sees(np.array([[x, y]]), np.array([radius]))[0]
