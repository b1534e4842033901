from typing import Any

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.notes import Note, OwnNote
from memorymaze.language.models.model import Completion, Usage


def test_a_journal_counts_what_was_spent() -> None:
    journal = Journal()
    journal.model_calls += 1
    journal.tokens += np.int64(30)
    journal.cost_usd += 0.5
    assert (journal.model_calls, journal.tokens, journal.cost_usd) == (1, 30, 0.5)
    assert type(journal.tokens) is int


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("model_calls", None),
        ("model_calls", -1),
        ("tokens", "many"),
        ("tokens", 1.5),
        ("cost_usd", float("nan")),
        ("cost_usd", float("inf")),
        ("cost_usd", "free"),
        ("cost_usd", "0.5"),
        ("model_calls", True),
    ],
)
def test_what_cannot_be_added_up_is_refused_where_it_is_assigned(
    name: str, value: object
) -> None:
    journal = Journal()
    with pytest.raises(ValueError, match=rf"journal\.{name}: expected .* at least 0"):
        setattr(journal, name, value)


def test_a_note_reaches_the_listener() -> None:
    heard: list[Note] = []
    journal = Journal(listener=heard.append)
    journal.note("steps", steps=["go"])
    assert heard == [*journal.notes] == [OwnNote("steps", {"steps": ["go"]})]


def test_a_note_may_have_a_field_of_any_name() -> None:
    journal = Journal()
    journal.note("decision", kind="T", self="robot")
    assert journal.notes == (OwnNote("decision", {"kind": "T", "self": "robot"}),)


def test_what_is_no_note_cannot_be_put_among_the_notes() -> None:
    with pytest.raises(AttributeError):
        Journal().notes.append("x")  # pyright: ignore


def test_a_counted_reply_is_added_up_and_noted():
    heard: list[Any] = []
    journal = Journal(on_completion=lambda completion: 2 * completion.latency)
    journal.listener = heard.append

    for cost in (0.5, None):
        usage = Usage(prompt_tokens=30, completion_tokens=12, cost_usd=cost)
        journal.count(Completion("left", "m-1", usage, latency=1.5), stage="step")

    assert (journal.model_calls, journal.tokens) == (2, 84)
    assert (journal.cost_usd, journal.inference_s) == (0.5, 3.0)
    assert [*journal.notes] == heard
    assert (heard[1].about, heard[1].details) == (
        "model_reply",
        {
            "stage": "step",
            "model": "m-1",
            "text": "left",
            "prompt_tokens": 30,
            "completion_tokens": 12,
            "cost_usd": None,
            "latency": 1.5,
            "standing_s": 3.0,
        },
    )


def test_a_journal_that_is_told_nothing_of_the_end_claims_arrival() -> None:
    journal = Journal()
    journal.note("decision", confidence=0.4)
    assert (journal.confidence, journal.gave_up) == (None, False)


def test_the_last_word_counts_and_the_last_confidence_that_is_told() -> None:
    journal = Journal()
    journal.note("gave_up", reason="lost", confidence=0.1)
    assert (journal.confidence, journal.gave_up) == (0.1, True)
    journal.note("arrival", reason="found it after all", confidence=np.float32(0.75))
    assert (journal.confidence, journal.gave_up) == (0.75, False)
    journal.note("gave_up", reason="no, it is another door")
    assert (journal.confidence, journal.gave_up) == (0.75, True)


@pytest.mark.parametrize("value", [1.2, -0.1, float("nan"), "high", "0.9", True])
def test_a_confidence_that_is_no_probability_is_refused_where_it_is_noted(
    value: object,
) -> None:
    journal = Journal()
    with pytest.raises(
        ValueError, match=r"note\('arrival', confidence=…\): expected a probability"
    ):
        journal.note("arrival", confidence=value)
    assert not journal.notes
