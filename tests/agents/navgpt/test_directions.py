import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.navgpt.directions import (
    compass_degrees,
    relative_words,
    sector_bounds,
    sector_of,
)

degrees = st.floats(0, 360, exclude_max=True)


@pytest.mark.parametrize(
    ("heading_deg", "sector"),
    [(0, 0), (22.4, 0), (22.5, 1), (90, 2), (337.4, 7), (337.5, 0), (359.999, 0)],
)
def test_a_heading_lies_in_the_sector_whose_middle_is_nearest(
    heading_deg: float, sector: int
) -> None:
    assert sector_of(heading_deg) == sector


@pytest.mark.parametrize("heading_deg", [337.5, 359.999])
def test_the_released_code_loses_headings_just_west_of_north(
    heading_deg: float,
) -> None:
    assert sector_of(heading_deg, faithful=True) is None
    assert sector_of(337.4, faithful=True) == 7


@given(degrees)
def test_every_heading_has_a_sector_that_holds_it(heading_deg: float) -> None:
    sector = sector_of(heading_deg)
    assert sector is not None
    off = (heading_deg - sector * 45 + 180) % 360 - 180
    assert -22.5 <= off <= 22.5


@given(st.floats(-math.pi, math.pi))
def test_the_compass_turns_the_other_way(heading: float) -> None:
    clockwise = compass_degrees(heading)
    assert 0 <= clockwise < 360
    assert math.cos(math.radians(90 - clockwise) - heading) == pytest.approx(1)


@pytest.mark.parametrize(
    ("there", "heading_deg", "words"),
    [
        (10, 350, "right 20.00"),
        (350, 10, "left 20.00"),
        (180, 0, "right 180.00"),
        (90, 90, "right 0.00"),
    ],
)
def test_directions_are_told_relative_to_the_robot(
    there: float, heading_deg: float, words: str
) -> None:
    assert relative_words(there, heading_deg) == words


def test_a_sector_is_bounded_relative_to_the_robot() -> None:
    assert sector_bounds(0, 10.0) == pytest.approx((-32.5, 12.5))
    assert sector_bounds(4, 0.0) == pytest.approx((157.5, -157.5))
