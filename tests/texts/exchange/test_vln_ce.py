import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.geometry.polyline import project
from memorymaze.basics.geometry.pose import Pose
from memorymaze.texts.exchange.vln_ce import (
    FORWARD,
    LEFT,
    STOP,
    from_position,
    to_heading,
    to_position,
    to_rotation,
    walk_along,
)


def test_a_straight_line_needs_only_steps() -> None:
    walk = walk_along([(0, 0), (2, 0)], Pose(0, 0, 0))
    assert walk.actions == (FORWARD,) * 8 + (STOP,)


def test_a_left_bend_turns_left_by_ninety_degrees_in_all() -> None:
    walk = walk_along([(0, 0), (5, 0), (5, 5)], Pose(0, 0, 0))
    assert walk.actions.count(LEFT) == 6
    assert walk.places[-1] == pytest.approx((5, 5), abs=0.3)


@given(
    turns=st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=6),
    lengths=st.lists(st.floats(2.0, 12.0), min_size=7, max_size=7),
    turn_deg=st.sampled_from([15, 30]),
)
def test_a_walk_stays_near_any_line_and_reaches_its_end(
    turns: list[float], lengths: list[float], turn_deg: int
) -> None:
    headings = np.cumsum([0.0, *turns])
    steps = np.array([
        [length * math.cos(heading), length * math.sin(heading)]
        for length, heading in zip(lengths, headings, strict=False)
    ])
    line = np.concatenate([[[0.0, 0.0]], np.cumsum(steps, axis=0)])
    walk = walk_along(line, Pose(0, 0, 0), turn=math.radians(turn_deg))
    assert all(project(line, place).distance < 0.9 for place in walk.places)
    assert math.dist(walk.places[-1], line[-1]) < 0.5


@given(st.floats(-3.14, 3.14))
def test_headings_come_back_from_habitats_frame(heading: float) -> None:
    assert to_heading(to_rotation(heading)) == pytest.approx(heading, abs=1e-9)


def test_north_is_minus_z_and_east_is_x() -> None:
    assert to_position(2.0, 3.0) == [2.0, 0.0, -3.0]
    assert from_position(to_position(2.0, 3.0)) == (2.0, 3.0)
    assert to_rotation(math.pi / 2) == [0.0, 0.0, 0.0, 1.0]
