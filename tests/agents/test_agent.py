import numpy as np
import pytest

from memorymaze.agents import Journal


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
    ],
)
def test_what_cannot_be_added_up_is_refused_where_it_is_assigned(
    name: str, value: object
) -> None:
    journal = Journal()
    with pytest.raises(ValueError, match=rf"journal\.{name}: expected .* at least 0"):
        setattr(journal, name, value)


def test_a_note_reaches_the_listener() -> None:
    heard: list[dict[str, object]] = []
    journal = Journal(listener=heard.append)
    journal.note("steps", steps=["go"])
    assert heard == journal.notes == [{"kind": "steps", "steps": ["go"]}]
