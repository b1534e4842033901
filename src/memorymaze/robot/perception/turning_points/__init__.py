"""Turning points found by LiDAR and odometry alone."""

from memorymaze.robot.perception.turning_points.finder import (
    SensedTurningPoint,
    TurningPointFinder,
)
from memorymaze.robot.perception.turning_points.junctions import SensedWay
from memorymaze.robot.perception.turning_points.local_map import (
    WallDirections,
    without_drop_outs,
)

__all__ = [
    "SensedTurningPoint",
    "SensedWay",
    "TurningPointFinder",
    "WallDirections",
    "without_drop_outs",
]
