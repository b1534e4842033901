"""What cameras see: looks of buildings and things, rendering, films.

Holds nothing that decides where a robot goes. Importing it loads no OpenGL.
"""

from typing import TYPE_CHECKING

from memorymaze.pictures.kinds_of_looks import OWN, Looks, file_of_looks

if TYPE_CHECKING:
    from memorymaze.simulation.cameras import RobotCameras
    from memorymaze.simulation.physics_engine import mujoco
    from memorymaze.simulation.scene import Scene

__all__ = ["OWN", "Looks", "file_of_looks", "robot_cameras"]


def robot_cameras(
    scene: "Scene", data: "mujoco.MjData", looks: Looks = OWN
) -> "RobotCameras":
    """Put cameras on a robot; the first picture builds the looks, which takes seconds.

    Args:
        scene: The building.
        data: Physics state, for where things and people are.
        looks: How things look: `own`, `mesh`, or the path of a GLB file with models.

    Raises:
        RenderingError: This machine cannot draw; says what to install.
        SettingsError: The looks that are asked for are not there.
    """
    # Runs that never draw load neither OpenGL nor the looks of things.
    from memorymaze.pictures.rendering.robot_eyes import RobotEyes

    return RobotEyes(scene, data, looks)
