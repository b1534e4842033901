from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.runs.episodes import own_bodies

from memorymaze.agents.agent import Journal
from memorymaze.basics.errors import MemoryMazeError, RobotBodyError, SettingsError
from memorymaze.front.cli.main import run_command_line
from memorymaze.robot.api.control import Robot
from memorymaze.runs.episodes.arena import arenas_of
from memorymaze.runs.episodes.bodies import BodySettings, find_body, parse_body
from memorymaze.runs.episodes.episode import EpisodeRun, run_episode
from memorymaze.runs.episodes.in_words import method_label, sense_notes
from memorymaze.runs.episodes.named_settings import named_in_python, run_settings
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import RunSettings, differences
from memorymaze.runs.episodes.trace_entries import TrajectoryEntry
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_run

OWN = str(Path(own_bodies.__file__))
MODULE = own_bodies.__name__
EXAMPLE = Path(__file__).parents[3] / "examples" / "own_robot.py"
Follow = Callable[..., EpisodeRun]


class GoesAhead:
    """An agent that drives a part of the way, and may take no notice of what is raised."""

    name = "goes_ahead"

    def __init__(self, metres: float = 14.0, deaf: bool = False) -> None:
        self.metres, self.deaf = metres, deaf

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        try:
            robot.turn_by(20)
            robot.turn_by(-20)
            robot.move_forward(self.metres)
        except MemoryMazeError:
            if not self.deaf:
                raise


@pytest.fixture
def follow(tiny_plan: Callable[..., RunPlan]) -> Follow:
    """Run the first episode, 14.5 m along a straight corridor, on a body."""

    def first_episode(
        robot: str | None, agent: GoesAhead | None = None, **choices: Any
    ) -> EpisodeRun:
        plan = tiny_plan("stop", **choices)
        body = None if robot is None else parse_body(robot)
        settings = replace(plan.settings, robot=body)
        arena = arenas_of(settings, plan.sites)["corridor"]
        return run_episode(agent or GoesAhead(), plan.episodes[0], arena, settings)

    return first_episode


def test_a_body_that_knows_its_place_walks_as_the_simulated_one(follow: Follow) -> None:
    simulated, own = follow(None), follow(f"{MODULE}:Localised")
    same = replace(own.result, wall_s=simulated.result.wall_s)
    assert same == simulated.result
    assert own.trajectory.poses == simulated.trajectory.poses


def test_a_walk_is_told_by_odometry_where_the_body_does_not_know_its_place(
    follow: Follow,
) -> None:
    result = follow(f"{MODULE}:Wheels").result
    assert (result.success, result.by_odometry) == (True, True)
    settings = RunSettings(robot=parse_body(f"{MODULE}:Wheels"))
    [note] = sense_notes(settings, [result])
    assert "BY ITS ODOMETRY" in note
    [note] = sense_notes(settings, [replace(result, by_odometry=False)])
    assert "by the pose on the plan that it tells" in note


def test_a_body_is_closed_when_its_episode_is_over(follow: Follow) -> None:
    follow(f"{MODULE}:Localised")
    assert own_bodies.opened[-1].closed == 1
    follow(f"{MODULE}:Localised,dies_after=1")
    assert own_bodies.opened[-1].closed == 1


def test_a_body_that_cannot_tell_where_it_begins_is_closed(follow: Follow) -> None:
    with pytest.raises(RobotBodyError, match="no map"):
        follow(f"{MODULE}:Lost")
    assert own_bodies.opened[-1].closed == 1


@pytest.mark.parametrize("deaf", [False, True])
def test_a_body_that_dies_is_a_crash_whatever_the_agent_makes_of_it(
    follow: Follow, deaf: bool
) -> None:
    run = follow(f"{MODULE}:Localised,dies_after=3", GoesAhead(deaf=deaf))
    assert (run.result.stopped_by, run.result.success) == ("crash", False)
    assert "no answer from the wheels" in (run.result.error or "")
    assert 0 < run.result.path_length < 5


def test_a_body_that_dies_costs_its_episode_and_not_the_run(
    tiny_plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    plan = tiny_plan("oracle")
    settings = replace(plan.settings, robot=parse_body(f"{OWN}:second_dies"))
    results = run_plan(replace(plan, settings=settings), tmp_path / "run")
    assert len(results) == len(plan.episodes)
    ends = [each.stopped_by for each in results]
    assert (ends.count("crash"), ends.count("agent")) == (1, len(ends) - 1)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("GetsLost", "pose_in_site: expected a Pose of finite numbers, got Pose(x=nan"),
        ("Overflows", "odometry: expected an OdometryReading of finite numbers"),
    ],
)
def test_a_body_that_tells_no_numbers_any_more_is_a_crash(
    follow: Follow, body: str, said: str
) -> None:
    run = follow(f"{MODULE}:{body}")
    assert run.result.stopped_by == "crash"
    assert f"the robot's body failed: {said}" in str(run.result.error)
    assert 0 < run.result.path_length < 5


def test_a_body_that_tells_a_tuple_for_its_place_is_told_so(follow: Follow) -> None:
    with pytest.raises(RobotBodyError, match=r"expected a Pose .*, got \(2\.0, 0\.0"):
        follow(f"{MODULE}:TellsTuple")


