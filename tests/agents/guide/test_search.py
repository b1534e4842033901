"""Walks of the guide through the tiny sites, with the simulated robot."""

from collections.abc import Callable
from functools import cache, partial
from types import SimpleNamespace
from typing import Any, cast

import pytest

from memorymaze.agents.guide import GuideAgent
from memorymaze.agents.guide.agent import GuideOptions
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.specification import API_NAMES

Walk = Any
TakeWalk = Callable[..., Walk]


@pytest.fixture(scope="module")
def take_walk(walk_with: TakeWalk) -> TakeWalk:
    """Walk as told, the same walk once: `take_walk(start, text, seed=…, as_seen=…)`."""
    return cache(partial(walk_with, GuideAgent()))


@pytest.mark.parametrize(
    ("start", "text", "goal"),
    [
        ("corridor", "Walk to the end of the corridor.", (19.3, 0)),
        ("corridor", "Stop at the bench on your right.", (10, 0)),
        ("l_shape", "At the end turn left and walk to the end.", (11, 11)),
        ("l_shape", "Go left at the corner. Stop before the red vending machine.", (11, 6)),
        ("t_junction", "Turn left at the T junction and go to the end.", (-11, 0)),
        ("t_junction", "Turn right at the end. The lift is at the end.", (11, 0)),
        ("t_junction", "Turn left and walk up to the clock.", (-4, 0)),
        ("crossing", "Turn left at the crossing and walk to the end.", (0, 11)),
        ("crossing", "Turn right at the crossing and walk to the end.", (0, -11)),
        ("crossing", "Stop at the white statue.", (-5, 0)),
        ("crossing", "Pass the statue, turn left and walk to the kitchen.", (0, 11)),
        ("slanted_crossing", "Bear left and walk to the piano.", (7, 8.4)),
        ("loop", "Turn right at the corner and walk to the drinking fountain.", (6, 13)),
        ("two_rooms", "Go through the passage and stop at the sofa.", (16, 3)),
    ],
)  # fmt: skip
def test_simple_instructions_lead_to_their_goal(
    take_walk: TakeWalk, start: str, text: str, goal: tuple[float, float]
) -> None:
    walk = take_walk(start, text)
    assert walk.ends_near(*goal)
    assert walk.stopped_by == "agent"
    (arrival,) = walk.notes("arrival")
    assert not walk.notes("gave_up")
    assert 0.3 < arrival["confidence"] <= 1


