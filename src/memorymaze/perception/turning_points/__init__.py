"""Turning points found by LiDAR and odometry alone."""

from memorymaze.perception.turning_points.finder import (
    SensedTurningPoint,
    TurningPointFinder,
)
from memorymaze.perception.turning_points.junctions import SensedWay

__all__ = ["SensedTurningPoint", "SensedWay", "TurningPointFinder"]
