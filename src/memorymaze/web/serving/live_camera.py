"""What the robot's camera sees, as small pictures for pages."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from memorymaze.language.models.model import Picture
from memorymaze.robot.simulation.robot import SimulatedRobot

QUALITY = 78
SIZE = (640, 480)
FOCAL = SIZE[0] / 2
"""Pixels; the camera is 90 degrees wide."""
BEARINGS = (math.pi, math.pi / 2, 0.0, -math.pi / 2)
"""Where a strip of the view all round is taken, radians from straight ahead."""


def seen_ahead(robot: SimulatedRobot) -> bytes:
    """Return what the camera sees now, as a JPEG."""
    return Picture.of_pixels(_picture(robot), quality=QUALITY).data


def seen_all_round(robot_facing: Callable[[float], SimulatedRobot]) -> bytes:
    """Return the view all round as one strip, straight ahead in its middle, as a JPEG."""
    views = [_on_cylinder(robot_facing(each)) for each in BEARINGS]
    strip = np.concatenate(views, axis=1)
    rolled = np.roll(strip, -views[0].shape[1] // 2, axis=1)
    return Picture.of_pixels(rolled, quality=QUALITY).data


def _on_cylinder(robot: SimulatedRobot) -> NDArray[np.uint8]:
    """Return the camera's picture so that pictures of quarter turns join."""
    width, height = SIZE
    angles = np.arange(-math.pi / 4, math.pi / 4, 1 / FOCAL)
    # At its edges the picture is lowest.
    tallest = math.floor(height / 2 * math.cos(math.pi / 4))
    rows = np.arange(-tallest, tallest)[:, np.newaxis] / np.cos(angles)
    columns = np.broadcast_to(FOCAL * np.tan(angles), rows.shape)
    down = np.clip(np.rint(height / 2 + rows), 0, height - 1).astype(np.intp)
    right = np.clip(np.rint(width / 2 + columns), 0, width - 1).astype(np.intp)
    return _picture(robot)[down, right]


def _picture(robot: SimulatedRobot) -> NDArray[np.uint8]:
    return robot.camera_view().picture(*SIZE).rgb
