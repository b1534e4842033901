import math
import re
from collections.abc import Callable

import pytest

from memorymaze.agents.navgpt.observation import (
    Place,
    history_line,
    observation_text,
    ways_text,
)
from memorymaze.robot.viewpoints import Panorama, SeenThing, WayOn

Look = Callable[..., Panorama]
JUST_WEST_OF_NORTH = math.pi / 2 + math.radians(0.001)


def directions_of(text: str) -> dict[str, str]:
    parts = re.split(r"^(\w[\w ]*), from .*:$", text, flags=re.MULTILINE)[1:]
    return dict(zip(parts[::2], parts[1::2], strict=True))


def test_the_front_comes_first_and_the_rest_clockwise(look: Look) -> None:
    text = observation_text(Place("a" * 32, 90.0, look(), ()))
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
    text = observation_text(Place("a" * 32, 80.0, look(), ()))
    assert "Front, from left 12.50 to right 32.50:" in text
    assert "View 2." in directions_of(text)["Front"]


def test_a_way_at_359_999_degrees_is_shown(look: Look) -> None:
    ways = (WayOn("b" * 32, JUST_WEST_OF_NORTH, 2.25),)
    place = Place("a" * 32, 0.0, look(), ways)
    front = directions_of(observation_text(place))["Front"]
    assert f"{'b' * 32} (right 0.00, 2.25 m)" in front.replace("left", "right")


def test_the_released_code_does_not_show_it(look: Look) -> None:
    ways = (WayOn("b" * 32, JUST_WEST_OF_NORTH, 2.25),)
    place = Place("a" * 32, 0.0, look(), ways)
    assert "b" * 32 not in observation_text(place, faithful=True)
    assert "b" * 32 in ways_text(place)


def test_things_of_one_name_are_numbered_through_all_directions(look: Look) -> None:
    north, east = math.pi / 2, 0.0
    seen = {
        0: [SeenThing("door", north, 1.0), SeenThing("door", north - 0.2, 2.0)],
        2: [SeenThing("door", east, 1.5), SeenThing("bench", east, 2.5)],
    }
    text = observation_text(Place("a" * 32, 0.0, look(seen), ()))
    assert "door 1 (right 0.00, 1.00 m); door 2 (right 11.46, 2.00 m)" in text
    assert "door 3 (right 90.00, 1.50 m); bench (right 90.00, 2.50 m)" in text


def test_the_released_code_tells_one_of_each_name_in_a_direction(look: Look) -> None:
    north = math.pi / 2
    seen = {0: [SeenThing("door", north, 1.0), SeenThing("door", north, 2.0)]}
    text = observation_text(Place("a" * 32, 0.0, look(seen), ()), faithful=True)
    assert text.count("door") == 1
    assert "door (right 0.00, 1.00 m)" in text


@pytest.mark.parametrize(
    ("before_deg", "after_deg", "turn"),
    [(350.0, 10.0, "right 20.00"), (90.0, 0.0, "left 90.00")],
)
def test_a_move_is_told_in_a_line(
    look: Look, before_deg: float, after_deg: float, turn: str
) -> None:
    before = Place("a" * 32, before_deg, look(), ())
    after = Place("b" * 32, after_deg, look(summary="A hall."), ())
    line = history_line(before, after)
    assert line.startswith(f"You turned {turn} degrees, from heading {before_deg:.2f}")
    assert line.endswith(f"to {'b' * 32}. A hall.")
