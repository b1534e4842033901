from collections.abc import Callable

import pytest

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.safety import Safety, safety

Make = Callable[..., EpisodeResult]


def test_rates_are_sums_over_sums_per_hundred_metres(result: Make) -> None:
    results = [
        result("a", path_length=50.0, collisions=2, person_collisions=1, waiting_s=3.0),
        result("b", path_length=150.0, near_misses=5, waiting_s=0.0),
    ]
    assert safety(results) == Safety(1.0, 0.5, 2.5, 1.5)


def test_who_does_not_drive_hits_nothing(result: Make) -> None:
    assert safety([result(path_length=0.0)]) == Safety(0.0, 0.0, 0.0, 0.0)


def test_no_results_are_an_error() -> None:
    with pytest.raises(ValueError, match="at least one"):
        safety([])
