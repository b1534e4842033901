import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import CommandError
from memorymaze.robot.api.control import DIRECTIONS
from memorymaze.robot.steering.commands import (
    direction_of,
    exit_meant,
    parse_direction,
)

ANGLES = st.floats(-180, 180).map(math.radians)


@given(angle=ANGLES)
def test_every_way_that_is_named_can_be_taken(angle: float) -> None:
    word = direction_of(angle)
    assert word is None or exit_meant(word, [angle]) == 0


@given(angles=st.lists(ANGLES, max_size=5))
def test_left_and_right_never_mix(angles: list[float]) -> None:
    for word in DIRECTIONS:
        if word == "around":
            continue
        found = exit_meant(word, angles)
        if found is not None and word != "forward":
            assert (angles[found] > 0) == word.endswith("left")


@pytest.mark.parametrize(
    ("word", "degrees", "meant"),
    [
        pytest.param("left", [50, 95], 1, id="straight left before slanted"),
        pytest.param("left", [50, 0], 0, id="slanted when there is no other"),
        pytest.param("forward", [40, -20], 1, id="bends least"),
        pytest.param("slight_right", [-70, -40], 1, id="nearest to slight"),
        pytest.param("right", [], None, id="no ways"),
    ],
)
def test_a_word_means_the_way_that_fits_best(
    word: str, degrees: list[float], meant: int | None
) -> None:
    direction = parse_direction(word)
    assert exit_meant(direction, [math.radians(each) for each in degrees]) == meant


@pytest.mark.parametrize("word", ["north", "", None, 90, ["left"]])
def test_other_words_are_refused_with_those_there_are(word: object) -> None:
    with pytest.raises(CommandError, match="slight_left"):
        parse_direction(word)
