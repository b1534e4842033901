import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.fidelity import cls, coverage, dtw, ndtw, sdtw

matrices = arrays(
    np.float64,
    array_shapes(min_dims=2, max_dims=2, max_side=12),
    elements=st.floats(0, 50),
)
lines = st.lists(st.floats(-50, 50), min_size=1, max_size=15).map(np.array)
metres = st.floats(0, 1000)

E_1 = math.exp(-1)


def apart(reference: np.ndarray, agent: np.ndarray) -> np.ndarray:
    """Return distances between places on a line, a metric like any other."""
    return np.abs(reference[:, None] - agent[None])


def length(line: np.ndarray) -> float:
    return float(np.abs(np.diff(line)).sum())


@pytest.mark.parametrize(
    ("reference", "agent", "pc", "score"),
    [
        pytest.param([0, 3, 6], [0, 3, 6], 1, 1, id="the path itself"),
        pytest.param([0, 3, 6], [6, 3, 0], 1, 1, id="backwards"),
        pytest.param([0, 3], [0], (1 + E_1) / 2, (1 + E_1) / 4, id="stands at start"),
        pytest.param([0, 3], [0, 3, 0, 3], 1, 1 / 3, id="there, back and there again"),
        pytest.param([0, 0], [0, 0], 1, 1, id="nothing to walk, nothing walked"),
        pytest.param([0], [0, 3], 1, 0, id="nothing to walk, but walked"),
        pytest.param([0], [3], E_1, 1, id="nothing walked, elsewhere"),
    ],
)
def test_coverage_and_cls_are_as_worked_by_hand(
    reference: list[float], agent: list[float], pc: float, score: float
) -> None:
    r, p = np.array(reference, dtype=float), np.array(agent, dtype=float)
    assert coverage(apart(r, p)) == pytest.approx(pc)
    assert cls(apart(r, p), length(r), length(p)) == pytest.approx(score)


@pytest.mark.parametrize(
    ("reference", "agent", "cost"),
    [
        pytest.param([0, 1, 2], [0, 1, 2], 0, id="the path itself"),
        pytest.param([0, 1, 2], [0, 0, 1, 2, 2], 0, id="pauses cost nothing"),
        pytest.param([0, 1, 2], [2, 1, 0], 4, id="backwards"),
        pytest.param([0, 1, 2], [1], 2, id="one place"),
        pytest.param([1], [0, 1, 2], 2, id="one place to be at"),
        pytest.param([0, 4], [0, 1, 4], 1, id="one place between"),
    ],
)
def test_dtw_is_as_worked_by_hand(
    reference: list[float], agent: list[float], cost: float
) -> None:
    r, p = np.array(reference, dtype=float), np.array(agent, dtype=float)
    assert dtw(apart(r, p)) == cost
    assert ndtw(apart(r, p)) == pytest.approx(math.exp(-cost / (3 * len(r))))


def dtw_by_the_definition(costs: np.ndarray) -> float:
    rows, columns = costs.shape
    table = np.full((rows + 1, columns + 1), np.inf)
    table[0, 0] = 0
    for i in range(rows):
        for j in range(columns):
            best = min(table[i, j], table[i, j + 1], table[i + 1, j])
            table[i + 1, j + 1] = costs[i, j] + best
    return table[-1, -1]


@given(matrices)
def test_dtw_equals_its_definition(costs: np.ndarray) -> None:
    assert dtw(costs) == pytest.approx(dtw_by_the_definition(costs), rel=1e-12)


@given(matrices)
def test_dtw_is_symmetric_and_does_not_change_when_both_walk_backwards(
    costs: np.ndarray,
) -> None:
    assert dtw(costs.T) == pytest.approx(dtw(costs))
    assert dtw(costs[::-1, ::-1]) == pytest.approx(dtw(costs))


def test_dtw_leaves_its_input_alone() -> None:
    costs = np.arange(12.0).reshape(3, 4)
    dtw(costs)
    assert costs.tolist() == np.arange(12.0).reshape(3, 4).tolist()


@given(lines, st.floats(0.1, 20))
def test_the_reference_itself_scores_one(line: np.ndarray, near: float) -> None:
    costs = apart(line, line)
    assert ndtw(costs, near) == 1
    assert coverage(costs, near) == 1
    assert cls(costs, length(line), length(line), near) == 1


@given(matrices, metres, metres, st.floats(0.1, 20))
def test_fidelity_is_between_zero_and_one(
    costs: np.ndarray, described: float, walked: float, near: float
) -> None:
    assert 0 <= ndtw(costs, near) <= 1
    assert 0 <= cls(costs, described, walked, near) <= 1


@given(matrices, metres, metres, st.data())
def test_cls_ignores_the_order_of_places(
    costs: np.ndarray, described: float, walked: float, data: st.DataObject
) -> None:
    rows = data.draw(st.permutations(range(costs.shape[0])))
    columns = data.draw(st.permutations(range(costs.shape[1])))
    assert cls(costs[rows][:, columns], described, walked) == pytest.approx(
        cls(costs, described, walked)
    )


def test_ndtw_does_not_ignore_the_order() -> None:
    line = np.array([0.0, 5.0, 10.0])
    assert ndtw(apart(line, line[::-1])) < ndtw(apart(line, line))


def test_repeated_places_of_the_reference_count() -> None:
    agent = np.array([0.0])
    once, twice = np.array([0.0, 3.0]), np.array([0.0, 3.0, 3.0])
    assert coverage(apart(once, agent)) > coverage(apart(twice, agent))


@pytest.mark.parametrize("metric", [coverage, ndtw])
@pytest.mark.parametrize(
    ("costs", "message"),
    [
        pytest.param(np.empty((0, 3)), "at least one node", id="no reference"),
        pytest.param(np.empty((3, 0)), "at least one node", id="no path"),
        pytest.param([[1.0, math.nan]], "got nan", id="nan"),
        pytest.param([[1.0], [math.inf]], "not joined", id="disconnected"),
        pytest.param([[-1.0]], "got -1", id="negative"),
        pytest.param([1.0, 2.0], "2 dimension", id="not a matrix"),
    ],
)
def test_undefined_distances_are_refused(
    metric: object, costs: object, message: str
) -> None:
    assert callable(metric)
    with pytest.raises(UndefinedMetricError, match=message):
        metric(costs)


@pytest.mark.parametrize("near", [0.0, -1.0, math.nan])
def test_a_threshold_without_meaning_is_refused(near: float) -> None:
    for call in (
        lambda: coverage([[1.0]], near),
        lambda: ndtw([[1.0]], near),
        lambda: cls([[1.0]], 1.0, 1.0, near),
    ):
        with pytest.raises(UndefinedMetricError, match="threshold > 0"):
            call()


@pytest.mark.parametrize(
    ("described", "walked", "name"),
    [(math.nan, 1.0, "reference length"), (1.0, math.inf, "path length")],
)
def test_cls_refuses_lengths_without_meaning(
    described: float, walked: float, name: str
) -> None:
    with pytest.raises(UndefinedMetricError, match=name):
        cls([[1.0]], described, walked)


@pytest.mark.parametrize(
    ("success", "value"), [(0.5, 0.5), (1.0, 1.5), (1.0, math.nan)]
)
def test_sdtw_refuses_what_is_no_success_or_ndtw(success: float, value: float) -> None:
    with pytest.raises(UndefinedMetricError, match="expected a success"):
        sdtw(success, value)
