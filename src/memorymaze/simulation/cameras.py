"""What a robot's cameras give, and what gives it; `pictures` draws, nothing here does."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.physics_engine import mujoco
from memorymaze.simulation.scene import Scene, SceneObject

NOTHING = -1
"""In `instances`: the sky."""


@dataclass(frozen=True, eq=False)
class CameraFrame:
    """One picture of a camera."""

    rgb: NDArray[np.uint8]
    """Colours, (height, width, 3), first row at the top."""
    depth: NDArray[np.float32]
    """Metres along the optical axis, (height, width); inf where nothing is. A pane of
    glass counts as seen, whatever is behind it."""
    instances: NDArray[np.int32]
    """Number in `objects` of what each pixel shows, (height, width); -1: nothing."""
    objects: tuple[SceneObject, ...]
    """What can be seen in the building."""

    def object_at(self, row: int, column: int) -> SceneObject | None:
        """Return what a pixel shows; None for the sky."""
        number = int(self.instances[row, column])
        return None if number == NOTHING else self.objects[number]


@dataclass(frozen=True, eq=False)
class PanoramaFrame:
    """One look all round. The middle column looks ahead, the middle row is level.

    Column c of W looks to the bearing pi - 2 pi (c + 0.5) / W, left positive; row r of
    H looks up by pi / 2 - pi (r + 0.5) / H.
    """

    rgb: NDArray[np.uint8]
    """Colours, (height, width, 3)."""
    distance: NDArray[np.float32]
    """Metres from the lens, (height, width); inf where nothing is."""
    instances: NDArray[np.int32]
    """Number in `objects` of what each pixel shows, (height, width); -1: nothing."""
    objects: tuple[SceneObject, ...]
    """What can be seen in the building."""


class RobotCameras(Protocol):
    """The cameras on one robot."""

    def frame(
        self, pose: Pose, width: int, height: int, horizontal_fov: float
    ) -> CameraFrame:
        """Take a picture that looks ahead horizontally."""
        ...

    def panorama(self, pose: Pose, width: int) -> PanoramaFrame:
        """Look all round."""
        ...


CameraMaker = Callable[[Scene, mujoco.MjData], RobotCameras]
"""Puts cameras on a robot; called when someone first looks."""
