"""Exact lengths of the shortest walks over a floor with walls and holes.

A shortest walk is straight but for bends at inner corners of the floor, so the corners
that see each other form a graph that holds every one of them (Lozano-Perez and Wesley
1979, "An algorithm for planning collision-free paths among polyhedral obstacles").
"""

import numpy as np
import shapely
from numpy.typing import ArrayLike
from scipy.sparse.csgraph import dijkstra
from shapely import MultiPolygon, Polygon

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.floor import Floor
from memorymaze.basics.geometry.points import FloatArray


class ShortestWalks:
    """Shortest walks of a point between any two places on a floor.

    >>> around = ShortestWalks(shapely.box(0, 0, 8, 8) - shapely.box(0, 2, 4, 8))
    >>> around.distance((1, 1), (7, 1)), around.distance((4, 8), (0, 2))
    (6.0, 10.0)
    """

    def __init__(
        self, floor: Polygon | MultiPolygon | Floor, tolerance: float = 0.5
    ) -> None:
        """Join the floor's inner corners that see each other.

        Points may lie off the floor by as many metres as `tolerance`; they are moved to
        its edge.
        """
        self.floor = floor if isinstance(floor, Floor) else Floor(floor)
        self.tolerance = tolerance
        self.corners = _inner_corners(self.floor.polygon)
        count = len(self.corners)
        tails, heads = np.triu_indices(count, k=1)
        seen = self.floor.joins(self.corners[tails], self.corners[heads])
        tails, heads = tails[seen], heads[seen]
        steps = np.zeros((count, count))
        steps[tails, heads] = np.hypot(*(self.corners[tails] - self.corners[heads]).T)
        self._between_corners = dijkstra(steps, directed=False) if count else steps

    def distance(self, start: ArrayLike, end: ArrayLike) -> float:
        """Return the length of the shortest walk between two points, metres.

        Where no walk joins the two, or one is off the floor, it raises
        `UndefinedMetricError`.
        """
        return float(self.distances_to(end, np.array([start]))[0])

    def distances_to(self, goal: ArrayLike, points: ArrayLike) -> FloatArray:
        """Return the lengths (K,) of the shortest walks from points (K, 2) to a goal."""
        target = self.floor.onto(np.array([goal]), self.tolerance)
        places = self.floor.onto(points, self.tolerance)
        straight = np.hypot(*(places - target).T)
        seen = self.floor.joins(places, np.broadcast_to(target, places.shape))
        walks = np.where(seen, straight, np.inf)
        from_corners = np.min(
            self._between_corners + self._to_corners(target[0]), axis=1, initial=np.inf
        )
        for index in np.flatnonzero(~seen):
            by_corner = self._to_corners(places[index]) + from_corners
            walks[index] = np.min(by_corner, initial=np.inf)
        lost = np.flatnonzero(np.isinf(walks))
        if len(lost):
            x, y = places[lost[0]]
            raise UndefinedMetricError(
                f"no walk on the floor joins ({x:.3f}, {y:.3f}) and "
                f"({target[0, 0]:.3f}, {target[0, 1]:.3f})"
            )
        return walks

    def _to_corners(self, place: FloatArray) -> FloatArray:
        """Straight distances to the corners that a place sees, others infinite."""
        if not len(self.corners):
            return np.empty(0)
        seen = self.floor.joins(
            np.broadcast_to(place, self.corners.shape), self.corners
        )
        return np.where(seen, np.hypot(*(self.corners - place).T), np.inf)


def _inner_corners(polygon: Polygon | MultiPolygon) -> FloatArray:
    """Return the vertices a walk can bend at: those where the floor turns inward."""
    corners: list[FloatArray] = []
    pieces = shapely.get_parts(shapely.orient_polygons(polygon))
    for ring in shapely.get_rings(pieces):
        vertices = shapely.get_coordinates(shapely.remove_repeated_points(ring))[:-1]
        before = vertices - np.roll(vertices, 1, axis=0)
        after = np.roll(vertices, -1, axis=0) - vertices
        # The floor lies to the left of every ring, so an inner corner turns right.
        turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        corners.append(vertices[turn < 0])
    return np.concatenate(corners)
