"""The lower end: an agent that stops where it stands."""

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.robot.api.control import Robot


class StopAgent:
    """Says "we are there" at once, whatever it is told."""

    name = "stop"

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Stop."""
        robot.stop()