@pytest.mark.parametrize(
    ("body", "advice"), [("Slips", "by its odometry, which may drift"), ("Leaps", "")]
)
def test_a_walk_that_leaves_the_floor_is_a_crash_measured_up_to_there(
    follow: Follow, body: str, advice: str
) -> None:
    run = follow(f"{MODULE}:{body}")
    result, points = run.result, run.trajectory.points
    assert (result.stopped_by, result.success) == ("crash", False)
    off = np.abs(points[:, 1]) > 2.0
    left = int(np.argmax(off))
    x, y = points[left]
    said = (
        f"the walk as measured leaves the floor at ({x:.2f}, {y:.2f}){advice and ', '}"
    )
    assert str(result.error).startswith(said + advice)
    walked = np.hypot(*np.diff(points[:left], axis=0).T).sum()
    assert result.path_length == pytest.approx(walked)
    assert off[-1]
    assert result.api_calls > 1
    [kept] = [each for each in run.trace if isinstance(each, TrajectoryEntry)]
    assert len(kept.poses) == len(points)


def test_a_walk_that_leaves_the_floor_is_driven_once(
    tiny_plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    plan = tiny_plan("oracle", limit=1)
    settings = replace(plan.settings, robot=parse_body(f"{OWN}:Leaps"))
    [result] = run_plan(replace(plan, settings=settings), tmp_path / "run")
    assert (result.stopped_by, result.path_length > 1) == ("crash", True)
    assert str(result.error).startswith("the walk as measured leaves the floor at")


def test_a_body_that_cannot_be_put_away_is_told_and_its_episode_counts(
    follow: Follow,
) -> None:
    with pytest.warns(UserWarning, match="not put away: stuck in the door"):
        run = follow(f"{MODULE}:Stays")
    assert run.result.success


def test_what_holds_a_body_ends_its_move(follow: Follow) -> None:
    run = follow(f"{MODULE}:Localised", GoesAhead(40.0))
    free = follow(None, GoesAhead(40.0))
    assert run.result.path_length == pytest.approx(free.result.path_length, abs=0.3)


def test_its_options_are_settings_of_the_run() -> None:
    given = {"robot": f"{MODULE}:Localised", "dies_after": 7, "limit": 2}
    settings = run_settings(RunSettings(), named_in_python(given))
    assert settings.robot == BodySettings(f"{MODULE}:Localised", "dies_after=7")
    assert str(settings.robot) == f"{MODULE}:Localised,dies_after=7"
    maker = find_body(settings.robot)
    assert maker is not None
    assert maker.options.dies_after == 7.0


@pytest.mark.parametrize(
    ("robot", "says"),
    [
        ("carl", "did you mean 'carla'"),
        ("nowhere.py:Body", "cannot be imported"),
        (f"{MODULE}:Nobody", "nothing of this name"),
        (f"{MODULE}:Localised,dies=1", "NAME is one of dies_after"),
        (f"{MODULE}:no_body,x=1", "has no options to set"),
    ],
)
def test_a_robot_that_is_none_is_refused(robot: str, says: str) -> None:
    with pytest.raises(SettingsError, match=says):
        find_body(parse_body(robot))


@pytest.mark.parametrize(
    ("robot", "says"),
    [
        (f"{MODULE}:no_body", "got str"),
        (f"{MODULE}:unreachable", "cannot be put at.*nobody answers"),
    ],
)
def test_a_body_that_cannot_be_had_ends_the_run_with_its_reason(
    follow: Follow, robot: str, says: str
) -> None:
    with pytest.raises(RobotBodyError, match=says):
        follow(robot)


@pytest.mark.parametrize("name", ["obstacles", "noise", "wheel_noise", "motion"])
def test_what_is_of_the_simulated_body_is_refused_with_another(name: str) -> None:
    values = {
        "obstacles": "light",
        "noise": "light",
        "wheel_noise": 0.5,
        "motion": "kinematic",
    }
    given = {"robot": f"{MODULE}:Localised", name: values[name]}
    with pytest.raises(SettingsError, match=f"{name}.*has its own"):
        run_settings(RunSettings(), named_in_python(given))


def test_the_example_runs_from_the_command_line_and_its_table_names_it(
    tmp_path: Path, tiny_files: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    run = tmp_path / "run"
    command = ["evaluate", "--agent", "oracle", "--robot", f"{EXAMPLE}:in_site"]
    command += [*tiny_files, "--limit", "2", "--out", str(run)]
    assert run_command_line(command) == 0
    record, results = read_run(run)
    assert [stamp.name for stamp in record.settings.robot_files] == ["own_robot.py"]
    assert all(result.success for result in results)
    capsys.readouterr()
    assert run_command_line(["table", str(run)]) == 0
    told = capsys.readouterr().out
    assert "on own_robot.py:in_site" in told
    assert "not the simulated one" in told


def test_runs_on_other_bodies_are_told_apart(
    settings: Any, result: Callable[..., EpisodeResult]
) -> None:
    own = replace(settings, robot=parse_body(f"{MODULE}:Localised,dies_after=3"))
    assert any("robot" in str(each) for each in differences(settings, own))
    assert method_label(own, [result()]).endswith("own_bodies:Localised")
