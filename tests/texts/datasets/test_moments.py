import numpy as np
import pytest

from memorymaze.texts.datasets.moments import RowMoments


def test_pieces_add_up_to_the_moments_of_all_rows() -> None:
    rows = np.random.default_rng(0).normal(3.0, 2.0, (100, 3))
    told = (
        RowMoments.none() + RowMoments.of(rows[:30]) + RowMoments.of(rows[30:])
    ).record(picture=False)
    assert told["count"] == [100]
    assert told["mean"] == pytest.approx(rows.mean(axis=0))
    assert told["std"] == pytest.approx(rows.std(axis=0))
    assert told["min"] == pytest.approx(rows.min(axis=0))
    assert told["max"] == pytest.approx(rows.max(axis=0))


def test_rows_that_several_episodes_share_count_for_each() -> None:
    rows = np.array([[1.0], [3.0]])
    told = (RowMoments.of(rows, 2) + RowMoments.of(np.array([[5.0]]))).record(
        picture=True
    )
    assert told["count"] == [5]
    assert np.shape(told["mean"]) == (1, 1, 1)
    assert np.ravel(told["mean"]) == pytest.approx([13 / 5])
