import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.runs.metrics.graph import WeightedGraph
from memorymaze.runs.metrics.score import score_path, score_walk

FILE = Path(__file__).parent / "data" / "cases_synthetic.json"
CONTENT: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def graphs() -> dict[str, WeightedGraph]:
    return {
        name: WeightedGraph(graph["nodes"], graph["edges"])
        for name, graph in CONTENT["graphs"].items()
    }


@pytest.mark.parametrize("case", CONTENT["cases"], ids=lambda case: case["id"])
def test_values_equal_those_of_the_reference_implementation(
    case: dict[str, Any], graphs: dict[str, WeightedGraph]
) -> None:
    values = score_path(
        graphs[case["graph"]],
        case["reference_path"],
        case["agent_path"],
        case["threshold"],
    )
    assert values.as_dict() == pytest.approx(case["expected"], rel=0, abs=1e-9)


@pytest.mark.parametrize(
    "case", CONTENT["undefined_cases"], ids=lambda case: case["id"]
)
def test_where_the_reference_implementation_fails_the_metrics_are_undefined(
    case: dict[str, Any], graphs: dict[str, WeightedGraph]
) -> None:
    with pytest.raises(UndefinedMetricError):
        score_path(
            graphs[case["graph"]],
            case["reference_path"],
            case["agent_path"],
            case["threshold"],
        )


LINE = WeightedGraph("abcde", [("a", "b", 2.0), ("b", "c", 2.0), ("c", "d", 2.0)])


@pytest.mark.parametrize(
    ("reference", "agent", "threshold", "message"),
    [
        ("", "a", 3.0, "in the reference path"),
        ("a", "", 3.0, "in the agent's path"),
        ("ab", "az", 3.0, "unknown node 'z' at place 1"),
        ("zb", "a", 3.0, "unknown node 'z' at place 0"),
        ("ab", "ae", 3.0, "reference node 'a' and agent node 'e'"),
        ("ae", "ab", 3.0, "reference node 'e' and agent node 'a'"),
        ("ab", "ab", 0.0, "threshold > 0"),
        ("ab", "ab", math.nan, "threshold > 0"),
    ],
)
def test_what_leaves_metrics_undefined_is_said(
    reference: str, agent: str, threshold: float, message: str
) -> None:
    with pytest.raises(UndefinedMetricError, match=message):
        score_path(LINE, reference, agent, threshold)


def test_a_walk_that_others_ended_is_no_success() -> None:
    values = score_path(LINE, "abcd", "abcd")
    failed = values.without_success()
    assert (values.success, values.spl, values.sdtw) == (1, 1, 1)
    assert (failed.success, failed.spl, failed.sdtw) == (0, 0, 0)
    assert (failed.oracle_success, failed.cls, failed.ndtw) == (1, 1, 1)


def test_a_grid_and_the_graph_of_its_steps_score_alike(pillar_grid: FloorGrid) -> None:
    steps = pillar_grid.graph.tocoo()
    edges = zip(map(str, steps.row), map(str, steps.col), steps.data, strict=True)
    graph = WeightedGraph(map(str, range(len(pillar_grid))), edges)
    reference = pillar_grid.map_path([(1, 1), (9, 1), (9, 9)]).tolist()
    agent = pillar_grid.map_path([(1, 1), (1, 9), (8, 9)]).tolist()
    on_graph = score_path(graph, [str(n) for n in reference], [str(n) for n in agent])
    assert score_path(pillar_grid, reference, agent).as_dict() == pytest.approx(
        on_graph.as_dict(), abs=1e-12
    )


@pytest.fixture(scope="module")
def pillar_grid() -> FloorGrid:
    """A hall of 10 m by 10 m with a pillar of 4 m by 4 m in its middle."""
    return FloorGrid.from_polygon(shapely.box(0, 0, 10, 10) - shapely.box(3, 3, 7, 7))


ROUND_THE_CORNER = [(1.0, 1.0), (9.0, 1.0), (9.0, 9.0)]


def test_walking_the_reference_scores_best(pillar_grid: FloorGrid) -> None:
    values = score_walk(pillar_grid, ROUND_THE_CORNER, ROUND_THE_CORNER)
    shortest = 2 * math.hypot(6, 2)
    assert values.as_dict() == pytest.approx({
        "success": 1,
        "oracle_success": 1,
        "ne": 0,
        "spl": shortest / 16,
        "cls": 1,
        "ndtw": 1,
        "sdtw": 1,
        "path_length": 16,
    })


