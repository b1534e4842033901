"""Shortest distances on a sparse graph, computed when asked for and remembered."""

from collections import OrderedDict

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

NUMBERS_KEPT = 20_000_000
"""Distances remembered between calls, at most (160 MB)."""


class DistanceRows:
    """Distances from single nodes to all, by Dijkstra's algorithm.

    Rows asked for lately are kept, so asking for them again is fast.
    """

    def __init__(self, graph: csr_array) -> None:
        """Take symmetric step lengths, metres, shape (N, N).

        A stored 0 is a step of no length; what is not stored is no step.
        """
        self._graph = graph
        self._count = len(graph.indptr) - 1
        self._kept: OrderedDict[int, NDArray[np.float64]] = OrderedDict()

    def rows(self, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Return the distances from some nodes to all, shape (k, N), metres.

        Infinite where no way joins the two.
        """
        return self.between(nodes, None)

    def between(
        self, starts: NDArray[np.intp], ends: NDArray[np.intp] | None
    ) -> NDArray[np.float64]:
        """Return the distances from each start to each end, shape (k, m), metres.

        Infinite where no way joins the two. The ends are all nodes when None.
        """
        answer = np.empty((len(starts), self._count if ends is None else len(ends)))
        at_once = max(1, NUMBERS_KEPT // max(1, self._count))
        for first in range(0, len(starts), at_once):
            wanted = [int(node) for node in starts[first : first + at_once]]
            self._find(wanted)
            for index, node in enumerate(wanted, start=first):
                row = self._kept[node]
                answer[index] = row if ends is None else row[ends]
                self._kept.move_to_end(node)
            while len(self._kept) > at_once:
                self._kept.popitem(last=False)
        return answer

    def _find(self, nodes: list[int]) -> None:
        missing = sorted({node for node in nodes if node not in self._kept})
        if missing:
            found = np.atleast_2d(dijkstra(self._graph, indices=missing))
            # Copies, because a view would keep all of `found` in memory.
            self._kept.update((node, found[i].copy()) for i, node in enumerate(missing))
