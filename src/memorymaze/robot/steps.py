"""Primitive motions and raw pictures, for agents that decide step by step.

Programs in the sandbox do not get these: the control API proper is
`memorymaze.robot.api`.
"""

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from memorymaze.robot.api import Robot


@dataclass(frozen=True, eq=False)
class CameraPicture:
    """What the camera sees, from where the robot stands."""

    rgb: NDArray[np.uint8]
    """Colours, (height, width, 3), first row at the top."""
    depth: NDArray[np.float32]
    """Metres along the optical axis, (height, width); inf where nothing is."""


@runtime_checkable
class SteppingRobot(Robot, Protocol):
    """A robot that can also be moved by single steps, without any help in steering.

    Each call counts as a call of the control API. The robot stands when a step ends.
    """

    def step_forward(self, distance: float) -> float:
        """Drive straight ahead, without keeping to the corridor or going round things.

        The robot stops where it touches something. It waits for people who walk by.

        Args:
            distance: Metres, greater than 0.

        Returns:
            Metres really moved ahead: `distance`, or less when something was in the
            way or the time budget ran out.

        Raises:
            CommandError: The distance has no meaning.
            EpisodeOver: The episode is over.
        """
        ...

    def rotate(self, angle: float) -> float:
        """Turn on the spot.

        Args:
            angle: Radians, left positive, up to a full turn either way, not 0.

        Returns:
            Radians really turned: `angle`, or less when something held the robot or
            the time budget ran out.

        Raises:
            CommandError: The angle has no meaning.
            EpisodeOver: The episode is over.
        """
        ...

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """Take a picture with the camera that looks ahead.

        Args:
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians; pixels are square.

        Raises:
            SettingsError: The size or field of view has no meaning.
            RenderingError: This machine cannot draw; says what to install.
            EpisodeOver: The episode is over.
        """
        ...
