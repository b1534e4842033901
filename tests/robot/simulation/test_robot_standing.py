"""The robot stands while something outside the building takes its time."""

import math
from typing import Any

import numpy as np
import pytest
from tests.robot.simulation.conftest import PutRobot

from memorymaze.basics.errors import CommandError, EpisodeOver
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene


def test_time_passes_and_the_robot_stays(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    before = robot.pose
    assert robot.wait(12.5) == pytest.approx(12.5)
    assert robot.time == robot.standing_time == pytest.approx(12.5)
    assert robot.pose == before
    assert robot.calls == 0
    assert robot.waiting_time == 0


def test_the_walk_is_the_same_however_long_it_stands(put_robot: PutRobot) -> None:
    walks: list[list[tuple[float, ...]]] = []
    for seconds in (0.0, 40.0):
        robot = put_robot("corridor", 2, 0)
        for _ in range(4):
            robot.move_forward(1.5)
            robot.wait(seconds)
        walks.append([pose[1:] for pose in robot.trajectory().poses])
    assert walks[1][-1] == walks[0][-1]
    assert set(walks[1]) == set(walks[0])


def test_a_rolling_robot_first_comes_to_rest(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    robot.move_forward(2)
    walked = robot.time
    rolled = robot.pose
    robot.wait(3)
    assert robot.pose.x > rolled.x
    assert robot.time > walked + 3
    assert robot.standing_time == pytest.approx(3)


def test_standing_does_not_count_against_the_time_budget(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0, time_budget=5.0)
    robot.wait(100)
    assert robot.move_forward(2).reason == "done"
    assert robot.move_forward(9).reason == "budget"
    assert robot.time - robot.standing_time == pytest.approx(5.0, abs=0.1)
    with pytest.raises(EpisodeOver, match="budget"):
        robot.move_forward(1)


def test_nothing_passes_once_the_episode_is_over(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    robot.finish()
    assert robot.wait(5) == 0
    assert robot.standing_time == 0


@pytest.mark.parametrize("nonsense", [-1, math.nan, math.inf, "3", True])
def test_times_without_meaning_are_refused(put_robot: PutRobot, nonsense: Any) -> None:
    with pytest.raises(CommandError, match="0 or more seconds"):
        put_robot("corridor", 2, 0).wait(nonsense)


def _people(robot: SimulatedRobot) -> np.ndarray:
    assert robot.surroundings is not None
    assert robot.surroundings.crowd is not None
    return np.array([(each.x, each.y) for each in robot.surroundings.crowd.people])


def test_people_go_on_walking_meanwhile(scenes: dict[str, Scene]) -> None:
    scene = build_scene(
        scenes["loop"].site, ObstacleSettings(things_per_100m=0, people=4)
    )
    start = Pose(*scenes["loop"].site.routes[0].start)
    places: list[np.ndarray] = []
    for _ in range(2):
        robot = SimulatedRobot(scene, start)
        before = _people(robot)
        robot.wait(6.03)
        places.append(_people(robot))
        assert np.hypot(*(places[-1] - before).T).max() > 2
        assert robot.time == robot.standing_time == pytest.approx(6.03)
        assert robot.waiting_time == 0
    assert np.array_equal(places[0], places[1])