def test_success_is_measured_on_the_floor_and_not_in_cells(
    pillar_grid: FloorGrid,
) -> None:
    """A cell more or less does not matter: 2.99 m is success and 3.0 m is none."""
    for left, success in ((2.99, 1.0), (3.0, 0.0)):
        path = [(1.0, 1.0), (9.0, 1.0), (9.0, 9.0 - left)]
        values = score_walk(pillar_grid, ROUND_THE_CORNER, path)
        assert values.ne == pytest.approx(left)
        assert values.success == success
        assert values.sdtw == success * values.ndtw


def test_passing_the_goal_is_oracle_success_only(pillar_grid: FloorGrid) -> None:
    passing = [*ROUND_THE_CORNER, (1.0, 9.0)]
    values = score_walk(pillar_grid, ROUND_THE_CORNER, passing)
    assert (values.success, values.oracle_success) == (0, 1)
    assert values.ne == pytest.approx(8)


def test_nearness_through_a_wall_is_no_oracle_success() -> None:
    floor = shapely.box(0, 0, 20, 4) - shapely.box(2, 1.9, 18, 2.1)
    grid = FloorGrid.from_polygon(floor)
    reference = [(10.0, 3.0), (1.0, 3.0), (1.0, 1.0), (10.0, 1.0)]
    stays = [(10.0, 3.0), (11.0, 3.0)]
    assert score_walk(grid, reference, stays).oracle_success == 0


def test_the_other_way_round_covers_less(pillar_grid: FloorGrid) -> None:
    other = [(1.0, 1.0), (1.0, 9.0), (9.0, 9.0)]
    values = score_walk(pillar_grid, ROUND_THE_CORNER, other)
    assert values.success == 1
    assert values.cls < 0.6
    assert values.ndtw < 0.5


def test_standing_still_is_a_walk_of_no_length(pillar_grid: FloorGrid) -> None:
    values = score_walk(pillar_grid, ROUND_THE_CORNER, [(1.0, 1.0)])
    assert (values.path_length, values.success, values.spl) == (0, 0, 0)
    assert values.ne == pytest.approx(2 * math.hypot(6, 2))


def test_an_empty_walk_is_undefined(pillar_grid: FloorGrid) -> None:
    with pytest.raises(UndefinedMetricError, match="agent's path"):
        score_walk(pillar_grid, ROUND_THE_CORNER, np.empty((0, 2)))


def test_a_walk_off_the_floor_is_undefined(pillar_grid: FloorGrid) -> None:
    with pytest.raises(UndefinedMetricError, match="off the floor"):
        score_walk(pillar_grid, ROUND_THE_CORNER, [(1.0, 1.0), (5.0, 5.0)])


@pytest.mark.parametrize(
    ("walk", "said"),
    [
        ([(1, 2), (10, 40), (18, 2)], r"point 1 at \(10.000, 40.000\) is 36.00 m off"),
        (
            [(1, 2), (10, 2), (10, 4.7), (10, 2), (18, 2)],
            r"point 2 at \(10.000, 4.700\) is 0.70 m off",
        ),
        (
            [(1, 2), (17, 2), (17, 4.7), (17, 2), (18, 2)],
            r"point 2 at \(17.000, 4.700\) is 0.70 m off",
        ),
        ([(1, 2), (math.nan, 2), (18, 2)], "point 1 is not finite"),
    ],
)
def test_every_position_off_the_floor_is_told_by_its_own_number(
    walk: list[tuple[float, float]], said: str
) -> None:
    grid, along = FloorGrid.from_polygon(shapely.box(0, 0, 20, 4)), [(1, 2), (18, 2)]
    with pytest.raises(UndefinedMetricError, match=said):
        score_walk(grid, along, walk)
    with pytest.raises(UndefinedMetricError, match=said):
        score_walk(grid, walk, along)


def test_a_threshold_without_meaning_is_undefined(pillar_grid: FloorGrid) -> None:
    with pytest.raises(UndefinedMetricError, match="threshold > 0"):
        score_walk(pillar_grid, ROUND_THE_CORNER, ROUND_THE_CORNER, 0.0)
