"""Marks are words of their texts, and tell each turn once."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from memorymaze.texts.corpus import load_corpus
from memorymaze.texts.corpus.records import DEVELOPED, is_of_split

MARKED = Path(__file__).parents[2] / "examples" / "marked_texts"
LABEL = re.compile(
    r"turn:(left|right|slight_left|slight_right|around|either)|bend:(left|right|either)"
    r"|(ordinal|nth):-?\d+|junction:(t|crossing|corner)|side:(left|right|ahead|behind)"
    r"|thing:(turn|target|along|passed|beside|before|after|opposite)|start:(from|facing)"
    r"|end|immediate|length|ignore|pass|too_far|wrong_way|count_after|dest|doubt|total"
    r"|undone|again|aside"
)


def _lines(name: str) -> Iterator[dict[str, Any]]:
    return map(json.loads, (MARKED / f"{name}.jsonl").read_text("utf-8").splitlines())


@pytest.mark.parametrize(
    "name", ["shipped", "voices", "invented", "from_memory", "not_learned"]
)
def test_marks_are_found_in_their_texts_one_after_the_other(name: str) -> None:
    developed = {
        each.instruction.id: each.instruction.text
        for each in load_corpus().episodes
        if is_of_split(each.instruction, DEVELOPED)
    }
    for line in _lines(name):
        text, end = line.get("text") or developed[line["id"]], 0
        for words, label, _ in line["marks"]:
            begin = text.find(words, end)
            assert begin >= 0, (line["id"], words)
            assert LABEL.fullmatch(label), (line["id"], label)
            end = begin + len(words)


def test_marks_of_texts_that_are_not_here_are_numbers_of_words() -> None:
    for line in _lines("sail"):
        assert line.keys() == {"id", "marks"}
        end = 0
        for begin, after, label, _ in line["marks"]:
            assert end <= begin < after, line["id"]
            assert LABEL.fullmatch(label), (line["id"], label)
            end = after


@pytest.mark.parametrize(
    "name", ["shipped", "voices", "invented", "from_memory", "sail", "not_learned"]
)
def test_each_leg_has_one_turn_and_the_destination_comes_after_all(name: str) -> None:
    for line in _lines(name):
        legs = {"turn": [], "dest": []}
        for *_, label, leg in line["marks"]:
            kind = "turn" if label.startswith(("turn:", "bend:")) else label
            legs.setdefault(kind, []).append(leg)
        assert sorted(legs["turn"]) == list(range(len(legs["turn"]))), line["id"]
        assert set(legs["dest"]) <= {len(legs["turn"])}, line["id"]
