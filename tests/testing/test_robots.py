from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.control import (
    Detection,
    Direction,
    MoveResult,
    Robot,
    TurnResult,
)
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.perception.eyes import Eyes, parse_detector
from memorymaze.robot.simulation.obstacles import parse_obstacles
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.guarded_robot import GuardedRobot
from memorymaze.testing import check_robot
from memorymaze.world.sites import Site


class Deaf(SimulatedRobot):
    def turn(self, direction: str) -> TurnResult:
        return TurnResult(False, 0.0, "no")


class Dizzy(SimulatedRobot):
    def turn_by(self, degrees: float) -> TurnResult:
        result = super().turn_by(degrees)
        return replace(result, angle_deg=result.angle_deg / 2)


class Boasting(SimulatedRobot):
    def move_forward(self, distance: float) -> MoveResult:
        return MoveResult(2 * super().move_forward(distance).distance, "done")


class Forgetful(SimulatedRobot):
    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        found = super().detect_from_RGB_image(object)
        return [*found, Detection("x", (0, 0, 1, 1), 0.5, 9.0, 0.0, 1)]


class Inventive(SimulatedRobot):
    def detect_turning_point(self) -> list[Direction]:
        return ["left"]


class Endless(SimulatedRobot):
    def stop(self) -> None:
        pass


@pytest.fixture
def put(corridor_site: Site) -> Callable[[type[SimulatedRobot]], SimulatedRobot]:
    """Put a robot into a corridor."""
    scene = build_scene(corridor_site)
    return lambda kind: kind(scene, Pose(2, 0, 0))


class Leaping(SimulatedRobot):
    def step_forward(self, distance: float) -> float:
        return 3 * super().step_forward(distance)


class Dazzled(SimulatedRobot):
    def lidar_scan(self) -> LidarScan:
        scan = super().lidar_scan()
        return replace(scan, ranges=np.full_like(scan.ranges, np.nan))


LIDAR = SimulationSettings(turning_points="lidar")
MISTAKEN = Eyes(parse_detector("truth:errors"))


@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda *at: GuardedRobot(SimulatedRobot(*at)), id="guarded"),
        pytest.param(lambda *at: SimulatedRobot(*at, LIDAR), id="by LiDAR"),
        pytest.param(
            lambda *at: SimulatedRobot(
                *at, detector=MISTAKEN.detector_for(np.random.default_rng(0))
            ),
            id="with mistakes",
        ),
    ],
)
def test_every_robot_keeps_the_contract(
    corridor_site: Site, make: Callable[..., Robot]
) -> None:
    check_robot(make(build_scene(corridor_site), Pose(2, 0, 0)))


def test_a_robot_among_obstacles_keeps_the_contract(corridor_site: Site) -> None:
    crowded = build_scene(corridor_site, parse_obstacles("heavy"))
    check_robot(SimulatedRobot(crowded, Pose(2, 0, 0)))


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        (Deaf, "not turned, and a message"),
        (Dizzy, r"turn_by\(30\): turned by that"),
        (Boasting, "at most 0.5 m"),
        (Forgetful, "within 4 m"),
        (Inventive, "nothing outside turning points"),
        (Leaping, "at most 0.1 m"),
        (Dazzled, "never nan"),
        (Endless, r"stop\(\) to raise EpisodeOver"),
    ],
)
def test_a_robot_that_breaks_the_contract_is_told_how(
    kind: type[SimulatedRobot],
    said: str,
    put: Callable[[type[SimulatedRobot]], SimulatedRobot],
) -> None:
    with pytest.raises(AssertionError, match=said):
        check_robot(put(kind))
