"""When the belief leaves a choice to a model, and what becomes of it."""

import json
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.guide import GuideAgent, GuideOptions
from memorymaze.errors import EpisodeOver, SettingsError
from memorymaze.geometry.pose import Pose
from memorymaze.language.scripted_model import ScriptedLanguageModel
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.settings import SimulationSettings


def told(way: str) -> str:
    """A plan: turn at the junction, then to the end."""
    turn = {"way": way, "junction": "t"}
    return json.dumps({"legs": [{"turn": turn}], "arrival": {"at_end": True}})


UNCLEAR, PLAIN = told("either"), told("left")


def choose(step: int) -> str:
    return json.dumps({"note": "As they say.", "doubt": 0.2, "step": step})


class Walk(NamedTuple):
    """How a walk went."""

    x: float
    asked: list[str]
    journal: Journal


@pytest.fixture
def walk(scenes: dict[str, Scene]) -> Callable[..., Walk]:
    """Walk up to a T junction as told, where the model says what is asked of it."""

    def take(text: str, *replies: str, y: float = -7, **options: Any) -> Walk:
        robot = SimulatedRobot(
            scenes["t_junction"],
            Pose(0, y, math.pi / 2),
            SimulationSettings(),
            np.random.default_rng(0),
        )
        model, journal = ScriptedLanguageModel(replies), Journal()
        agent = GuideAgent(
            GuideOptions(decide="both", reader="plan", **options), model=model
        )
        with pytest.raises(EpisodeOver):
            agent.follow(text, robot, journal, np.random.default_rng(0))
        asked = [each.messages[-1].content for each in model.requests]
        return Walk(robot.pose.x, asked, journal)

    return take


def test_a_model_chooses_where_two_ways_fit_what_was_told(
    walk: Callable[..., Walk],
) -> None:
    first, second = (walk(UNCLEAR, *[choose(step)] * 9) for step in (1, 2))
    assert first.x * second.x < 0
    assert "1. turn" in first.asked[0]
    [line] = [each for each in first.asked[0].splitlines() if each.startswith("2. (")]
    assert "take way" in line
    assert "turn 1 at 1" in line
    [note, *_] = [each for each in second.journal.notes if each["kind"] == "choice"]
    assert (note["step"], note["reason"]) == (2, "As they say.")


def test_nobody_is_asked_where_one_explanation_is_clear(
    walk: Callable[..., Walk],
) -> None:
    taken = walk(PLAIN)
    assert taken.x < -5
    assert taken.asked == []


def test_how_near_explanations_must_be_is_an_option(walk: Callable[..., Walk]) -> None:
    assert walk(PLAIN, *[choose(1)] * 9, near=1e-9).asked
    with pytest.raises(SettingsError, match="near: expected a number greater than 0"):
        walk(PLAIN, near=0.0)


def test_the_belief_goes_on_alone_when_no_request_is_left(
    walk: Callable[..., Walk],
) -> None:
    taken = walk(UNCLEAR, choose(2), most_requests=1)
    assert len(taken.asked) == 1
    assert taken.journal.confidence is not None


def test_only_places_that_were_come_to_are_told(walk: Callable[..., Walk]) -> None:
    # It begins inside the turning point at the south end.
    first = walk(UNCLEAR, *[choose(1)] * 9, y=-9).asked[0]
    assert "Place 0" not in first
    assert "Place 1 (the start): " in first
