from collections.abc import Callable
from typing import get_args

import pytest

from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.in_words import (
    OUTCOMES,
    ending_words,
    outcome_line,
    outcome_of,
    sense_notes,
)
from memorymaze.runs.episodes.results import EpisodeResult, StoppedBy
from memorymaze.runs.episodes.settings import RunSettings

Make = Callable[..., EpisodeResult]


def test_who_arrives_has_arrived_whatever_else_happened(result: Make) -> None:
    arrived = result(success=True, oracle_success=True, stopped_by="agent")
    assert outcome_of(arrived) is OUTCOMES["arrived"]
    assert outcome_line(arrived).startswith("✔ ARRIVED: the agent said")
    assert "was near the goal" not in outcome_line(arrived)


def test_who_stops_elsewhere_near_the_goal_once_is_told_so(result: Make) -> None:
    elsewhere = result(success=False, oracle_success=True, stopped_by="agent")
    assert outcome_of(elsewhere) is OUTCOMES["elsewhere"]
    assert ending_words(elsewhere) == "stopped elsewhere"
    assert outcome_line(elsewhere).startswith("✘ DID NOT ARRIVE")
    assert "was near the goal on its way" in outcome_line(elsewhere)


def test_who_gives_up_does_not_say_that_it_is_there(result: Make) -> None:
    gave_up = result(success=False, gave_up=True, stopped_by="agent")
    assert outcome_of(gave_up) is OUTCOMES["elsewhere"]
    assert ending_words(gave_up) == "gave up"
    assert "the agent gave up and said so" in outcome_line(gave_up)


@pytest.mark.parametrize("end", sorted({*get_args(StoppedBy)} - {"agent"}))
def test_every_other_end_has_words_of_its_own(result: Make, end: str) -> None:
    broken = result(success=False, stopped_by=end)
    assert outcome_of(broken) is OUTCOMES["broken"]
    others = [
        ending_words(result(success=False, stopped_by=each))
        for each in get_args(StoppedBy)
        if each != end
    ]
    assert ending_words(broken) not in others


def test_a_run_that_sees_further_than_usual_says_how_far() -> None:
    assert not [*sense_notes(RunSettings(), [])]
    further = SimulationSettings(detection_range=40.0)
    [note] = sense_notes(RunSettings(simulation=further), [])
    assert note == "things are detected up to 40 m away"
