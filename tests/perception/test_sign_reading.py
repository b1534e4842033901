"""Which texts in view can be read."""

import math
from dataclasses import replace

import pytest

from memorymaze.geometry.pose import Pose
from memorymaze.perception.sign_reading import TruthSignReader
from memorymaze.perception.visible_object import (
    ObjectDescription,
    VisibleObject,
    VisibleText,
)

SIGN = VisibleText(
    text="Library",
    bearer=VisibleObject(
        description=ObjectDescription("sign", text="Library"),
        position=(3.0, 0.0),
        length=0.8,
        box=(300.0, 200.0, 340.0, 220.0),
        distance=3.0,
        bearing=math.radians(10),
        visible_fraction=1.0,
    ),
    facing=0.0,
    letter_height=12.0,
)


class View:
    """Shows what it is given."""

    pose = Pose(0, 0, 0)

    def __init__(self, *texts: VisibleText) -> None:
        self.texts = texts

    def visible_texts(self, range_limit: float):
        return [each for each in self.texts if each.bearer.distance <= range_limit]


def at(distance: float, text: str, **changes) -> VisibleText:
    bearer = replace(SIGN.bearer, distance=distance, position=(distance, 0.0))
    return replace(SIGN, text=text, bearer=bearer, **changes)


def test_a_sign_ahead_is_read_with_its_distance_and_direction():
    [read] = TruthSignReader().read(View(SIGN))

    assert (read.text, read.distance, read.track_id) == ("Library", 3.0, 1)
    assert read.bearing_deg == pytest.approx(10)


def test_the_nearest_text_comes_first():
    read = TruthSignReader().read(View(at(5, "far"), at(2, "near")))

    assert [each.text for each in read] == ["near", "far"]


@pytest.mark.parametrize(
    "sign",
    [
        pytest.param(at(6.1, "far"), id="beyond 6 m"),
        pytest.param(replace(SIGN, facing=math.radians(70)), id="turned away"),
        pytest.param(replace(SIGN, facing=math.pi), id="from behind"),
        pytest.param(replace(SIGN, cut=True), id="cut by the picture's edge"),
        pytest.param(replace(SIGN, letter_height=4.0), id="letters too small"),
        pytest.param(
            replace(SIGN, bearer=replace(SIGN.bearer, visible_fraction=0.4)),
            id="half hidden",
        ),
        pytest.param(replace(SIGN, text=" \n "), id="nothing written"),
    ],
)
def test_what_cannot_be_read_is_left_out(sign: VisibleText):
    assert TruthSignReader().read(View(sign)) == []


def test_lines_are_joined():
    [read] = TruthSignReader().read(View(replace(SIGN, text="Mail\n  room")))

    assert read.text == "Mail room"


def test_a_text_read_again_keeps_its_number_and_another_gets_its_own():
    reader = TruthSignReader()
    [first] = reader.read(View(at(3, "Library")))
    both = reader.read(View(at(3, "Library"), at(3.1, "Lifts")))

    assert [each.track_id for each in both] == [first.track_id, 2]
