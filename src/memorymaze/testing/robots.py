"""What every robot must do that agents drive."""

from collections.abc import Callable, Sequence
from typing import cast

import numpy as np

from memorymaze.basics.errors import EpisodeOver, RenderingError
from memorymaze.robot.api.control import (
    DETECTION_RANGE,
    DIRECTIONS,
    READING_RANGE,
    Detection,
    MoveResult,
    Robot,
    SignText,
    TurnResult,
)
from memorymaze.robot.api.steps import SteppingRobot
from memorymaze.testing.expectation import expect

SLACK = 0.05
"""Metres, and metres per metre, by which odometers and moves may differ."""


def check_robot(robot: Robot) -> None:
    """Check that a robot keeps the contract of the control API.

    It drives half a metre ahead, turns around and to and fro, and stops, so the episode is over
    afterwards. One that goes by steps, as all robots of runs do, also takes a step of
    10 cm, turns a little, scans and takes a picture where it can.

    Args:
        robot: At the beginning of an episode, with at least a metre of room ahead.

    Raises:
        AssertionError: It breaks the contract.
    """
    expect(_is_a(Robot, robot), "all functions of the API", type(robot).__name__)
    _check_looks(robot)
    _check_move(robot)
    _check_turn(robot)
    if _is_a(SteppingRobot, robot):
        _check_steps(cast(SteppingRobot, robot))
    _check_end(robot)


def _check_looks(robot: Robot) -> None:
    directions = robot.detect_turning_point()
    expect(
        _is_a(list, directions)
        and set(directions) <= set(DIRECTIONS) - {"around"}
        and len(set(directions)) == len(directions),
        "detect_turning_point: a list of different directions, none of them `around`",
        directions,
    )
    number = robot.turning_point_id()
    expect(
        number is None or (type(number) is int and number >= 1),
        "turning_point_id: None or a number from 1",
        number,
    )
    expect(
        number is not None or not directions,
        "detect_turning_point: nothing outside turning points",
        directions,
    )
    expect(robot.say("Hello.") is None, "say: None", "something else")
    first = robot.detect_from_RGB_image("door")
    _check_detections(first)
    second = robot.detect_from_RGB_image("door")
    expect(
        [each.track_id for each in first] == [each.track_id for each in second],
        "detect_from_RGB_image: the same track_ids when nothing has moved",
        second,
    )
    _expect_value_error(
        lambda: robot.detect_from_RGB_image(""), "detect_from_RGB_image('')"
    )
    signs = robot.read_signs()
    _check_signs(signs)
    again = robot.read_signs()
    expect(
        [each.track_id for each in signs] == [each.track_id for each in again],
        "read_signs: the same track_ids when nothing has moved",
        again,
    )


def _check_signs(signs: Sequence[SignText]) -> None:
    distances = [each.distance for each in signs]
    expect(
        distances == sorted(distances), "read_signs: the nearest text first", distances
    )
    for each in signs:
        expect(
            _is_a(str, each.text)
            and each.text == " ".join(each.text.split()) != ""
            and 0 <= each.distance <= READING_RANGE
            and -180 <= each.bearing_deg <= 180
            and type(each.track_id) is int,
            "a text of one line within 6 m",
            each,
        )


def _check_detections(found: Sequence[Detection]) -> None:
    distances = [each.distance for each in found]
    expect(
        distances == sorted(distances),
        "detect_from_RGB_image: the nearest first",
        distances,
    )
    for each in found:
        left, top, right, bottom = each.box
        expect(
            0 <= each.distance <= DETECTION_RANGE
            and 0 <= left <= right <= 640
            and 0 <= top <= bottom <= 480
            and 0 <= each.score <= 1
            and -180 <= each.bearing_deg <= 180
            and type(each.track_id) is int,
            "a detection within 4 m and inside the 640x480 picture",
            each,
        )


def _check_move(robot: Robot) -> None:
    for nonsense in (0, -1.0, float("nan"), float("inf"), True, "1", None):
        _expect_value_error(
            lambda distance=nonsense: robot.move_forward(distance),  # type: ignore[arg-type]
            f"move_forward({nonsense!r})",
        )
    expect(
        robot.distance_travelled() == 0,
        "distance_travelled: 0 before the first move",
        robot.distance_travelled(),
    )
    result = robot.move_forward(0.5)
    expect(
        _is_a(MoveResult, result)
        and result.reason in ("done", "wall", "obstacle", "budget")
        and 0 <= result.distance <= 0.5 + SLACK,
        "move_forward(0.5): a MoveResult of at most 0.5 m",
        result,
    )
    expect(
        result.reason != "done" or result.distance >= 0.5 - SLACK,
        "move_forward(0.5): 0.5 m when it is `done`",
        result,
    )
    driven = robot.distance_travelled()
    expect(
        abs(driven - result.distance) <= SLACK,
        f"distance_travelled: {result.distance:.3f} m after the first move",
        driven,
    )


