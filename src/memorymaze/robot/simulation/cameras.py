"""Cameras in a scene, with the things and people where its physics has them."""

import math
import os
import threading
from functools import lru_cache

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import mujoco
from memorymaze.robot.simulation.scene import Scene
from memorymaze.world.cameras import (
    CameraFrame,
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.world.looks import Looks


@lru_cache(maxsize=4)
def visual_scene_of(scene: Scene, looks: Looks) -> VisualScene:
    """Return what a physics scene looks like; built once for each scene and looks."""
    return build_visual_scene(scene.site, scene.movables, looks)


@lru_cache(maxsize=4)
def _camera_of(
    scene: VisualScene,
    size: tuple[int, int],
    horizontal_fov: float,
    owner: tuple[int, int],
) -> RenderedCamera:
    """Return a camera that all robots of a scene share: opening one takes a second.

    Its owner is a process and a thread, which alone may use it.
    """
    return RenderedCamera(scene, *size, horizontal_fov)


class SceneCameras:
    """Cameras of any size, with the things and people that the physics knows of."""

    def __init__(self, scene: Scene, data: mujoco.MjData, looks: Looks) -> None:
        """Look at a scene; builds its looks where nobody did before."""
        self._scene = scene
        self._data = data
        self._visual = visual_scene_of(scene, looks)

    def frame(
        self, pose: Pose, width: int, height: int, horizontal_fov: float
    ) -> CameraFrame:
        """Take a picture; see `RenderedCamera`."""
        owner = os.getpid(), threading.get_ident()
        camera = _camera_of(self._visual, (width, height), horizontal_fov, owner)
        places: dict[str, Pose] = {}
        for name, row in self._scene.mocap_ids.items():
            x, y, z = self._data.mocap_pos[row].tolist()
            if z > 0:  # the others are parked under the floor
                w, _, _, rise = self._data.mocap_quat[row].tolist()
                places[name] = Pose(x, y, 2 * math.atan2(rise, w))
        self._visual.place(places)
        return camera.frame(pose)
