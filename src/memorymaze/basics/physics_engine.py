"""MuJoCo, from here for everybody, so that its failure to load can be explained.

MuJoCo loads the OpenGL that `MUJOCO_GL` names when it is imported, also where nothing is
ever drawn, and fails on the spot with whatever that library raises.
"""

import math
import os

from memorymaze.basics.errors import RenderingError

try:
    import mujoco as mujoco
except (AttributeError, OSError, RuntimeError) as error:
    wish = os.environ.get("MUJOCO_GL", "")
    raise RenderingError(
        f"MuJoCo cannot be loaded with MUJOCO_GL={wish} ({error}); unset MUJOCO_GL to "
        "draw with what this machine has, or install what it names (on Debian and Ubuntu "
        "egl: apt-get install libegl1 libgl1 libgl1-mesa-dri; osmesa: apt-get install "
        "libosmesa6)"
    ) from error


def about_z(heading: float) -> list[float]:
    """Return a heading as a quaternion, w first."""
    return [math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2)]
