import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.aggregate import Estimate, mean, participant_bootstrap


def rng(seed: int = 0) -> np.random.Generator:
    return np.random.default_rng(seed)


def one(values: list[float], participants: list[str]) -> Estimate:
    [estimate] = participant_bootstrap([[v] for v in values], participants, rng())
    return estimate


def test_the_mean_weighs_episodes_alike() -> None:
    assert one([1, 1, 1, 0], ["a", "a", "a", "b"]).mean == mean([1, 1, 1, 0]) == 0.75


def test_the_interval_of_independent_people_is_the_binomials() -> None:
    """0.5 plus or minus 1.96 * sqrt(0.25 / 400)."""
    people = [f"p{number}" for number in range(400)]
    estimate = one([float(number % 2) for number in range(400)], people)
    assert estimate.low == pytest.approx(0.451, abs=0.006)
    assert estimate.high == pytest.approx(0.549, abs=0.006)


def test_people_who_repeat_themselves_widen_the_interval() -> None:
    values = [float(number // 20 % 2) for number in range(400)]
    alone = one(values, [f"p{number}" for number in range(400)])
    grouped = one(values, [f"p{number // 20}" for number in range(400)])
    assert alone.low is not None
    assert grouped.low is not None
    assert 0.5 - grouped.low > 3 * (0.5 - alone.low)


def test_the_same_seed_gives_the_same_interval_and_order_does_not_matter() -> None:
    values, people = [0.1, 0.7, 0.4, 0.9, 0.3], ["a", "b", "b", "c", "a"]
    assert one(values, people) == one(values, people)
    turned = one(values[::-1], people[::-1])
    assert turned.low == pytest.approx(one(values, people).low)


def test_a_single_participant_has_no_interval() -> None:
    assert one([1.0, 0.0], ["a", "a"]) == Estimate(0.5, None, None)


def test_cells_count_alike_whatever_their_size() -> None:
    [estimate] = participant_bootstrap(
        [[10.0], [0.0], [0.0], [0.0]], list("abcd"), rng(), cells=[1, 2, 2, 2]
    )
    assert estimate.mean == 5.0


def test_a_cell_of_one_person_is_never_drawn_empty() -> None:
    people = ["lone", *(f"p{number}" for number in range(30))]
    values = [[4.0], *([2.0 + number % 2] for number in range(30))]
    cells = [1, *[2] * 30]
    [estimate] = participant_bootstrap(values, people, rng(), cells=cells)
    assert estimate.low is not None
    assert estimate.high is not None
    assert 3.0 <= estimate.low < estimate.mean < estimate.high <= 3.5


def test_metrics_are_estimated_side_by_side() -> None:
    both = participant_bootstrap([[1, 5], [0, 7]], ["a", "b"], rng())
    assert [each.mean for each in both] == [0.5, 6.0]
    assert [(each.low, each.high) for each in both] == [(0, 1), (5, 7)]


@given(
    st.lists(st.tuples(st.floats(0, 1), st.sampled_from("abcd")), min_size=1),
    st.integers(0, 99),
)
def test_the_interval_lies_within_the_values(
    episodes: list[tuple[float, str]], seed: int
) -> None:
    values, people = zip(*episodes, strict=True)
    [estimate] = participant_bootstrap(
        [[value] for value in values], people, rng(seed), resamples=50
    )
    if len(set(people)) == 1:
        assert estimate.low is None
    else:
        assert estimate.low is not None
        assert estimate.high is not None
        slack = 1e-12
        assert min(values) - slack <= estimate.low <= estimate.high
        assert estimate.high <= max(values) + slack


def test_a_wider_level_gives_a_wider_interval() -> None:
    values, people = [[float(n)] for n in range(30)], [f"p{n}" for n in range(30)]
    [narrow] = participant_bootstrap(values, people, rng(), level=0.5)
    [wide] = participant_bootstrap(values, people, rng(), level=0.99)
    assert narrow.low is not None
    assert wide.low is not None
    assert wide.low < narrow.low


def test_no_values_have_no_mean() -> None:
    with pytest.raises(UndefinedMetricError, match="at least one value"):
        mean([])
    with pytest.raises(UndefinedMetricError, match="at least one value"):
        participant_bootstrap(np.empty((0, 1)), [], rng())


def test_a_value_that_is_not_finite_is_named() -> None:
    with pytest.raises(UndefinedMetricError, match="got nan for episode 1"):
        participant_bootstrap([[1.0], [np.nan]], ["a", "b"], rng())


@pytest.mark.parametrize(
    ("people", "options", "message"),
    [
        (["a"], {}, "a participant and a cell for each of 2"),
        (["a", "b"], {"cells": [1]}, "a participant and a cell for each of 2"),
        (["a", "b"], {"level": 1.0}, "level between 0 and 1"),
        (["a", "b"], {"resamples": 0}, "resamples >= 1"),
    ],
)
def test_settings_without_meaning_are_refused(
    people: list[str], options: dict[str, object], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        participant_bootstrap([[1.0], [2.0]], people, rng(), **options)
