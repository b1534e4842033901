"""The walk on a navigation graph that runs along a line on the floor."""

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.geometry.polyline import resample
from memorymaze.sites.navigation_graph import NavigationGraph, Viewpoint

STEP = 0.5
"""Metres between the places of the line that are compared with viewpoints."""
CHANGE = 0.05
"""Square metres that going on to the next viewpoint costs, so that none is visited for
nothing."""


def viewpoints_along(graph: NavigationGraph, line: ArrayLike) -> tuple[Viewpoint, ...]:
    """Return the viewpoints that a walk along a line visits, in order.

    Of all walks on the graph it is the one that stays nearest to the line all along:
    the least sum of squared distances between places on the line, in order, and the
    viewpoint that one is at (map matching by dynamic programming).

    Args:
        graph: Of the site the line lies in.
        line: Vertices, metres, shape (N, 2).

    Returns:
        At least one viewpoint; neighbours in the result are neighbours in the graph.
    """
    places = np.array([(each.x, each.y) for each in graph.viewpoints])
    samples = resample(line, STEP)
    apart = ((samples[:, None, :] - places[None, :, :]) ** 2).sum(axis=2)
    arrivals = _arrivals(graph)
    cost = apart[0]
    came_from: list[NDArray[np.intp]] = []
    for row in apart[1:]:
        candidates = np.where(arrivals, cost[:, None] + CHANGE, np.inf)
        np.fill_diagonal(candidates, cost)
        came_from.append(candidates.argmin(axis=0))
        cost = candidates.min(axis=0) + row
    at = int(cost.argmin())
    visited = [at]
    for before in reversed(came_from):
        at = int(before[at])
        visited.append(at)
    visited.reverse()
    changes = [there for here, there in pairwise(visited) if here != there]
    return tuple(graph.viewpoints[index] for index in [visited[0], *changes])


def _arrivals(graph: NavigationGraph) -> NDArray[np.bool_]:
    """Return whether one can go from the row's viewpoint to the column's."""
    joined = np.zeros((len(graph.viewpoints),) * 2, dtype=bool)
    for first, second in graph.edges:
        joined[first, second] = joined[second, first] = True
    return joined
