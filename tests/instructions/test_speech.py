import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memorymaze.instructions.speech import spoken_marks


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


@settings(deadline=None)
@given(st.lists(st.sampled_from(["um", "the", "maybe", "no", "wait,", "i", "mean"])))
def test_no_stretch_of_a_text_counts_twice(words: list[str]) -> None:
    text = " ".join(words)
    ends = 0
    for mark in spoken_marks(text):
        assert mark.start >= ends
        assert text[mark.start :].startswith(mark.words)
        ends = mark.start + len(mark.words)
