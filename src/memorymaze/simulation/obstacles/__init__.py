"""Things left in the way and people who walk about: a setting of a run."""

from memorymaze.simulation.obstacles.settings import (
    LEVELS,
    Movable,
    ObstacleSettings,
    parse_obstacles,
)

__all__ = ["LEVELS", "Movable", "ObstacleSettings", "parse_obstacles"]
