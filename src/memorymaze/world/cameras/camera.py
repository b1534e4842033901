"""Cameras that draw RGB, depth and what each pixel shows, from anywhere in a building."""

import math
import os
import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import RenderingError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.options import check_number
from memorymaze.basics.physics_engine import mujoco
from memorymaze.basics.robot_size import CAMERA_HEIGHT
from memorymaze.world.cameras.open_gl import filter_fast, open_context
from memorymaze.world.cameras.sky import SKY_DISTANCE
from memorymaze.world.cameras.visual_scene import (
    HIDDEN_GROUP,
    LARGEST_PICTURE,
    SHOWN_GROUP,
    VisualScene,
)
from memorymaze.world.sites.scene_objects import SceneObject

NOTHING = -1
"""In `instances`: the sky."""
WIDEST = 3.1
"""Radians of the widest field of view; half a turn has no picture."""


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


class RenderedCamera:
    """A pinhole camera without lens errors, drawn with OpenGL.

    Use it in the thread that made it, and close it, or use it in a `with` statement.
    The same scene and pose give the same picture on the same machine.
    """

    def __init__(
        self,
        scene: VisualScene,
        width: int = 640,
        height: int = 480,
        horizontal_fov: float = math.pi / 2,
        near: float = 0.05,
        far: float = 100.0,
        multisamples: int = 0,
        trilinear: bool | None = None,
    ) -> None:
        """Open a camera.

        Args:
            scene: The building.
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians, less than pi; pixels are square.
            near: Metres along the axis below which nothing is seen.
            far: Metres along the axis beyond which nothing is seen.
            multisamples: Samples per pixel that smooth edges in `rgb`; 0 is fastest.
            trilinear: Whether textures are mixed from two of their sizes, which is
                slower; None where edges are smoothed too.

        Raises:
            SettingsError: A setting has no meaning.
            RenderingError: This machine cannot draw; says what to install.
        """
        check_camera(width, height, horizontal_fov, near, far, multisamples)
        self.width, self.height = width, height
        self.horizontal_fov = horizontal_fov
        self.near, self.far = near, far
        self._scene = scene
        self._context = open_context(width, height)
        self._context.make_current()
        quality, size = scene.model.vis.quality, scene.model.vis.global_
        quality.offsamples = multisamples
        size.offwidth, size.offheight = width, height
        self._buffers = mujoco.MjrContext(
            scene.model, mujoco.mjtFontScale.mjFONTSCALE_100.value
        )
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._buffers)
        self._buffers.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        self._drawn = mujoco.MjvScene(scene.model, maxgeom=scene.model.ngeom + 8)
        self._drawn.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        self._drawn.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = 0
        self._drawn.flags[mujoco.mjtRndFlag.mjRND_HAZE] = 0
        if not (multisamples if trilinear is None else trilinear):
            filter_fast(self._buffers)
        self._options = mujoco.MjvOption()
        self._options.geomgroup[:] = 0
        self._options.geomgroup[SHOWN_GROUP] = 1
        self._view = mujoco.MjvCamera()
        self._perturbation = mujoco.MjvPerturb()
        self._rect = mujoco.MjrRect(0, 0, width, height)
        self._pixels = np.empty((height, width, 3), dtype=np.uint8)
        self._depth = np.empty((height, width), dtype=np.float32)
        self._is_open = True
        self._process = os.getpid()

    def frame(
        self, pose: Pose, height: float = CAMERA_HEIGHT, pitch: float = 0.0
    ) -> CameraFrame:
        """Take a picture.

        Args:
            pose: Where the lens is and which way it looks.
            height: Of the lens over the floor, metres.
            pitch: Upwards from level, radians, within a quarter turn.

        Raises:
            RenderingError: The camera was closed.
        """
        shown = self._show(pose, height, pitch)
        rgb = self._rgb()
        # The decals come last in the scene; without them it has only what is solid.
        solid = shown[: np.searchsorted(shown, self._scene.first_decal)]
        self._drawn.ngeom = len(solid)
        geoms = self._drawn.geoms
        for place, owner in enumerate(self._scene.geom_objects[solid].tolist()):
            geoms[place].segid = owner
        depth, instances = self._depth_and_ids()
        return CameraFrame(rgb, depth, instances, self._scene.objects)

    def picture(
        self, pose: Pose, height: float = CAMERA_HEIGHT, pitch: float = 0.0
    ) -> NDArray[np.uint8]:
        """Return only the colours of `frame`, faster."""
        self._show(pose, height, pitch)
        return self._rgb()

    def close(self) -> None:
        """Give back its memory; it takes no more pictures."""
        if self._is_open:
            self._is_open = False
            self._context.make_current()
            self._buffers.free()
            self._context.free()

    def __enter__(self) -> "RenderedCamera":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()

    def __del__(self) -> None:
        """Close it: freed in another context, its buffers would take others' along."""
        # At the interpreter's exit OpenGL is gone already, with all its buffers; in a
        # process forked from the one that opened it there never was any.
        if (
            getattr(self, "_is_open", False)
            # At the very end even the names of this module are gone.
            and sys is not None
            and not sys.is_finalizing()
            and self._process == os.getpid()
        ):
            self.close()

    def _show(self, pose: Pose, height: float, pitch: float) -> NDArray[np.intp]:
        """Prepare the scene as seen from there, and return the geoms shown."""
        if not self._is_open:
            raise RenderingError("the camera is closed; make a new RenderedCamera")
        scene = self._scene
        self._context.make_current()
        seen = self._may_be_seen(pose, height, pitch)
        # The sky's dome comes last of what is opaque, so only what shows of it is
        # drawn. Where it would be cut off the engine draws its own, more slowly.
        shows_sky = bool(seen[scene.outlet_geoms].any())
        dome = shows_sky and self.far > SKY_DISTANCE
        seen[scene.first_sky :] = dome
        self._drawn.flags[mujoco.mjtRndFlag.mjRND_SKYBOX] = shows_sky and not dome
        if dome:
            scene.put_sky_around(pose.x, pose.y, height)
        scene.model.geom_group[:] = np.where(seen, SHOWN_GROUP, HIDDEN_GROUP)
        mujoco.mjv_updateScene(
            scene.model,
            scene.data,
            self._options,
            self._perturbation,
            self._view,
            mujoco.mjtCatBit.mjCAT_ALL.value,
            self._drawn,
        )
        self._aim(pose, height, pitch)
        return np.flatnonzero(seen)

    def _may_be_seen(
        self, pose: Pose, height: float, pitch: float
    ) -> NDArray[np.bool_]:
        """Leave out what walls hide and what lies beside the picture.

        Of no meaning for the sky's geoms.
        """
        half = self.horizontal_fov / 2
        vertical = math.atan(math.tan(half) * self.height / self.width)
        far = min(self.far * 1.5, self._reach(height, pitch, half, vertical))
        if abs(pitch) + vertical >= math.pi / 2 - 0.01:
            half = math.pi
        elif pitch:
            # Above and below the level the same picture is wider on the plan.
            reach = math.tan(half) / math.cos(vertical)
            half = math.atan2(reach, math.cos(abs(pitch) + vertical))
        lines = self._scene.sightlines
        outlook = lines.outlook(pose.x, pose.y, pose.heading, half, far)
        return outlook.sees(self._scene.centres, self._scene.radii)

    def _reach(
        self, height: float, pitch: float, half: float, vertical: float
    ) -> float:
        """Return how far away on the plan a picture may show something, metres.

        One that looks so steeply that the level is not in it shows what is near.
        """
        sideways, low = math.tan(half), math.tan(vertical)
        steep = abs(pitch)
        # The corners are what comes nearest to the level.
        rise = math.sin(steep) - low * math.cos(steep)
        if rise <= 0.01:
            return math.inf
        away = math.hypot(math.cos(steep) + low * math.sin(steep), sideways)
        bottom, top = self._scene.extent
        across = top - height if pitch > 0 else height - bottom
        return max(0.0, across) * away / rise + 1.0

    def _aim(self, pose: Pose, height: float, pitch: float) -> None:
        ahead = (math.cos(pose.heading), math.sin(pose.heading))
        level, rise = math.cos(pitch), math.sin(pitch)
        top = self.near * math.tan(self.horizontal_fov / 2) * self.height / self.width
        for eye in self._drawn.camera:
            eye.pos = (pose.x, pose.y, height)
            eye.forward = (ahead[0] * level, ahead[1] * level, rise)
            eye.up = (-ahead[0] * rise, -ahead[1] * rise, level)
            eye.frustum_center = 0.0
            eye.frustum_width = 0.0
            eye.frustum_bottom, eye.frustum_top = -top, top
            eye.frustum_near, eye.frustum_far = self.near, self.far

    def _rgb(self) -> NDArray[np.uint8]:
        flags = self._drawn.flags
        flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = 0
        flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = 0
        mujoco.mjr_render(self._rect, self._drawn, self._buffers)
        mujoco.mjr_readPixels(self._pixels, None, self._rect, self._buffers)
        return np.ascontiguousarray(self._pixels[::-1])

    def _depth_and_ids(self) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """Draw each geom's number plus 1 instead of its colours; 0 is nothing."""
        flags = self._drawn.flags
        flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = 1
        flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = 1
        mujoco.mjr_render(self._rect, self._drawn, self._buffers)
        mujoco.mjr_readPixels(self._pixels, self._depth, self._rect, self._buffers)
        # Depth is stored from 1 at the near plane to 0 at the far plane.
        stored = self._depth[::-1]
        span = np.float32(1 / self.near - 1 / self.far)
        with np.errstate(divide="ignore"):
            depth = np.float32(1) / (stored * span + np.float32(1 / self.far))
        depth[stored <= 0] = np.inf
        flipped = self._pixels[::-1]
        instances = flipped[:, :, 1].astype(np.int32)
        instances <<= 8
        instances |= flipped[:, :, 0]
        instances -= 1
        return depth, instances


def check_camera(
    width: int,
    height: int,
    horizontal_fov: float,
    near: float,
    far: float,
    multisamples: int,
) -> None:
    """Refuse what no camera can be; lengths in metres, the field of view in radians."""
    check_number("camera width", width, 1, LARGEST_PICTURE, whole=True)
    check_number("camera height", height, 1, LARGEST_PICTURE, whole=True)
    check_number("camera horizontal_fov", horizontal_fov, most=WIDEST, above=0)
    check_number("camera near", near, above=0)
    check_number("camera far", far, above=near)
    check_number("camera multisamples", multisamples, 0, 32, whole=True)
