import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.robot.simulation.conftest import PutRobot

from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import (
    CommandError,
    EpisodeOver,
    ProgramError,
    SettingsError,
)
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.api.specification import API_NAMES, api_specification
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.steering.calls import TraceEvent

MILLIMETRE = 0.001
TENTH_OF_A_DEGREE = math.radians(0.1)
STEPS_ONLY = ("step_forward", "rotate", "camera_picture")


def off_course(before: Pose, after: Pose) -> tuple[float, float]:
    """Return metres ahead and metres aside, seen from where it stood before."""
    dx, dy = after.x - before.x, after.y - before.y
    cosine, sine = math.cos(before.heading), math.sin(before.heading)
    return dx * cosine + dy * sine, dy * cosine - dx * sine


@pytest.mark.parametrize("seed", range(3))
def test_a_step_is_as_long_and_as_straight_as_asked(
    put_robot: PutRobot, seed: int
) -> None:
    robot = put_robot("corridor", 2, 0.4, 3, seed=seed)
    for _ in range(20):
        before = robot.pose
        moved = robot.step_forward(0.25)
        ahead, aside = off_course(before, robot.pose)
        assert moved == pytest.approx(0.25, abs=MILLIMETRE)
        assert ahead == pytest.approx(0.25, abs=MILLIMETRE)
        assert abs(aside) < 3 * MILLIMETRE
        turned = turn_between(before.heading, robot.pose.heading)
        assert abs(turned) < TENTH_OF_A_DEGREE


@pytest.mark.parametrize("degrees", [15, -15, 30, -30, 90, 180, -350, 360])
def test_a_turn_is_as_wide_as_asked_and_on_the_spot(
    put_robot: PutRobot, degrees: float
) -> None:
    robot = put_robot("corridor", 5, 0, 40)
    for _ in range(4):
        before = robot.pose
        angle = math.radians(degrees)
        assert robot.rotate(angle) == pytest.approx(angle, abs=TENTH_OF_A_DEGREE)
        error = turn_between(before.heading + angle, robot.pose.heading)
        assert abs(error) < TENTH_OF_A_DEGREE
        assert math.dist(before[:2], robot.pose[:2]) < 5 * MILLIMETRE


@given(
    st.lists(
        st.one_of(
            st.tuples(st.just("step_forward"), st.floats(0.02, 0.6)),
            st.tuples(
                st.just("rotate"),
                st.floats(-3.1, 3.1).filter(lambda angle: abs(angle) > 0.01),
            ),
        ),
        min_size=1,
        max_size=6,
    )
)
def test_steps_end_at_rest_and_tell_what_happened(
    scenes: dict[str, Scene], steps: list[tuple[str, float]]
) -> None:
    robot = SimulatedRobot(scenes["two_rooms"], Pose(3, 3, 0.3))
    for name, amount in steps:
        before, since = robot.pose, robot.time
        done = getattr(robot, name)(amount)
        ahead, _ = off_course(before, robot.pose)
        turned = turn_between(before.heading, robot.pose.heading)
        if name == "step_forward":
            assert done == pytest.approx(ahead, abs=1e-9)
            assert done <= amount + MILLIMETRE
        else:
            assert done == pytest.approx(turned, abs=TENTH_OF_A_DEGREE)
        assert robot.time > since
        stands = robot.pose
        robot.distance_travelled()
        assert robot.pose == stands


def test_a_step_goes_straight_on_where_a_move_keeps_to_the_middle(
    put_robot: PutRobot,
) -> None:
    stepping = put_robot("corridor", 2, 0.9)
    moving = put_robot("corridor", 2, 0.9)
    stepping.step_forward(5)
    moving.move_forward(5)
    assert stepping.pose.y == pytest.approx(0.9, abs=0.01)
    assert moving.pose.y == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("degrees", [0, 20, 45, 90])
