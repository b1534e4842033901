import sys

import numpy as np
import pytest
import shapely

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.obstacles.crowd import RobotMotion
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene

AWAY = RobotMotion(-50.0, 0.0, 0.0, 0.0)


def _walks(robot: SimulatedRobot, seconds: float, machine: RobotMotion = AWAY):
    """Let people walk; return where they were every 0.1 s, shape (T, n, 2)."""
    assert robot.surroundings is not None
    crowd = robot.surroundings.crowd
    assert crowd is not None
    places = []
    for step in range(1, round(seconds * 10) + 1):
        crowd.advance(step / 10, machine)
        places.append([(each.x, each.y) for each in crowd.people])
    return np.array(places), np.array([each.radius for each in crowd.people])


def test_the_same_seed_gives_the_same_people_step_by_step(loop_site, crowded):
    first, _ = _walks(crowded(loop_site, 6, seed=3), 20)
    second, _ = _walks(crowded(loop_site, 6, seed=3), 20)
    other, _ = _walks(crowded(loop_site, 6, seed=4), 20)

    assert (first == second).all()
    assert not np.array_equal(first, other)


def test_how_a_span_of_time_is_cut_does_not_matter_to_those_who_walk_alone(
    wide, crowded
):
    coarse, fine = (
        crowded(wide, 1).surroundings.crowd,
        crowded(wide, 1).surroundings.crowd,
    )

    coarse.advance(3.0, AWAY)
    for step in range(1, 301):
        fine.advance(step / 100, AWAY)

    [one], [other] = coarse.people, fine.people
    assert (one.x, one.y) == pytest.approx((other.x, other.y), abs=1e-6)


def test_people_keep_off_walls_and_each_other(two_rooms, crowded):
    robot = crowded(two_rooms, 6)

    places, radii = _walks(robot, 40)

    everywhere = shapely.points(places.reshape(-1, 2))
    room = shapely.distance(two_rooms.walkable_floor.boundary, everywhere)
    assert shapely.contains(two_rooms.walkable_floor, everywhere).all()
    assert (room.reshape(len(places), -1) - radii).min() > -0.1
    gaps = np.linalg.norm(places[:, :, None] - places[:, None], axis=3)
    gaps -= radii[:, None] + radii[None]
    gaps[:, np.arange(len(radii)), np.arange(len(radii))] = 1.0
    assert gaps.min() > -0.02


def test_people_get_on_at_walking_speed(loop_site, crowded):
    robot = crowded(loop_site, 4)

    places, _ = _walks(robot, 30)

    pace = np.linalg.norm(np.diff(places, axis=0), axis=2) * 10
    assert 0.7 < np.median(pace) < 1.7
    assert pace.max() < 2.2


def test_people_walk_round_a_robot_that_stands(wide, crowded, person_of):
    robot = crowded(wide)
    person = person_of(robot, 12, 0.05, walks_to=(3, 0))

    places, radii = _walks(robot, 9, RobotMotion(8.0, 0.0, 0.0, 0.0))

    gap = np.linalg.norm(places[:, 0] - (8, 0), axis=1).min() - radii[0] - 0.25
    assert gap > 0.1
    assert person.x < 6


def test_people_turn_back_where_the_robot_fills_the_way(narrow, crowded, person_of):
    robot = crowded(narrow)
    person = person_of(robot, 12, 0, walks_to=(1, 0))

    places, radii = _walks(robot, 25, RobotMotion(8.0, 0.0, 0.0, 0.0))

    assert np.linalg.norm(places[:, 0] - (8, 0), axis=1).min() > radii[0] + 0.25
    assert places[:, 0, 0].min() > 8
    assert person.x > 10


def test_nobody_begins_beside_the_robot(two_rooms):
    obstacles = ObstacleSettings(things_per_100m=0, people=5)
    scene = build_scene(two_rooms, obstacles)
    for seed in range(5):
        robot = SimulatedRobot(
            scene, Pose(3, 3, 0), obstacles_rng=np.random.default_rng(seed)
        )
        crowd = robot.surroundings.crowd
        assert crowd.near(3, 3, 3.0 - 1e-9) == []
        assert len(crowd.people) >= 2


def test_things_alone_need_no_package(wide, monkeypatch):
    monkeypatch.setitem(sys.modules, "navground", None)

    robot = SimulatedRobot(build_scene(wide, ObstacleSettings(people=0)), Pose(2, 0, 0))

    assert robot.surroundings.crowd is None
