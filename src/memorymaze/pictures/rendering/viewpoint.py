"""Which parts of a building a camera may see from where it is."""

import math

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.pose import Pose
from memorymaze.pictures.rendering.visual_scene import VisualScene


def geoms_in_view(
    scene: VisualScene,
    pose: Pose,
    pitch: float,
    size: tuple[int, int],
    horizontal_fov: float,
    far: float,
) -> NDArray[np.bool_]:
    """Leave out what walls hide and what lies beside the picture.

    Args:
        scene: The building.
        pose: Where the lens is and which way it looks.
        pitch: Upwards from level, radians.
        size: Width and height of the picture, pixels.
        horizontal_fov: Radians.
        far: Metres along the axis beyond which nothing is seen.

    Returns:
        Whether each geom may be seen; of no meaning for the sky's.
    """
    half = horizontal_fov / 2
    vertical = math.atan(math.tan(half) * size[1] / size[0])
    if abs(pitch) + vertical >= math.pi / 2 - 0.01:
        half = math.pi
    elif pitch:
        # Above and below the level the same picture is wider on the plan.
        reach = math.tan(half) / math.cos(vertical)
        half = math.atan2(reach, math.cos(abs(pitch) + vertical))
    outlook = scene.sightlines.outlook(pose.x, pose.y, pose.heading, half, far * 1.5)
    return outlook.sees(scene.centres, scene.radii)
