"""All-round pictures: equirectangular, put together from six square faces."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import SettingsError
from memorymaze.geometry.pose import Pose
from memorymaze.pictures.rendering.camera import RenderedCamera
from memorymaze.pictures.rendering.visual_scene import VisualScene
from memorymaze.simulation.cameras import PanoramaFrame
from memorymaze.simulation.motion.wheeled_base import CAMERA_HEIGHT

FACE_FOV = math.radians(94)
"""A little more than a quarter turn, so that no pixel is mixed across a face's edge."""
FACES: tuple[tuple[float, float], ...] = (
    (0.0, 0.0),
    (math.pi / 2, 0.0),
    (math.pi, 0.0),
    (-math.pi / 2, 0.0),
    (0.0, math.pi / 2),
    (0.0, -math.pi / 2),
)
"""Bearing, left positive, and pitch of each face."""


class PanoramaCamera:
    """A camera that looks all round at once; use it like `RenderedCamera`."""

    def __init__(
        self, scene: VisualScene, width: int = 1024, multisamples: int = 0
    ) -> None:
        """Open a camera.

        Args:
            scene: The building.
            width: Pixels, even, at least 8; the picture is half as high.
            multisamples: Samples per pixel that smooth edges; 0 is fastest.

        Raises:
            SettingsError: The width is odd or too small.
            RenderingError: This machine cannot draw; says what to install.
        """
        if width < 8 or width % 2:
            raise SettingsError(
                f"panorama: expected an even width of at least 8 pixels, got {width}"
            )
        # As fine ahead of each face as the panorama is at its level.
        edge = math.ceil(width / math.pi * math.tan(FACE_FOV / 2))
        self._camera = RenderedCamera(
            scene, edge, edge, FACE_FOV, multisamples=multisamples
        )
        self._lookup = _Lookup.of(width, edge)

    def frame(self, pose: Pose, height: float = CAMERA_HEIGHT) -> PanoramaFrame:
        """Look all round.

        Args:
            pose: Where the lens is; the picture's middle looks along its heading.
            height: Of the lens over the floor, metres.
        """
        frames = [
            self._camera.frame(
                Pose(pose.x, pose.y, pose.heading + bearing), height, pitch
            )
            for bearing, pitch in FACES
        ]
        look = self._lookup
        at = (look.face, look.near_row, look.near_column)
        depth = np.stack([each.depth for each in frames])[at]
        return PanoramaFrame(
            look.mixed(np.stack([each.rgb for each in frames])),
            depth * look.stretch,
            np.stack([each.instances for each in frames])[at],
            frames[0].objects,
        )

    def picture(self, pose: Pose, height: float = CAMERA_HEIGHT) -> NDArray[np.uint8]:
        """Return only the colours of `frame`, faster."""
        pictures = [
            self._camera.picture(
                Pose(pose.x, pose.y, pose.heading + bearing), height, pitch
            )
            for bearing, pitch in FACES
        ]
        return self._lookup.mixed(np.stack(pictures))

    def close(self) -> None:
        """Give back its memory; it takes no more pictures."""
        self._camera.close()

    def __enter__(self) -> "PanoramaCamera":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()


@dataclass(frozen=True, eq=False)
class _Lookup:
    """Which pixels of which face each pixel of the panorama is made of."""

    face: NDArray[np.intp]
    row: NDArray[np.intp]
    """Upper of two rows."""
    column: NDArray[np.intp]
    """Left of two columns."""
    down: NDArray[np.float32]
    """Share of the lower row."""
    right: NDArray[np.float32]
    """Share of the right column."""
    near_row: NDArray[np.intp]
    near_column: NDArray[np.intp]
    stretch: NDArray[np.float32]
    """Distance from the lens per depth along the face's axis."""

    @staticmethod
    def of(width: int, edge: int) -> "_Lookup":
        height = width // 2
        bearing = np.pi - 2 * np.pi * (np.arange(width) + 0.5) / width
        rise = np.pi / 2 - np.pi * (np.arange(height) + 0.5) / height
        level = np.cos(rise)[:, None]
        ahead = level * np.cos(bearing)
        left = level * np.sin(bearing)
        up = np.broadcast_to(np.sin(rise)[:, None], ahead.shape)
        directions = np.stack([ahead, left, up], axis=-1)
        axes = np.stack([_axes(*face) for face in FACES])
        depth = np.einsum("hwk,fk->fhw", directions, axes[:, 0])
        face = np.argmax(depth, axis=0)
        along, sideways, above = (
            np.einsum("hwk,hwk->hw", directions, axes[face, axis]) for axis in range(3)
        )
        focal = edge / 2 / math.tan(FACE_FOV / 2)
        column = edge / 2 - focal * sideways / along - 0.5
        row = edge / 2 - focal * above / along - 0.5
        left_column = np.clip(np.floor(column).astype(np.intp), 0, edge - 2)
        upper_row = np.clip(np.floor(row).astype(np.intp), 0, edge - 2)
        return _Lookup(
            face,
            upper_row,
            left_column,
            (row - upper_row).astype(np.float32),
            (column - left_column).astype(np.float32),
            np.clip(np.rint(row).astype(np.intp), 0, edge - 1),
            np.clip(np.rint(column).astype(np.intp), 0, edge - 1),
            (1 / along).astype(np.float32),
        )

    def mixed(self, pictures: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Return the panorama of pictures (6, edge, edge, 3)."""
        right, down = self.right[..., None], self.down[..., None]
        top = (
            pictures[self.face, self.row, self.column] * (1 - right)
            + pictures[self.face, self.row, self.column + 1] * right
        )
        bottom = (
            pictures[self.face, self.row + 1, self.column] * (1 - right)
            + pictures[self.face, self.row + 1, self.column + 1] * right
        )
        return np.rint(top * (1 - down) + bottom * down).astype(np.uint8)


def _axes(bearing: float, pitch: float) -> NDArray[np.float64]:
    """Return the face's forward, left and up as rows, in the robot's frame."""
    cosine, sine = math.cos(bearing), math.sin(bearing)
    level, rise = math.cos(pitch), math.sin(pitch)
    return np.array([
        (cosine * level, sine * level, rise),
        (-sine, cosine, 0.0),
        (-cosine * rise, -sine * rise, level),
    ])
