"""Questions about a floor that grids and shortest walks ask many times over.

Metres. The floor counts with its edge: walking along a wall is walking on the floor.
"""

from functools import cached_property

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import MultiPolygon, Polygon

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.points import BoolArray, FloatArray

HAIRLINE = 1e-6
"""Metres; rounding slits up to twice this wide between joined pieces are no walls."""


class Floor:
    """A polygon one can walk on, prepared for many points and straight lines."""

    def __init__(self, polygon: Polygon | MultiPolygon) -> None:
        """Prepare a floor, which may be neither empty nor invalid."""
        if polygon.is_empty or not polygon.is_valid:
            reason = "empty" if polygon.is_empty else shapely.is_valid_reason(polygon)
            raise ValueError(f"expected a valid floor polygon, got: {reason}")
        self.polygon = polygon
        self._eased = shapely.buffer(polygon, HAIRLINE, join_style="mitre")
        shapely.prepare(self._eased)

    def contains(self, xs: FloatArray, ys: FloatArray) -> BoolArray:
        """Tell which points are on the floor; the shape is that of `xs` and `ys`."""
        return np.asarray(shapely.contains_xy(self._eased, xs, ys))

    def joins(self, starts: FloatArray, ends: FloatArray) -> BoolArray:
        """Tell which straight lines stay on the floor, (K, 2) and (K, 2) to (K,)."""
        lines = shapely.linestrings(np.stack([starts, ends], axis=1))
        return np.asarray(shapely.covers(self._eased, lines), dtype=bool).reshape(-1)

    def beside_edge(self, points: FloatArray, distance: float) -> BoolArray:
        """Tell which points are within `distance` of the floor's edge, (K, 2) to (K,)."""
        near = shapely.dwithin(self._edge, shapely.points(points), distance)
        return np.asarray(near, dtype=bool)

    def onto(self, points: ArrayLike, tolerance: float) -> FloatArray:
        """Return the points, those off the floor moved to its edge, shape (K, 2).

        One that is farther off than so many metres raises `UndefinedMetricError`.
        """
        places = np.array(points, dtype=np.float64)
        if places.ndim != 2 or places.shape[1] != 2:
            raise ValueError(f"expected points of shape (K, 2), got {places.shape}")
        bad = np.flatnonzero(~np.isfinite(places).all(axis=1))
        if len(bad):
            raise UndefinedMetricError(
                f"point {bad[0]} is not finite: {places[bad[0]]}"
            )
        for index in np.flatnonzero(~self.contains(places[:, 0], places[:, 1])):
            spot = shapely.Point(places[index])
            away = self.polygon.distance(spot)
            if away > tolerance:
                raise UndefinedMetricError(
                    f"point {index} at ({spot.x:.3f}, {spot.y:.3f}) is {away:.2f} m "
                    f"off the floor; at most {tolerance:.2f} m are allowed"
                )
            way = shapely.shortest_line(self.polygon, spot)
            places[index] = shapely.get_coordinates(way)[0]
        return places

    @cached_property
    def _edge(self) -> shapely.Geometry:
        edge = self.polygon.boundary
        shapely.prepare(edge)
        return edge
