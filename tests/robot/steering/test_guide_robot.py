"""The control API on the body of forty lines of `examples/own_robot.py`, in no simulator."""

import math
import runpy
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import DetectorError, EpisodeOver
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.robot.api.sensors_and_motion import OdometryReading
from memorymaze.robot.api.steps import SteppingRobot
from memorymaze.robot.perception.detector import TruthDetector
from memorymaze.robot.steering.guide_robot import GuideRobot
from memorymaze.robot.steering.settings import RobotSettings

EXAMPLE = Path(__file__).parents[3] / "examples" / "own_robot.py"
PointBody: Any = runpy.run_path(str(EXAMPLE))["PointBody"]


class Elsewhere(PointBody):
    """Tells of itself in a frame turned by 2 radians, by a clock that began long ago."""

    def odometry(self) -> OdometryReading:
        time, (x, y, heading), speed = super().odometry()
        cosine, sine = math.cos(2), math.sin(2)
        pose = Pose(
            500 + x * cosine - y * sine,
            -300 + x * sine + y * cosine,
            wrap_angle(heading + 2),
        )
        return OdometryReading(1e6 + time, pose, speed)


def test_it_is_what_agents_are_given() -> None:
    assert isinstance(GuideRobot(PointBody()), SteppingRobot)


@pytest.mark.parametrize("kind", [PointBody, Elsewhere])
def test_where_odometry_begins_makes_no_difference(kind: Any) -> None:
    body = kind()
    robot = GuideRobot(body, settings=RobotSettings(time_budget=100))
    assert robot.move_forward(100).reason == "wall"
    assert body.pose[:2] == pytest.approx((14 - 0.7, 0), abs=0.1)
    assert robot.detect_turning_point() == ["right"]
    assert robot.turn("right").turned
    robot.move_forward(4)
    assert body.pose[:2] == pytest.approx((13, -4), abs=0.15)


def test_the_time_budget_is_of_the_bodys_clock() -> None:
    robot = GuideRobot(Elsewhere(), settings=RobotSettings(time_budget=3))
    result = robot.move_forward(10)
    assert result.reason == "budget"
    assert 1 < result.distance < 3
    with pytest.raises(EpisodeOver):
        robot.say("Still there?")


def test_without_rolling_every_move_ends_at_rest() -> None:
    body = PointBody()
    robot = GuideRobot(body, settings=RobotSettings(rolling_speed=0))
    robot.move_forward(1)
    assert body.speed == pytest.approx(0, abs=0.05)


def test_without_eyes_nothing_is_seen() -> None:
    robot = GuideRobot(PointBody())
    assert robot.detect_from_RGB_image("door") == []
    assert robot.read_signs() == []


def test_a_detector_that_wants_to_be_told_what_is_seen_is_refused() -> None:
    robot = GuideRobot(PointBody(), detector=TruthDetector())
    with pytest.raises(DetectorError, match="such as PictureDetector"):
        robot.detect_from_RGB_image("door")
