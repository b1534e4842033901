"""What a thing looks like: triangles with materials, free of any renderer."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Material:
    """How a surface looks; shared between models, so compare by identity."""

    rgba: tuple[float, float, float, float]
    """Colour in [0, 1], which multiplies the texture; alpha below 1 is seen through."""
    texture: NDArray[np.uint8] | None = None
    """Picture (height, width, 3 or 4), first row at the top; read-only."""
    emission: float = 0.0
    """Share of its own colour that it gives off, in [0, 1]."""
    shininess: float = 0.1
    """0 is dull, 1 is polished."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshPart:
    """Triangles of one material; all arrays are read-only."""

    vertices: NDArray[np.float32]
    """(N, 3) metres, in the model's frame."""
    faces: NDArray[np.int32]
    """(M, 3) vertex numbers, counter-clockwise as seen from outside."""
    normals: NDArray[np.float32] | None
    """(N, 3) unit vectors that point outwards; None: flat faces."""
    uv: NDArray[np.float32] | None
    """(N, 2): the share of the texture's width from the left, and of its height from
    the top; beyond [0, 1] the picture repeats. None where the material has no texture."""
    material: Material


@dataclass(frozen=True, slots=True, eq=False)
class ObjectModel:
    """A thing in its own frame.

    Metres; the origin is the centre of the footprint, z = 0 the thing's bottom, +x the
    way its front faces, +y its left, +z up. Things that look the same share one model.
    """

    parts: tuple[MeshPart, ...]

    @property
    def triangle_count(self) -> int:
        """Triangles of all parts."""
        return sum(len(part.faces) for part in self.parts)

    def bounds(self) -> NDArray[np.float64]:
        """Return the lowest and the highest corner of its bounding box, (2, 3)."""
        points = np.concatenate([part.vertices for part in self.parts]).astype(float)
        return np.stack([points.min(axis=0), points.max(axis=0)])
