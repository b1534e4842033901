"""What cameras see: looks of buildings and things, rendering, furniture models, films.

Holds nothing that decides where a robot goes. Importing it loads no OpenGL.
"""

import mujoco

from memorymaze.simulation.cameras import RobotCameras
from memorymaze.simulation.scene import Scene

__all__ = ["robot_cameras"]


def robot_cameras(scene: Scene, data: mujoco.MjData) -> RobotCameras:
    """Put cameras on a robot; the first picture builds the looks, which takes seconds.

    Args:
        scene: The building.
        data: Physics state, for where things and people are.

    Raises:
        RenderingError: This machine cannot draw; says what to install.
    """
    # Runs that never draw load neither OpenGL nor the looks of things.
    from memorymaze.pictures.rendering.robot_eyes import RobotEyes

    return RobotEyes(scene, data)
