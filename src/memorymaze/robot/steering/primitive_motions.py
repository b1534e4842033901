"""Motions without help in steering: straight ahead, on the spot, and at given speeds.

Steps and turns are steered by where the robot really is, so they end where they were
asked to, however the wheels err.
"""

import math

from memorymaze.basics.geometry.pose import turn_between
from memorymaze.robot.steering.driving import Driver
from memorymaze.robot.steering.settings import TICK, RobotSettings

BLOCKED_DECISIONS = 40
"""Decisions in a row without motion after which the robot gives up."""
CLOSE_ENOUGH = 0.0004
"""Metres."""
TURNED_ENOUGH = 0.0004
"""Radians."""
BRAKING_SHARE = 0.8
"""Share of the greatest acceleration that planned braking uses."""
APPROACH = 16.0
"""Speed per metre, or turn rate per radian, that is left at the very end; 1/s."""
DECISION = 2
"""Ticks from one decision to the next, so that it stops to the millimetre."""
RECOIL = 0.002
"""Metres that a push against something may seem to move the robot."""
STRAIGHTENING = 6.0
"""Turn rate per radian off the heading, 1/s; and per metre aside times speed, 1/m^2."""


def go_straight(
    driver: Driver,
    distance: float,
    settings: RobotSettings,
    patience: float = math.inf,
) -> float:
    """Drive straight ahead from a stand and come to rest; return metres moved.

    It ends where the robot touches something ahead, or has waited for people for as
    long as `patience` lasts, seconds.
    """
    start = driver.pose
    ahead_x, ahead_y = math.cos(start.heading), math.sin(start.heading)
    braking = BRAKING_SHARE * settings.max_acceleration
    driver.held_for = 0.0
    odometer = driver.distance
    idle = 0
    while idle < BLOCKED_DECISIONS and driver.held_for < patience:
        dx, dy = driver.pose.x - start.x, driver.pose.y - start.y
        left = distance - (dx * ahead_x + dy * ahead_y)
        if left <= CLOSE_ENOUGH:
            break
        speed = min(settings.max_speed, _falling(left, braking))
        speed = min(speed, driver.yielding_speed_to(left, start.heading))
        aside = dy * ahead_x - dx * ahead_y
        error = turn_between(driver.pose.heading, start.heading)
        turn_rate = STRAIGHTENING * (error - speed * aside)
        moved = driver.tick(speed, turn_rate, start.heading, DECISION)
        if driver.floor.is_blocked_ahead(driver.pose, start.heading):
            break
        waits = driver.room_ahead is not None
        slow = moved < 0.1 * driver.speed * DECISION * TICK
        idle = idle + 1 if slow and not waits else 0
    driver.come_to_rest()
    # Else the many steps of a walk would add up what the wheels are off.
    spin_by(driver, turn_between(driver.pose.heading, start.heading), settings)
    dx, dy = driver.pose.x - start.x, driver.pose.y - start.y
    moved = dx * ahead_x + dy * ahead_y
    if moved < RECOIL:
        # To and fro against a wall is no way driven, however often it is tried.
        driver.distance = odometer
    return moved


def spin_by(driver: Driver, angle: float, settings: RobotSettings) -> float:
    """Turn on the spot from a stand and come to rest; return radians turned.

    The angle is left positive; a full turn is one.
    """
    braking = BRAKING_SHARE * settings.max_turn_acceleration
    turned, idle = 0.0, 0
    driver.room_ahead = None
    while idle < BLOCKED_DECISIONS:
        left = angle - turned
        if abs(left) <= TURNED_ENOUGH:
            break
        rate = _falling(abs(left), braking)
        before = driver.pose.heading
        driver.tick(0.0, math.copysign(rate, left), None, DECISION)
        step = turn_between(before, driver.pose.heading)
        turned += step
        slow = abs(step) < 0.1 * abs(driver.turn_rate) * DECISION * TICK
        idle = idle + 1 if slow else 0
    before = driver.pose.heading
    driver.come_to_rest()
    return turned + turn_between(before, driver.pose.heading)


def drive_on(
    driver: Driver, speed: float, turn_rate: float, seconds: float, period: float
) -> float:
    """Go for speeds for some time and roll on afterwards; return metres driven.

    The time is a multiple of `TICK`; `period` is from one decision to the
    next, seconds.
    """
    driver.room_ahead = None
    left, whole = round(seconds / TICK), round(period / TICK)
    driven = 0.0
    while left > 0:
        steps = min(left, whole)
        driven += driver.tick(speed, turn_rate, driver.pose.heading, steps)
        left -= steps
    return driven


def _falling(left: float, braking: float) -> float:
    """Return the speed at which to brake: even first, ever softer at the very end."""
    soft = braking / APPROACH
    return math.sqrt(soft * soft + 2 * braking * left) - soft
