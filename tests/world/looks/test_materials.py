import pytest

from memorymaze.world.looks.materials import (
    colours_of,
    is_wooden,
    mixed,
    shade,
)
from memorymaze.world.sites import load_sites


def test_every_colour_of_the_shipped_plans_is_known():
    words = {
        each.color
        for site in load_sites(None).values()
        for each in site.landmarks
        if each.color
    }
    assert not [each for each in sorted(words) if not colours_of(each)]


def test_two_colours_come_in_their_order():
    blue, green = colours_of("blue and green")
    assert blue[2] > blue[1]
    assert green[1] > green[2]


def test_dark_and_light_change_a_colour():
    light, plain, dark = (
        sum(colours_of(each)[0]) for each in ("light blue", "blue", "dark blue")
    )
    assert light > plain > dark


def test_unknown_words_name_no_colour():
    assert colours_of("heliotrope") == ()
    assert colours_of(None) == ()


@pytest.mark.parametrize(
    ("words", "wooden"),
    [("light wood", True), ("oak", True), ("red", False), (None, False)],
)
def test_wood_is_told_from_paint(words, wooden):
    assert is_wooden(words) is wooden


def test_shades_stay_colours():
    assert shade((0.5, 0.5, 0.5), 5.0) == (1.0, 1.0, 1.0)
    assert shade((0.5, 0.5, 0.5), 0.5) == (0.25, 0.25, 0.25)
    assert mixed((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), 0.25) == (0.25, 0.25, 0.25)
