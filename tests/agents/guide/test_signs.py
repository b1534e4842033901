"""Which way signs point for a destination, and at which crossing."""

import math

import pytest

from memorymaze.agents.guide.signs import Pointers, pointed
from memorymaze.agents.walking.floor_map import Crossing, FloorMap, Sighting

LEFT, RIGHT, AHEAD, BACK = 90, -90, 0, 180


def _pointed(text: str, *words: str) -> list[int]:
    return pointed(text, [frozenset(words)])


@pytest.mark.parametrize(
    ("text", "angles"),
    [
        ("← Library", [LEFT]),
        ("Library →", [RIGHT]),
        ("↑ Library", [AHEAD]),
        ("↓ Library", [BACK]),
        ("Library to the left", [LEFT]),
        ("Library on the right", [RIGHT]),
        ("Library straight on", [AHEAD]),
        ("Library", []),
        ("← Café", []),
        ("← Café   Library →", [RIGHT]),
        ("← Library   Café →", [LEFT]),
        ("← Café, Library", [LEFT]),
        ("← Library   Library →", [LEFT, RIGHT]),
        ("LIBRARY →", [RIGHT]),
        ("← Libraries and Museum", []),
    ],
)
def test_a_sign_points_as_its_arrow_or_its_words_say(
    text: str, angles: list[int]
) -> None:
    assert _pointed(text, "library") == angles


@pytest.mark.parametrize(
    "text", ["← Rooms 210-220", "← Rooms 210\u2013220", "Rooms 210 to 220 to the left"]
)
@pytest.mark.parametrize(
    ("number", "is_named"), [("210", True), ("215", True), ("221", False)]
)
def test_a_range_of_numbers_names_all_in_it(
    text: str, number: str, *, is_named: bool
) -> None:
    assert _pointed(text, "room", number) == ([LEFT] if is_named else [])


@pytest.mark.parametrize(
    ("text", "is_named"),
    [
        ("← Meeting Rooms", True),
        ("← Meeting Rooms, Reception", True),
        ("← Meeting Room 4", False),
        ("← Meeting Rooms 1-5", False),
        ("← Restrooms", False),
        ("← Meeting Point", False),
    ],
)
def test_a_sign_to_rooms_of_a_kind_points_to_each_of_them(
    text: str, *, is_named: bool
) -> None:
    assert _pointed(text, "meeting", "room", "6") == ([LEFT] if is_named else [])
    assert _pointed(text, "room", "6") == ([LEFT] if is_named else [])


def test_of_names_on_one_line_between_two_arrows_those_at_the_ends_alone_are_sure() -> (
    None
):
    text = "← Museum, Café, Library →"
    assert _pointed(text, "museum") == [LEFT]
    assert _pointed(text, "library") == [RIGHT]
    assert _pointed(text, "cafe") == []


def _sign(text: str, x: float, y: float = 0.0) -> Sighting:
    """Return a sign read from 3 m before it, by one who walks east."""
    return Sighting(text, text, 1.0, (x, y), (x - 3, y), 3.0, 1, (0, 0), "ahead")


def _floor(text: str, x: float, y: float = 0.0) -> FloorMap:
    """Return a hall to the east with a crossing after 10 m and one after 30 m."""
    floor = FloorMap()
    for number, place in ((1, (10.0, 0.0)), (2, (30.0, 0.0))):
        exits = [0.0, math.pi / 2, -math.pi / 2, math.pi]
        floor.crossings[number] = Crossing(number, place, exits)
    floor.note_text(_sign(text, x, y))
    return floor


def test_a_sign_is_about_the_crossing_that_one_comes_to_next() -> None:
    before = Pointers(["library"]).headings(_floor("← Library", 8.0))
    assert before == {1: [pytest.approx(math.pi / 2)]}
    beyond = Pointers(["library"]).headings(_floor("← Library", 27.0))
    assert list(beyond) == [2]


def test_a_sign_far_from_any_crossing_points_nowhere() -> None:
    assert not Pointers(["library"]).headings(_floor("← Library", 60.0))


@pytest.mark.parametrize("name", ["toilet", "lift", "door", "chair"])
def test_what_there_are_several_of_is_not_told_by_a_sign(name: str) -> None:
    floor = _floor(f"← {name.capitalize()}", 8.0)
    assert not Pointers([name]).headings(floor)


def test_a_sign_told_as_the_destination_points_for_the_place_on_it() -> None:
    floor = _floor("← Library", 8.0)
    assert Pointers(["sign that says Library"]).headings(floor)
