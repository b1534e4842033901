"""Shortest distances on a sparse graph, computed when asked for and remembered."""

from collections import OrderedDict

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

__all__ = ["DistanceRows"]

NUMBERS_KEPT = 20_000_000
"""Distances remembered between calls, at most (160 MB)."""


class DistanceRows:
    """Distances from single nodes to all, by Dijkstra's algorithm.

    Rows asked for lately are kept, so asking for them again is fast.
    """

    def __init__(self, graph: csr_array) -> None:
        """Take a graph.

        Args:
            graph: Symmetric step lengths, metres, shape (N, N). A stored 0 is a step
                of no length; what is not stored is no step.
        """
        self._graph = graph
        self._count = len(graph.indptr) - 1
        self._kept: OrderedDict[int, NDArray[np.float64]] = OrderedDict()

    def rows(self, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Return the distances from some nodes to all, shape (k, N), metres.

        Infinite where no way joins the two.
        """
        distinct, places = np.unique(nodes, return_inverse=True)
        missing = [int(node) for node in distinct if int(node) not in self._kept]
        if missing:
            found = np.atleast_2d(dijkstra(self._graph, indices=missing))
            self._kept.update(zip(missing, found, strict=True))
        answer = np.empty((len(distinct), self._count))
        for index, node in enumerate(map(int, distinct)):
            answer[index] = self._kept[node]
            self._kept.move_to_end(node)
        while len(self._kept) * self._count > NUMBERS_KEPT:
            self._kept.popitem(last=False)
        return answer[places]
