"""Shortest distances on a graph of named places, such as an R2R navigation graph."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.distance_rows import DistanceRows


class WeightedGraph:
    """An undirected graph; distances are sums of edge lengths, never straight lines.

    >>> ring = WeightedGraph("abc", [("a", "b", 1.0), ("b", "c", 1.0)])
    >>> ring.between(["a"], ["c", "a"]).tolist(), ring.along(["a", "c", "b"]).tolist()
    ([[2.0, 0.0]], [2.0, 1.0])
    """

    def __init__(
        self, nodes: Iterable[str], edges: Iterable[tuple[str, str, float]]
    ) -> None:
        """Join the nodes.

        Args:
            nodes: Ids.
            edges: Two ids and the length of the way between them, metres, >= 0. Of
                several edges between two nodes the shortest counts.

        Raises:
            UndefinedMetricError: An edge has an unknown node or a bad length.
        """
        self._index = {node: index for index, node in enumerate(nodes)}
        lengths: dict[tuple[int, int], float] = {}
        for number, (start, end, metres) in enumerate(edges):
            for node in (start, end):
                if node not in self._index:
                    raise UndefinedMetricError(
                        f"edge {number} ({start!r} to {end!r}): unknown node {node!r}"
                    )
            if not (math.isfinite(metres) and metres >= 0):
                raise UndefinedMetricError(
                    f"edge {number} ({start!r} to {end!r}): expected a length >= 0 m, "
                    f"got {metres}"
                )
            here, there = self._index[start], self._index[end]
            shortest = min(metres, lengths.get((here, there), math.inf))
            lengths[here, there] = lengths[there, here] = shortest
        self._rows = DistanceRows(_table(len(self._index), lengths))

    def between(
        self, starts: Sequence[str], ends: Sequence[str]
    ) -> NDArray[np.float64]:
        """Return the distances from each start to each end, shape (k, m), metres.

        Infinite where no way joins the two.

        Raises:
            UndefinedMetricError: A node is not in the graph.
        """
        # Summed from the ends, which are the agent's places, as the field's reference
        # code does: a distance that rounds to the threshold is then judged alike.
        return self._rows.between(self._numbers(ends), self._numbers(starts)).T

    def along(self, nodes: Sequence[str]) -> NDArray[np.float64]:
        """Return the distances between consecutive nodes, shape (k - 1,), metres.

        Consecutive nodes need not be neighbours. Infinite where no way joins the two.

        Raises:
            UndefinedMetricError: A node is not in the graph.
        """
        numbers = self._numbers(nodes)
        rows = self._rows.rows(numbers[:-1])
        return rows[np.arange(len(rows)), numbers[1:]]

    def _numbers(self, nodes: Sequence[str]) -> NDArray[np.intp]:
        for place, node in enumerate(nodes):
            if node not in self._index:
                raise UndefinedMetricError(
                    f"unknown node {node!r} at place {place} of the path"
                )
        return np.array([self._index[node] for node in nodes], dtype=np.intp)


def _table(count: int, lengths: dict[tuple[int, int], float]) -> csr_array:
    ends = np.array(list(lengths), dtype=np.intp).reshape(-1, 2)
    metres = np.array(list(lengths.values()), dtype=np.float64)
    return coo_array((metres, (ends[:, 0], ends[:, 1])), shape=(count, count)).tocsr()
