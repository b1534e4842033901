"""Things left in the way and people who walk about: a setting of a run.

How many there are, where they stand and walk, and what the robot meets of them. How it
gets past them is in `steering`.
"""

from memorymaze.robot.simulation.obstacles.settings import (
    LEVELS,
    ObstacleSettings,
    PassersBy,
    parse_obstacles,
)

__all__ = ["LEVELS", "ObstacleSettings", "PassersBy", "parse_obstacles"]