def test_it_thinks_anew_where_the_last_stretch_gets_longer_than_was_told(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk("corridor", "Walk 4 metres and stop at the door.")
    assert max(x for x, _ in walk.points) < 12


def test_opposite_words_lead_to_opposite_ends(take_walk: TakeWalk) -> None:
    text = "At the end turn {} and go to the end."
    assert take_walk("t_junction", text.format("left")).ends_near(-11, 0)
    assert take_walk("t_junction", text.format("right")).ends_near(11, 0)


def test_where_nothing_is_told_of_the_place_it_is_some_metres_after_the_last_turn(
    take_walk: TakeWalk,
) -> None:
    x, y = take_walk("t_junction", "At the end turn left.").end
    assert -8 < x < -3
    assert abs(y) < 0.5


def test_a_corner_that_was_not_told_is_taken_where_there_is_no_choice(
    take_walk: TakeWalk,
) -> None:
    text = "Walk until you see the vending machine."
    assert take_walk("l_shape", text).ends_near(11, 6)


@pytest.mark.parametrize(
    ("start", "text", "goal"),
    [
        ("crossing", "It is the kitchen.", (0, 11)),
        ("t_junction", "You want the clock, not far from the lift.", (-4, 0)),
        ("loop", "The drinking fountain, that is beside the plant.", (6, 13)),
    ],
)
def test_where_no_way_is_told_it_looks_for_the_place(
    take_walk: TakeWalk, start: str, text: str, goal: tuple[float, float]
) -> None:
    walk = take_walk(start, text)
    assert walk.ends_near(*goal)
    assert walk.notes("arrival")
    assert all(note["score"] < 0.5 for note in walk.notes("doubt"))


# -- what was told wrongly

WRONG_SIDE = (
    "slanted_crossing",
    "Turn right at the crossing. Then turn left. Walk to the piano.",
)
"""The way to the right is a dead end; the piano stands on the left."""


def test_it_goes_back_from_a_dead_end_and_tries_the_other_side(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk(*WRONG_SIDE)
    assert walk.came_by(0, -11)
    assert walk.ends_near(7, 8.4)
    repairs = walk.notes("repair")
    assert repairs
    assert repairs[0]["leg"] == 1


def test_it_says_what_it_doubts_and_where(take_walk: TakeWalk) -> None:
    walk = take_walk(*WRONG_SIDE)
    told = [note for note in walk.notes("doubt") if "leg" in note]
    assert told[0]["leg"] == 1
    assert 0.5 <= told[0]["score"] <= 1
    assert any("turn 1" in words for words in walk.said)


def test_it_doubts_more_where_something_is_wrong(take_walk: TakeWalk) -> None:
    right = take_walk("slanted_crossing", "Bear left and walk to the piano.")
    wrong = take_walk(*WRONG_SIDE)
    assert _last(right, "doubt")["score"] < 0.5 < _last(wrong, "doubt")["score"]
    assert not right.notes("repair")


def _last(walk: Walk, kind: str) -> dict[str, Any]:
    return walk.notes(kind)[-1]


def test_it_comes_back_for_a_turn_when_there_is_no_later_one(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk("crossing", "Take the third left and walk to the end.")
    assert walk.came_by(11, 0)
    assert walk.ends_near(0, 11)


def test_without_repair_it_never_goes_back(walk_with: TakeWalk) -> None:
    walk = walk_with(GuideAgent(GuideOptions(repair=False)), *WRONG_SIDE)
    assert walk.ends_near(0, -11)
    assert not walk.notes("repair")


@pytest.mark.parametrize("things", [True, False])
def test_things_told_count_unless_they_are_left_out(
    walk_with: TakeWalk, *, things: bool
) -> None:
    agent = GuideAgent(GuideOptions(things=things))
    text = "Pass the plant, turn left at the end and walk to the clock."
    walk = walk_with(agent, "t_junction", text)
    assert ("plant" in walk.looked_for) == things
    assert "clock" in walk.looked_for


# -- giving up


def test_what_is_not_in_the_building_is_not_claimed_but_said_not_to_be_found(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk("corridor", "Turn left, right, left. Stop at room 512.")
    assert walk.journal.gave_up
    assert not walk.notes("arrival")
    assert walk.notes("gave_up")[-1]["confidence"] < 0.5
    assert "I could not find it." in walk.said


def test_what_was_found_is_claimed(take_walk: TakeWalk) -> None:
    walk = take_walk("slanted_crossing", "Bear left and walk to the piano.")
    assert not walk.journal.gave_up
    assert walk.notes("arrival")[-1]["confidence"] > 0.5
    assert "I could not find it." not in walk.said


# -- what it writes down


def test_the_journal_tells_the_plan_what_it_believes_and_why_it_stopped(
    take_walk: TakeWalk,
) -> None:
    walk = take_walk(*WRONG_SIDE)
    (plan,) = walk.notes("plan")
    assert walk.journal.notes[0].details == plan
    decisions = walk.notes("decision")
    assert len(decisions) >= 2
    fields = {"at", "exit", "probability", "legs_done", "because"}
    assert all(fields <= set(note) for note in decisions)
    assert all(0 <= note["probability"] <= 1 for note in decisions)
    (arrival,) = walk.notes("arrival")
    assert walk.journal.notes[-1].details == arrival
    assert "piano" in arrival["reason"]


def test_a_belief_is_a_distribution_over_the_legs_done(take_walk: TakeWalk) -> None:
    walk = take_walk("crossing", "Turn left at the crossing. Turn right at the end.")
    beliefs = walk.notes("belief")
    assert all(len(note["legs"]) == 3 for note in beliefs)
    assert all(sum(note["legs"]) == pytest.approx(1, abs=0.01) for note in beliefs)
    assert all(0 <= note["doubt"] <= 1 for note in beliefs)
    assert beliefs[0]["legs"][0] > 0.5 > beliefs[-1]["legs"][0]


# -- always

STARTS = (
    "corridor",
    "l_shape",
    "t_junction",
    "crossing",
    "slanted_crossing",
    "loop",
    "two_rooms",
)


@pytest.mark.parametrize(
    ("start", "text"),
    [
        *((start, "") for start in STARTS),
        ("crossing", "Colourless green ideas sleep furiously."),
        ("loop", "🙂 12 %% 右に曲がる"),
        ("corridor", "Turn left, then turn right."),
        ("corridor", "Take the ninth corridor on the right."),
        ("loop", "Turn left, left, left, left, left, left, left and left."),
    ],
)
def test_whatever_is_said_the_walk_ends_by_itself(
    take_walk: TakeWalk, start: str, text: str
) -> None:
    walk = take_walk(start, text)
    assert walk.stopped_by == "agent"
    assert walk.metres < 450
    assert 0 <= walk.journal.notes[-1].details["confidence"] <= 1


def test_the_same_words_give_the_same_walk_whatever_the_seed(
    take_walk: TakeWalk,
) -> None:
    first, second = (take_walk(*WRONG_SIDE, seed=seed) for seed in (0, 1))
    assert first.points == second.points
    assert first.journal.notes == second.journal.notes


def test_the_functions_of_the_control_api_are_all_that_it_needs(
    take_walk: TakeWalk,
) -> None:
    def api_alone(robot: Robot) -> Robot:
        functions = {name: getattr(robot, name) for name in API_NAMES}
        return cast("Robot", SimpleNamespace(**functions))

    alone = take_walk(*WRONG_SIDE, as_seen=api_alone)
    assert alone.points == take_walk(*WRONG_SIDE).points
    assert set(alone.calls) <= set(API_NAMES)


def test_it_may_have_to_face_any_way_first(walk_with: TakeWalk) -> None:
    agent = GuideAgent(GuideOptions(start_heading="unknown"))
    text = "Go ahead and turn right. Walk to the lift at the end."
    assert walk_with(agent, "t_junction", text).ends_near(11, 0)
