"""A robot on an endless floor, for everything that needs no building."""

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from memorymaze.basics.errors import EpisodeOver


class FloorRobot:
    """Goes where it is sent; each picture tells in its colours how often it moved."""

    def __init__(self, free_metres: float = math.inf) -> None:
        self.free_metres = free_metres
        self.calls: list[Any] = []
        self.stopped = False

    def step_forward(self, distance: float) -> float:
        moved = min(distance, self.free_metres)
        self.free_metres -= moved
        self.calls.append(("forward", distance))
        return moved

    def rotate(self, angle: float) -> float:
        self.calls.append(("rotate", round(math.degrees(angle))))
        return angle

    def camera_picture(self, width: int, height: int, horizontal_fov: float) -> Any:
        assert (width, height, horizontal_fov) == (640, 480, math.pi / 2)
        rgb = np.full((height, width, 3), len(self.calls) % 256, np.uint8)
        return SimpleNamespace(rgb=rgb)

    def stop(self) -> None:
        self.stopped = True
        raise EpisodeOver("agent")

    def __getattr__(self, name: str) -> Any:
        """The rest of the control API, which this agent never calls."""

        def refuse(*_: Any) -> None:
            raise AssertionError(f"{name} was called")

        return refuse


@pytest.fixture
def make_robot() -> Callable[..., FloorRobot]:
    """Make robots: `make_robot(free_metres=3.0)`."""
    return FloorRobot


@pytest.fixture
def robot() -> FloorRobot:
    """A robot with nothing in its way."""
    return FloorRobot()
