from collections.abc import Callable

import pytest

from memorymaze.geometry.pose import Pose
from memorymaze.robot.api import Detection, Direction, MoveResult, TurnResult
from memorymaze.simulation import SimulatedRobot, build_scene
from memorymaze.sites import Site
from memorymaze.testing import check_robot


class Deaf(SimulatedRobot):
    def turn(self, direction: str) -> TurnResult:
        return TurnResult(False, 0.0, "no")


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


def test_the_simulated_robot_keeps_the_contract(
    put: Callable[[type[SimulatedRobot]], SimulatedRobot],
) -> None:
    check_robot(put(SimulatedRobot))


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        (Deaf, "not turned, and a message"),
        (Boasting, "at most 0.5 m"),
        (Forgetful, "within 4 m"),
        (Inventive, "nothing outside turning points"),
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
