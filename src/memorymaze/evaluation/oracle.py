"""The upper end: an agent that is given the answer."""

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.evaluation.guarded_robot import simulated_behind
from memorymaze.robot.api import Robot


class OracleAgent:
    """Follows the reference path of its episode and stops at the goal.

    It shows what the robot's body can reach, whatever is understood of the text.
    """

    name = "oracle"
    needs: ClassVar[frozenset[Need]] = frozenset({"answers"})

    def __init__(self, reference_path: Sequence[tuple[float, float]]) -> None:
        """Remember the way."""
        self._reference_path = tuple(reference_path)

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive along the reference path."""
        simulated_behind(robot, self.name).follow(self._reference_path)
        robot.stop()
