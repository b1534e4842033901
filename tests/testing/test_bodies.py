import runpy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.sensors_and_motion import OdometryReading, SensorsAndMotion
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.simulation.body import SimulatedBody
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.testing import check_sensors_and_motion
from memorymaze.world.sites import Site

EXAMPLE = Path(__file__).parents[2] / "examples" / "own_robot.py"
PointBody: Any = runpy.run_path(str(EXAMPLE))["PointBody"]


@pytest.mark.parametrize("localised", [True, False])
def test_the_simulated_body_keeps_the_contract(l_site: Site, localised: bool) -> None:
    body = SimulatedBody(
        build_scene(l_site),
        Pose(2, 0, 0.1),
        SimulationSettings(),
        np.random.default_rng(0),
        localised=localised,
    )
    assert isinstance(body, SensorsAndMotion)
    check_sensors_and_motion(body)


def test_the_example_of_an_own_robot_keeps_the_contract() -> None:
    check_sensors_and_motion(PointBody())


class RightHanded(PointBody):
    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        super().drive(speed, -turn_rate, seconds)


class InCentimetres(PointBody):
    def odometry(self) -> OdometryReading:
        time, (x, y, heading), speed = super().odometry()
        return OdometryReading(time, Pose(100 * x, 100 * y, heading), speed)


class Timeless(PointBody):
    def odometry(self) -> OdometryReading:
        return super().odometry()._replace(time=0.0)


class LooksBack(PointBody):
    def lidar_scan(self) -> LidarScan:
        scan = super().lidar_scan()
        return replace(scan, ranges=np.roll(scan.ranges, 180))


class Clockwise(PointBody):
    def lidar_scan(self) -> LidarScan:
        scan = super().lidar_scan()
        return replace(scan, ranges=np.roll(scan.ranges[::-1], 1))


class FromZero(PointBody):
    def lidar_scan(self) -> LidarScan:
        scan = super().lidar_scan()
        return replace(scan, angles=scan.angles[::-1])


class Rolling(PointBody):
    def odometry(self) -> OdometryReading:
        return super().odometry()._replace(speed=0.3)


class TellsTuple(PointBody):
    def odometry(self) -> OdometryReading:
        read = super().odometry()
        return read._replace(pose=tuple(read.pose))


class KnowsNoPose(PointBody):
    def pose_in_site(self) -> Any:
        return (1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (RightHanded, "left positive"),
        (InCentimetres, "odometry 0.5 m farther"),
        (Timeless, "to take about 2 s"),
        (LooksBack, "room at angle 0"),
        (Clockwise, "moves what is seen to the right"),
        (FromZero, "ascending"),
        (Rolling, "standing still"),
        (TellsTuple, "odometry: expected an OdometryReading .* with a Pose"),
        (KnowsNoPose, "pose_in_site: expected a Pose of finite numbers"),
    ],
)
def test_what_a_body_does_wrong_is_told(body: Any, words: str) -> None:
    with pytest.raises(AssertionError, match=words):
        check_sensors_and_motion(body())
