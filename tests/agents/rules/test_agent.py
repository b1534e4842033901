"""Walks of the rules agent through the tiny sites, with the simulated robot."""

from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any, cast

import pytest

from memorymaze.agents.agent import TOLD_AGAIN
from memorymaze.agents.rules import RulesAgent
from memorymaze.robot.api import Robot
from memorymaze.robot.specification import API_NAMES

TakeWalk = Callable[..., Any]


@pytest.fixture
def take_walk(walk_with: TakeWalk) -> TakeWalk:
    """Walk as told: `take_walk(start, text, seed=…, as_seen=…)`."""
    return partial(walk_with, RulesAgent())


@pytest.mark.parametrize(
    ("start", "text", "goal"),
    [
        ("corridor", "Walk to the end of the corridor.", (19.3, 0)),
        ("corridor", "Stop at the bench on your right.", (10, 0)),
        ("l_shape", "Go to the end and turn left.", (11, 11)),
        ("l_shape", "Go left at the corner. Stop before the red vending machine.", (11, 6)),
        ("t_junction", "Turn left at the T junction and go to the end.", (-11, 0)),
        ("t_junction", "Turn right at the end. The lift is at the end.", (11, 0)),
        ("t_junction", "Turn left and walk up to the clock.", (-4, 0)),
        ("t_junction", "Turn left, sorry, I mean right, and walk to the red chair.", (4, 0)),
        ("crossing", "Turn left at the crossing and walk to the end.", (0, 11)),
        ("crossing", "Turn right at the crossing.", (0, -11)),
        ("crossing", "Go straight on.", (11, 0)),
        ("crossing", "Stop at the white statue.", (-5, 0)),
        ("crossing", "Pass the statue, turn left and walk to the kitchen.", (0, 11)),
        ("slanted_crossing", "Bear left and walk to the piano.", (7, 8.4)),
        ("slanted_crossing", "Turn right.", (0, -11)),
        ("loop", "Turn right at the corner and walk to the drinking fountain.", (6, 13)),
        ("loop", "Go to the drinking fountain.", (6, 13)),
        ("two_rooms", "Go through the passage and stop at the sofa.", (16, 3)),
    ],
)  # fmt: skip
def test_simple_instructions_lead_to_their_goal(
    take_walk: TakeWalk, start: str, text: str, goal: tuple[float, float]
) -> None:
    walk = take_walk(start, text)
    assert walk.ends_near(*goal)
    assert walk.stopped_by == "agent"


def test_opposite_words_lead_to_opposite_ends(take_walk: TakeWalk) -> None:
    left = take_walk("t_junction", "At the end turn left.")
    right = take_walk("t_junction", "At the end turn right.")
    assert left.ends_near(-11, 0)
    assert right.ends_near(11, 0)


