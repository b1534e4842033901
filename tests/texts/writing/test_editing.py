"""Errors in what people said: edited where that is certain, else told anew."""

from dataclasses import replace

import pytest

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus.records import Failure, Instruction
from memorymaze.texts.writing import parse_rates
from memorymaze.texts.writing.editing import with_errors
from memorymaze.texts.writing.told_sides import certain_sides
from memorymaze.world.sites import Site

CERTAIN = (
    "Go straight and right at the corner. At the dead end turn left, then right. "
    "You might smell the kitchen on your left. Turn left at the end. Ahead is the library."
)


@pytest.fixture
def said() -> Instruction:
    return Instruction(
        id="one",
        site="university",
        route="R1",
        participant="p",
        text=CERTAIN,
        reference_route="route_r1_reference",
    )


def test_a_side_is_changed_where_it_is_certain_which_turn_it_tells(
    builtin_sites: dict[str, Site], said: Instruction
) -> None:
    rates = parse_rates("wrong_direction=1")
    wrong, right = with_errors([said], builtin_sites, rates, 0, paired=True)
    (span,) = wrong.spans
    changed = wrong.text[: span.start] + wrong.text[span.end :]
    (meant,) = right.spans
    assert changed == right.text[: meant.start] + right.text[meant.end :]
    assert (wrong.method, wrong.source, wrong.original_text) == (
        "edited",
        "synthetic",
        CERTAIN,
    )
    assert (right.text, right.source, right.failures) == (CERTAIN, "human", ())
    assert wrong.pair == right.pair


def test_a_sentence_that_is_one_turn_alone_can_be_left_out(
    builtin_sites: dict[str, Site], said: Instruction
) -> None:
    rates = parse_rates("missing_turn=1")
    (wrong,) = with_errors([said], builtin_sites, rates, 0, paired=False)
    assert wrong.method == "edited"
    assert wrong.text == CERTAIN.replace("Turn left at the end. ", "")


def test_what_is_not_certain_is_told_anew_at_its_length(
    builtin_sites: dict[str, Site], said: Instruction
) -> None:
    vague = replace(said, text="Just keep left, right, whatever, to the library. " * 4)
    rates = parse_rates("wrong_direction=1")
    wrong, right = with_errors([vague], builtin_sites, rates, 0, paired=True)
    assert wrong.method == right.method == "retold"
    assert wrong.source == right.source == "synthetic"
    assert wrong.original_text == vague.text
    assert 25 <= len(wrong.text.split()) <= 40


def test_only_right_texts_are_made_wrong(
    builtin_sites: dict[str, Site], said: Instruction
) -> None:
    failed = replace(said, failures=(Failure("extra_turn", "", ""),))
    with pytest.raises(InstructionFileError, match="without failures"):
        list(with_errors([failed], builtin_sites, parse_rates("none"), 0, paired=True))


@pytest.mark.parametrize(
    ("text", "sides", "certain"),
    [
        ("Turn left, then right.", ["left", "right"], True),
        ("Turn left, pass the bench on your right.", ["left"], True),
        ("Left. Then the first right.", ["left", "right"], True),
        ("Turn left, no, right.", ["right"], False),
        ("Turn right at the end.", ["left"], False),
        ("It is right by the door, then left.", ["right", "left"], False),
        ("All right, go left and right after that left.", ["left", "left"], True),
    ],
)
def test_a_turn_word_is_certain_only_where_nothing_else_could_be_meant(
    text: str, sides: list[str], certain: bool
) -> None:
    assert (certain_sides(text, sides) is not None) == certain
