"""A floor as a graph of square cells, and shortest walks over it.

The cells lie on whole multiples of their size in the plan's frame. A cell is a node
when its centre is on the floor; nodes are joined to their 8 neighbours where the
straight step stays on the floor, diagonally only where the four sides of the square
between them are open too (no corner is cut). Only the largest connected piece is kept.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree
from shapely import MultiPolygon, Polygon

from memorymaze.errors import UndefinedMetricError
from memorymaze.geometry import polyline

__all__ = ["FloorGrid"]

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

HAIRLINE = 1e-6
"""Metres; rounding slits of this width between joined floor pieces are no walls."""

HALF_DIAGONAL = 0.7072
"""Of a cell of size 1, rounded up."""


@dataclass(frozen=True, eq=False)
class FloorGrid:
    """Square cells over a floor, joined where one can walk; nodes are 0 … N-1.

    >>> grid = FloorGrid.from_polygon(shapely.box(0, 0, 2, 1))
    >>> len(grid), grid.centres[0].tolist()
    (8, [0.25, 0.25])
    >>> grid.map_path([(0.1, 0.2), (1.9, 0.2)]).tolist()
    [0, 2, 4, 6]
    """

    floor: Polygon | MultiPolygon
    """What it was made from, metres."""
    cell: float
    """Side of a cell, metres."""
    tolerance: float
    """Metres a mapped point may lie off the floor."""
    centres: FloatArray
    """Position of every node, metres, shape (N, 2)."""
    graph: csr_array
    """Symmetric step lengths, metres, shape (N, N)."""
    _rows: dict[int, FloatArray] = field(default_factory=dict[int, FloatArray])

    @classmethod
    def from_polygon(
        cls, floor: Polygon | MultiPolygon, cell: float = 0.5, tolerance: float = 0.5
    ) -> Self:
        """Lay a grid over a floor.

        Args:
            floor: Polygon with holes, metres.
            cell: Side of a cell, metres, > 0.
            tolerance: Metres a point may lie off the floor and still be mapped.

        Raises:
            ValueError: The floor is empty, invalid, or has no cell centre on it.
        """
        if not (np.isfinite(cell) and cell > 0):
            raise ValueError(f"expected a cell size > 0 m, got {cell}")
        if floor.is_empty or not floor.is_valid:
            reason = "empty" if floor.is_empty else shapely.is_valid_reason(floor)
            raise ValueError(f"expected a valid floor polygon, got: {reason}")
        eased = _eased(floor)
        shapely.prepare(eased)
        west, south, east, north = floor.bounds
        xs = np.arange(np.floor(west / cell), np.ceil(east / cell)) * cell + cell / 2
        ys = np.arange(np.floor(south / cell), np.ceil(north / cell)) * cell + cell / 2
        grid_x, grid_y = np.meshgrid(xs, ys, indexing="ij")
        on_floor = shapely.contains_xy(eased, grid_x, grid_y)
        if not on_floor.any():
            raise ValueError(f"no centre of a {cell} m cell lies on the floor")
        number = np.full(on_floor.shape, -1, dtype=np.intp)
        number[on_floor] = np.arange(np.count_nonzero(on_floor))
        centres = np.column_stack([grid_x[on_floor], grid_y[on_floor]])
        graph = _steps(number, centres, eased, cell)
        labels = connected_components(graph, directed=False)[1]
        kept = np.flatnonzero(labels == np.argmax(np.bincount(labels)))
        return cls(
            floor, cell, tolerance, centres[kept], csr_array(graph[kept][:, kept])
        )

    def __len__(self) -> int:
        """Return the number of nodes."""
        return len(self.centres)

    def map_points(self, points: ArrayLike) -> IntArray:
        """Return the node of each point: the nearest that no wall hides.

        Args:
            points: Metres, shape (K, 2).

        Returns:
            Node ids, shape (K,).

        Raises:
            UndefinedMetricError: A point is not finite, lies farther than `tolerance`
                off the floor, or farther than `tolerance` plus one cell from the
                nearest node.
        """
        places = np.asarray(points, dtype=np.float64)
        if places.ndim != 2 or places.shape[1] != 2:
            raise ValueError(f"expected points of shape (K, 2), got {places.shape}")
        self._check_on_floor(places)
        near = min(9, len(self))
        distances, nodes = self._tree.query(places, k=range(1, near + 1))
        chosen = nodes[:, 0].astype(np.intp)
        doubtful = np.flatnonzero(
            self._beside_wall[chosen] | (distances[:, 0] > HALF_DIAGONAL * self.cell)
        )
        seen = self._sees(places[doubtful], nodes[doubtful, 0])
        for index in doubtful[~seen]:
            open_ways = self._sees(
                np.repeat(places[index : index + 1], near, axis=0), nodes[index]
            )
            if open_ways.any():
                chosen[index] = nodes[index, np.argmax(open_ways)]
        gap = np.hypot(*(places - self.centres[chosen]).T)
        lost = np.flatnonzero(gap > self.tolerance + self.cell)
        if len(lost):
            x, y = places[lost[0]]
            raise UndefinedMetricError(
                f"point {lost[0]} at ({x:.3f}, {y:.3f}) is {gap[lost[0]]:.2f} m from "
                f"the nearest cell of the main floor; at most "
                f"{self.tolerance + self.cell:.2f} m are allowed"
            )
        return chosen

    def map_path(self, points: ArrayLike) -> IntArray:
        """Return the nodes a path passes, consecutive repeats removed.

        Args:
            points: Vertices of the path, metres, shape (N, 2).

        Raises:
            UndefinedMetricError: The path is empty or leaves the floor; see
                `map_points`.
        """
        if np.size(points) == 0:
            raise UndefinedMetricError(
                "expected a path of at least one point, got none"
            )
        samples = polyline.resample(points, self.cell / 4)
        nodes = self.map_points(samples)
        return nodes[np.concatenate([[True], nodes[1:] != nodes[:-1]])]

    def distances_from(self, nodes: ArrayLike) -> FloatArray:
        """Return the shortest distances from some nodes to all, shape (k, N), metres.

        Rows are kept, so that asking again costs nothing.
        """
        wanted = np.atleast_1d(np.asarray(nodes, dtype=np.intp))
        missing = [node for node in np.unique(wanted) if int(node) not in self._rows]
        if missing:
            rows = np.atleast_2d(dijkstra(self.graph, indices=missing))
            self._rows.update(zip(map(int, missing), rows, strict=True))
        return np.array([self._rows[int(node)] for node in wanted])

    def distance(self, point_a: ArrayLike, point_b: ArrayLike) -> float:
        """Return the length of the shortest walk between two points, metres."""
        start, end = self.map_points(np.array([point_a, point_b], dtype=np.float64))
        return float(self.distances_from([end])[0, start])

    @cached_property
    def _tree(self) -> KDTree:
        return KDTree(self.centres)

    @cached_property
    def _eased_floor(self) -> Polygon | MultiPolygon:
        eased = _eased(self.floor)
        shapely.prepare(eased)
        return eased

    @cached_property
    def _beside_wall(self) -> NDArray[np.bool_]:
        return _near_boundary(self.centres, self._eased_floor, self.cell)

    def _sees(self, places: FloatArray, nodes: IntArray) -> NDArray[np.bool_]:
        lines = shapely.linestrings(np.stack([places, self.centres[nodes]], axis=1))
        return np.asarray(shapely.covers(self._eased_floor, lines))

    def _check_on_floor(self, places: FloatArray) -> None:
        bad = np.flatnonzero(~np.isfinite(places).all(axis=1))
        if len(bad):
            raise UndefinedMetricError(
                f"point {bad[0]} is not finite: {places[bad[0]]}"
            )
        near = shapely.dwithin(
            self._eased_floor, shapely.points(places), self.tolerance
        )
        if not np.all(near):
            first = int(np.argmin(near))
            x, y = places[first]
            away = self.floor.distance(shapely.Point(x, y))
            raise UndefinedMetricError(
                f"point {first} at ({x:.3f}, {y:.3f}) is {away:.2f} m off the floor; "
                f"at most {self.tolerance:.2f} m are allowed"
            )


def _eased(floor: Polygon | MultiPolygon) -> Polygon | MultiPolygon:
    return shapely.buffer(floor, HAIRLINE, join_style="mitre")


def _near_boundary(
    centres: FloatArray, floor: Polygon | MultiPolygon, cell: float
) -> NDArray[np.bool_]:
    """Tell which cells a step over the floor's boundary can begin or end in."""
    boundary = floor.boundary
    shapely.prepare(boundary)
    spots = shapely.points(centres)
    return np.asarray(shapely.dwithin(boundary, spots, HALF_DIAGONAL * cell))


