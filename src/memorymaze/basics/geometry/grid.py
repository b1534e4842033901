"""A floor as a graph of square cells, and shortest walks over it.

Cell centres lie on whole multiples of the cell size in the plan's frame. A cell is a
node when its centre is on the floor; nodes are joined to their 8 neighbours where the
straight step stays on the floor, diagonally only where the four sides of the square
between them are open too (no corner is cut). Only the largest connected piece is kept.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree
from shapely import MultiPolygon, Polygon

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.distance_rows import DistanceRows
from memorymaze.basics.geometry.floor import Floor
from memorymaze.basics.geometry.points import BoolArray, FloatArray
from memorymaze.basics.geometry.shortest_walk import ShortestWalks

_IndexArray = NDArray[np.intp]

CELL = 0.5
"""Side of a cell, metres."""
MOST_CELLS = 200_000
"""Of one floor. They take some 200 MB, and the distances from a place some tenths of a
second; both grow with their number."""
LARGEST_FLOOR = MOST_CELLS * CELL**2
"""Square metres that have so many cells."""
HALF_DIAGONAL = 0.7072
"""Of a cell of size 1, rounded up."""


@dataclass(frozen=True, eq=False)
class FloorGrid:
    """Square cells over a floor, joined where one can walk; nodes are 0 … N-1.

    >>> from shapely import box
    >>> grid = FloorGrid.from_polygon(box(0, 0, 2, 1))
    >>> len(grid), grid.centres[4].tolist()
    (15, [0.5, 0.5])
    >>> grid.map_path([(0.1, 0.6), (1.9, 0.6)]).tolist()
    [1, 4, 7, 10, 13]
    """

    floor: Floor
    """What it was made from."""
    cell: float
    """Side of a cell, metres."""
    tolerance: float
    """Metres a mapped point may lie off the floor."""
    centres: FloatArray
    """Position of every node, metres, shape (N, 2)."""
    graph: csr_array
    """Symmetric step lengths, metres, shape (N, N)."""

    @classmethod
    def from_polygon(
        cls, floor: Polygon | MultiPolygon, cell: float = CELL, tolerance: float = 0.5
    ) -> Self:
        """Lay a grid of cells of some metres over a floor.

        Points may lie off the floor by as many metres as `tolerance`, and still be
        mapped.
        """
        if not (np.isfinite(cell) and cell > 0):
            raise ValueError(f"expected a cell size > 0 m, got {cell}")
        cells = floor.area / cell**2
        if cells > MOST_CELLS:
            raise ValueError(
                f"expected a floor of at most {MOST_CELLS * cell**2:,.0f} m² for cells "
                f"of {cell:g} m, got {floor.area:,.0f} m²"
            )
        prepared = Floor(floor)
        west, south, east, north = floor.bounds
        xs = np.arange(np.floor(west / cell), np.ceil(east / cell) + 1) * cell
        ys = np.arange(np.floor(south / cell), np.ceil(north / cell) + 1) * cell
        # Row by row: the box around a building may be far larger than its floor.
        on_floor = np.stack([prepared.contains(np.full_like(ys, x), ys) for x in xs])
        if not on_floor.any():
            raise ValueError(f"no centre of a {cell} m cell lies on the floor")
        number = np.full(on_floor.shape, -1, dtype=np.int32)
        number[on_floor] = np.arange(np.count_nonzero(on_floor))
        rows, columns = np.nonzero(on_floor)
        centres = np.column_stack([xs[rows], ys[columns]])
        graph = _steps(number, centres, prepared, cell)
        labels = connected_components(graph, directed=False)[1]
        kept = np.flatnonzero(labels == np.argmax(np.bincount(labels)))
        pieces = csr_array(graph[kept][:, kept])
        return cls(prepared, cell, tolerance, centres[kept], pieces)

    def __len__(self) -> int:
        """Return the number of nodes."""
        return len(self.centres)

    def map_points(self, points: ArrayLike) -> _IndexArray:
        """Return the node of each point (K, 2): the nearest that no wall hides.

        Where walls hide the nine nearest nodes, the nearest of all is taken. A point
        farther than `tolerance` off the floor, or than that and a cell from its node
        (as in a piece of floor that the grid does not reach), raises
        `UndefinedMetricError`.
        """
        places = self.floor.onto(points, self.tolerance)
        near = min(9, len(self))
        answer = self._tree.query(places, k=near)
        gaps = np.asarray(answer[0], dtype=np.float64).reshape(len(places), near)
        nodes = np.asarray(answer[1], dtype=np.intp).reshape(len(places), near)
        best = np.zeros(len(places), dtype=np.intp)
        doubtful = np.flatnonzero(
            self._beside_edge[nodes[:, 0]] | (gaps[:, 0] > HALF_DIAGONAL * self.cell)
        )
        seen = self.floor.joins(places[doubtful], self.centres[nodes[doubtful, 0]])
        for index in doubtful[~seen]:
            spot = np.broadcast_to(places[index], (near, 2))
            best[index] = np.argmax(self.floor.joins(spot, self.centres[nodes[index]]))
        every = np.arange(len(places))
        lost = np.flatnonzero(gaps[every, best] > self.tolerance + self.cell)
        if len(lost):
            (x, y), gap = places[lost[0]], gaps[lost[0], best[lost[0]]]
            raise UndefinedMetricError(
                f"point {lost[0]} at ({x:.3f}, {y:.3f}) is {gap:.2f} m from the nearest "
                f"cell of the main floor; at most {self.tolerance + self.cell:.2f} m "
                "are allowed"
            )
        return nodes[every, best]

    def map_path(self, points: ArrayLike) -> _IndexArray:
        """Return the nodes a path (N, 2) passes, consecutive repeats removed.

        The path is sampled at steps of one cell, so that consecutive nodes are
        neighbours and a straight walk beside a cell's edge makes few detours. None of
        its own points may lie farther off the floor than `tolerance`.
        """
        if np.size(points) == 0:
            raise UndefinedMetricError(
                "expected a path of at least one point, got none"
            )
        # Samples pass over a point between them, and have numbers of their own.
        self.floor.onto(points, self.tolerance)
        nodes = self.map_points(polyline.resample(points, self.cell))
        return nodes[np.concatenate([[True], nodes[1:] != nodes[:-1]])]

    def distances_from(self, nodes: ArrayLike) -> FloatArray:
        """Return the shortest distances from some nodes to all, shape (k, N), metres.

        The latest answers are remembered, so asking for them again is fast.
        """
        return self._rows.rows(self._checked(nodes))

    def between(self, starts: ArrayLike, ends: ArrayLike) -> FloatArray:
        """Return the distances from k start nodes to m end nodes, (k, m) metres."""
        return self._rows.between(self._checked(starts), self._checked(ends))

    def along(self, nodes: ArrayLike) -> FloatArray:
        """Return the distances between consecutive nodes, shape (k - 1,), metres."""
        passed = self._checked(nodes)
        tails, heads = passed[:-1], passed[1:]
        if len(tails) == 0:
            return np.empty(0)
        steps = np.asarray(self.graph[tails, heads], dtype=np.float64)
        for index in np.flatnonzero((steps == 0) & (tails != heads)):
            row = dijkstra(self.graph, indices=tails[index])
            steps[index] = row[heads[index]]
        return steps

    def distance(self, point_a: ArrayLike, point_b: ArrayLike) -> float:
        """Return the length of the shortest walk between two points, metres.

        Exact on the floor's polygon, not rounded to cells: see `ShortestWalks`.
        """
        return self.walks.distance(point_a, point_b)

    @cached_property
    def walks(self) -> ShortestWalks:
        """Exact shortest walks on the same floor."""
        return ShortestWalks(self.floor, self.tolerance)

    @cached_property
    def _rows(self) -> DistanceRows:
        return DistanceRows(self.graph)

    @cached_property
    def _tree(self) -> KDTree:
        return KDTree(self.centres)

    @cached_property
    def _beside_edge(self) -> BoolArray:
        return self.floor.beside_edge(self.centres, HALF_DIAGONAL * self.cell)

    def _checked(self, nodes: ArrayLike) -> _IndexArray:
        ids = np.asarray(nodes)
        if ids.ndim != 1 or (len(ids) and not np.issubdtype(ids.dtype, np.integer)):
            raise ValueError(f"expected node ids of shape (k,), got {nodes!r}")
        wrong = np.flatnonzero((ids < 0) | (ids >= len(self)))
        if len(wrong):
            raise UndefinedMetricError(
                f"expected nodes from 0 to {len(self) - 1}, got {ids[wrong[0]]} at "
                f"index {wrong[0]}"
            )
        return ids.astype(np.intp)


def _steps(
    number: NDArray[np.int32], centres: FloatArray, floor: Floor, cell: float
) -> csr_array:
    """Join neighbouring cells; `number` is the node of each cell or -1."""
    beside_edge = floor.beside_edge(centres, HALF_DIAGONAL * cell)

    def joined(tails: NDArray[np.int32], heads: NDArray[np.int32]) -> BoolArray:
        is_open = (tails >= 0) & (heads >= 0)
        doubtful = is_open & (beside_edge[tails] | beside_edge[heads])
        is_open[doubtful] = floor.joins(
            centres[tails[doubtful]], centres[heads[doubtful]]
        )
        return is_open

    east = joined(number[:-1], number[1:])
    north = joined(number[:, :-1], number[:, 1:])
    square = east[:, :-1] & east[:, 1:] & north[:-1] & north[1:]
    corners = (number[:-1, :-1], number[1:, 1:], number[1:, :-1], number[:-1, 1:])
    rising = square & joined(corners[0], corners[1])
    falling = square & joined(corners[2], corners[3])
    kinds: Sequence[tuple[NDArray[np.int32], NDArray[np.int32], BoolArray, float]] = (
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
