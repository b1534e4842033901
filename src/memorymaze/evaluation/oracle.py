"""The upper end: an agent that is given the answer."""

from typing import ClassVar

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.evaluation.guarded_robot import RobotThatKnows


class OracleAgent:
    """Follows the reference path of its episode and stops at the goal.

    It shows what the robot's body can reach, whatever is understood of the text.
    """

    name = "oracle"
    needs: ClassVar[frozenset[Need]] = frozenset({"answers"})

    def follow(
        self,
        instruction: str,
        robot: RobotThatKnows,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive along the reference path."""
        robot.follow_reference_path()
        robot.stop()
