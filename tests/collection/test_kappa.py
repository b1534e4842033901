import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from memorymaze.collection.kappa import cohens_kappa, fleiss_kappa

FLEISS_1971_STYLE = [
    [0, 0, 0, 0, 14],
    [0, 2, 6, 4, 2],
    [0, 0, 3, 5, 6],
    [0, 3, 9, 2, 0],
    [2, 2, 8, 1, 1],
    [7, 7, 0, 0, 0],
    [3, 2, 6, 3, 0],
    [2, 5, 3, 2, 2],
    [6, 5, 2, 1, 0],
    [0, 2, 2, 3, 7],
]
"""Fourteen raters, ten subjects, five answers: kappa 0.210."""

TABLES = arrays(np.int64, (3, 3), elements=st.integers(0, 9)).filter(lambda t: t.any())


@pytest.mark.parametrize(
    ("table", "kappa"),
    [
        pytest.param([[88, 14, 18], [10, 40, 10], [2, 6, 12]], 0.492, id="Cohen"),
        pytest.param([[45, 15], [25, 15]], 0.1304, id="equal agreement, low"),
        pytest.param([[25, 35], [5, 35]], 0.2593, id="equal agreement, higher"),
        pytest.param([[0, 5], [5, 0]], -1.0, id="never agree"),
        # What the README beside the shipped corpus reports of its second reader.
        pytest.param([[107, 1], [0, 456]], 0.9943, id="second reader"),
    ],
)
def test_cohens_kappa_equals_published_values(
    table: list[list[int]], kappa: float
) -> None:
    assert cohens_kappa(table).value == pytest.approx(kappa, abs=5e-4)


def test_fleiss_kappa_equals_the_published_value() -> None:
    found = fleiss_kappa(FLEISS_1971_STYLE)
    assert found.agreement == pytest.approx(0.378, abs=5e-4)
    assert found.expected == pytest.approx(0.213, abs=5e-4)
    assert found.value == pytest.approx(0.210, abs=5e-4)


@settings(deadline=None)
@given(TABLES)
def test_kappa_does_not_depend_on_who_is_first_or_how_answers_are_ordered(
    table: np.ndarray,
) -> None:
    kappa = cohens_kappa(table).value
    for same in (table.T, table[::-1, ::-1], 3 * table):
        other = cohens_kappa(same).value
        assert other == (None if kappa is None else pytest.approx(kappa))
    assert kappa is None or kappa <= 1.0


@settings(deadline=None)
@given(TABLES)
def test_fleiss_kappa_of_two_is_cohens_with_shared_shares(table: np.ndarray) -> None:
    answers = np.array([
        np.eye(3)[i] + np.eye(3)[j]
        for i, j in np.ndindex(3, 3)
        for _ in range(table[i, j])
    ])
    found = fleiss_kappa(answers).value
    shared = cohens_kappa(table + table.T).value
    assert found == (None if shared is None else pytest.approx(shared))


@settings(deadline=None)
@given(st.integers(1, 20))
def test_full_agreement_is_one_and_undefined_where_nothing_differs(count: int) -> None:
    assert cohens_kappa([[count, 0], [0, 3]]).value == pytest.approx(1.0)
    assert cohens_kappa([[count, 0], [0, 0]]).value is None
    assert fleiss_kappa([[3, 0]] * count).value is None


@pytest.mark.parametrize(
    ("table", "said"),
    [
        pytest.param([[2, 0], [3, 0]], "got 2 to 3", id="other numbers of raters"),
        pytest.param([[1, 0], [0, 1]], "got 1 to 1", id="one rater"),
        pytest.param([[-1, 3]], "numbers >= 0", id="negative"),
        pytest.param([], "two dimensions", id="empty"),
    ],
)
def test_what_has_no_meaning_is_refused(table: list[list[int]], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        fleiss_kappa(table)
