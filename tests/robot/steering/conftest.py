"""Steering is tested on simulated robots, in the buildings made for their tests."""

from tests.robot.simulation.conftest import plans, put_robot

__all__ = ["plans", "put_robot"]
