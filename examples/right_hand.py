"""A whole agent in twenty lines: it ignores the words and keeps to the right.

Try it: memorymaze evaluate --agent examples/right_hand.py:RightHand --limit 12
"""

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.robot.api import Robot


class RightHand:
    """Takes the rightmost way at every turning point, for sixty metres."""

    name = "right_hand"

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        """Drive the robot; returning says "we are there"."""
        last = None
        while robot.distance_travelled() < 60:
            here = robot.turning_point_id()
            if here is not None and here != last:
                ways = robot.detect_turning_point()
                robot.turn("right" if "right" in ways else "forward")
                journal.note("decision", turning_point=here, ways=ways)
            last = here
            if robot.move_forward(0.5).reason == "wall":
                robot.turn("around")
