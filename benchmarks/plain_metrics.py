"""CLS and nDTW written straight from their formulas, to be measured against.

Dictionaries of dictionaries and loops, as the field's reference code has them; nothing
of the project is used.
"""

import heapq
import math
from itertools import pairwise

__all__ = ["Distances", "Graph", "all_distances", "cls", "ndtw"]

Graph = dict[int, dict[int, float]]
"""Neighbours of every node and the metres to them."""

Distances = dict[int, dict[int, float]]
"""Shortest distances by start and end, metres."""


def all_distances(graph: Graph) -> Distances:
    """Return the shortest distances between all pairs: Dijkstra from every node."""
    return {start: distances_from(graph, start) for start in graph}


def distances_from(graph: Graph, start: int) -> dict[int, float]:
    """Return the shortest distances from one node to all it can reach."""
    found: dict[int, float] = {}
    queue = [(0.0, start)]
    while queue:
        metres, node = heapq.heappop(queue)
        if node in found:
            continue
        found[node] = metres
        for neighbour, step in graph[node].items():
            if neighbour not in found:
                heapq.heappush(queue, (metres + step, neighbour))
    return found


def length(distances: Distances, path: list[int]) -> float:
    """Return the length of a path, metres."""
    return sum(distances[a][b] for a, b in pairwise(path))


def cls(
    distances: Distances, reference: list[int], path: list[int], threshold: float
) -> float:
    """Return coverage weighted by length score."""
    nearest = [min(distances[r][p] for p in path) for r in reference]
    coverage = sum(math.exp(-metres / threshold) for metres in nearest) / len(reference)
    expected = coverage * length(distances, reference)
    walked = length(distances, path)
    return coverage * expected / (expected + abs(expected - walked))


def ndtw(
    distances: Distances, reference: list[int], path: list[int], threshold: float
) -> float:
    """Return normalised dynamic time warping."""
    table = [[math.inf] * (len(path) + 1) for _ in range(len(reference) + 1)]
    table[0][0] = 0.0
    for i, r in enumerate(reference, start=1):
        for j, p in enumerate(path, start=1):
            best = min(table[i - 1][j], table[i][j - 1], table[i - 1][j - 1])
            table[i][j] = distances[r][p] + best
    return math.exp(-table[-1][-1] / (threshold * len(reference)))
