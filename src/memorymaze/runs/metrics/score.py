"""All eight path metrics of one walk, on a graph or on the floor of a building."""

from collections.abc import Sequence, Sized
from dataclasses import asdict, dataclass, replace
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.runs.metrics import efficiency, fidelity, success
from memorymaze.runs.metrics.success import SUCCESS_DISTANCE

_Node = TypeVar("_Node", contravariant=True)
"""What a graph calls its places: names, or numbers."""


class DistanceSource(Protocol[_Node]):
    """A graph that knows shortest distances: `WeightedGraph` or `FloorGrid`."""

    def between(
        self, starts: Sequence[_Node], ends: Sequence[_Node], /
    ) -> NDArray[np.float64]:
        """Return distances from starts to ends, shape (k, m), metres, maybe infinite."""
        ...

    def along(self, nodes: Sequence[_Node], /) -> NDArray[np.float64]:
        """Return distances between consecutive nodes, shape (k - 1,), metres."""
        ...


@dataclass(frozen=True, slots=True)
class MetricValues:
    """The metrics of one walk, under the names of the published reference cases."""

    success: float
    """SR, 0 or 1; whether the agent itself stopped is not looked at."""
    oracle_success: float
    """OSR, 0 or 1."""
    ne: float
    """Navigation error, the paper's SPD, metres."""
    spl: float
    """0 to 1."""
    cls: float
    """0 to 1."""
    ndtw: float
    """0 to 1."""
    sdtw: float
    """0 to 1."""
    path_length: float
    """Metres."""

    def without_success(self) -> "MetricValues":
        """Return the values of the same walk where the agent itself did not stop.

        SR, SPL and SDTW become 0; the others do not depend on who ended the walk.
        """
        return replace(self, success=0.0, spl=0.0, sdtw=0.0)

    def as_dict(self) -> dict[str, float]:
        """Return the eight values by name."""
        return asdict(self)


def score_path(
    source: DistanceSource[_Node],
    reference_nodes: Sequence[_Node],
    agent_nodes: Sequence[_Node],
    success_distance: float = SUCCESS_DISTANCE,
) -> MetricValues:
    """Score a path of nodes against a reference path of nodes on the same graph.

    The goal is the last reference node; SPL's shortest path begins at the first agent
    node. All distances are shortest distances on the graph; consecutive nodes need not
    be neighbours.

    Args:
        source: The graph.
        reference_nodes: At least one.
        agent_nodes: At least one.
        success_distance: Threshold, metres, > 0.

    Raises:
        UndefinedMetricError: A path is empty, a node unknown, a pair of nodes not
            joined, or the threshold not positive.
    """
    _demand_nodes(reference_nodes, agent_nodes)
    distances = source.between(reference_nodes, agent_nodes)
    apart = np.argwhere(np.isinf(distances))
    if len(apart):
        raise UndefinedMetricError(
            f"no way joins reference node {reference_nodes[apart[0][0]]!r} and agent "
            f"node {agent_nodes[apart[0][1]]!r}"
        )
    goal_distances = distances[-1]
    walked = efficiency.path_length(source.along(agent_nodes))
    described = efficiency.path_length(source.along(reference_nodes))
    reached = success.success(goal_distances, success_distance)
    ndtw = fidelity.ndtw(distances, success_distance)
    return MetricValues(
        success=reached,
        oracle_success=success.oracle_success(goal_distances, success_distance),
        ne=success.navigation_error(goal_distances),
        spl=efficiency.spl(reached, goal_distances[0], walked),
        cls=fidelity.cls(distances, described, walked, success_distance),
        ndtw=ndtw,
        sdtw=fidelity.sdtw(reached, ndtw),
        path_length=walked,
    )


def score_walk(
    grid: FloorGrid,
    reference_points: ArrayLike,
    agent_points: ArrayLike,
    success_distance: float = SUCCESS_DISTANCE,
) -> MetricValues:
    """Score a walk over a floor against a reference path on it.

    What does not need a graph is measured exactly: success, oracle success, navigation
    error and SPL by shortest walks on the floor, path length along the points. CLS and
    nDTW are computed on the grid, onto which both paths are mapped.

    Args:
        grid: The floor.
        reference_points: Vertices of the path described, metres, shape (N, 2); the
            last is the goal.
        agent_points: Positions of the agent in the order of time, metres, shape (M, 2).
        success_distance: Threshold, metres, > 0.

    Raises:
        UndefinedMetricError: A path is empty or leaves the floor, or the threshold is
            not positive.
    """
    reference, agent = np.asarray(reference_points), np.asarray(agent_points)
    _demand_nodes(reference, agent)
    on_grid = score_path(
        grid,
        grid.map_path(reference).tolist(),
        grid.map_path(agent).tolist(),
        success_distance,
    )
    goal = reference[-1]
    left = grid.walks.distances_to(goal, agent[[0, -1]])
    reached = success.success(left, success_distance)
    # No walk is shorter than the straight line, so farther points cannot count.
    near = np.hypot(*(agent - goal).T) < success_distance
    closest = np.append(grid.walks.distances_to(goal, agent[near]), left[-1])
    walked = polyline.length(agent)
    return MetricValues(
        success=reached,
        oracle_success=success.oracle_success(closest, success_distance),
        ne=success.navigation_error(left),
        spl=efficiency.spl(reached, float(left[0]), walked),
        cls=on_grid.cls,
        ndtw=on_grid.ndtw,
        sdtw=fidelity.sdtw(reached, on_grid.ndtw),
        path_length=walked,
    )


def _demand_nodes(reference: Sized, agent: Sized) -> None:
    for name, path in (("reference", reference), ("agent's", agent)):
        if len(path) == 0:
            raise UndefinedMetricError(
                f"expected at least one node in the {name} path, got none"
            )
