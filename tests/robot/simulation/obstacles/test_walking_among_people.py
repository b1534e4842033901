"""What moves do where things stand and people are in the way."""

import math

import numpy as np
import pytest
from shapely import Point

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.obstacles.placing import footprint
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings


def _among_things(site, seed: int) -> SimulatedRobot:
    obstacles = ObstacleSettings(
        things_per_100m=20, people=0, kinds=("queue_barrier", "cart")
    )
    return SimulatedRobot(
        build_scene(site, obstacles),
        Pose(1, 0, 0),
        SimulationSettings(),
        np.random.default_rng(0),
        obstacles_rng=np.random.default_rng(seed),
    )


def _gap_to_things(robot: SimulatedRobot) -> float:
    assert robot.surroundings is not None
    walk = [Point(point) for point in robot.trajectory().points]
    return min(
        footprint(each.record, each.pose).distance(place) - ROBOT_RADIUS
        for each in robot.surroundings.things
        for place in walk
    )


def test_things_in_the_way_are_passed(wide):
    aside = []
    for seed in range(3):
        robot = _among_things(wide, seed)

        assert robot.move_forward(30).reason == "wall"
        assert robot.pose.x > 22
        assert robot.collisions == ()
        assert _gap_to_things(robot) > 0.03
        aside.append(np.abs(robot.trajectory().points[:, 1]).max())
    assert max(aside) > 0.4, "some thing really stands in the way"


def test_a_given_line_is_followed_round_things(wide):
    for seed in range(3):
        robot = _among_things(wide, seed)

        result = robot.follow([(1, 0), (22, 0)])

        assert result.reason == "done"
        assert math.dist(robot.pose[:2], (22, 0)) < 0.1
        assert robot.collisions == ()
        assert _gap_to_things(robot) > 0.03


def test_the_robot_waits_for_a_person_who_stands_and_goes_on(
    narrow, crowded, person_of
):
    robot = crowded(narrow)
    person_of(robot, 6, 0, stands_until=7.0, walks_to=(22, 0))

    result = robot.move_forward(8)

    assert result.reason == "done"
    assert result.distance == pytest.approx(8, abs=0.05)
    assert robot.time > 10
    assert 2 < robot.waiting_time < 7
    assert robot.collisions == ()


def _blindly(mind, me, wanted, others, period):
    return wanted


@pytest.mark.parametrize("begin", [-4.0, -3.0, -2.0])
def test_the_robot_lets_a_person_cross_who_looks_at_nothing_and_goes_on(
    begin: float, plans, crowded, person_of, monkeypatch
):
    hall = plans.site(plans.area("hall", plans.corridor("c", 0, -6, 24, 6).polygon))
    robot = crowded(hall)
    person = person_of(robot, 4.5, begin, walks_to=(4.5, 5))
    monkeypatch.setattr(robot.surroundings.crowd._avoidance, "decide", _blindly)

    result = robot.move_forward(8)

    assert result.reason == "done"
    assert robot.pose.y == pytest.approx(0, abs=0.1)
    assert person.y > 2
    assert robot.collisions == ()


def test_the_robot_really_slows_down_for_somebody_who_crosses(
    plans, crowded, person_of, monkeypatch
):
    hall = plans.site(plans.area("hall", plans.corridor("c", 0, -6, 24, 6).polygon))
    alone, robot = crowded(hall), crowded(hall)
    person_of(alone, 22, 5, stands_until=math.inf)
    person_of(robot, 4.5, -3.0, walks_to=(4.5, 5))
    monkeypatch.setattr(robot.surroundings.crowd._avoidance, "decide", _blindly)

    alone.move_forward(8)
    robot.move_forward(8)

    assert robot.time > alone.time + 0.3


def test_a_person_who_blocks_the_way_for_good_is_waited_for_in_each_call(
    narrow, crowded, person_of, api_says
):
    api_says("a person it has waited for, about 15 seconds")
    assert ObstacleSettings().patience == 15
    robot = crowded(narrow, patience=2.0)
    person_of(robot, 6, 0, stands_until=math.inf)

    for call in (1, 2):
        assert robot.move_forward(8).reason == "obstacle"
        assert robot.pose.x < 6 - 0.5
        assert robot.waiting_time == pytest.approx(2.0 * call, abs=0.3)
    assert robot.collisions == ()


def test_a_person_who_stands_in_a_wide_way_is_passed(wide, crowded, person_of):
    robot = crowded(wide)
    person = person_of(robot, 8, 0, stands_until=math.inf)

    result = robot.move_forward(12)

    assert result.reason == "done"
    assert robot.pose.x > 13
    assert robot.waiting_time < 4
    assert robot.collisions == ()
    points = robot.trajectory().points
    gaps = np.hypot(*(points - (person.x, person.y)).T) - person.radius - ROBOT_RADIUS
    assert gaps.min() > 0.15


def test_following_a_line_waits_longer_than_a_move(narrow, crowded, person_of):
    robot = crowded(narrow, patience=2.0)
    person_of(robot, 6, 0, stands_until=12.0, walks_to=(22, 0))

    result = robot.follow([(2, 0), (10, 0)])

    assert result.reason == "done"
    assert math.dist(robot.pose[:2], (10, 0)) < 0.1
    assert robot.collisions == ()


def test_following_a_line_gives_up_in_the_end(narrow, crowded, person_of):
    robot = crowded(narrow)
    person_of(robot, 6, 0, stands_until=math.inf)

    assert robot.follow([(2, 0), (10, 0)]).reason == "obstacle"
    assert robot.time > 60


def test_a_turn_ends_although_somebody_stands_where_it_would_be_made(
    crossing_site, crowded, person_of
):
    robot = crowded(crossing_site, patience=2.0)
    start = crossing_site.find_route("R1").start
    robot = SimulatedRobot(robot.scene, start, obstacles_rng=np.random.default_rng(0))
    person_of(robot, 0, 0, stands_until=math.inf)
    while not robot.detect_turning_point():
        assert robot.move_forward(0.25).reason == "done"

    assert robot.turn("left").turned
    assert robot.collisions == ()


def test_touching_a_person_is_a_collision_with_a_person(wide, crowded, person_of):
    robot = crowded(wide)
    person = person_of(robot, 2.3, 0, stands_until=math.inf)

    robot.turn("around")

    first = robot.collisions[0]
    assert (first.kind, first.object_id) == ("person", person.record.id)
    assert len(robot.near_misses) == 1
    assert robot.near_misses[0].gap == 0


def test_a_building_as_in_its_plan_has_nobody_around(narrow):
    scene = build_scene(narrow)
    robot = SimulatedRobot(scene, Pose(2, 0, 0))

    robot.move_forward(3)

    assert robot.surroundings is None
    assert robot.near_misses == ()
    assert robot.waiting_time == 0
    assert scene.model.nmocap == 0


def test_a_step_waits_for_somebody_who_stands_in_the_way(narrow, crowded, person_of):
    robot = crowded(narrow)
    person_of(robot, 5, 0, stands_until=6.0, walks_to=(22, 0))

    assert robot.step_forward(4) == pytest.approx(4, abs=0.001)
    assert robot.waiting_time > 1
    assert not robot.collisions


def test_a_step_gives_up_when_patience_ends(narrow, crowded, person_of):
    robot = crowded(narrow)
    person_of(robot, 5, 0, stands_until=math.inf)

    assert 1 < robot.step_forward(4) < 2.8
    assert robot.surroundings is not None
    assert robot.waiting_time >= robot.surroundings.patience
    assert not robot.collisions
