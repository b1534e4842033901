"""A tiny checkpoint, shared with the tests of perception."""

from tests.perception.conftest import grounding_dino

__all__ = ["grounding_dino"]
