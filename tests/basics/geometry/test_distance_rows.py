import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from memorymaze.basics.geometry import distance_rows
from memorymaze.basics.geometry.distance_rows import DistanceRows


def chain(steps: list[float]) -> DistanceRows:
    """Return nodes 0, 1, … in a row, this many metres apart."""
    tails = np.arange(len(steps))
    ends = (np.append(tails, tails + 1), np.append(tails + 1, tails))
    shape = (len(steps) + 1, len(steps) + 1)
    return DistanceRows(coo_array((steps * 2, ends), shape=shape).tocsr())


def test_rows_come_in_the_order_asked_for_with_repeats() -> None:
    rows = chain([1.0, 2.0]).rows(np.array([2, 0, 2]))
    assert rows.tolist() == [[3, 2, 0], [0, 1, 3], [3, 2, 0]]


def test_a_step_of_no_length_joins_its_nodes() -> None:
    assert chain([0.0, 2.0]).rows(np.array([0])).tolist() == [[0, 0, 2]]


def test_forgetting_rows_changes_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(distance_rows, "NUMBERS_KEPT", 4)
    line = chain([1.0, 2.0])
    every = np.arange(3)
    first = line.rows(every)
    assert line.rows(every).tolist() == first.tolist()
    assert line.rows(np.array([1])).tolist() == [[1, 0, 2]]


def test_a_large_question_is_answered_in_pieces_that_fit_into_memory(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[int] = []

    def counted(graph: object, indices: list[int]) -> object:
        asked.append(len(indices))
        return dijkstra(graph, indices=indices)

    monkeypatch.setattr(distance_rows, "NUMBERS_KEPT", 12)
    monkeypatch.setattr(distance_rows, "dijkstra", counted)
    line = chain([1.0] * 5)
    every = np.arange(6)
    assert line.between(every, every[:2]).tolist() == [
        [abs(here - there) for there in (0, 1)] for here in range(6)
    ]
    assert asked == [2, 2, 2]


def test_an_answer_is_the_callers_to_change() -> None:
    line = chain([1.0])
    line.rows(np.array([0]))[:] = 99
    assert line.rows(np.array([0])).tolist() == [[0, 1]]
