from collections.abc import Callable

import numpy as np
import pytest

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.results.tables import estimate_means

Make = Callable[..., EpisodeResult]


def test_means_equal_those_worked_by_hand(result: Make) -> None:
    cell = [
        result("a-1", success=True, spd=1.0, cls=0.2),
        result("a-2", success=False, spd=2.0, cls=0.4),
        result("b-1", success=False, oracle_success=False, spd=6.0, cls=0.6),
    ]
    means = {name: each.mean for name, each in estimate_means([cell]).items()}
    assert means == pytest.approx({"sr": 1 / 3, "osr": 2 / 3, "spd": 3.0, "cls": 0.4})


def test_the_mean_over_cells_does_not_weigh_them_by_size(result: Make) -> None:
    small = [result("a-1", spd=10.0)]
    large = [result(f"{name}-1", route="R2", spd=0.0) for name in "bcd"]
    assert estimate_means([small, large])["spd"].mean == 5.0


def test_one_persons_episodes_are_drawn_together(result: Make) -> None:
    """Two persons who always agree with themselves: draws are 0, 1/2 or 1."""
    cell = [
        result(f"{name}-{number}", success=name == "a")
        for name in "ab"
        for number in range(50)
    ]
    interval = estimate_means([cell])["sr"]
    assert (interval.low, interval.high) == (0.0, 1.0)


def test_the_interval_is_that_of_independent_persons(result: Make) -> None:
    """With one episode each it is the binomial's: 0.5 plus or minus about 0.098."""
    cell = [result(f"p{number}-1", success=number % 2 == 0) for number in range(100)]
    interval = estimate_means([cell])["sr"]
    assert interval.low == pytest.approx(0.40, abs=0.011)
    assert interval.high == pytest.approx(0.60, abs=0.011)


def test_a_cell_of_one_person_is_never_drawn_empty(result: Make) -> None:
    lone = [result("a-1", spd=4.0)]
    others = [result(f"p{number}-1", route="R2", spd=2.0) for number in range(30)]
    interval = estimate_means([lone, others])["spd"]
    assert (interval.low, interval.mean, interval.high) == (3.0, 3.0, 3.0)


def test_the_interval_does_not_depend_on_the_order_of_episodes(result: Make) -> None:
    rng = np.random.default_rng(0)
    cell = [result(f"p{n}-1", spd=float(rng.random())) for n in range(20)]
    assert estimate_means([cell])["spd"].low == pytest.approx(
        estimate_means([cell[::-1]])["spd"].low
    )


def test_an_empty_cell_is_an_error(result: Make) -> None:
    with pytest.raises(ValueError, match="at least one episode"):
        estimate_means([[result()], []])
