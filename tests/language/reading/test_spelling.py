"""Misspelt words are read as they were meant, and nothing else is changed."""

import pytest

from memorymaze.language.plans import Turn
from memorymaze.language.reading import parse_route_description
from memorymaze.language.reading.spelling import spelt


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("at the intersecton", "at the intersection"),
        ("go foward", "go forward"),
        ("down the ahllway", "down the hallway"),
        ("by the aesal", "by the easel"),
        ("turn laft", "turn left"),
        ("Straigth on. Foward.", "straight on. forward."),
    ],
)
def test_misspelt_words_are_read_for_common_ones(written: str, meant: str) -> None:
    assert spelt(written).lower() == meant.lower()


@pytest.mark.parametrize(
    "text",
    [
        "past the red ball and the loft",
        "near Larft Hall",
        "the doors that exist there send you back",
        "stone lions contain nothing",
        "room 2347, AED, wc",
        "take the flat path beside the bank",
    ],
)
def test_words_of_their_own_and_names_stay(text: str) -> None:
    assert spelt(text) == text


def test_a_misspelt_turn_is_a_turn() -> None:
    plan = parse_route_description("Go to the end and take a laft. Then turn rigth.")
    assert [leg.turn.way for leg in plan.legs] == ["left", "right"]
    assert plan.legs[0].turn == Turn("left", at_end=True)
