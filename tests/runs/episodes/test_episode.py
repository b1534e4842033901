from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.notes import TracebackNote
from memorymaze.basics.errors import (
    EpisodeOver,
    InterpreterLostError,
    LanguageModelError,
    ProgramError,
)
from memorymaze.robot.api.control import Robot
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import EpisodeRun, run_episode
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.trace import plain_entries
from memorymaze.runs.episodes.trace_entries import NoteEntry

Act = Callable[[Robot, Journal], None]
Run = Callable[..., EpisodeRun]


class Acting:
    """An agent that does what a test says."""

    name = "acting"

    def __init__(self, act: Act) -> None:
        self.act = act

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        self.act(robot, journal)


@pytest.fixture
def run(tiny_plan: Callable[..., RunPlan]) -> Run:
    """Run the first episode: 14.5 m along a straight corridor."""

    def first_episode(act: Act, **options: float) -> EpisodeRun:
        plan = tiny_plan("stop", **options)
        arena = Arena(plan.sites["corridor"])
        return run_episode(Acting(act), plan.episodes[0], arena, plan.settings)

    return first_episode


def walk(robot: Robot, _: Journal) -> None:
    robot.move_forward(14.0)


def walk_ahead(robot: Robot, journal: Journal) -> None:
    robot.distance_travelled()
    walk(robot, journal)


def test_returning_near_the_goal_is_success(run: Run) -> None:
    result = run(walk).result
    assert (result.stopped_by, result.success, result.error) == ("agent", True, None)
    assert result.spd == pytest.approx(0.5, abs=0.3)
    assert result.path_length == pytest.approx(14.0, abs=0.3)
    assert result.spl > 0.9
    assert (result.site, result.participant, result.split) == ("corridor", "p1", "dev")


def pace_to_and_fro(robot: Robot, _: Journal) -> None:
    while True:
        robot.move_forward(14.0)
        robot.turn("around")


def test_the_time_of_an_episode_is_three_times_what_its_own_way_takes(
    run: Run, api_says: Callable[[str], None]
) -> None:
    api_says("Time is limited, to a small multiple of what the way takes")
    by_way = run(pace_to_and_fro).result
    by_longest = run(pace_to_and_fro, budget_by="longest").result
    assert {by_way.stopped_by, by_longest.stopped_by} == {"budget"}
    # 14.5 m at up to 1 m/s, with a second to get going and to halt; a loop is longer.
    assert by_way.duration_s == pytest.approx(3 * 15.5, abs=2)
    assert by_longest.duration_s > 1.5 * by_way.duration_s
    assert by_way.way_m == pytest.approx(14.5)


def test_stopping_far_from_the_goal_is_no_success(run: Run) -> None:
    result = run(lambda robot, _: robot.stop()).result
    assert (result.stopped_by, result.success) == ("agent", False)
    assert result.spd == pytest.approx(14.5)
    assert result.path_length == 0.0


def test_a_result_says_how_sure_the_agent_was_and_whether_it_gave_up(run: Run) -> None:
    def despair(robot: Robot, journal: Journal) -> None:
        journal.note("arrival", reason="a red door", confidence=0.8)
        journal.note("gave_up", reason="no handle", confidence=0.2)

    def despair_too_late(robot: Robot, journal: Journal) -> None:
        despair(robot, journal)
        pace_to_and_fro(robot, journal)

    lost, silent, cut_off = (
        run(act).result for act in (despair, walk, despair_too_late)
    )
    assert (lost.confidence, lost.gave_up) == (0.2, True)
    assert (silent.confidence, silent.gave_up) == (None, False)
    # Who did not stop has not given up either.
    assert (cut_off.confidence, cut_off.gave_up) == (0.2, False)


def test_success_needs_the_agents_own_stop(run: Run) -> None:
    """At the goal when an error ends the walk: no success, though it was there."""

    def fail_at_the_goal(robot: Robot, journal: Journal) -> None:
        walk(robot, journal)
        raise RuntimeError("lost my\nmind")

    result = run(fail_at_the_goal).result
    assert (result.stopped_by, result.success, result.spl) == ("crash", False, 0.0)
    assert (result.oracle_success, result.sdtw) == (True, 0.0)
    assert result.error is not None
    assert result.error.startswith("RuntimeError: lost my mind (test_episode.py, line ")


@pytest.mark.parametrize(
    ("error", "stopped_by", "said"),
    [
        pytest.param(ProgramError("bad", line=3), "crash", "(line 3 of", id="program"),
        pytest.param(ProgramError("bad", unsafe=True), "unsafe", "bad", id="unsafe"),
        pytest.param(LanguageModelError("down"), "model_error", "down", id="model"),
        pytest.param(SystemExit(3), "crash", "SystemExit: 3", id="exit"),
        pytest.param(MemoryError(), "crash", "MemoryError: no message", id="memory"),
        pytest.param(ValueError("x" * 9999), "crash", "ValueError: xx", id="long"),
    ],
)
def test_what_an_agent_raises_becomes_the_outcome(
    run: Run, error: BaseException, stopped_by: str, said: str
) -> None:
    def fail(robot: Robot, journal: Journal) -> None:
        raise error

    result = run(fail).result
    assert result.stopped_by == stopped_by
    assert result.error is not None
    assert said in result.error
    assert len(result.error) <= 500


