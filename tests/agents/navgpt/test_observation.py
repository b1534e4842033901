"""-"""

import math
import re
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.navgpt.observation import (
    ObservedPlace,
    Scratchpad,
    compass_degrees,
    history_line,
    observation_text,
    relative_words,
    sector_bounds,
    sector_of,
    ways_text,
)
from memorymaze.robot.api.viewpoints import Panorama, SeenThing, WayOn

Look = Callable[..., Panorama]
JUST_WEST_OF_NORTH = math.pi / 2 + math.radians(0.001)


def directions_of(text: str) -> dict[str, str]:
    parts = re.split(r"^(\w[\w ]*), from .*:$", text, flags=re.MULTILINE)[1:]
    return dict(zip(parts[::2], parts[1::2], strict=True))


def test_the_front_comes_first_and_the_rest_clockwise(look: Look) -> None:
    text = observation_text(ObservedPlace("a" * 32, 90.0, look(), ()))
    directions = directions_of(text)
    assert list(directions) == [
        "Front",
        "Front Right",
        "Right",
        "Rear Right",
        "Rear",
        "Rear Left",
        "Left",
        "Front Left",
    ]
    assert "View 2." in directions["Front"], "east, for a robot that faces east"
    assert "View 0." in directions["Left"]
    assert "Front, from left 22.50 to right 22.50:" in text


def test_directions_are_fixed_to_the_compass_and_ranges_to_the_robot(
    look: Look,
) -> None:
    text = observation_text(ObservedPlace("a" * 32, 80.0, look(), ()))
    assert "Front, from left 12.50 to right 32.50:" in text
    assert "View 2." in directions_of(text)["Front"]


def test_a_way_at_359_999_degrees_is_shown(look: Look) -> None:
    ways = (WayOn("b" * 32, JUST_WEST_OF_NORTH, 2.25),)
    place = ObservedPlace("a" * 32, 0.0, look(), ways)
    front = directions_of(observation_text(place))["Front"]
    assert f"{'b' * 32} (right 0.00, 2.25 m)" in front.replace("left", "right")


def test_the_released_code_does_not_show_it(look: Look) -> None:
    ways = (WayOn("b" * 32, JUST_WEST_OF_NORTH, 2.25),)
    place = ObservedPlace("a" * 32, 0.0, look(), ways)
    assert "b" * 32 not in observation_text(place, faithful=True)
    assert "b" * 32 in ways_text(place)


def test_things_of_one_name_are_numbered_through_all_directions(look: Look) -> None:
    north, east = math.pi / 2, 0.0
    seen = {
        0: [SeenThing("door", north, 1.0), SeenThing("door", north - 0.2, 2.0)],
        2: [SeenThing("door", east, 1.5), SeenThing("bench", east, 2.5)],
    }
    text = observation_text(ObservedPlace("a" * 32, 0.0, look(seen), ()))
    assert "door 1 (right 0.00, 1.00 m); door 2 (right 11.46, 2.00 m)" in text
    assert "door 3 (right 90.00, 1.50 m); bench (right 90.00, 2.50 m)" in text


def test_the_released_code_tells_one_of_each_name_in_a_direction(look: Look) -> None:
    north = math.pi / 2
    seen = {0: [SeenThing("door", north, 1.0), SeenThing("door", north, 2.0)]}
    text = observation_text(ObservedPlace("a" * 32, 0.0, look(seen), ()), faithful=True)
    assert text.count("door") == 1
    assert "door (right 0.00, 1.00 m)" in text


@pytest.mark.parametrize(
    ("before_deg", "after_deg", "turn"),
    [(350.0, 10.0, "right 20.00"), (90.0, 0.0, "left 90.00")],
)
def test_a_move_is_told_in_a_line(
    look: Look, before_deg: float, after_deg: float, turn: str
) -> None:
    before = ObservedPlace("a" * 32, before_deg, look(), ())
    after = ObservedPlace("b" * 32, after_deg, look(summary="A hall."), ())
    line = history_line(before, after)
    assert line.startswith(f"You turned {turn} degrees, from heading {before_deg:.2f}")
    assert line.endswith(f"to {'b' * 32}. A hall.")


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


def test_only_the_last_place_is_told_in_full() -> None:
    pad = Scratchpad(10_000)
    pad.add_move("first", "all of A", "A in short")
    pad.add_failure("hm", "say what you mean")
    pad.add_move("second", "all of B", "B in short")
    pad.add_failure("hm", "once more")
    assert pad.text() == (
        "first\nObservation: A in short\n\n"
        "hm\nObservation: say what you mean\n\n"
        "second\nObservation: all of B\n\n"
        "hm\nObservation: once more\n"
    )


def test_the_released_scratchpad_cuts_a_record_in_two() -> None:
    pad = Scratchpad(20, whole_steps=False)
    pad.add_move("first", "all of A", "A in short")
    pad.add_move("second", "all of B", "B in short")
    assert pad.text() == "bservation: all of B\n"[-20:]


def test_whole_steps_are_left_out_the_oldest_first() -> None:
    pad = Scratchpad(80)
    for number in range(9):
        pad.add_move(f"step {number}", f"all of {number}", f"{number} in short")
    shown = pad.text()
    assert len(shown) <= 80
    assert shown.startswith("step 7\n")
    assert "all of 8" in shown


def test_where_the_robot_is_stays_though_many_replies_fail() -> None:
    pad = Scratchpad(150)
    pad.add_move("old", "all of A", "A in short")
    pad.add_move("step", "all of B", "B in short")
    for number in range(20):
        pad.add_failure(f"nonsense {number}", "no")
    shown = pad.text()
    assert len(shown) <= 150
    assert "all of B" in shown
    assert "nonsense 19" in shown
    assert "A in short" not in shown


def test_an_observation_longer_than_the_limit_is_cut() -> None:
    pad = Scratchpad(50)
    pad.add_move("step", "x" * 500, "short")
    assert pad.text() == "x" * 49 + "\n"


def test_nonsense_is_not_shown_at_length() -> None:
    pad = Scratchpad(10_000)
    pad.add_failure("blah " * 1000, "no")
    assert len(pad.text()) < 450
