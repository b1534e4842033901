"""Round shapes along a way: tubes, limbs, bodies from cross-sections, leaves."""

import math
from collections.abc import Sequence

import numpy as np

from memorymaze.geometry.points import FloatArray
from memorymaze.pictures.looks.shapes import (
    Shape,
    cross_products,
    joined,
    smoothed_shape,
)

Point3 = tuple[float, float, float]
RIB = 0.12
"""How far the rib of a leaf is raised, as a share of its width."""


def tube(
    path: Sequence[Point3],
    radius: float | Sequence[float],
    sides: int = 8,
    *,
    closed: bool = False,
) -> Shape:
    """Return a tube round a line, with flat ends, or closed to a ring.

    Neighbouring points must differ; the radius is one for all or one per point.
    """
    return _round_path(path, radius, sides, closed=closed, round_ends=False)


def limb(
    path: Sequence[Point3], radius: float | Sequence[float], sides: int = 8
) -> Shape:
    """Return a tube with round ends, which lie 3/4 radius beyond the path's ends."""
    return _round_path(path, radius, sides, closed=False, round_ends=True)


def ellipse_ring(
    centre: Point3, half_x: float, half_y: float, sides: int = 12
) -> FloatArray:
    """Return a level ellipse as a cross-section for `lofted`, (sides, 3) metres."""
    angles = np.arange(sides) * (2 * math.pi / sides)
    flat = np.column_stack([
        half_x * np.cos(angles),
        half_y * np.sin(angles),
        np.zeros(sides),
    ])
    return flat + centre


def lofted(
    rings: Sequence[FloatArray], *, round_ends: bool = False, closed: bool = False
) -> Shape:
    """Return a smooth skin over cross-sections.

    Each is (N, 3) metres, counter-clockwise as seen looking back from the next one to
    it. Round ends are shaded into the skin and not cut off flat; a closed skin has
    none.
    """
    grid = np.stack(rings)
    count, sides = grid.shape[:2]
    rows = np.arange(count if closed else count - 1)[:, None]
    here = np.arange(sides)[None, :]
    there = (here + 1) % sides
    after = (rows + 1) % count
    a, b = rows * sides + here, rows * sides + there
    c, d = after * sides + there, after * sides + here
    faces = np.concatenate([
        np.stack([a, b, c], axis=-1).reshape(-1, 3),
        np.stack([a, c, d], axis=-1).reshape(-1, 3),
    ])
    points = grid.reshape(-1, 3)
    if closed:
        return smoothed_shape(points, faces)
    around = np.arange(sides)
    following = (around + 1) % sides
    first, last = grid[0].mean(axis=0), grid[-1].mean(axis=0)
    if round_ends:
        bottom, top = len(points), len(points) + 1
        end = (count - 1) * sides
        faces = np.concatenate([
            faces,
            np.column_stack([following, around, np.full(sides, bottom)]),
            np.column_stack([end + around, end + following, np.full(sides, top)]),
        ])
        return smoothed_shape(np.vstack([points, first, last]), faces)
    fan = np.column_stack([around, following, np.full(sides, sides)])
    return joined(
        smoothed_shape(points, faces),
        smoothed_shape(np.vstack([grid[0], first]), fan[:, ::-1]),
        smoothed_shape(np.vstack([grid[-1], last]), fan),
    )


def plant_leaves(bases: FloatArray, tips: FloatArray, widths: FloatArray) -> Shape:
    """Return thin closed leaves, four flat triangles each.

    They grow from bases (N, 3) to tips not straight above or below; widths (N,) are
    metres across.
    """
    along = tips - bases
    sideways = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(along))])
    sideways /= np.linalg.norm(sideways, axis=1, keepdims=True)
    upwards = cross_products(along, sideways)
    upwards /= np.linalg.norm(upwards, axis=1, keepdims=True)
    half = widths[:, None] / 2
    middle = bases + along * 0.45
    raised = middle + upwards * widths[:, None] * RIB
    left, right = middle + sideways * half, middle - sideways * half
    # The rib runs below the blade's plane: base, left, right, and the tip above.
    corners = (bases, left - (raised - middle), right - (raised - middle), tips)
    triangles = ((0, 3, 1), (0, 2, 3), (0, 1, 2), (3, 2, 1))
    points = np.stack(
        [corners[corner] for face in triangles for corner in face], axis=1
    ).reshape(-1, 3)
    faces = np.arange(len(points)).reshape(-1, 3)
    return smoothed_shape(points, faces)


def _round_path(
    path: Sequence[Point3],
    radius: float | Sequence[float],
    sides: int,
    *,
    closed: bool,
    round_ends: bool,
) -> Shape:
    points = np.array(path, dtype=float)
    radii = np.broadcast_to(np.asarray(radius, dtype=float), len(points))
    steps = np.diff(points, axis=0, append=points[:1] if closed else points[-1:])
    if not closed:
        steps[-1] = steps[-2]
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    before = np.roll(steps, 1, axis=0)
    if not closed:
        before[0] = steps[0]
    tangents = steps + before
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    stretch = 1 / np.maximum(np.einsum("ij,ij->i", tangents, steps), 0.5)
    if round_ends:
        points, radii, tangents, stretch = _with_round_ends(
            points, radii, tangents, stretch
        )
    last = tangents[0]
    normal = _least_along(last)
    normal = normal - last * (normal @ last)
    normal /= math.sqrt(normal @ normal)
    normals = np.empty_like(points)
    for place, tangent in enumerate(tangents):
        # The least turn that takes the last direction to this one.
        turned = normal @ tangent / max(1 + last @ tangent, 1e-6)
        normal = normal - (last + tangent) * turned
        normals[place] = normal
        last = tangent
    others = cross_products(tangents, normals)
    radii = radii * (1 + (stretch - 1) * 0.5)
    angles = np.arange(sides) * (2 * math.pi / sides)
    across = np.cos(angles)[:, None] * normals[:, None]
    across = across + np.sin(angles)[:, None] * others[:, None]
    rings = points[:, None] + radii[:, None, None] * across
    return lofted(list(rings), round_ends=round_ends, closed=closed)


def _with_round_ends(
    points: FloatArray, radii: FloatArray, tangents: FloatArray, stretch: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    head = points[0] - tangents[0] * radii[0] * 0.75
    tail = points[-1] + tangents[-1] * radii[-1] * 0.75
    return (
        np.vstack([head, points, tail]),
        np.concatenate([[0.66 * radii[0]], radii, [0.66 * radii[-1]]]),
        np.vstack([tangents[:1], tangents, tangents[-1:]]),
        np.concatenate([[1], stretch, [1]]),
    )


def _least_along(direction: FloatArray) -> FloatArray:
    return np.eye(3)[int(np.argmin(np.abs(direction)))]
