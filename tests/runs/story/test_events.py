from typing import Any

from memorymaze.runs.episodes.trace_entries import AnswerEntry, CallEntry
from memorymaze.runs.story.events import events_of

HERE = (0.0, 0.0, 0.0)


def answered(**told: Any) -> AnswerEntry:
    return AnswerEntry(
        time=6.0,
        place=(0.0, 0.0),
        person="person-3",
        reliable=True,
        seconds=3.5,
        **{"error": "", **told},
    )


def test_a_dialogue_is_told_with_what_was_true_of_the_answer() -> None:
    question = {"question": "Excuse me, is this the library?"}
    entries = [
        CallEntry(1.0, HERE, "ask", question, None),
        CallEntry(9.5, HERE, "ask", question, "Yes, that's it."),
        answered(truth="wrong", error="says yes; it is 9.0 m away"),
    ]
    assert [(each.time, each.text) for each in events_of(entries)] == [
        (1.0, "“Excuse me, is this the library?” → nobody near"),
        (9.5, "“Excuse me, is this the library?” → “Yes, that's it.”"),
        (9.5, "the answer of person-3 is WRONG: says yes; it is 9.0 m away"),
    ]


def test_who_put_an_answer_into_words_is_told() -> None:
    entries = [answered(truth="unknown"), answered(truth="right", model="canned")]
    assert [each.text for each in events_of(entries)] == [
        "the answer of person-3 tells nothing",
        "the answer of person-3 is right (in the words of a language model, canned; "
        "not checked)",
    ]


def test_a_look_for_what_cannot_be_looked_for_is_told_as_one_that_saw_nothing() -> None:
    refused = {"error": "detect_from_RGB_image: expected a name"}
    look = CallEntry(1.0, HERE, "detect_from_RGB_image", {"object": ""}, refused)
    assert [each.text for each in events_of([look])] == ["saw nothing (looked for )"]
