"""What a plan says of itself."""

import pytest

from memorymaze.language.plans.records import RoutePlan
from memorymaze.language.reading import parse_route_description


@pytest.mark.parametrize(
    "text",
    [
        "It's the computer room, next to the red painting.",
        "The cafeteria? That's by the big staircase.",
        "Oh, the library. Ask again there.",
    ],
)
def test_who_tells_the_place_alone_tells_place_alone(text: str) -> None:
    assert parse_route_description(text).tells_place_alone


@pytest.mark.parametrize(
    "text",
    [
        "Turn left at the painting, then it is the library.",
        "Walk twenty metres to the library.",
        "The library is at the end.",
        "It is the third door on the left.",
        "Pass two openings on the left, then stop at the library.",
        "Face the lifts. The library is in front of you.",
    ],
)
def test_who_tells_a_turn_a_length_or_how_to_set_off_tells_a_way(text: str) -> None:
    assert not parse_route_description(text).tells_place_alone


def test_nothing_said_tells_no_place() -> None:
    assert not RoutePlan().tells_place_alone
