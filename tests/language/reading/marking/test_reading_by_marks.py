"""What the trained network makes of texts."""

import numpy as np
import pytest

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading.marking import (
    WEIGHTS,
    destination_chance,
    read_by_marks,
)
from memorymaze.language.reading.marking.marks import Marker
from memorymaze.language.reading.marking.network import Judged, Network, encoded
from memorymaze.language.reading.marking.word_pieces import WordPieces, words_in

EVERYDAY = {
    "…then it's the second right by the kitchen I think, and at the end of that one left again. "
    "You'll see the library sign.": ["right", "left"],
    "At the plant go right, no wait, left, then straight on until the wall and right.": [
        "left",
        "right",
    ],
    "Follow the red carpet, hang a louie at the piano and it's the door on your right.": [
        "left"
    ],
    "It's two lefts and a right: left at the bin, left at the clock, and right at the sign.": [
        "left",
        "left",
        "right",
    ],
    "Turn around, go ten metres, then turn left to the library.": ["around", "left"],
}


@pytest.mark.parametrize("text", EVERYDAY)
def test_turns_are_told_from_sides_repairs_and_overviews(text: str) -> None:
    assert [each.turn.way for each in read_by_marks(text).legs] == EVERYDAY[text]


def test_misspelt_words_are_read_as_they_were_meant() -> None:
    told = "Turn laft at the second intersecton, and the library is on your rigth."
    meant = "Turn left at the second intersection, and the library is on your right."
    assert read_by_marks(told) == read_by_marks(meant)
    assert destination_chance(told, "intersection") is not None


def test_a_text_is_read_the_same_each_time() -> None:
    text = next(iter(EVERYDAY))
    assert read_by_marks(text) == read_by_marks(text)


@pytest.mark.parametrize("text", ["", "  \n", "…", "你好", "🙂"])
def test_what_says_nothing_gives_an_empty_plan(text: str) -> None:
    assert read_by_marks(text) == RoutePlan()


def test_a_text_longer_than_the_network_sees_is_read_as_far_as_it_goes() -> None:
    text = "Turn left at the clock. " + "Well, you know how it is in here. " * 200
    assert [each.turn.way for each in read_by_marks(text).legs] == ["left"]


def test_words_are_cut_into_the_longest_pieces_known() -> None:
    pieces = WordPieces(["[UNK]", "[CLS]", "[SEP]", "left", "un", "##left", "##able"])
    assert pieces.of("LEFT") == (3,)
    assert pieces.of("unleft") == (4, 5)
    assert pieces.of("unright") == (0,)


def test_a_capital_within_a_sentence_is_told_from_one_that_begins_it() -> None:
    pieces = Network(WEIGHTS).pieces
    cases = encoded(pieces, words_in("Go to Bakery. EXIT")).cases
    assert cases[1:-1] == [2, 0, 1, 0, 3]


def test_a_mark_goes_on_only_where_it_began() -> None:
    """The likeliest sequence is found, not the likeliest label of each word."""
    never = -1e9
    follows = np.zeros((3, 3))
    follows[0, 2] = never
    marker = Marker(["end"], follows)
    labels = np.log([[0.6, 0.3, 0.1], [0.1, 0.1, 0.8]])
    steps = np.tile([1.0, 0.0, 0.0], (2, 1))
    (mark,) = marker.marks(words_in("the end"), Judged(labels, steps))
    assert (mark.start, mark.end, mark.label) == (0, 7, "end")
