"""Poses and angles in the plane; nothing here knows of sites or robots.

Metres and radians; x east, y north; angles counter-clockwise from +x in (-pi, pi].
"""

import math
from typing import NamedTuple

from memorymaze.basics.geometry.points import XY


class Pose(NamedTuple):
    """Where something stands and which way it faces."""

    x: float
    """East, metres."""
    y: float
    """North, metres."""
    heading: float
    """Radians counter-clockwise from +x, in (-pi, pi]."""

    def at(self, ahead: float, left: float = 0.0) -> XY:
        """Return the place so many metres ahead and to the left.

        >>> Pose(1.0, 2.0, 0.0).at(3.0, 0.5)
        (4.0, 2.5)
        """
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        return (
            self.x + ahead * cosine - left * sine,
            self.y + ahead * sine + left * cosine,
        )


def wrap_angle(angle: float) -> float:
    """Bring an angle in radians into (-pi, pi].

    >>> wrap_angle(3 * math.pi) == math.pi
    True
    >>> wrap_angle(-math.pi) == math.pi
    True
    """
    wrapped = math.remainder(angle, 2 * math.pi)
    return math.pi if wrapped <= -math.pi else wrapped


def turn_between(heading: float, target_heading: float) -> float:
    """Return the signed turn from one heading to another, left positive."""
    return wrap_angle(target_heading - heading)


def moved(place: XY, heading: float, distance: float) -> XY:
    """Return the place so many metres away along a heading."""
    return (
        place[0] + distance * math.cos(heading),
        place[1] + distance * math.sin(heading),
    )


def heading_to(
    start: tuple[float, float] | Pose, end: tuple[float, float] | Pose
) -> float:
    """Return the heading of the line from one point to another, which must differ."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    if dx == 0 and dy == 0:
        raise ValueError(f"no heading between coinciding points at {start[:2]}")
    return wrap_angle(math.atan2(dy, dx))


def bearing_to(pose: Pose, point: tuple[float, float]) -> float:
    """Return the direction of a point seen from a pose, left positive.

    >>> round(bearing_to(Pose(0, 0, 0), (0, 2)), 3)
    1.571
    """
    return turn_between(pose.heading, heading_to(pose, point))
