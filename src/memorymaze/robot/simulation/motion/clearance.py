"""How much room there is on the floor of a plan, exactly."""

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import LineString, Polygon, STRtree

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.robot.steering.detours import CLEARANCE_RANGE


class Clearance:
    """How much room there is around points of a floor; implements `FreeSpace`."""

    def __init__(self, floor: Polygon, obstacles: Sequence[Polygon]) -> None:
        """Index the walls of the floor and the obstacles' footprints."""
        self._floor = floor
        shapely.prepare(self._floor)
        rings = [floor.exterior, *floor.interiors]
        pieces = [
            np.stack([corners[:-1], corners[1:]], axis=1)
            for corners in (np.asarray(ring.coords)[:, :2] for ring in rings)
        ]
        self._edges = np.concatenate(pieces)
        walls = [LineString(edge) for edge in self._edges]
        self._walls = STRtree(walls)
        self._everything = STRtree([*walls, *obstacles])

    def to_walls(self, points: FloatArray) -> FloatArray:
        """Return distances of points (N, 2) to the nearest wall, metres, shape (N,).

        At most `CLEARANCE_RANGE`; 0 where there is no floor.
        """
        return self._distances(points, self._walls)

    def to_anything(self, points: FloatArray) -> FloatArray:
        """Return distances to the nearest wall or obstacle, as `to_walls` does."""
        return self._distances(points, self._everything)

    def is_free(self, line: Sequence[tuple[float, float]], radius: float) -> bool:
        """Whether a disc of this radius, metres, can be moved along a line."""
        return self.is_within_walls(line) and not len(
            self._everything.query(
                LineString(line), predicate="dwithin", distance=radius
            )
        )

    def is_within_walls(self, line: Sequence[tuple[float, float]]) -> bool:
        """Whether a line crosses no wall."""
        return self._floor.contains(LineString(line))

    def wall_crossings(
        self, start: tuple[float, float], direction: tuple[float, float]
    ) -> list[float]:
        """Return where a ray crosses walls: metres from its start, ascending.

        From a start on the floor the first crossing leaves it, the next comes back.
        """
        ux, uy = direction
        offsets = self._edges - np.array(start)
        along = offsets[..., 0] * ux + offsets[..., 1] * uy
        across = offsets[..., 1] * ux - offsets[..., 0] * uy
        first, second = across[:, 0], across[:, 1]
        # Half-open, so that a ray through a corner crosses one of its two walls.
        cut = (first > 0) != (second > 0)
        fraction = first[cut] / (first[cut] - second[cut])
        at = along[cut, 0] + fraction * (along[cut, 1] - along[cut, 0])
        return np.sort(at[at > 0]).tolist()

    def _distances(self, points: FloatArray, tree: STRtree) -> FloatArray:
        distances = np.zeros(len(points))
        on_floor = np.flatnonzero(
            shapely.contains_xy(self._floor, points[:, 0], points[:, 1])
        )
        places = np.asarray(shapely.points(points[on_floor]))
        near, things = tree.query(places, predicate="dwithin", distance=CLEARANCE_RANGE)
        distances[on_floor] = CLEARANCE_RANGE
        np.minimum.at(
            distances,
            on_floor[near],
            shapely.distance(places[near], tree.geometries[things]),
        )
        return distances
