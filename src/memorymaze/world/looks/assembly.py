"""Meshes with materials: what a model is, and how doors and windows are put together."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Concatenate, ParamSpec

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.points import FloatArray, IntArray
from memorymaze.world.looks.materials import Material
from memorymaze.world.looks.shapes import AxisSpan, Shape, box, joined, plate

P = ParamSpec("P")
PICTURE_SPAN = 2.0
"""Metres that a picture covers where a shape does not say how it lies."""


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

    def with_normals(self) -> "MeshPart":
        """Return the part with a normal per vertex; flat faces get their own corners."""
        if self.normals is not None:
            return self
        corners = self.vertices[self.faces]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
        return MeshPart(
            corners.reshape(-1, 3),
            np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3),
            across.repeat(3, axis=0).astype(np.float32),
            None if self.uv is None else self.uv[self.faces].reshape(-1, 2),
            self.material,
        )


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


@dataclass(slots=True)
class Assembly:
    """Shapes so far, by material."""

    shapes: dict[Material, list[Shape]] = field(default_factory=dict)

    def add(self, material: Material, *shapes: Shape) -> None:
        """Add shapes of one material."""
        self.shapes.setdefault(material, []).extend(shapes)

    def box(
        self,
        material: Material,
        x: AxisSpan,
        y: AxisSpan,
        z: AxisSpan,
        bevel: float = 0.0,
    ) -> None:
        """Add a box."""
        self.add(material, box(x, y, z, bevel))

    def plate(self, material: Material, x: AxisSpan, y: AxisSpan, z: AxisSpan) -> None:
        """Add a box whose front shows a whole picture."""
        self.add(material, plate(x, y, z))

    def unstretched(self) -> ObjectModel:
        """Return what was put together, as it stands."""
        return ObjectModel(
            tuple(
                _part(
                    joined(*(_with_uv(shape, material) for shape in shapes)), material
                )
                for material, shapes in self.shapes.items()
            )
        )


def built(
    build: Callable[Concatenate[Assembly, P], None], *args: P.args, **named: P.kwargs
) -> Assembly:
    """Return what a builder makes on its own, to be shifted or turned."""
    made = Assembly()
    build(made, *args, **named)
    return made


def _with_uv(shape: Shape, material: Material) -> Shape:
    uv = shape.uv
    if material.texture is None:
        uv = None
    elif uv is None:
        uv = uv_from_the_sides(shape.vertices, shape.normals)
    return Shape(shape.vertices, shape.faces, shape.normals, uv)


def _part(shape: Shape, material: Material) -> MeshPart:
    uv = None if shape.uv is None else np.clip(shape.uv, 0, 1)
    return read_only_part(shape.vertices, shape.faces, shape.normals, uv, material)


def uv_from_the_sides(vertices: FloatArray, normals: FloatArray) -> FloatArray:
    """Lay a picture on from the side that each corner faces, along its long side."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    share = (vertices - low) / max(PICTURE_SPAN, *(high - low))
    facing = np.argmax(np.abs(normals), axis=1)
    long_way = int(np.argmax(high - low))
    along = np.where(facing == long_way, (long_way + 1) % 3, long_way)
    rows = np.arange(len(share))
    return np.column_stack([share[rows, along], 1 - share[rows, 3 - facing - along]])


def read_only_part(
    vertices: FloatArray,
    faces: IntArray,
    normals: FloatArray,
    uv: FloatArray | None,
    material: Material,
) -> MeshPart:
    """Return triangles as they are drawn, which nobody changes any more."""
    made = MeshPart(
        vertices.astype(np.float32),
        faces.astype(np.int32),
        normals.astype(np.float32),
        None if uv is None else uv.astype(np.float32),
        material,
    )
    for array in (made.vertices, made.faces, made.normals, made.uv):
        if array is not None:
            array.flags.writeable = False
    return made
