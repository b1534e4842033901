import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.paired import sign_flip_test

DIFFERENCES = np.array([0.9, 0.4, 0.7, -0.2, 0.5, 0.3])
"""Of six people; of their 64 sign patterns 4 have a mean as far from zero."""


@pytest.mark.parametrize("seed", [0, 1])
def test_few_people_have_the_exact_p_value_whatever_the_seed(seed: int) -> None:
    rng = np.random.default_rng(seed)
    assert sign_flip_test(DIFFERENCES[:, None], list("abcdef"), rng) == [4 / 64]


def test_who_shows_no_difference_does_not_make_the_value_inexact() -> None:
    values = np.concatenate([DIFFERENCES, np.zeros(40)])
    people = [str(number) for number in range(46)]
    rng = np.random.default_rng(0)
    assert sign_flip_test(values[:, None], people, rng) == [4 / 64]


def test_drawn_patterns_come_near_to_counting_all_of_them() -> None:
    values = np.random.default_rng(3).normal(0.4, 1.0, size=(14, 1))
    people = [str(number) for number in range(14)]
    [exact] = sign_flip_test(values, people, np.random.default_rng(0), draws=2**14)
    [drawn] = sign_flip_test(values, people, np.random.default_rng(0))
    assert drawn != exact
    assert drawn == pytest.approx(exact, abs=0.01)


def test_one_person_alone_shows_nothing() -> None:
    rows = [[1.0]] * 50
    assert sign_flip_test(rows, ["a"] * 50, np.random.default_rng(0)) == [1.0]


def test_cells_count_alike_however_many_episodes_they_have() -> None:
    """Nine episodes of one route do not drown the one of the other."""
    rows = [[1.0]] * 9 + [[-1.0]]
    people = [f"p{index}" for index in range(10)]
    cells = ["many"] * 9 + ["few"]
    [p] = sign_flip_test(rows, people, np.random.default_rng(0), cells=cells)
    assert p == 1.0


@given(
    st.lists(st.floats(-5, 5), min_size=2, max_size=12),
    st.integers(0, 5),
)
def test_swapping_the_two_agents_changes_nothing(
    values: list[float], seed: int
) -> None:
    rows = np.array(values)[:, None]
    people = [str(index) for index in range(len(values))]
    there = sign_flip_test(rows, people, np.random.default_rng(seed), draws=200)
    back = sign_flip_test(-rows, people, np.random.default_rng(seed), draws=200)
    assert there == back
    assert 0 < there[0] <= 1


def test_no_episode_is_refused() -> None:
    with pytest.raises(UndefinedMetricError, match=r"at least one episode"):
        sign_flip_test(np.zeros((0, 1)), [], np.random.default_rng(0))
