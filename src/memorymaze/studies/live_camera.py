"""What the robot's camera sees, as small pictures for pages."""

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.simulation import SimulatedRobot

QUALITY = 78
PANORAMA_WIDTH = 2048
RISE = 0.19
"""Share of an all-round picture above and below its level that is shown: 34 degrees."""


def seen_ahead(robot: SimulatedRobot, size: tuple[int, int]) -> bytes:
    """Return what the camera sees now, as a JPEG."""
    return _jpeg(robot.camera_frame(*size).rgb)


def seen_all_round(robot: SimulatedRobot) -> bytes:
    """Return a strip of the view all round, the robot's way in its middle, as a JPEG."""
    rgb = robot.panorama(PANORAMA_WIDTH).rgb
    height = len(rgb)
    cut = round(height * RISE)
    return _jpeg(rgb[height // 2 - cut : height // 2 + cut])


def _jpeg(rgb: NDArray[np.uint8]) -> bytes:
    file = io.BytesIO()
    Image.fromarray(rgb).save(file, "JPEG", quality=QUALITY)
    return file.getvalue()
