"""What a visitor reads of a walk."""

from typing import Any

import pytest

from memorymaze.agents.notes import BeliefNote
from memorymaze.runs.episodes.navigation import navigate
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.trace_entries import CallEntry, NoteEntry, TraceEntry
from memorymaze.web.try_page.words import (
    Verdict,
    belief_words,
    change_of_mind,
    thought_of,
    verdict_of,
)
from memorymaze.world.sites import Site


def note(about: str, **told: Any) -> NoteEntry:
    return NoteEntry(1.0, about, told)


def call(name: str, **arguments: Any) -> CallEntry:
    return CallEntry(1.0, (0.0, 0.0, 0.0), name, arguments, None)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        pytest.param(
            call("say", text="We turn left."),
            ("says", "We turn left."),
            id="speech",
        ),
        pytest.param(
            note("repair", leg=2, reason="wrong side"),
            ("thinks", "Goes back: turn 2 may go to the other side."),
            id="repair",
        ),
        pytest.param(
            note("arrival", reason="library seen", confidence=0.934),
            ("says", "We are there. (93% sure)"),
            id="arrival",
        ),
        pytest.param(
            note("gave_up", reason="nothing fits", confidence=0.02),
            ("thinks", "Gives up: nothing fits. (2% sure)"),
            id="gave up",
        ),
        pytest.param(call("move_forward"), None, id="move"),
        pytest.param(note("decision", at=1), None, id="decision"),
    ],
)
def test_a_visitor_hears_what_the_robot_says_and_why_it_goes_back(
    entry: TraceEntry, told: tuple[str, str] | None
) -> None:
    assert thought_of(entry) == told


def test_a_belief_names_the_likeliest_step() -> None:
    belief = note("belief", at=1, legs=[0.1, 0.7, 0.2], doubt=0.25).note
    assert isinstance(belief, BeliefNote)
    assert belief_words(belief) == "Probably at step 2 of 3 (70%)"
    assert (belief.likeliest, belief.doubt) == (1, 0.25)


def test_only_another_step_or_a_new_doubt_is_a_change_of_mind() -> None:
    steps = ["turn left", "arrive at the library"]
    first = BeliefNote(0, [0.9, 0.1], 0.1)
    onward = BeliefNote(1, [0.2, 0.8], 0.1)
    doubting = BeliefNote(1, [0.3, 0.7], 0.6)
    assert change_of_mind(None, first, steps) == (
        "thinks",
        "Now comes step 1: turn left.",
    )
    assert change_of_mind(first, onward, steps) == (
        "thinks",
        "Now comes step 2: arrive at the library.",
    )
    assert change_of_mind(onward, onward, steps) is None
    assert change_of_mind(onward, doubting, steps) == (
        "thinks",
        "Something it was told may be wrong.",
    )


@pytest.fixture
def judged(t_site: Site) -> Any:
    def judge(text: str, agent: str = "guide") -> tuple[EpisodeResult, Verdict]:
        route = t_site.find_route("R1")
        run = navigate(t_site, route, text, agent)
        return run.result, verdict_of(run.result, run.trajectory, t_site, route, 3.0)

    return judge


def test_a_walk_that_arrives_followed_the_way(judged: Any) -> None:
    result, verdict = judged("Go to the T and turn left, then go to the end.")
    assert result.success
    assert verdict.headline == "The robot arrived."
    assert "It followed the way on the plan to its end." in verdict.sentences
    assert verdict.lost is None


def test_a_walk_that_goes_astray_says_where_and_how(judged: Any) -> None:
    result, verdict = judged("Go to the T and turn right, then go to the end.")
    assert not result.success
    assert verdict.headline == "The robot did not arrive."
    assert any("one would turn left; it went right" in s for s in verdict.sentences)
    assert verdict.lost is not None
    assert abs(verdict.lost[1]) < 3.0


def test_a_robot_that_stays_stopped_too_early(judged: Any) -> None:
    _, verdict = judged("Stay.", "stop")
    assert any("stopped too early, 0 m from the start" in s for s in verdict.sentences)
