"""The upper end: an agent that is given the answer."""

from collections.abc import Sequence

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.robot.api import Robot
from memorymaze.simulation import SimulatedRobot


class OracleAgent:
    """Follows the reference path of its episode and stops at the goal.

    It shows what the robot's body can reach, whatever is understood of the text.

    Args:
        reference_path: Vertices, metres.
    """

    name = "oracle"

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
        """Drive along the reference path.

        Raises:
            TypeError: The robot is not a simulated one.
        """
        if not isinstance(robot, SimulatedRobot):
            raise TypeError(
                f"the oracle needs a SimulatedRobot, got {type(robot).__name__}"
            )
        robot.follow(self._reference_path)
        robot.stop()
