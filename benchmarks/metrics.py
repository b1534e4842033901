"""How long metrics take, on a grid of 2,000 nodes and paths of 300 nodes.

Ours and the plain implementation answer the same questions and must agree. Ours are
timed from node ids to value; the time to look distances up is included in both.
"""

import math

import numpy as np
import shapely

from benchmarks import plain_metrics
from benchmarks.measuring import Row, best_ms, timed
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.runs.metrics import efficiency, fidelity
from memorymaze.runs.metrics.score import score_path

NODES, PATH_NODES, THRESHOLD = 2_000, 300, 3.0
PLAIN = "plain Python from the formulas (benchmarks/plain_metrics.py)"


def run() -> list[Row]:
    grid = FloorGrid.from_polygon(shapely.box(0, 0, 19.5, 24.5))
    if len(grid) != NODES:
        raise AssertionError(f"expected {NODES} nodes, got {len(grid)}")
    rng = np.random.default_rng(0)
    reference, path = wander(grid, rng), wander(grid, rng)
    neighbours = neighbours_of(grid)
    plain, plain_ms = timed(lambda: plain_metrics.all_distances(neighbours))
    setup = Row(
        f"shortest distances, all pairs of {NODES} nodes",
        best_ms(lambda: all_pairs(grid), 3),
        "ms",
        plain_ms,
        PLAIN,
        target=1000.0,
    )
    grid.distances_from(np.arange(NODES))
    agree(grid, plain, reference, path)
    paths = f"{PATH_NODES} x {PATH_NODES} nodes"
    return [
        setup,
        Row(
            f"CLS, {paths}",
            best_ms(lambda: our_cls(grid, reference, path), 50),
            "ms",
            best_ms(lambda: plain_metrics.cls(plain, reference, path, THRESHOLD), 5),
            PLAIN,
            target=2.0,
        ),
        Row(
            f"nDTW, {paths}",
            best_ms(lambda: our_ndtw(grid, reference, path), 50),
            "ms",
            best_ms(lambda: plain_metrics.ndtw(plain, reference, path, THRESHOLD), 5),
            PLAIN,
            target=10.0,
        ),
        Row(
            f"all eight metrics, {paths}",
            best_ms(lambda: score_path(grid, reference, path, THRESHOLD), 50),
            "ms",
        ),
        Row(
            "grid of a 100 m x 60 m floor with 228 screens",
            best_ms(lambda: FloorGrid.from_polygon(floor_with_screens()), 3),
            "ms",
            target=300.0,
        ),
    ]


def wander(grid: FloorGrid, rng: np.random.Generator) -> list[int]:
    """Return a path of neighbouring nodes that keeps its direction more or less."""
    path = [int(rng.integers(len(grid)))]
    heading = rng.uniform(0, 2 * math.pi)
    while len(path) < PATH_NODES:
        here = path[-1]
        around = grid.graph.indices[
            grid.graph.indptr[here] : grid.graph.indptr[here + 1]
        ]
        ways = grid.centres[around] - grid.centres[here]
        heading += rng.normal(scale=0.3)
        ahead = ways @ (math.cos(heading), math.sin(heading)) / np.hypot(*ways.T)
        path.append(int(around[np.argmax(ahead)]))
    return path


def neighbours_of(grid: FloorGrid) -> plain_metrics.Graph:
    table = grid.graph.tocoo()
    graph: plain_metrics.Graph = {node: {} for node in range(len(grid))}
    for tail, head, metres in zip(table.row, table.col, table.data, strict=True):
        graph[int(tail)][int(head)] = float(metres)
    return graph


def all_pairs(grid: FloorGrid) -> None:
    """Compute all distances afresh, as for a floor seen for the first time."""
    fresh = FloorGrid(grid.floor, grid.cell, grid.tolerance, grid.centres, grid.graph)
    fresh.distances_from(np.arange(len(fresh)))


def our_cls(grid: FloorGrid, reference: list[int], path: list[int]) -> float:
    return fidelity.cls(
        grid.between(reference, path),
        efficiency.path_length(grid.along(reference)),
        efficiency.path_length(grid.along(path)),
        THRESHOLD,
    )


def our_ndtw(grid: FloorGrid, reference: list[int], path: list[int]) -> float:
    return fidelity.ndtw(grid.between(reference, path), THRESHOLD)


def agree(
    grid: FloorGrid,
    plain: plain_metrics.Distances,
    reference: list[int],
    path: list[int],
) -> None:
    """Demand that both implementations give the same values."""
    pairs = (
        (our_cls(grid, reference, path), plain_metrics.cls),
        (our_ndtw(grid, reference, path), plain_metrics.ndtw),
    )
    for ours, metric in pairs:
        theirs = metric(plain, reference, path, THRESHOLD)
        if abs(ours - theirs) > 1e-9:
            raise AssertionError(f"{metric.__name__}: ours {ours}, plain {theirs}")


def floor_with_screens() -> shapely.Polygon:
    screens = [
        shapely.box(x, y, x + 3, y + 0.2).exterior.coords
        for x in range(2, 97, 5)
        for y in range(2, 58, 5)
    ]
    return shapely.Polygon([(0, 0), (100, 0), (100, 60), (0, 60)], screens)
