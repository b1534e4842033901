"""Driving along a given line, whatever it is; for walks whose way is known."""

import math
from itertools import pairwise
from typing import Literal

import numpy as np

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.robot.steering.detours import FreeSpace
from memorymaze.robot.steering.driving import Driver
from memorymaze.robot.steering.floor import GETS_PAST, LOOK_AROUND, Surroundings
from memorymaze.robot.steering.lanes import (
    Lane,
    LaneFollower,
    lane_along,
    lane_round_things,
)

SHARP_VERTEX = math.radians(25)
"""Bend from which on the robot stops at a vertex and turns on the spot."""
ALIGNED = math.radians(2)
NEAR = 0.05
"""Metres within which two places are the same here."""

LONGEST_WAIT = 60.0
"""Seconds without getting on after which it gives up."""
GOT_ON = 0.3
"""Metres that count as getting on."""

FollowEnd = Literal["arrived", "blocked", "obstacle"]


def follow_line(
    driver: Driver, points: FloatArray, max_speed: float = 1.0
) -> FollowEnd:
    """Drive to a line's first point, along it (N, 2), and come to rest at its end.

    It is `blocked` when it pushed against something and gave up; `obstacle` where
    things or people stand that it cannot get past.
    """
    here = np.array([driver.pose[:2]])
    line = _without_repeats(np.concatenate([here, points]))
    surroundings = driver.floor.surroundings
    for leg in _legs(line):
        if surroundings is not None:
            how = _follow_among_people(driver, leg, max_speed, surroundings)
            if how != "arrived":
                return how
            continue
        follower = _joined(driver, lane_along(leg, max_speed))
        if driver.follow(follower, math.inf, 0.0) == "blocked":
            return "blocked"
    driver.come_to_rest()
    return "arrived"


def _follow_among_people(
    driver: Driver, leg: FloatArray, max_speed: float, surroundings: Surroundings
) -> FollowEnd:
    """Drive along a straight leg, round things; wait for people or go round them."""
    driver.held_for = 0.0
    lane = _rest_of(leg, driver, max_speed, driver.floor.clearance)
    if lane is None:
        return "arrived"
    follower = _joined(driver, lane)
    before, until = driver.distance, driver.time + LONGEST_WAIT
    while True:
        how = driver.follow(follower, math.inf, 0.0, driver.held_for + LOOK_AROUND)
        if how == "blocked":
            return "blocked"
        if how == "end" and follower.lane.end == "done":
            return "arrived"
        if driver.distance - before > GOT_ON:
            before, until = driver.distance, driver.time + LONGEST_WAIT
        elif driver.time > until:
            driver.come_to_rest()
            return "obstacle"
        clearance = surroundings.clearance_now(driver.pose[:2])
        needed = follower.remaining
        if how == "end":
            driver.wait(LOOK_AROUND)
            clearance, needed = clearance or driver.floor.clearance, GETS_PAST
        elif driver.room_ahead is not None:
            needed = min(needed, driver.room_ahead + GETS_PAST)
        if clearance is not None:
            lane = _rest_of(leg, driver, max_speed, clearance)
            if lane is None:
                return "arrived"
            if lane.length >= needed or (how == "end" and lane.end == "done"):
                follower = _joined(driver, lane)


def _joined(driver: Driver, lane: Lane) -> LaneFollower:
    """Begin a lane, facing along it."""
    follower = LaneFollower(lane)
    heading = follower.station.heading
    if abs(turn_between(driver.pose.heading, heading)) > ALIGNED:
        driver.come_to_rest()
        driver.spin_to(heading)
    return follower


def _rest_of(
    leg: FloatArray, driver: Driver, max_speed: float, clearance: FreeSpace
) -> Lane | None:
    """Return the lane along what is left of a leg; None where nothing is left."""
    here = driver.pose[:2]
    s = polyline.project(leg, here).s
    along = polyline.arc_lengths(leg)
    if along[-1] - s < NEAR and math.dist(here, leg[-1]) < GOT_ON:
        return None
    begin = polyline.point_at(leg, min(s, float(along[-1]) - NEAR))
    rest = np.concatenate([[begin], leg[along > s + NEAR / 2]])
    if len(rest) < 2:
        rest = np.array([begin, leg[-1]])
    return lane_round_things(rest, here, max_speed, clearance)


def _without_repeats(points: FloatArray) -> FloatArray:
    kept = [points[0]]
    for point in points[1:]:
        if math.dist(point, kept[-1]) > NEAR:
            kept.append(point)
    return np.array(kept)


def _legs(line: FloatArray) -> list[FloatArray]:
    """Cut a line at its sharp vertices."""
    steps = np.diff(line, axis=0)
    headings = np.arctan2(steps[:, 1], steps[:, 0]).tolist()
    cuts = [
        vertex
        for vertex in range(1, len(line) - 1)
        if abs(turn_between(headings[vertex - 1], headings[vertex])) > SHARP_VERTEX
    ]
    bounds = [0, *cuts, len(line) - 1]
    return [line[first : last + 1] for first, last in pairwise(bounds) if last > first]
