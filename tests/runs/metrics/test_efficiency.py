import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.efficiency import path_length, spl

lengths = st.floats(0, 1e6)


@pytest.mark.parametrize(
    ("success", "shortest", "walked", "expected"),
    [
        pytest.param(1, 10, 10, 1.0, id="the shortest way"),
        pytest.param(1, 10, 20, 0.5, id="twice as long"),
        pytest.param(1, 10, 8, 1.0, id="stopped early but near enough"),
        pytest.param(0, 10, 10, 0.0, id="failed"),
        pytest.param(1, 0, 0, 0.0, id="began at the goal"),
        pytest.param(1, 0, 5, 0.0, id="began at the goal and walked round"),
        pytest.param(1, 10, 0, 1.0, id="did not move"),
    ],
)
def test_spl_is_as_worked_by_hand(
    success: float, shortest: float, walked: float, expected: float
) -> None:
    assert spl(success, shortest, walked) == expected


@given(st.sampled_from([0.0, 1.0]), lengths, lengths, lengths)
def test_spl_is_between_zero_and_success_and_falls_with_detours(
    success: float, shortest: float, walked: float, detour: float
) -> None:
    value = spl(success, shortest, walked)
    assert 0 <= spl(success, shortest, walked + detour) <= value <= success


@given(st.lists(lengths))
def test_path_length_does_not_depend_on_direction(steps: list[float]) -> None:
    assert path_length(steps) == pytest.approx(path_length(steps[::-1]))
    assert path_length(steps) == pytest.approx(sum(steps))


@pytest.mark.parametrize(
    ("step", "message"), [(math.nan, "nan"), (-1.0, "-1"), (math.inf, "not joined")]
)
def test_a_step_without_length_leaves_path_length_undefined(
    step: float, message: str
) -> None:
    with pytest.raises(UndefinedMetricError, match=message):
        path_length([1.0, step])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.5, 1.0, 1.0), "success of 0 or 1"),
        ((1.0, math.nan, 1.0), "the shortest distance"),
        ((1.0, math.inf, 1.0), "the shortest distance"),
        ((1.0, 1.0, -1.0), "the path length"),
    ],
)
def test_spl_refuses_undefined_inputs(
    arguments: tuple[float, float, float], message: str
) -> None:
    with pytest.raises(UndefinedMetricError, match=message):
        spl(*arguments)
