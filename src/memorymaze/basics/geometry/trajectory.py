"""Timed poses: what a robot really did, whatever it was asked to do."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.pose import Pose


class TimedPose(NamedTuple):
    """Where something stood at a moment, and which way it faced."""

    time: float
    """Seconds since the start of the episode."""
    x: float
    """East, metres."""
    y: float
    """North, metres."""
    heading: float
    """Radians counter-clockwise from +x, in (-pi, pi]."""

    @property
    def pose(self) -> Pose:
        """The pose without its time."""
        return Pose(self.x, self.y, self.heading)


@dataclass(frozen=True)
class Trajectory:
    """Poses in the order of time; at least one.

    >>> walk = Trajectory([TimedPose(0, 0, 0, 0), TimedPose(2, 1.5, 0, 0)])
    >>> walk.length, walk.duration
    (1.5, 2.0)
    """

    poses: tuple[TimedPose, ...]
    """Times never decrease; equal times are allowed."""

    def __init__(self, poses: Iterable[TimedPose]) -> None:
        """Keep the poses, checked."""
        object.__setattr__(self, "poses", tuple(TimedPose(*pose) for pose in poses))
        if not self.poses:
            raise ValueError("a trajectory needs at least one pose, got none")
        table = np.array(self.poses, dtype=np.float64)
        wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
        if len(wrong):
            raise ValueError(f"pose {wrong[0]} is not finite: {self.poses[wrong[0]]}")
        backwards = np.flatnonzero(np.diff(table[:, 0]) < 0)
        if len(backwards):
            first = int(backwards[0])
            raise ValueError(
                f"time runs backwards from {self.poses[first].time} s at pose {first} "
                f"to {self.poses[first + 1].time} s"
            )

    @cached_property
    def points(self) -> NDArray[np.float64]:
        """Positions, metres, shape (N, 2); read-only."""
        points = np.array([(pose.x, pose.y) for pose in self.poses], dtype=np.float64)
        points.flags.writeable = False
        return points

    @cached_property
    def length(self) -> float:
        """Metres along the positions; turning on the spot adds nothing."""
        return polyline.length(self.points)

    @property
    def duration(self) -> float:
        """Seconds from the first pose to the last."""
        return float(self.poses[-1].time - self.poses[0].time)
