"""Lengths, positions and samples along lines of straight pieces.

A polyline is an array of vertices, shape (N, 2) with N >= 1, in metres. Arc length `s`
runs from 0 at the first vertex. Nothing here knows of floors, time or robots.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.basics.geometry.points import FloatArray


class Projection(NamedTuple):
    """The place on a polyline that is nearest to a point."""

    s: float
    """Arc length of that place, metres."""
    distance: float
    """Metres from the point to it."""


def arc_lengths(points: ArrayLike) -> FloatArray:
    """Return the arc length at every vertex, shape (N,), beginning with 0."""
    steps = np.diff(_vertices(points), axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])


def length(points: ArrayLike) -> float:
    """Return the length in metres; 0 for a single point.

    >>> length([(0, 0), (3, 4), (3, 6)])
    7.0
    """
    return float(arc_lengths(points)[-1])


def point_at(points: ArrayLike, s: float) -> FloatArray:
    """Return the point at arc length `s`, shape (2,); `s` must lie on the line.

    >>> point_at([(0, 0), (3, 4), (3, 6)], 6.0).tolist()
    [3.0, 5.0]
    """
    return points_at(points, np.array([s]))[0]


def points_at(points: ArrayLike, stations: FloatArray) -> FloatArray:
    """Return the points at arc lengths, (M, 2); all of them must lie on the line."""
    along = arc_lengths(points)
    slack = 1e-9 * (1.0 + along[-1])
    off = ~((stations >= -slack) & (stations <= along[-1] + slack))
    if off.any():
        raise ValueError(
            f"expected an arc length from 0 to {along[-1]:.6g} m, got "
            f"{stations[off][0]:.6g}"
        )
    return _interpolate(_vertices(points), along, stations)


def resample(points: ArrayLike, spacing: float) -> FloatArray:
    """Return points at equal steps of arc length, both ends kept, shape (M, 2).

    The steps are the longest that divide the line evenly and do not exceed `spacing`,
    so corners between two samples are cut. A line of no length gives its one point.

    >>> resample([(0, 0), (1, 0), (1, 1)], 0.5).tolist()
    [[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 0.5], [1.0, 1.0]]
    """
    if not (np.isfinite(spacing) and spacing > 0):
        raise ValueError(f"expected a spacing > 0 m, got {spacing}")
    vertices, along = _vertices(points), arc_lengths(points)
    if along[-1] == 0:
        return vertices[:1].copy()
    # 1e-9: a length of 3 * 0.1 over a spacing of 0.1 is three steps, not four.
    steps = max(1, int(np.ceil(along[-1] / spacing - 1e-9)))
    samples = _interpolate(vertices, along, np.linspace(0.0, along[-1], steps + 1))
    samples[-1] = vertices[-1]
    return samples


def project(points: ArrayLike, p: ArrayLike) -> Projection:
    """Return where on the polyline the nearest place to `p` is, and how far away.

    Of equally near places the one met first is taken.

    >>> project([(0, 0), (4, 0), (4, 4)], (1, 2))
    Projection(s=1.0, distance=2.0)
    """
    vertices, along = _vertices(points), arc_lengths(points)
    target = np.asarray(p, dtype=np.float64)
    if target.shape != (2,) or not np.isfinite(target).all():
        raise ValueError(f"expected one finite point of shape (2,), got {p!r}")
    if len(vertices) == 1:
        return Projection(0.0, float(np.hypot(*(target - vertices[0]))))
    starts, pieces = vertices[:-1], np.diff(vertices, axis=0)
    squared = np.einsum("ij,ij->i", pieces, pieces)
    inner = np.einsum("ij,ij->i", target - starts, pieces)
    fraction = np.divide(inner, squared, out=np.zeros_like(inner), where=squared > 0)
    fraction = np.clip(fraction, 0.0, 1.0)
    offsets = target - (starts + fraction[:, None] * pieces)
    distances = np.hypot(offsets[:, 0], offsets[:, 1])
    best = int(np.argmin(distances))
    s = along[best] + fraction[best] * (along[best + 1] - along[best])
    return Projection(float(s), float(distances[best]))


def smoothed_rows(values: FloatArray, passes: int = 1) -> FloatArray:
    """Return rows of numbers, each drawn to its neighbours; the first and last stay."""
    smooth = values.copy()
    for _ in range(passes):
        smooth[1:-1] = (smooth[:-2] + 2 * smooth[1:-1] + smooth[2:]) / 4
    return smooth


def left_normals(points: FloatArray) -> FloatArray:
    """Return unit vectors to the left of a line at its points, (N, 2) with N >= 2."""
    tangents = np.gradient(points, axis=0)
    lengths = np.hypot(tangents[:, 0], tangents[:, 1])
    tangents /= np.maximum(lengths, 1e-9)[:, None]
    return np.column_stack([-tangents[:, 1], tangents[:, 0]])


def _vertices(points: ArrayLike) -> FloatArray:
    vertices = np.asarray(points, dtype=np.float64)
    if vertices.ndim != 2 or vertices.shape[1] != 2 or len(vertices) == 0:
        raise ValueError(
            f"expected points of shape (N, 2) with N >= 1, got shape {vertices.shape}"
        )
    if not np.isfinite(vertices).all():
        row = int(np.flatnonzero(~np.isfinite(vertices).all(axis=1))[0])
        raise ValueError(f"expected finite points, got {vertices[row]} at index {row}")
    return vertices


def _interpolate(vertices: FloatArray, along: FloatArray, at: FloatArray) -> FloatArray:
    return np.column_stack([
        np.interp(at, along, vertices[:, 0]),
        np.interp(at, along, vertices[:, 1]),
    ])
