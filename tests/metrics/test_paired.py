from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.errors import UndefinedMetricError
from memorymaze.metrics.paired import sign_flip_test


def test_the_p_value_is_that_of_counting_all_sign_patterns() -> None:
    differences = np.array([0.9, 0.4, 0.7, -0.2, 0.5, 0.3])
    people = list("abcdef")
    seen = abs(differences.sum())
    extreme = [
        abs(np.dot(signs, differences)) >= seen - 1e-12
        for signs in product([-1, 1], repeat=6)
    ]
    [p] = sign_flip_test(
        differences[:, None], people, np.random.default_rng(1), draws=40_000
    )
    assert p == pytest.approx(np.mean(extreme), abs=0.01)


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