def _check_turn(robot: Robot) -> None:
    refused = robot.turn("sideways")
    expect(
        _is_a(TurnResult, refused)
        and not refused.turned
        and refused.angle_deg == 0
        and all(direction in refused.message for direction in DIRECTIONS),
        "turn('sideways'): not turned, and a message with the directions there are",
        refused,
    )
    around = robot.turn("around")
    expect(
        around.turned and 90 <= abs(around.angle_deg) <= 180,
        "turn('around'): turned, from anywhere",
        around,
    )
    for nonsense in (361.0, float("nan"), float("inf"), True, "90", None):
        _expect_value_error(
            lambda angle=nonsense: robot.turn_by(angle),  # type: ignore[arg-type]
            f"turn_by({nonsense!r})",
        )
    for degrees in (0.0, 30.0, -30.0):
        faced = robot.turn_by(degrees)
        expect(
            faced.turned and abs(faced.angle_deg - degrees) <= 1,
            f"turn_by({degrees:g}): turned by that, from anywhere",
            faced,
        )


def _check_steps(robot: SteppingRobot) -> None:
    for nonsense in (0, -1.0, float("nan"), True, "1", None):
        _expect_value_error(
            lambda distance=nonsense: robot.step_forward(distance),  # type: ignore[arg-type]
            f"step_forward({nonsense!r})",
        )
    for nonsense in (0, 7.0, float("inf"), True, "1", None):
        _expect_value_error(
            lambda angle=nonsense: robot.rotate(angle),  # type: ignore[arg-type]
            f"rotate({nonsense!r})",
        )
    moved = robot.step_forward(0.1)
    expect(abs(moved) <= 0.1 + SLACK, "step_forward(0.1): at most 0.1 m", moved)
    turned = robot.rotate(0.3) + robot.rotate(-0.3)
    expect(
        abs(turned) <= SLACK, "rotate: to the left, and as much to the right", turned
    )
    scan = robot.lidar_scan()
    expect(
        scan.ranges.shape[-1:] == scan.angles.shape
        and not bool(np.isnan(scan.ranges).any())
        and bool((np.diff(scan.angles) > 0).all()),
        "lidar_scan: a range for each of ascending angles, never nan",
        scan,
    )
    try:
        picture = robot.camera_picture(64, 48)
    except RenderingError:
        return
    expect(
        picture.rgb.shape == (48, 64, 3) and picture.depth.shape == (48, 64),
        "camera_picture(64, 48): colours (48, 64, 3) and depth (48, 64)",
        (picture.rgb.shape, picture.depth.shape),
    )


def _check_end(robot: Robot) -> None:
    _expect_over(robot.stop, "stop()")
    calls: list[tuple[str, Callable[[], object]]] = [
        ("move_forward(0.5)", lambda: robot.move_forward(0.5)),
        ("detect_turning_point()", robot.detect_turning_point),
        ("turning_point_id()", robot.turning_point_id),
        ("turn('around')", lambda: robot.turn("around")),
        ("turn_by(30)", lambda: robot.turn_by(30)),
        ("detect_from_RGB_image('door')", lambda: robot.detect_from_RGB_image("door")),
        ("read_signs()", robot.read_signs),
        ("say('Bye.')", lambda: robot.say("Bye.")),
        ("distance_travelled()", robot.distance_travelled),
        ("stop()", robot.stop),
    ]
    if _is_a(SteppingRobot, robot):
        stepping = cast(SteppingRobot, robot)
        calls += [
            ("step_forward(0.1)", lambda: stepping.step_forward(0.1)),
            ("rotate(0.3)", lambda: stepping.rotate(0.3)),
            ("camera_picture()", stepping.camera_picture),
        ]
    for name, call in calls:
        _expect_over(call, f"{name} after stop()")


def _is_a(kind: type, value: object) -> bool:
    # What is checked may be anything, whatever its annotations say.
    return isinstance(value, kind)


def _expect_value_error(call: Callable[[], object], name: str) -> None:
    try:
        got = call()
    except ValueError:
        return
    raise AssertionError(f"expected {name} to raise ValueError; got {got!r}")


def _expect_over(call: Callable[[], object], name: str) -> None:
    try:
        got = call()
    except EpisodeOver as over:
        expect(over.stopped_by == "agent", f"{name}: stopped by agent", over)
        return
    raise AssertionError(f"expected {name} to raise EpisodeOver; got {got!r}")
