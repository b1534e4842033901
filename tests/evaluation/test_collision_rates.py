from collections.abc import Callable

import pytest

from memorymaze.evaluation.collision_rates import CollisionRates, collision_rates
from memorymaze.evaluation.results import EpisodeResult

Make = Callable[..., EpisodeResult]


def test_rates_are_sums_over_sums_per_hundred_metres(result: Make) -> None:
    results = [
        result("a", path_length=50.0, collisions=2, person_collisions=1, waiting_s=3.0),
        result("b", path_length=150.0, near_misses=5, waiting_s=0.0),
    ]
    assert collision_rates(results) == CollisionRates(1.0, 0.5, 2.5, 1.5)


def test_who_does_not_drive_hits_nothing(result: Make) -> None:
    assert collision_rates([result(path_length=0.0)]) == CollisionRates(
        0.0, 0.0, 0.0, 0.0
    )


def test_no_results_are_an_error() -> None:
    with pytest.raises(ValueError, match="at least one"):
        collision_rates([])
