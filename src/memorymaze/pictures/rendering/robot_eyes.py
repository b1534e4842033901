"""What a simulated robot's cameras see; opened when someone first looks."""

import math
import os
import threading
from functools import lru_cache

from memorymaze.geometry.pose import Pose
from memorymaze.pictures.kinds_of_looks import OWN, Looks
from memorymaze.pictures.looks.catalogue import check_looks
from memorymaze.pictures.rendering.camera import CameraFrame, RenderedCamera
from memorymaze.pictures.rendering.panorama import PanoramaCamera, PanoramaFrame
from memorymaze.pictures.rendering.visual_scene import (
    VisualScene,
    build_visual_scene,
)
from memorymaze.simulation.physics_engine import mujoco
from memorymaze.simulation.scene import Scene


def visual_scene_of(scene: Scene, looks: Looks = OWN) -> VisualScene:
    """Return what a physics scene looks like; built once for each scene and looks."""
    return _visual_scene(scene, check_looks(looks))


@lru_cache(maxsize=4)
def _visual_scene(scene: Scene, looks: Looks) -> VisualScene:
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


@lru_cache(maxsize=2)
def _panorama_camera_of(
    scene: VisualScene, width: int, owner: tuple[int, int]
) -> PanoramaCamera:
    return PanoramaCamera(scene, width)


def _owner() -> tuple[int, int]:
    return os.getpid(), threading.get_ident()


class RobotEyes:
    """Cameras on a robot, with the things and people that the physics knows of."""

    def __init__(self, scene: Scene, data: mujoco.MjData, looks: Looks = OWN) -> None:
        """Look at a scene; builds its looks where nobody did before."""
        self._scene = scene
        self._data = data
        self._visual = visual_scene_of(scene, looks)

    def frame(
        self, pose: Pose, width: int, height: int, horizontal_fov: float
    ) -> CameraFrame:
        """Take a picture; see `RenderedCamera`."""
        size = (width, height)
        camera = _camera_of(self._visual, size, horizontal_fov, _owner())
        self._place_movables()
        return camera.frame(pose)

    def panorama(self, pose: Pose, width: int) -> PanoramaFrame:
        """Look all round; see `PanoramaCamera`."""
        camera = _panorama_camera_of(self._visual, width, _owner())
        self._place_movables()
        return camera.frame(pose)

    def _place_movables(self) -> None:
        places: dict[str, Pose] = {}
        for name, row in self._scene.mocap_ids.items():
            x, y, z = self._data.mocap_pos[row].tolist()
            if z > 0:  # the others are parked under the floor
                w, _, _, rise = self._data.mocap_quat[row].tolist()
                places[name] = Pose(x, y, 2 * math.atan2(rise, w))
        self._visual.place(places)