def test_a_corner_that_was_not_told_is_taken_where_there_is_no_choice(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk("l_shape", "Walk until you see the vending machine.")
    assert walk.ends_near(11, 6)


def test_the_long_way_round_is_taken_when_it_is_the_one_told(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk(
        "loop, the other way",
        "Turn left, then left again, then left again. Stop at the drinking fountain.",
    )
    assert walk.ends_near(8, 13)
    assert walk.came_by(13, 1)
    assert not walk.came_by(1, 13)


@pytest.mark.parametrize(
    ("start", "text"),
    [
        *(
            (start, "")
            for start in (
                "corridor",
                "l_shape",
                "t_junction",
                "crossing",
                "slanted_crossing",
                "loop",
                "loop, the other way",
                "two_rooms",
            )
        ),
        ("crossing", "Colourless green ideas sleep furiously."),
        ("corridor", "🙂 12 %% 右に曲がる"),
        ("loop", "🙂 12 %% 右に曲がる"),
    ],
)
def test_a_walk_that_nothing_is_said_about_ends_by_itself(
    take_walk: TakeWalk, start: str, text: str
) -> None:
    walk = take_walk(start, text)
    assert walk.stopped_by == "agent"
    assert walk.metres < 150


@pytest.mark.parametrize(
    ("start", "text"),
    [
        ("corridor", "Turn left, then turn right."),
        ("corridor", "Take the ninth corridor on the right."),
        ("crossing", "Take the first slight right."),
    ],
)
def test_a_turn_that_does_not_exist_does_not_keep_it_from_walking_on(
    take_walk: TakeWalk, start: str, text: str
) -> None:
    walk = take_walk(start, text)
    assert walk.metres > 8
    assert walk.stopped_by == "agent"


def test_the_corner_there_is_is_taken_when_the_turn_told_does_not_exist(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk("l_shape", "Turn right and walk to the vending machine.")
    assert walk.ends_near(11, 6)


def test_it_comes_back_from_a_dead_end_that_does_not_fit_what_was_said(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk(
        "slanted_crossing", "Turn right at the crossing and walk to the piano."
    )
    assert walk.came_by(0, -11)
    assert walk.ends_near(7, 8.4)


def test_it_comes_back_for_a_turn_when_there_is_no_later_one(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk("crossing", "Take the third left.")
    assert walk.came_by(11, 0)
    assert walk.ends_near(0, 11)


WITH_DOUBTS = ("slanted_crossing", "Turn right at the crossing and walk to the piano.")
"""A walk with a wrong way, looks and turns."""


def test_the_same_words_give_the_same_walk_whatever_the_seed(
    take_walk: TakeWalk,
) -> None:
    first = take_walk(*WITH_DOUBTS, seed=0)
    second = take_walk(*WITH_DOUBTS, seed=1)
    assert first.points == second.points
    assert first.calls == second.calls
    assert first.journal.notes == second.journal.notes


def test_the_journal_tells_the_plan_each_decision_and_why_it_stopped(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk(*WITH_DOUBTS)
    (plan,) = walk.notes("plan")
    assert walk.journal.notes[0].details == plan
    assert any("piano" in step for step in plan["steps"])
    assert len(walk.notes("decision")) >= 2
    assert all({"at", "exit", "cost"} <= set(note) for note in walk.notes("decision"))
    (arrival,) = walk.notes("arrival")
    assert walk.journal.notes[-1].details == arrival
    assert "piano" in arrival["reason"]


def test_it_spends_nothing_on_language_models(take_walk: TakeWalk) -> None:
    journal = take_walk("crossing", "Turn left.").journal
    assert (journal.model_calls, journal.tokens, journal.cost_usd) == (0, 0, 0.0)


def test_the_functions_of_the_control_api_are_all_that_it_needs(
    take_walk: TakeWalk,
) -> None:
    def api_alone(robot: Robot) -> Robot:
        functions = {name: getattr(robot, name) for name in API_NAMES}
        return cast("Robot", SimpleNamespace(**functions))

    alone = take_walk(*WITH_DOUBTS, as_seen=api_alone)
    assert alone.points == take_walk(*WITH_DOUBTS).points
    assert set(alone.calls) <= set(API_NAMES)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (
            "Turn left at the T junction and walk up to the clock.",
            "At the end go left.",
        ),
        (
            "At the end go left.",
            "Turn left at the T junction and walk up to the clock.",
        ),
    ],
)
def test_what_one_telling_leaves_out_the_other_adds(
    take_walk: TakeWalk, first: str, second: str
) -> None:
    walk = take_walk("t_junction", first + TOLD_AGAIN + second)
    assert len(walk.notes("plan")) == 2
    assert walk.ends_near(-4, 0)


def test_a_way_told_twice_alike_is_walked_as_told_once(take_walk: TakeWalk) -> None:
    text = "Pass the statue, turn left and walk to the kitchen."
    assert take_walk("crossing", text + TOLD_AGAIN + text).ends_near(0, 11)
