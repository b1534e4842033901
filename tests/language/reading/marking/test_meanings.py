"""What the words of a mark mean."""

import pytest

from memorymaze.language.plans import Passing, Totals
from memorymaze.language.reading.marking.meanings import (
    length_in,
    ordinal_in,
    passings_in,
    phrase_in,
    totals_in,
)


@pytest.mark.parametrize(
    ("words", "metres"),
    [
        ("about twenty metres", 20.0),
        ("twenty-five", 25.0),
        ("ten more", 10.0),
        ("five and a half metres", 5.5),
        ("a good hundred and fifty metres", 150.0),
        ("half a minute", 30.0),
        ("about twenty", 20.0),
        ("another fifteen-ish", 15.0),
        ("ten of my steps", 7.0),
        ("two blocks", 16.0),
        ("One crossing", 8.0),
        ("0 blocks", 12.0),
        ("two mirrors", 12.0),
        ("a little way", 4.0),
    ],
)
def test_a_length_is_read_with_or_without_its_unit(words: str, metres: float) -> None:
    assert length_in(words, "metres").metres == metres


def test_a_bare_number_is_counted_as_other_lengths_are() -> None:
    assert length_in("ten more", "steps").unit == "steps"


@pytest.mark.parametrize(
    ("words", "passings"),
    [
        ("two openings on the left", [Passing(2, "left")]),
        ("the second right", [Passing(1, "right")]),
        ("last opening on the left", [Passing(1, "left")]),
        ("first two on the left", [Passing(2, "left")]),
        (
            "one on the left and two on the right",
            [Passing(1, "left"), Passing(2, "right")],
        ),
        ("an opening on each side", [Passing(1, "left"), Passing(1, "right")]),
        ("straight over the crossing", [Passing(1, None, "crossing")]),
        ("don\u2019t turn", [Passing(None)]),
        ("none of the openings", [Passing(None)]),
        ("bright opening", [Passing(1)]),
    ],
)
def test_openings_left_alone_are_counted_on_each_side(
    words: str, passings: list[Passing]
) -> None:
    assert passings_in(words) == passings


@pytest.mark.parametrize(
    ("words", "number"),
    [
        ("ninth", 9),
        ("2nd", 2),
        ("last", -1),
        ("second to last", None),
        ("0th", None),
        ("9" * 5000 + "th", None),
    ],
)
def test_a_count_that_has_no_number_here_is_none(
    words: str, number: int | None
) -> None:
    assert ordinal_in(words) == number


@pytest.mark.parametrize(
    ("words", "totals"),
    [
        ("six turns total", Totals(turns=6)),
        ("twenty-two metres all up", Totals(metres=22.0)),
        ("hundred and sixty steps", Totals(metres=112.0)),
        ("no idea", Totals()),
    ],
)
def test_totals_are_turns_or_a_length(words: str, totals: Totals) -> None:
    assert totals_in(words) == totals


@pytest.mark.parametrize(
    ("words", "phrase"),
    [
        ("the Waiting Room", "waiting room"),
        ("Lost & Found", "lost and found"),
        ("\u201cExit\u201d", "exit"),
        ("Room 12", "door that says 12"),
        ("one", ""),
    ],
)
def test_a_thing_is_named_as_one_asks_for_it(words: str, phrase: str) -> None:
    assert phrase_in(words) == phrase
