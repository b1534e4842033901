"""The quality mode: a camera whose colours are drawn by MuJoCo's Filament renderer."""

import atexit
import math
import os
import weakref
from dataclasses import replace
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import RenderingError
from memorymaze.geometry.pose import Pose
from memorymaze.pictures.rendering.camera import (
    CameraFrame,
    RenderedCamera,
    check_camera,
)
from memorymaze.pictures.rendering.filament_engine import (
    engine_of_this_process,
    without_chatter,
)
from memorymaze.pictures.rendering.filament_scene import FilamentScene
from memorymaze.pictures.rendering.viewpoint import geoms_in_view
from memorymaze.pictures.rendering.visual_scene import VisualScene
from memorymaze.simulation.motion.wheeled_base import CAMERA_HEIGHT

NEAR, FAR = 0.05, 100.0
"""Metres."""

_cameras: "weakref.WeakSet[FilamentCamera]" = weakref.WeakSet()


class FilamentCamera:
    """A pinhole camera like `RenderedCamera`, with colours by Filament.

    Corners and the feet of things are darker (ambient occlusion). Depth and ids come
    from a `RenderedCamera` with the same view. Use it in the thread that made it.
    """

    def __init__(
        self,
        scene: VisualScene,
        width: int = 640,
        height: int = 480,
        horizontal_fov: float = math.pi / 2,
        multisamples: int = 4,
    ) -> None:
        """Open a camera; takes seconds.

        Args:
            scene: The building.
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians, less than pi; pixels are square.
            multisamples: Samples per pixel that smooth edges in `rgb`.

        Raises:
            SettingsError: A setting has no meaning.
            RenderingError: Filament cannot draw here; says what to install.
        """
        check_camera(width, height, horizontal_fov, NEAR, FAR, multisamples)
        self.width, self.height = width, height
        self.horizontal_fov = horizontal_fov
        self._scene = scene
        self._engine = engine_of_this_process()
        self._classic: RenderedCamera | None = None
        with without_chatter():
            self._drawn = FilamentScene(self._engine, scene, multisamples)
            self._aim_at_memory()
            self._is_open = True
            # The first picture takes seconds, and the engine talks about it.
            self._draw(Pose(0.0, 0.0, 0.0), CAMERA_HEIGHT, 0.0)
        _cameras.add(self)

    def _aim_at_memory(self) -> None:
        """Let pictures go into an array of this camera."""
        library, context = self._engine.library, self._engine.context
        config = library.RenderTargetConfig()
        config.width, config.height = self.width, self.height
        config.color_format = library.PixelFormat.PIXEL_FORMAT_RGB8
        self._target: Any = context.create_render_target(config)
        self._target.resize(self.width, self.height)
        self._pixels = np.zeros((self.height, self.width, 3), dtype=np.uint8)
        self._read: Any = library.ReadRequest(target=self._target)
        self._read.set_buffer(self._pixels)
        self._request: Any = library.RenderRequest()
        self._request.scene, self._request.target = self._drawn.handle, self._target
        self._request.viewport = library.Rect()
        self._request.viewport.width = self.width
        self._request.viewport.height = self.height
        self._request.haze = False

    def frame(
        self, pose: Pose, height: float = CAMERA_HEIGHT, pitch: float = 0.0
    ) -> CameraFrame:
        """Take a picture, with depth and ids; see `RenderedCamera.frame`."""
        rgb = self.picture(pose, height, pitch)
        if self._classic is None:
            self._classic = RenderedCamera(
                self._scene, self.width, self.height, self.horizontal_fov, NEAR, FAR
            )
        return replace(self._classic.frame(pose, height, pitch), rgb=rgb)

    def picture(
        self, pose: Pose, height: float = CAMERA_HEIGHT, pitch: float = 0.0
    ) -> NDArray[np.uint8]:
        """Return only the colours of `frame`, faster."""
        if not self._is_open:
            raise RenderingError("the camera is closed; make a new FilamentCamera")
        self._engine.check_owner()
        self._draw(pose, height, pitch)
        return self._pixels.copy()

    def close(self) -> None:
        """Give back its memory; it takes no more pictures."""
        if self._is_open and self._classic is not None:
            self._classic.close()
        self.release()

    def release(self) -> None:
        """Give back what Filament holds of it, in an order that it survives.

        Left to the garbage collector, users could go after what they use.
        """
        if self._is_open and self._engine.process == os.getpid():
            self._is_open = False
            self._read = self._request = None
            self._target = None
            self._drawn.close()

    def __del__(self) -> None:
        """Release it."""
        if getattr(self, "_is_open", False):
            self.release()

    def __enter__(self) -> "FilamentCamera":
        """Return itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close it."""
        self.close()

    def _draw(self, pose: Pose, height: float, pitch: float) -> None:
        scene, size = self._scene, (self.width, self.height)
        seen = geoms_in_view(scene, pose, pitch, size, self.horizontal_fov, FAR)
        seen[scene.first_sky :] = seen[scene.outlet_geoms].any()
        self._drawn.show(seen, pose.x, pose.y, height)
        ahead = (math.cos(pose.heading), math.sin(pose.heading))
        level, rise = math.cos(pitch), math.sin(pitch)
        top = NEAR * math.tan(self.horizontal_fov / 2) * self.height / self.width
        self._request.camera = self._engine.library.Camera(
            pos=(pose.x, pose.y, height),
            forward=(ahead[0] * level, ahead[1] * level, rise),
            up=(-ahead[0] * rise, -ahead[1] * rise, level),
            frustum_bottom=-top,
            frustum_top=top,
            frustum_near=NEAR,
            frustum_far=FAR,
        )
        context = self._engine.context
        context.wait_for_frame(context.render([self._request], [self._read]))


@atexit.register
def _release_all() -> None:
    """Release what is still open; by now OpenGL may be gone, so nothing else."""
    for camera in list(_cameras):
        camera.release()
