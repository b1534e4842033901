"""Driving along a given line, whatever it is; for walks whose way is known."""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.pose import turn_between
from memorymaze.simulation.driving import Driver
from memorymaze.simulation.lanes import lane_along
from memorymaze.simulation.path_following import LaneFollower

__all__ = ["follow_line"]

SHARP_VERTEX = math.radians(25)
"""Bend from which on the robot stops at a vertex and turns on the spot."""
ALIGNED = math.radians(2)
NEAR = 0.05
"""Metres within which two places are the same here."""

FloatArray = NDArray[np.float64]


def follow_line(driver: Driver, points: FloatArray, max_speed: float = 1.0) -> bool:
    """Drive to a line's first point, along it and to its end, and come to rest there.

    Args:
        driver: Of the robot that drives.
        points: Vertices, metres, shape (N, 2), N >= 1.
        max_speed: Metres per second.

    Returns:
        Whether it arrived; False when it pushed against something and gave up.
    """
    here = np.array([driver.pose[:2]])
    line = _without_repeats(np.concatenate([here, points]))
    for leg in _legs(line):
        follower = LaneFollower(lane_along(leg, max_speed))
        heading = follower.station.heading
        if abs(turn_between(driver.pose.heading, heading)) > ALIGNED:
            driver.come_to_rest()
            driver.spin_to(heading)
        if driver.follow(follower, math.inf, 0.0) == "blocked":
            return False
    driver.come_to_rest()
    return True


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
