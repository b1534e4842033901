"""What a simulated robot's cameras see; opened when someone first looks."""

import math
from functools import lru_cache

import mujoco

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.rendering.camera import CameraFrame, RenderedCamera
from memorymaze.simulation.rendering.panorama import PanoramaCamera, PanoramaFrame
from memorymaze.simulation.rendering.visual_scene import (
    VisualScene,
    build_visual_scene,
)
from memorymaze.simulation.scene import Scene

__all__ = ["RobotEyes", "visual_scene_of"]


@lru_cache(maxsize=4)
def visual_scene_of(scene: Scene) -> VisualScene:
    """Return what a physics scene looks like; built once for each scene."""
    return build_visual_scene(scene.site, scene.movables)


class RobotEyes:
    """Cameras on a robot, with the things and people that the physics knows of."""

    def __init__(self, scene: Scene, data: mujoco.MjData) -> None:
        """Look at a scene.

        Args:
            scene: The building.
            data: Physics state, for where things and people are.
        """
        self._scene = scene
        self._data = data
        self._camera: RenderedCamera | None = None
        self._panorama: tuple[int, PanoramaCamera] | None = None

    def frame(
        self, pose: Pose, width: int, height: int, horizontal_fov: float
    ) -> CameraFrame:
        """Take a picture; see `RenderedCamera`."""
        camera = self._camera
        if camera is None or (
            (camera.width, camera.height, camera.horizontal_fov)
            != (width, height, horizontal_fov)
        ):
            if camera is not None:
                camera.close()
            looks = visual_scene_of(self._scene)
            camera = RenderedCamera(looks, width, height, horizontal_fov)
            self._camera = camera
        self._place_movables()
        return camera.frame(pose)

    def panorama(self, pose: Pose, width: int) -> PanoramaFrame:
        """Look all round; see `PanoramaCamera`."""
        if self._panorama is None or self._panorama[0] != width:
            if self._panorama is not None:
                self._panorama[1].close()
            looks = visual_scene_of(self._scene)
            self._panorama = (width, PanoramaCamera(looks, width))
        self._place_movables()
        return self._panorama[1].frame(pose)

    def _place_movables(self) -> None:
        places: dict[str, Pose] = {}
        for name, row in self._scene.mocap_ids.items():
            x, y, z = self._data.mocap_pos[row].tolist()
            if z > 0:  # the others are parked under the floor
                w, _, _, rise = self._data.mocap_quat[row].tolist()
                places[name] = Pose(x, y, 2 * math.atan2(rise, w))
        visual_scene_of(self._scene).place(places)
