"""Robots that know no plan, in buildings of which the tests know it."""

import math
from typing import Any

import numpy as np
import pytest

from memorymaze.basics.errors import CommandError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles import parse_obstacles
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.lidar import LidarSettings
from memorymaze.robot.simulation.senses.odometry import OdometrySettings
from memorymaze.testing import check_robot
from memorymaze.world.sites import Site

Scenes = dict[str, Scene]
NOISY = {
    "lidar": LidarSettings(noise=0.03, drop_out=0.05),
    "odometry": OdometrySettings(
        scale_error=0.02, heading_drift=0.005, distance_noise=0.01, heading_noise=0.005
    ),
}


def put(
    scene: Scene, x: float, y: float, degrees: float = 0.0, **sensors: Any
) -> SimulatedRobot:
    """Put a robot somewhere that must not run into anything."""
    start = Pose(x, y, math.radians(degrees))
    return SimulatedRobot(
        scene, start, rng=np.random.default_rng(0), knows_plan=False, **sensors
    )


@pytest.mark.parametrize("sensors", [{}, NOISY], ids=["exact", "noisy"])
def test_it_keeps_to_the_middle_and_halts_before_the_wall(
    scenes: Scenes, sensors: dict[str, Any]
) -> None:
    robot = put(scenes["corridor"], 1, 0.8, **sensors)
    result = robot.move_forward(100)
    assert result.reason == "wall"
    assert robot.pose.x == pytest.approx(20 - 0.7, abs=0.15)
    beyond_the_door = robot.trajectory().points[:, 0] > 6
    assert np.abs(robot.trajectory().points[beyond_the_door, 1]).max() < 0.2
    assert robot.collisions == ()


def test_short_moves_lead_as_far_as_a_long_one(scenes: Scenes) -> None:
    robot = put(scenes["corridor"], 1, 0)
    for _ in range(30):
        result = robot.move_forward(0.5)
        assert result.reason == "done"
        assert result.distance == pytest.approx(0.5, abs=0.03)
    assert robot.pose[:2] == pytest.approx((16, 0), abs=0.3)


@pytest.mark.parametrize("sensors", [{}, NOISY], ids=["exact", "noisy"])
def test_it_turns_into_ways_it_has_seen(t_site: Site, sensors: dict[str, Any]) -> None:
    robot = put(build_scene(t_site), 0, -8, 90, **sensors)
    for _ in range(30):
        if "left" in robot.detect_turning_point():
            break
        robot.move_forward(0.5)
    assert set(robot.detect_turning_point()) == {"left", "right"}
    assert robot.turn("left").turned
    assert robot.move_forward(4).reason == "done"
    assert robot.pose.x < -3
    assert robot.pose.y == pytest.approx(0, abs=0.25)
    assert robot.collisions == ()


def test_it_goes_round_a_thing_and_back_to_the_middle(plans: Any) -> None:
    site = plans.site(
        plans.corridor("way", 0, -1.5, 20, 1.5), plans.thing("crate", 8, 0.1)
    )
    robot = put(build_scene(site), 1, 0)
    assert robot.move_forward(14).reason == "done"
    assert robot.collisions == ()
    assert robot.pose.x > 14
    assert abs(robot.pose.y) < 0.1


def test_it_halts_before_what_leaves_no_room(plans: Any) -> None:
    site = plans.site(
        plans.corridor("way", 0, -1, 20, 1),
        plans.thing("counter", 8, 0, size=(1.5, 0.5, 1.0)),
    )
    robot = put(build_scene(site), 1, 0)
    assert robot.move_forward(14).reason in ("wall", "obstacle")
    assert robot.pose.x == pytest.approx(8 - 0.25 - 0.6, abs=0.25)
    assert robot.collisions == ()


def test_single_steps_end_before_the_wall(scenes: Scenes) -> None:
    robot = put(scenes["corridor"], 17, 0)
    assert robot.step_forward(1.0) == pytest.approx(1.0, abs=0.01)
    assert robot.step_forward(5.0) < 2
    assert robot.pose.x == pytest.approx(20 - 0.65, abs=0.2)
    assert robot.step_forward(1.0) < 0.1
    assert robot.collisions == ()


def test_it_faces_a_wall_and_finds_back_to_its_way(scenes: Scenes) -> None:
    robot = put(scenes["corridor"], 5, 0)
    robot.turn_by(90)
    assert robot.move_forward(5).reason == "wall"
    assert robot.pose.y == pytest.approx(1.5 - 0.7, abs=0.15)
    robot.turn_by(-90)
    assert robot.move_forward(8).reason == "done"
    assert robot.pose[:2] == pytest.approx((13, 0), abs=0.25)


@pytest.mark.proof
def test_people_who_walk_about_are_not_run_into(corridor_site: Site) -> None:
    scene = build_scene(corridor_site, parse_obstacles("things=2,people=3"))
    robot = put(scene, 2, 0)
    for _ in range(3):
        robot.move_forward(30)
        robot.turn("around")
    assert robot.distance_travelled() > 15
    assert robot.collisions == ()


def test_it_keeps_the_contract_of_the_control_api(scenes: Scenes) -> None:
    check_robot(put(scenes["crossing"], -8, 0))


def test_the_same_seed_gives_the_same_walk(scenes: Scenes) -> None:
    first, second = (put(scenes["crossing"], -8, 0.3, **NOISY) for _ in range(2))
    for robot in (first, second):
        robot.move_forward(12)
    assert first.pose == second.pose


def test_it_cannot_follow_a_line_on_the_plan(scenes: Scenes) -> None:
    with pytest.raises(CommandError, match="knows_plan=False"):
        put(scenes["corridor"], 2, 0).follow([(5, 0)])
