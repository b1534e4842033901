import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.success import navigation_error, oracle_success, success

distances = st.lists(st.floats(0, 100), min_size=1)


@pytest.mark.parametrize(
    ("goal_distances", "ne", "sr", "osr"),
    [
        pytest.param([0.0], 0.0, 1, 1, id="starts and stays at the goal"),
        pytest.param([9.0, 5.0, 1.0], 1.0, 1, 1, id="arrives"),
        pytest.param([9.0, 1.0, 5.0], 5.0, 0, 1, id="passes by"),
        pytest.param([9.0, 8.0, 7.0], 7.0, 0, 0, id="never near"),
        pytest.param([9.0, 3.0], 3.0, 0, 0, id="exactly at the threshold"),
        pytest.param([9.0, math.nextafter(3, 0)], 3.0, 1, 1, id="just nearer"),
    ],
)
def test_success_and_oracle_success_are_strict(
    goal_distances: list[float], ne: float, sr: float, osr: float
) -> None:
    assert navigation_error(goal_distances) == pytest.approx(ne)
    assert success(goal_distances) == sr
    assert oracle_success(goal_distances) == osr


def test_the_success_distance_is_a_setting() -> None:
    assert success([4.0], success_distance=5.0) == 1.0
    assert oracle_success([4.0], success_distance=4.0) == 0.0


@given(distances, st.floats(0.1, 50))
def test_oracle_success_is_never_below_success(path: list[float], near: float) -> None:
    assert oracle_success(path, near) >= success(path, near)


@given(distances, st.floats(0.1, 50))
def test_oracle_success_does_not_depend_on_the_order(
    path: list[float], near: float
) -> None:
    assert oracle_success(path, near) == oracle_success(sorted(path), near)


@pytest.mark.parametrize("metric", [navigation_error, success, oracle_success])
@pytest.mark.parametrize(
    ("goal_distances", "message"),
    [
        pytest.param([], "at least one node", id="empty"),
        pytest.param([1.0, math.nan], "got nan", id="nan"),
        pytest.param([1.0, -1.0], r"got -1\.0", id="negative"),
        pytest.param([1.0, math.inf], "not joined", id="disconnected"),
        pytest.param([[1.0]], "1 dimension", id="matrix"),
    ],
)
def test_undefined_inputs_are_refused(
    metric: object, goal_distances: list[float], message: str
) -> None:
    assert callable(metric)
    with pytest.raises(UndefinedMetricError, match=message):
        metric(goal_distances)


@pytest.mark.parametrize("metric", [success, oracle_success])
@pytest.mark.parametrize("near", [0.0, -3.0, math.nan, math.inf])
def test_a_threshold_without_meaning_is_refused(metric: object, near: float) -> None:
    assert callable(metric)
    with pytest.raises(UndefinedMetricError, match="threshold > 0"):
        metric([1.0], near)