def _steps(
    number: IntArray,
    centres: FloatArray,
    floor: Polygon | MultiPolygon,
    cell: float,
) -> csr_array:
    """Join neighbouring cells; `number` is the node of each cell or -1."""
    beside_wall = _near_boundary(centres, floor, cell)

    def joined(tails: IntArray, heads: IntArray) -> NDArray[np.bool_]:
        is_open = (tails >= 0) & (heads >= 0)
        doubtful = is_open & (beside_wall[tails] | beside_wall[heads])
        ends = np.stack([centres[tails[doubtful]], centres[heads[doubtful]]], axis=1)
        is_open[doubtful] = shapely.covers(floor, shapely.linestrings(ends))
        return is_open

    east = joined(number[:-1], number[1:])
    north = joined(number[:, :-1], number[:, 1:])
    square = east[:, :-1] & east[:, 1:] & north[:-1] & north[1:]
    corners = (number[:-1, :-1], number[1:, 1:], number[1:, :-1], number[:-1, 1:])
    rising = square & joined(corners[0], corners[1])
    falling = square & joined(corners[2], corners[3])
    kinds: Sequence[tuple[IntArray, IntArray, NDArray[np.bool_], float]] = (
        (number[:-1], number[1:], east, cell),
        (number[:, :-1], number[:, 1:], north, cell),
        (corners[0], corners[1], rising, cell * np.sqrt(2)),
        (corners[2], corners[3], falling, cell * np.sqrt(2)),
    )
    tails = np.concatenate([tail[is_open] for tail, _, is_open, _ in kinds])
    heads = np.concatenate([head[is_open] for _, head, is_open, _ in kinds])
    metres = np.concatenate([
        np.full(np.count_nonzero(is_open), step) for _, _, is_open, step in kinds
    ])
    both = (np.concatenate([tails, heads]), np.concatenate([heads, tails]))
    count = len(centres)
    return coo_array((np.tile(metres, 2), both), shape=(count, count)).tocsr()
