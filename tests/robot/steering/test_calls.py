from collections.abc import Callable

import pytest
from tests.robot.simulation.conftest import PutRobot

from memorymaze.basics.errors import EpisodeOver
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.settings import SimulationSettings

ApiSays = Callable[[str], None]


def repeat(call: Callable[[], object], times: int) -> None:
    for _ in range(times):
        call()


def test_a_move_ends_when_the_time_is_used_up(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0, time_budget=5.0)
    result = robot.move_forward(100)
    assert result.reason == "budget"
    assert robot.time == pytest.approx(5, abs=0.06)
    assert robot.stopped_by == "budget"
    with pytest.raises(EpisodeOver) as over:
        robot.say("Still there?")
    assert over.value.stopped_by == "budget"


def test_a_turn_ends_when_the_time_is_used_up(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0, time_budget=1.0)
    result = robot.turn("around")
    assert not result.turned
    assert robot.stopped_by == "budget"


def test_calls_beyond_the_budget_are_refused(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0, call_budget=3)
    for _ in range(3):
        robot.move_forward(0.5)
    with pytest.raises(EpisodeOver) as over:
        robot.move_forward(0.5)
    assert over.value.stopped_by == robot.stopped_by == "budget"
    assert robot.calls == 3


@pytest.mark.parametrize(
    "call",
    [
        pytest.param(lambda robot: robot.move_forward(1), id="against a wall"),
        pytest.param(lambda robot: robot.detect_turning_point(), id="looking"),
        pytest.param(lambda robot: robot.turn("left"), id="turning nowhere"),
        pytest.param(lambda robot: robot.say("Hm."), id="talking"),
    ],
)
def test_calls_that_change_nothing_end_the_episode_as_stuck(
    put_robot: PutRobot, call: Callable[[SimulatedRobot], object]
) -> None:
    robot = put_robot("corridor", 19.3, 0, stuck_limit=10)
    for _ in range(8):
        call(robot)
    assert robot.stopped_by is None
    with pytest.raises(EpisodeOver) as over:
        repeat(lambda: call(robot), 4)
    assert over.value.stopped_by == robot.stopped_by == "stuck"


def test_the_control_api_names_the_limits_of_calls(api_says: ApiSays) -> None:
    limits = SimulationSettings()
    api_says(f"so are calls, to {limits.call_budget:,}.")
    api_says(
        f"After {limits.stuck_limit} calls in a row without motion or anything new"
    )


def test_asking_for_something_else_is_not_stuck(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0, stuck_limit=10)
    for number in range(30):
        robot.detect_from_RGB_image(f"door {number}")
    assert robot.stopped_by is None


def test_walking_on_is_never_stuck(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0, stuck_limit=5)
    for _ in range(12):
        robot.detect_turning_point()
        robot.say("On we go.")
        robot.move_forward(0.5)
    assert robot.stopped_by is None


def test_after_stop_nothing_follows(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    assert robot.finish() == "agent"
    assert robot.finish() == "agent", "finishing twice does nothing"
    with pytest.raises(EpisodeOver):
        robot.stop()
