import math

import pytest
from tests.robot.simulation.conftest import PutRobot

from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import CommandError
from memorymaze.robot.steering.calls import TraceEvent


def test_a_thing_that_is_seen_is_faced(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 7.5, 0)
    (bench,) = robot.detect_from_RGB_image("bench")
    assert bench.bearing_deg < -10
    result = robot.turn_by(bench.bearing_deg)
    assert result.turned
    assert result.angle_deg == pytest.approx(bench.bearing_deg, abs=0.2)
    (bench,) = robot.detect_from_RGB_image("bench")
    assert abs(bench.bearing_deg) < 5


def test_a_door_beside_the_way_is_driven_up_to(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 3, 0)
    assert not robot.turn("left").turned
    assert robot.turn_by(90).turned
    assert [sign.text for sign in robot.read_signs()] == ["101"]
    assert robot.move_forward(5).reason == "wall"
    assert robot.pose[:2] == pytest.approx((3, 0.8), abs=0.03)
    assert robot.collisions == ()


def test_the_walk_goes_on_along_the_corridor_after_a_look_aside(
    put_robot: PutRobot,
) -> None:
    robot = put_robot("corridor", 3, 0)
    for degrees in (90, -180, 90):
        robot.turn_by(degrees)
    assert robot.move_forward(5).reason == "done"
    assert robot.pose == pytest.approx((8, 0, 0), abs=0.03)


def test_directions_count_from_what_is_faced(put_robot: PutRobot) -> None:
    robot = put_robot("crossing", 0, 0, 90)
    assert robot.detect_turning_point() == ["left", "right", "forward"]
    robot.turn_by(90)
    # It came from the south, which now lies to the left.
    assert robot.detect_turning_point() == ["right", "forward"]
    assert robot.turn("right").turned
    assert robot.pose.heading == pytest.approx(math.pi / 2, abs=0.02)


def test_refuses_angles_that_no_float_holds(put_robot: PutRobot) -> None:
    with pytest.raises(CommandError, match="degrees, left positive"):
        put_robot("corridor", 3, 0).turn_by(10**400)


def test_a_turn_by_degrees_ends_when_the_time_is_used_up(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 3, 0, time_budget=0.5)
    assert not robot.turn_by(180).turned
    assert robot.stopped_by == "budget"


def test_a_program_faces_the_door_that_it_sees(put_robot: PutRobot) -> None:
    events: list[TraceEvent] = []
    robot = put_robot("corridor", 1, 0, events=events)
    program = 'turn_by(detect_from_RGB_image("door")[0].bearing_deg)\nread_signs()\n'
    run_program(program, robot)
    assert [event.call for event in events][1:] == ["turn_by", "read_signs"]
    assert "101" in str(events[-1].result)