def test_a_wall_stops_a_step_and_is_a_collision(
    put_robot: PutRobot, degrees: float
) -> None:
    robot = put_robot("corridor", 16, 0, degrees)
    free = min(
        3.75 / math.cos(math.radians(degrees)),
        1.25 / max(math.sin(math.radians(degrees)), 1e-9),
    )
    # Where it grazes the wall, it slides along while it brakes.
    braking = 1.0 / (2 * 1.5) if degrees else 0.0
    assert free - 0.02 < robot.step_forward(6) < free + braking + 0.02
    assert {each.kind for each in robot.collisions} == {"wall"}
    assert robot.step_forward(0.25) == pytest.approx(0, abs=0.08)
    robot.rotate(math.pi)
    assert robot.step_forward(1) == pytest.approx(1, abs=MILLIMETRE)


def test_steps_stand_in_the_trace_and_count_as_calls(put_robot: PutRobot) -> None:
    events: list[TraceEvent] = []
    robot = put_robot("corridor", 2, 0, events=events)
    moved = robot.step_forward(0.25)
    turned = robot.rotate(0.3)
    robot.camera_picture(32, 24)
    assert [(each.call, each.result) for each in events] == [
        ("step_forward", moved),
        ("rotate", turned),
        ("camera_picture", None),
    ]
    assert [dict(each.arguments) for each in events] == [
        {"distance": 0.25},
        {"angle": 0.3},
        {"width": 32, "height": 24, "horizontal_fov": math.pi / 2},
    ]
    assert robot.calls == 3
    assert robot.distance_travelled() == pytest.approx(0.25, abs=0.01)


def test_a_picture_shows_what_the_camera_frame_shows(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    picture = robot.camera_picture(48, 32, math.radians(80))
    frame = robot.camera_frame(48, 32, math.radians(80))
    assert (picture.rgb == frame.rgb).all()
    assert (picture.depth == frame.depth).all()
    assert (picture.rgb.shape, picture.depth.shape) == ((32, 48, 3), (32, 48))


@pytest.mark.parametrize(("call", "asked"), [("step_forward", 10), ("rotate", 6)])
def test_the_time_budget_cuts_a_step_short(
    put_robot: PutRobot, call: str, asked: float
) -> None:
    robot = put_robot("corridor", 2, 0, time_budget=1.0)
    assert 0 < getattr(robot, call)(asked) < asked
    assert robot.stopped_by == "budget"
    with pytest.raises(EpisodeOver):
        robot.step_forward(1)


def test_refuses_steps_back_turns_of_more_than_a_circle_and_odd_pictures(
    put_robot: PutRobot,
) -> None:
    robot = put_robot("corridor", 2, 0)
    with pytest.raises(CommandError, match=r"got -0\.25"):
        robot.step_forward(-0.25)
    with pytest.raises(CommandError, match="full turn"):
        robot.rotate(90)
    with pytest.raises(SettingsError, match="width"):
        robot.camera_picture(0, 10)


def test_moves_and_turns_go_on_from_where_steps_have_led(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 10, 0)
    robot.move_forward(1)
    robot.rotate(math.pi)
    assert robot.move_forward(4).reason == "done"
    assert robot.pose.x == pytest.approx(7, abs=0.2)
    corner = put_robot("crossing", -3, 0)
    while corner.turning_point_id() is None:
        corner.step_forward(0.25)
    assert "left" in corner.detect_turning_point()


@pytest.mark.parametrize("name", STEPS_ONLY)
def test_programs_do_not_get_steps(put_robot: PutRobot, name: str) -> None:
    assert name not in API_NAMES
    assert name not in api_specification()
    robot = put_robot("corridor", 2, 0)
    with pytest.raises(ProgramError, match=name):
        run_program(f"{name}(1)", robot)
    assert robot.calls == 0


def test_driving_at_given_speeds_rolls_on(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    driven = [robot.drive(0.5, 0.0, 1.0) for _ in range(3)]
    assert robot.time == pytest.approx(3.0)
    # Speeding up at 1.5 m/s2 costs the first second 0.08 m.
    assert driven == pytest.approx([0.42, 0.5, 0.5], abs=0.02)
    robot.drive(0.0, 1.0, 1.5)
    assert robot.pose.heading > 1
    for name, numbers in {
        "speed": (1.5, 0.0, 1.0),
        "turn_rate": (0.0, 9.0, 1.0),
        "seconds": (0.0, 0.0, 0.0),
    }.items():
        with pytest.raises(CommandError, match=f"drive: expected {name}"):
            robot.drive(*numbers)