def test_ctrl_c_passes_through(run: Run) -> None:
    def interrupt(robot: Robot, journal: Journal) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(interrupt)


def test_a_spent_budget_stays_one_though_the_agent_catches_everything(
    run: Run,
) -> None:
    def deny(robot: Robot, journal: Journal) -> None:
        while True:
            try:
                robot.move_forward(0.5)
            except EpisodeOver:
                return

    result = run(deny, time_budget=5.0).result
    assert (result.stopped_by, result.success) == ("budget", False)
    assert result.duration_s == pytest.approx(5.0, abs=0.2)


def test_returning_when_the_budget_ends_a_move_is_no_stop(run: Run) -> None:
    result = run(walk, time_budget=14.0, success_distance=5.0).result
    assert (result.stopped_by, result.success) == ("budget", False)
    assert result.oracle_success


def test_an_error_after_stopping_does_not_undo_the_stop(run: Run) -> None:
    def stop_then_fail(robot: Robot, journal: Journal) -> None:
        walk(robot, journal)
        try:
            robot.stop()
        except EpisodeOver:
            raise RuntimeError("too late") from None

    result = run(stop_then_fail).result
    assert (result.stopped_by, result.success) == ("agent", True)


def test_calls_without_end_spend_the_call_budget(run: Run) -> None:
    def look_forever(robot: Robot, journal: Journal) -> None:
        while True:
            robot.move_forward(0.01)
            robot.detect_turning_point()

    result = run(look_forever, call_budget=50).result
    assert (result.stopped_by, result.api_calls) == ("budget", 50)


def test_an_episode_whose_interpreter_was_killed_is_run_once_more(run: Run) -> None:
    tries: list[float] = []

    def lose_the_first_time(robot: Robot, journal: Journal) -> None:
        tries.append(robot.distance_travelled())
        walk(robot, journal)
        if len(tries) == 1:
            raise InterpreterLostError("killed")

    done = run(lose_the_first_time)
    assert (done.result.stopped_by, done.result.error) == ("agent", None)
    assert replace(done.result, wall_s=0) == replace(run(walk_ahead).result, wall_s=0)
    assert tries == [0.0, 0.0]


def test_a_program_that_brings_its_interpreter_down_does_so_twice(run: Run) -> None:
    tries: list[bool] = []

    def lose(robot: Robot, journal: Journal) -> None:
        tries.append(True)
        raise InterpreterLostError("dead")

    result = run(lose).result
    assert (result.stopped_by, result.error) == ("crash", "InterpreterLostError: dead")
    assert len(tries) == 2


def test_an_agent_cannot_invent_an_ending(run: Run) -> None:
    def declare(robot: Robot, journal: Journal) -> None:
        raise EpisodeOver("victory")

    assert run(declare).result.stopped_by == "agent"


def test_the_trace_says_where_an_agent_failed(run: Run) -> None:
    def fail(robot: Robot, journal: Journal) -> None:
        raise RuntimeError("lost")

    *_, note, _, _ = run(fail).trace
    assert isinstance(note, NoteEntry)
    assert isinstance(note.note, TracebackNote)
    assert note.note.lines[-1] == "RuntimeError: lost"
    assert any("in fail" in line for line in note.note.lines)


def test_the_trace_has_calls_thoughts_poses_and_the_end(run: Run) -> None:
    def think_and_go(robot: Robot, journal: Journal) -> None:
        robot.say("Hello.")
        journal.note("plan", steps=["go"])
        robot.move_forward(2.0)
        journal.model_calls, journal.tokens = 1, 30

    done = run(think_and_go)
    kinds = [entry.kind for entry in done.trace]
    assert kinds[:4] == ["episode", "call", "note", "call"]
    assert kinds[-2:] == ["trajectory", "end"]
    opening, said, note, moved, *_, walk, _ = plain_entries(done.trace)
    assert opening["instruction"] == "Go to the fourth door on the left."
    assert opening["instruction_source"] == "human"
    assert (said["call"], said["arguments"]) == ("say", {"text": "Hello."})
    assert (note["about"], note["steps"]) == ("plan", ["go"])
    assert moved["result"]["reason"] == "done"
    assert walk["poses"][-1][1] == pytest.approx(4.0, abs=0.3)
    assert (done.result.model_calls, done.result.tokens) == (1, 30)


def test_the_same_seed_gives_the_same_walk_step_by_step(run: Run) -> None:
    first, second, other = run(walk), run(walk), run(walk, seed=1)
    assert first.trajectory.poses == second.trajectory.poses
    assert replace(first.result, wall_s=0) == replace(second.result, wall_s=0)
    assert first.trajectory.poses != other.trajectory.poses
