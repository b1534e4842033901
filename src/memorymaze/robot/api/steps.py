"""Primitive motions, pictures with depth and LiDAR scans, for agents that go by steps.

Programs in the sandbox do not get these: the control API proper is
`memorymaze.robot.api.control`.
"""

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.robot.api.control import Robot


@dataclass(frozen=True, eq=False)
class CameraPicture:
    """What the camera sees, from where the robot stands."""

    rgb: NDArray[np.uint8]
    """Colours, (height, width, 3), first row at the top."""
    depth: NDArray[np.float32]
    """Metres along the optical axis, (height, width); inf where nothing is."""


@dataclass(frozen=True, eq=False)
class LidarScan:
    """What one turn of a LiDAR measured, in the robot's frame; it knows no pose."""

    ranges: FloatArray
    """Metres along each ray, shape (beams, rays) or with one beam (rays,). `inf`
    where nothing came back: nothing within `farthest`, something within `nearest`, or
    a ray that dropped out. Never nan."""
    angles: FloatArray
    """Of the rays in the horizontal plane, radians from straight ahead, left positive,
    ascending from -pi; shape (rays,)."""
    elevations: FloatArray
    """Of the beams, radians, up positive, shape (beams,)."""
    time: float
    """Simulated seconds."""

    def points(self) -> FloatArray:
        """Return where the rays ended: metres in the robot's frame, shape (N, 3).

        x ahead, y to the left, z up from the sensor; only rays that gave a return.
        """
        ranges = np.atleast_2d(self.ranges)
        level = ranges * np.cos(self.elevations)[:, np.newaxis]
        with np.errstate(invalid="ignore"):  # inf times a sine of 0
            points = np.stack(
                [
                    level * np.cos(self.angles),
                    level * np.sin(self.angles),
                    ranges * np.sin(self.elevations)[:, np.newaxis],
                ],
                axis=-1,
            )
        return points[np.isfinite(ranges)]


@runtime_checkable
class SteppingRobot(Robot, Protocol):
    """A robot that can also be moved by single steps, without any help in steering.

    This is what every agent is given. Each call counts as a call of the control API. The robot stands when a step ends.
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

    def lidar_scan(self) -> LidarScan:
        """Measure once all around, in no time; it is no call of the control API."""
        ...
