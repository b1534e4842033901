"""What every body must do that steering drives: frames, units, signs."""

import math

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import RenderingError, RobotBodyError
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.robot.api.sensors_and_motion import (
    OdometryReading,
    SensorsAndMotion,
    checked_place,
    checked_reading,
)
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.simulation.own_body import KnowsItsPlace
from memorymaze.testing.expectation import expect

SPEED, TURN_RATE = 0.25, 0.5
"""Metres per second and radians per second of the motions that are tried."""
PERIOD, PERIODS = 0.05, 40
"""Seconds of a command, and how many of them make a motion."""
SHARE = 0.3
"""Share of a motion by which it may fall short: bodies speed up slowly."""
NEAR = 0.1
"""Metres by which the LiDAR may see a wall elsewhere than odometry tells."""


def check_sensors_and_motion(body: SensorsAndMotion) -> None:
    """Check that a body keeps the contract of `SensorsAndMotion`.

    It drives half a metre ahead and back, and turns a radian to the left and back. Where
    it has a `pose_in_site`, that must tell a `Pose`.

    Args:
        body: At rest, with 1.5 m of room ahead, walls in sight, and nothing that moves.

    Raises:
        AssertionError: It breaks the contract.
    """
    _check_scan(body.lidar_scan())
    _check_picture(body)
    _check_ahead(body)
    _check_turn(body)
    rested = _go(body, 0.0, 0.0)
    expect(rested.speed <= 0.02, "drive(0, 0, …): standing still in the end", rested)


def _go(body: SensorsAndMotion, speed: float, turn_rate: float) -> OdometryReading:
    before = _odometry(body)
    for _ in range(PERIODS):
        body.drive(speed, turn_rate, PERIOD)
    after = _odometry(body)
    passed = after.time - before.time
    expect(
        0.9 * PERIODS * PERIOD <= passed <= 2 * PERIODS * PERIOD,
        f"drive: {PERIODS} times {PERIOD} s to take about {PERIODS * PERIOD:g} s",
        passed,
    )
    expect(after.speed >= 0, "odometry: a speed of at least 0", after)
    return after


def _odometry(body: SensorsAndMotion) -> OdometryReading:
    """Read where it believes it is; it must tell that, and where it is, as runs need it."""
    try:
        if isinstance(body, KnowsItsPlace):
            checked_place(body.pose_in_site())
        return checked_reading(body.odometry())
    except RobotBodyError as error:
        raise AssertionError(str(error)) from error


def _check_scan(scan: LidarScan) -> None:
    count = len(scan.angles)
    expect(
        scan.ranges.shape == (count,) and not bool(np.isnan(scan.ranges).any()),
        "lidar_scan: one beam, a range for each angle, never nan",
        scan.ranges.shape,
    )
    steps = np.diff(scan.angles)
    expect(
        count >= 90 and np.allclose(steps, 2 * math.pi / count, atol=1e-3),
        "lidar_scan: at least 90 angles evenly round the full circle, ascending",
        (count, steps.min(), steps.max()),
    )
    expect(bool(np.isfinite(scan.ranges).any()), "lidar_scan: walls in sight", "none")


def _check_picture(body: SensorsAndMotion) -> None:
    try:
        picture = body.camera_picture(64, 48)
    except RenderingError:
        return
    expect(
        picture.rgb.shape == (48, 64, 3)
        and picture.depth.shape == (48, 64)
        and not bool((picture.depth < 0).any()),
        "camera_picture(64, 48): colours (48, 64, 3) and depth (48, 64) in metres",
        (picture.rgb.shape, picture.depth.shape),
    )


def _check_ahead(body: SensorsAndMotion) -> None:
    """Drive ahead and back: odometry and LiDAR must tell the same of both."""
    asked = SPEED * PERIODS * PERIOD
    before, room = _odometry(body), _room_ahead(body)
    expect(room >= 1.2, "lidar_scan: 1.2 m of room at angle 0, straight ahead", room)
    _go(body, SPEED, 0.0)
    after = _go(body, 0.0, 0.0)
    dx, dy = after.pose.x - before.pose.x, after.pose.y - before.pose.y
    cosine, sine = math.cos(before.pose.heading), math.sin(before.pose.heading)
    ahead, aside = dx * cosine + dy * sine, dy * cosine - dx * sine
    expect(
        (1 - SHARE) * asked <= ahead <= (1 + SHARE) * asked and abs(aside) <= NEAR,
        f"drive({SPEED}, 0): odometry {asked:g} m farther along its heading",
        (ahead, aside),
    )
    nearer = room - _room_ahead(body)
    expect(
        not math.isfinite(room) or abs(nearer - ahead) <= NEAR,
        f"lidar_scan: what is straight ahead {ahead:.2f} m nearer, as odometry says",
        nearer,
    )
    _go(body, -SPEED, 0.0)
    back = _go(body, 0.0, 0.0)
    gone = math.dist(back.pose[:2], before.pose[:2])
    expect(gone <= SHARE * asked, f"drive({-SPEED}, 0): back to where it was", gone)


def _check_turn(body: SensorsAndMotion) -> None:
    """Turn to the left: headings grow, and what was seen moves to the right."""
    asked = TURN_RATE * PERIODS * PERIOD
    before, seen = _odometry(body), _smooth(body.lidar_scan())
    _go(body, 0.0, TURN_RATE)
    after = _go(body, 0.0, 0.0)
    turned = turn_between(before.pose.heading, after.pose.heading)
    expect(
        (1 - SHARE) * asked <= turned <= (1 + SHARE) * asked,
        f"drive(0, {TURN_RATE}): a heading {asked:g} rad greater, left positive",
        turned,
    )
    now = _smooth(body.lidar_scan())
    shift = round(turned / (2 * math.pi) * len(now))
    right, wrong = (
        float(np.median(np.abs(np.roll(seen, by) - now))) for by in (-shift, shift)
    )
    expect(
        right <= wrong,
        "lidar_scan: angles left positive, so that a turn to the left moves what is seen "
        "to the right",
        f"{right:.2f} m apart so, {wrong:.2f} m the other way",
    )
    _go(body, 0.0, -TURN_RATE)


def _room_ahead(body: SensorsAndMotion) -> float:
    scan = body.lidar_scan()
    return float(np.median(scan.ranges[np.abs(scan.angles) < math.radians(3)]))


def _smooth(scan: LidarScan) -> NDArray[np.float64]:
    return np.minimum(scan.ranges, 10.0)
