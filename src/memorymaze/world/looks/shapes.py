"""Shapes without material, of which doors and windows are made: boxes, plates, panes."""

import math
from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np

from memorymaze.basics.geometry.points import FloatArray, IntArray

AxisSpan = tuple[float, float]
"""From and to along an axis, metres."""


THINNEST = 1e-4
"""Metres of material that even a box without thickness has."""


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Triangles counter-clockwise from outside; metres. Moves return a new shape."""

    vertices: FloatArray
    """(N, 3)."""
    faces: IntArray
    """(M, 3)."""
    normals: FloatArray
    """(N, 3), unit."""
    uv: FloatArray | None = None
    """(N, 2) in [0, 1] from the top left; None: laid on from the sides."""

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Shape":
        """Return it shifted."""
        return Shape(
            self.vertices + np.array((x, y, z)), self.faces, self.normals, self.uv
        )

    def turned(self, degrees: float) -> "Shape":
        """Return it turned about the z axis, counter-clockwise from above."""
        angle = math.radians(degrees)
        c, s = math.cos(angle), math.sin(angle)
        turn = np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
        return Shape(self.vertices @ turn.T, self.faces, self.normals @ turn.T, self.uv)


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


def around(middle: float, half: float) -> AxisSpan:
    """Return the span that reaches so far to either side of its middle."""
    return middle - half, middle + half


def span_between(one: float, other: float) -> AxisSpan:
    """Return the span from the smaller of two numbers to the larger."""
    return (one, other) if one < other else (other, one)


def box(x: AxisSpan, y: AxisSpan, z: AxisSpan, bevel: float = 0.0) -> Shape:
    """Return an upright box: from back to front, across, from bottom to top.

    Its edges lose `bevel` metres, shaded round; at most half its smallest side.
    """
    low, high = _corners(x, y, z)
    half = (high - low) / 2
    if bevel <= 0:
        signs, normals, faces = _box_template()
        return Shape((low + high) / 2 + signs * half, faces, normals)
    bevel = min(bevel, *(half * 0.999))
    signs, normals, faces = _bevelled_template()
    points = signs * (half - bevel) + normals * bevel
    return Shape((low + high) / 2 + points, faces, normals)


def plate(x: AxisSpan, y: AxisSpan, z: AxisSpan) -> Shape:
    """Return a box whose front shows a whole picture; its rim has a corner's colour."""
    signs, normals, faces = _box_template()
    low, high = _corners(x, y, z)
    points = (low + high) / 2 + signs * (high - low) / 2
    uv = np.full((len(points), 2), 0.004)
    front = normals[:, 0] > 0.5
    picture = np.column_stack([(signs[:, 1] + 1) / 2, (1 - signs[:, 2]) / 2])
    uv[front] = picture[front]
    return Shape(points, faces, normals, uv)


def pane(x: float, y: AxisSpan, z: AxisSpan) -> Shape:
    """Return a single rectangle that is seen from the front."""
    points = np.array([
        (x, y[0], z[0]),
        (x, y[1], z[0]),
        (x, y[1], z[1]),
        (x, y[0], z[1]),
    ])
    return Shape(
        points, np.array([(0, 1, 2), (0, 2, 3)]), np.tile((1.0, 0.0, 0.0), (4, 1))
    )


def _corners(x: AxisSpan, y: AxisSpan, z: AxisSpan) -> tuple[FloatArray, FloatArray]:
    """Return the lowest and the highest corner; spans may be given either way round."""
    ends = np.array([x, y, z], dtype=float)
    low, high = ends.min(axis=1), ends.max(axis=1)
    return low, np.maximum(high, low + THINNEST)


@cache
def _box_template() -> tuple[FloatArray, FloatArray, IntArray]:
    signs: list[tuple[float, ...]] = []
    normals: list[tuple[float, ...]] = []
    faces: list[tuple[int, int, int]] = []
    for axis, side in product(range(3), (-1.0, 1.0)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        start = len(signs)
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corner = [0.0, 0.0, 0.0]
            corner[axis], corner[first], corner[second] = side, a, b
            signs.append(tuple(corner))
            normals.append(tuple(side * (each == axis) for each in range(3)))
        quad = [(0, 1, 2), (0, 2, 3)] if side > 0 else [(0, 2, 1), (0, 3, 2)]
        faces += [(start + i, start + j, start + k) for i, j, k in quad]
    return np.array(signs, dtype=float), np.array(normals), np.array(faces)


@cache
def _bevelled_template() -> tuple[FloatArray, FloatArray, IntArray]:
    """Join the six faces, drawn apart, by twelve edges and eight corners."""
    signs, normals, flat = _box_template()
    rows = {
        (tuple(sign), int(np.argmax(np.abs(normal)))): row
        for row, (sign, normal) in enumerate(zip(signs, normals, strict=True))
    }
    faces: list[tuple[int, ...]] = [tuple(map(int, face)) for face in flat]
    for axis, a, b in product(range(3), (-1.0, 1.0), (-1.0, 1.0)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        ends: list[tuple[int, int]] = []
        for end in (-1.0, 1.0):
            corner = [0.0, 0.0, 0.0]
            corner[axis], corner[first], corner[second] = end, a, b
            ends.append((rows[tuple(corner), first], rows[tuple(corner), second]))
        (p, q), (r, s) = ends
        faces += [(p, q, s), (p, s, r)]
    faces += [
        tuple(rows[corner, axis] for axis in range(3))
        for corner in product((-1.0, 1.0), repeat=3)
    ]
    outside = signs + 0.3 * normals
    turned = [
        face if np.linalg.det(outside[list(face)]) > 0 else face[::-1] for face in faces
    ]
    return signs, normals, np.array(turned)
