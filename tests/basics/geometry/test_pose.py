import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.geometry.pose import (
    Pose,
    bearing_to,
    heading_to,
    turn_between,
    wrap_angle,
)

angles = st.floats(-100, 100)


@given(angles)
def test_a_wrapped_angle_is_the_same_direction_in_the_half_open_range(
    angle: float,
) -> None:
    wrapped = wrap_angle(angle)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle), abs=1e-9)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle), abs=1e-9)


@given(angles, angles)
def test_turning_by_the_turn_between_two_headings_leads_to_the_second(
    heading: float, target: float
) -> None:
    reached = heading + turn_between(heading, target)
    assert math.cos(reached - target) == pytest.approx(1)


@pytest.mark.parametrize(
    ("end", "heading"),
    [((1, 0), 0), ((0, 1), math.pi / 2), ((-1, 0), math.pi), ((0, -1), -math.pi / 2)],
)
def test_headings_go_counter_clockwise_from_east(
    end: tuple[float, float], heading: float
) -> None:
    assert heading_to((0, 0), end) == pytest.approx(heading)


def test_what_lies_to_the_left_has_a_positive_bearing() -> None:
    north = Pose(1, 1, math.pi / 2)
    assert bearing_to(north, (0, 1)) == pytest.approx(math.pi / 2)
    assert bearing_to(north, (2, 1)) == pytest.approx(-math.pi / 2)


def test_no_heading_leads_from_a_point_to_itself() -> None:
    with pytest.raises(ValueError, match="coinciding"):
        heading_to((2, 3), (2, 3))
