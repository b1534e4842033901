import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.texts.corpus.speech import PHRASES, spoken_marks, words_like


@pytest.mark.parametrize(
    ("text", "marks"),
    [
        pytest.param("Turn left at the lift.", [], id="plain"),
        pytest.param("Um, you know, uhh, hmm.", ["filler"] * 4, id="fillers"),
        pytest.param(
            "Okay, so right, now left.", ["filler"], id="right is a direction"
        ),
        pytest.param("I think about 20 m, maybe, or so.", ["hedge"] * 4, id="hedges"),
        pytest.param("Walk about the room.", [], id="about is no hedge here"),
        pytest.param(
            "Left, no wait, sorry, right.", ["correction"], id="taken back once"
        ),
        pytest.param("Wait for the lift, wait there.", [], id="waiting"),
        pytest.param("Go to the, the door.", ["correction"], id="said twice"),
        pytest.param("The the door is le- right.", ["correction"] * 2, id="broken off"),
        pytest.param("I\u2019m not sure.", ["hedge"], id="curly apostrophe"),
        pytest.param("It is a very very long hall.", [], id="very very"),
        pytest.param("When you reach it, it is left.", [], id="two clauses"),
    ],
)
def test_marks_of_speech_are_found(text: str, marks: list[str]) -> None:
    assert [mark.kind for mark in spoken_marks(text)] == marks


@given(st.lists(st.sampled_from(["um", "the", "maybe", "no", "wait,", "i", "mean"])))
def test_no_stretch_of_a_text_counts_twice(words: list[str]) -> None:
    text = " ".join(words)
    ends = 0
    for mark in spoken_marks(text):
        assert mark.start >= ends
        assert text[mark.start :].startswith(mark.words)
        ends = mark.start + len(mark.words)


@pytest.mark.parametrize(
    ("kind", "row"),
    [(kind, row) for kind, rows in PHRASES.items() for row in rows],
    ids=lambda value: value if isinstance(value, str) else value["examples"][0],
)
def test_a_row_finds_what_its_examples_show_and_nothing_else(
    kind: str, row: dict[str, Any]
) -> None:
    own = row["pattern"]
    pattern = re.compile(own) if kind == "restart" else words_like([row])
    for example in row["examples"]:
        text = example.replace("[", "").replace("]", "")
        found = pattern.sub(lambda match: f"[{match.group()}]", text)
        assert found == example
    for counter_example in row["counter_examples"]:
        assert pattern.search(counter_example) is None, counter_example
