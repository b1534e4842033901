import math
from typing import Any

import numpy as np
import pytest
from tests.robot.simulation.conftest import PutRobot

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.body import SimulatedBody
from memorymaze.robot.simulation.plan_floor import PlanFloor
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.turning_points import AnnotatedTurningPoints
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.driving import Driver


def driver_at(
    scene: Scene, x: float, y: float, degrees: float = 0.0
) -> tuple[SimulatedBody, Driver]:
    settings = SimulationSettings()
    start = Pose(x, y, math.radians(degrees))
    body = SimulatedBody(scene, start, settings, np.random.default_rng(0))
    floor = PlanFloor(body, AnnotatedTurningPoints(scene))
    return body, Driver(body, floor, settings)


def push(driver: Driver, seconds: float, speed: float = 0.5) -> None:
    for _ in range(round(seconds / 0.05)):
        driver.tick(speed, 0.0, 0.0)


def test_pushing_against_a_thing_is_one_collision_with_it(plans: Any) -> None:
    site = plans.site(
        plans.corridor("way", 0, -1, 10, 1),
        plans.thing("crate", 5, 0, size=(1.0, 0.6, 0.3)),
    )
    body, driver = driver_at(build_scene(site), 3, 0)
    push(driver, 8)
    (collision,) = body.collisions
    assert (collision.kind, collision.object_id) == ("landmark", "crate")
    assert collision.pose.x == pytest.approx(4.45, abs=0.05)
    push(driver, 4, speed=-0.5)
    push(driver, 8)
    assert len(body.collisions) == 2


def test_the_robot_stays_upright_and_on_the_floor(scenes: dict[str, Scene]) -> None:
    body, driver = driver_at(scenes["corridor"], 2, 0.3)
    rng = np.random.default_rng(5)
    for _ in range(600):
        driver.tick(float(rng.uniform(-1, 1)), float(rng.uniform(-2, 2)), 0.0)
        body.base.update_view()
        z, w, i, j = body.base.data.qpos[[2, 3, 4, 5]].tolist()
        assert abs(z) < 0.01
        assert math.hypot(i, j) < 0.02 + 0 * w


def test_speed_and_acceleration_keep_their_limits(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 1, 0, wheel_noise=0.0, sampling_period=0.05)
    robot.move_forward(15)
    poses = robot.trajectory().poses
    times = np.array([pose.time for pose in poses])
    speeds = np.diff([pose.x for pose in poses]) / np.diff(times)
    assert speeds.max() == pytest.approx(1.0, abs=0.02)
    assert np.abs(np.diff(speeds)).max() < 1.5 * 0.05 * 1.6


def test_backs_up_to_a_point_close_behind(scenes: dict[str, Scene]) -> None:
    _, driver = driver_at(scenes["corridor"], 5, 0)
    driver.drive_to(4.2, 0.1)
    assert math.dist(driver.pose[:2], (4.2, 0.1)) < 0.05
    assert abs(driver.pose.heading) < 0.3


def test_turns_and_drives_to_a_point_far_behind(scenes: dict[str, Scene]) -> None:
    _, driver = driver_at(scenes["corridor"], 8, 0)
    driver.drive_to(4, 0)
    assert math.dist(driver.pose[:2], (4, 0)) < 0.05
    assert abs(driver.pose.heading) > 3
