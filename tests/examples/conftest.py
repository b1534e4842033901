"""A tiny checkpoint, shared with the tests of perception."""

from tests.robot.perception.conftest import grounding_dino

__all__ = ["grounding_dino"]
