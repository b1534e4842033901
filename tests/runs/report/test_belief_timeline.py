"""How the belief over a plan is read from a trace and drawn."""

from typing import Any

import pytest

from memorymaze.runs.episodes.trace_entries import NoteEntry, TrajectoryEntry
from memorymaze.runs.report.belief_timeline import BeliefTimeline, belief_timeline
from memorymaze.runs.story.story import story_of

WALK = TrajectoryEntry(
    ("time", "x", "y", "heading"),
    [(0.0, 0.0, 0.0, 0.0), (10.0, 10.0, 0.0, 0.0), (20.0, 0.0, 0.0, 3.14)],
)
"""Ten metres there and ten metres back, a metre a second."""


def note(time: float, about: str, **told: Any) -> NoteEntry:
    return NoteEntry(time, about, told)


def belief(time: float, legs: list[float], doubt: float = 0.0) -> NoteEntry:
    return note(time, "belief", at=int(time), legs=legs, doubt=doubt)


def timeline(*notes: NoteEntry) -> BeliefTimeline | None:
    return belief_timeline(story_of([*notes, WALK], "a trace"))


def drawn(*notes: NoteEntry) -> BeliefTimeline:
    found = timeline(*notes)
    assert found is not None
    return found


def test_an_agent_that_notes_no_belief_has_no_timeline() -> None:
    assert timeline(note(1.0, "arrival", confidence=0.9)) is None


def test_places_lie_at_the_metres_walked_also_on_the_way_back() -> None:
    found = drawn(belief(0, [1, 0]), belief(5, [0.4, 0.6]), belief(15, [0.7, 0.3]))
    spans = [(each.metres, each.until) for each in found.places]
    assert spans == [(0, 5), (5, 15), (15, 20)]
    assert [each.note.likeliest for each in found.places] == [0, 1, 0]
    assert (found.legs, found.length) == (1, 20)


def test_of_several_notes_at_a_place_the_last_one_counts() -> None:
    found = drawn(belief(4, [1, 0]), belief(4, [0.5, 0.5]), belief(4, [0.1, 0.9]))
    [place] = found.places
    assert place.note.legs == [0.1, 0.9]
    assert (place.metres, place.until) == (0, 20)


def test_changes_of_mind_stand_with_the_place_where_they_were_noted() -> None:
    found = drawn(
        belief(0, [1, 0]),
        note(2, "doubt", score=0.3, leg=1),
        belief(5, [0.5, 0.5], 0.6),
        note(5, "doubt", score=0.6, leg=1),
        note(7, "repair", leg=1, reason="no such turn"),
    )
    words = [[each.words for each in place.changes] for place in found.places]
    # A doubt below one half is not said.
    assert words == [[], ["doubts leg 1 (0.60)", "repairs leg 1: no such turn"]]
    assert [metres for metres, _ in found.marks] == [5, 7]


def test_the_stronger_the_shade_the_likelier() -> None:
    found = drawn(belief(0, [0.01, 0.1, 0.95]), note(20, "arrival", confidence=0.5))
    shades = {found.row(row): row for row in range(4)}
    assert {shades[y]: shade for _, y, _, shade in found.cells} == {1: 1, 2: 5, 3: 3}


def test_the_words_say_how_the_walk_ended() -> None:
    found = drawn(belief(0, [1.0]), note(20, "gave_up", confidence=0.25))
    assert found.end_words == "After 20 m it gave up, confidence 0.25."
    silent = drawn(belief(0, [1.0]))
    assert silent.end_words == "After 20 m it ended without a word."


@pytest.mark.parametrize(
    "told",
    [
        pytest.param({"text": "the door is near"}, id="another note of that name"),
        pytest.param({"at": 1, "legs": [], "doubt": 0}, id="no leg"),
        pytest.param({"at": 1, "legs": [1.5, 0], "doubt": 0}, id="no probability"),
        pytest.param({"at": 1, "legs": ["1", "0"], "doubt": 0}, id="texts"),
        pytest.param({"at": 1, "legs": [1, 0, 0], "doubt": 0}, id="another plan"),
    ],
)
def test_notes_of_another_form_are_counted_and_left_out(told: dict[str, Any]) -> None:
    found = drawn(belief(0, [1, 0]), note(1, "belief", **told))
    assert (len(found.places), found.unread) == (1, 1)
