"""Texts put together anew are still told leg by leg, with each turn once."""

import json
from pathlib import Path

import pytest
from benchmarks.marking.marked_texts import (
    MarkedText,
    load_marked_texts,
    plan_as_marked,
    ways_of,
)
from benchmarks.marking.recombining import Recombiner, legs_of, mirrored

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading.marking.word_pieces import Word

SHIPPED = Path(__file__).parents[2] / "examples" / "marked_texts"


@pytest.fixture(scope="module")
def texts(tmp_path_factory: pytest.TempPathFactory) -> list[MarkedText]:
    """Every third of the shipped ones."""
    folder = tmp_path_factory.mktemp("marked_texts")
    for path in SHIPPED.glob("*.jsonl"):
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        (folder / path.name).write_text("".join(lines[::3]), encoding="utf-8")
    return load_marked_texts(folder)


def _plan(words) -> RoutePlan:  # type: ignore[no-untyped-def]
    text, at = "", list[Word]()
    for each in words:
        at.append(Word(each.text, len(text), len(text) + len(each.text)))
        text += each.text + " "
    return plan_as_marked(text, at, words)


def test_marks_by_numbers_of_words_are_found_in_sails_texts(tmp_path: Path) -> None:
    (tmp_path / "marks").mkdir()
    line = {"id": "A-Grid-1", "marks": [[1, 2, "turn:left", 0], [4, 5, "dest", 1]]}
    (tmp_path / "marks" / "sail.jsonl").write_text(json.dumps(line))
    told = {"id": "A-Grid-1", "text": "turn left at the chair"}
    (tmp_path / "instructions.jsonl").write_text(json.dumps(told))
    assert load_marked_texts(tmp_path / "marks") == []
    [text] = set(load_marked_texts(tmp_path / "marks", tmp_path))
    marked = [(each.text, each.label) for each in text.words if each.label]
    assert marked == [("left", "turn:left"), ("chair", "dest")]
    assert (text.person, text.turns) == ("A", 1)


def test_the_marks_of_a_text_make_a_plan_with_its_turns(
    texts: list[MarkedText],
) -> None:
    for text in texts:
        told = [way.removeprefix("slight_") for way in ways_of(text.words)]
        read = [leg.turn.way.removeprefix("slight_") for leg in _plan(text.words).legs]
        assert sorted(read) == sorted(told), text.id


@pytest.mark.parametrize("seed", range(3))
def test_each_leg_of_a_drawn_text_has_one_turn(
    texts: list[MarkedText], seed: int
) -> None:
    recombiner = Recombiner(texts, seed)
    for _ in range(100):
        words = recombiner.draw()
        turns = [
            each.leg for each in words if each.begins and each.label[:5] == "turn:"
        ]
        turns += [
            each.leg for each in words if each.begins and each.label[:5] == "bend:"
        ]
        assert sorted(turns) == list(range(len(turns)))


def test_the_other_side_of_the_other_side_is_the_first(
    texts: list[MarkedText],
) -> None:
    for text in texts[::2]:
        words = list(text.words)
        assert [each.label for each in mirrored(mirrored(words))] == [
            w.label for w in words
        ]


def test_legs_put_together_again_are_the_text(texts: list[MarkedText]) -> None:
    cut = [(text, legs) for text in texts if (legs := legs_of(text)) is not None]
    assert len(cut) > len(texts) / 2
    for text, legs in cut:
        assert [word for leg in legs for word in leg] == list(text.words)
        assert len(legs) == text.turns + 1
