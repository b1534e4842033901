"""Habitat's frame: x east, y up, -z north; rotations as quaternions (x, y, z, w).

A Habitat agent without rotation looks along -z, which is north.
"""

import math
from collections.abc import Sequence

from memorymaze.geometry.pose import Pose, wrap_angle


def to_position(x: float, y: float) -> list[float]:
    """Return a point on the floor in Habitat's frame, metres, shape (3,)."""
    return [x, 0.0, -y]


def from_position(position: Sequence[float]) -> tuple[float, float]:
    """Return a point of Habitat's frame on our floor, metres; its height is dropped."""
    x, _, z = position
    return x, -z


def to_rotation(heading: float) -> list[float]:
    """Return a heading (radians from east) as a quaternion about the y axis.

    >>> to_rotation(math.pi / 2)
    [0.0, 0.0, 0.0, 1.0]
    """
    half = (heading - math.pi / 2) / 2
    return [0.0, math.sin(half), 0.0, math.cos(half)]


def to_heading(rotation: Sequence[float]) -> float:
    """Return the heading in radians from east of a rotation about the y axis."""
    _, y, _, w = rotation
    return wrap_angle(2 * math.atan2(y, w) + math.pi / 2)


def at_start(pose: Pose) -> tuple[list[float], list[float]]:
    """Return position and rotation of a pose."""
    return to_position(pose.x, pose.y), to_rotation(pose.heading)
