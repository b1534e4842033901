"""Bare triangles with normals, before they get a material."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Axis = Literal["x", "y", "z"]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Triangles counter-clockwise from outside; metres. Moves return a new shape."""

    vertices: Floats
    """(N, 3)."""
    faces: Ints
    """(M, 3)."""
    normals: Floats
    """(N, 3), unit."""
    uv: Floats | None = None
    """(N, 2) in [0, 1] from the top left; None: laid on from the sides."""

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Shape":
        """Return it shifted."""
        return Shape(
            self.vertices + np.array((x, y, z)), self.faces, self.normals, self.uv
        )

    def turned(self, axis: Axis, degrees: float) -> "Shape":
        """Return it turned about an axis through the origin, by the right-hand rule."""
        angle = math.radians(degrees)
        c, s = math.cos(angle), math.sin(angle)
        first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        turn = np.eye(3)
        turn[first, first] = turn[second, second] = c
        turn[first, second], turn[second, first] = -s, s
        return Shape(self.vertices @ turn.T, self.faces, self.normals @ turn.T, self.uv)

    def scaled(self, x: float = 1.0, y: float = 1.0, z: float = 1.0) -> "Shape":
        """Return it stretched along the axes; negative factors mirror it."""
        factors = np.array((x, y, z))
        normals = self.normals / factors
        normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        faces = self.faces if x * y * z > 0 else self.faces[:, ::-1]
        return Shape(self.vertices * factors, faces, normals, self.uv)


def joined(*shapes: Shape) -> Shape:
    """Return one shape with all triangles of the given ones.

    Pictures are kept where every shape has one.
    """
    starts = np.cumsum([0, *(len(shape.vertices) for shape in shapes)])
    pictures = [shape.uv for shape in shapes if shape.uv is not None]
    return Shape(
        np.concatenate([shape.vertices for shape in shapes]),
        np.concatenate([
            shape.faces + start for shape, start in zip(shapes, starts, strict=False)
        ]),
        np.concatenate([shape.normals for shape in shapes]),
        np.concatenate(pictures) if len(pictures) == len(shapes) else None,
    )


def crossed(first: Floats, second: Floats) -> Floats:
    """Return the cross products of rows; `numpy.cross` is slow on few of them."""
    (a, b, c), (d, e, f) = first.T, second.T
    return np.column_stack([b * f - c * e, c * d - a * f, a * e - b * d])


def smoothed(vertices: Floats, faces: Ints) -> Shape:
    """Return a shape whose normals are the area-weighted means of the faces' normals.

    Triangles without area are dropped.

    Args:
        vertices: (N, 3) metres.
        faces: (M, 3), counter-clockwise from outside.
    """
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    across = crossed(b - a, c - a)
    sound = np.einsum("ij,ij->i", across, across) > 1e-18
    faces, across = faces[sound], across[sound]
    normals = np.zeros_like(vertices)
    for axis in range(3):
        normals[:, axis] = np.bincount(
            faces.ravel(), np.repeat(across[:, axis], 3), len(vertices)
        )
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 0, normals / np.maximum(lengths, 1e-12), (0, 0, 1))
    return Shape(vertices, faces, normals)
