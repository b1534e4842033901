from collections.abc import Callable

import numpy as np
import pytest

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables.measures import PAPER_QUANTITIES, mean_fields

Make = Callable[..., EpisodeResult]


def means(results: list[EpisodeResult]) -> dict[str, float]:
    """Return the means over routes, and the ends of their intervals."""
    people = [each.participant for each in results]
    routes = [each.route for each in results]
    return mean_fields(PAPER_QUANTITIES, results, people, routes)


def interval(results: list[EpisodeResult], name: str) -> tuple[float, float, float]:
    found = means(results)
    return found[f"{name}_low"], found[name], found[f"{name}_high"]


def test_means_equal_those_worked_by_hand(result: Make) -> None:
    cell = [
        result("a-1", success=True, spd=1.0, cls=0.2),
        result("a-2", success=False, spd=2.0, cls=0.4),
        result("b-1", success=False, oracle_success=False, spd=6.0, cls=0.6),
    ]
    found = {name: means(cell)[name] for name in ("sr", "osr", "spd", "cls")}
    assert found == pytest.approx({"sr": 1 / 3, "osr": 2 / 3, "spd": 3.0, "cls": 0.4})


def test_the_mean_over_cells_does_not_weigh_them_by_size(result: Make) -> None:
    small = [result("a-1", spd=10.0)]
    large = [result(f"{name}-1", route="R2", spd=0.0) for name in "bcd"]
    assert means(small + large)["spd"] == 5.0


def test_one_persons_episodes_are_drawn_together(result: Make) -> None:
    """Two persons who always agree with themselves: draws are 0, 1/2 or 1."""
    cell = [
        result(f"{name}-{number}", success=name == "a")
        for name in "ab"
        for number in range(50)
    ]
    low, _, high = interval(cell, "sr")
    assert (low, high) == (0.0, 1.0)


def test_the_interval_is_that_of_independent_persons(result: Make) -> None:
    """With one episode each it is the binomial's: 0.5 plus or minus about 0.098."""
    cell = [result(f"p{number}-1", success=number % 2 == 0) for number in range(100)]
    low, _, high = interval(cell, "sr")
    assert (low, high) == pytest.approx((0.40, 0.60), abs=0.011)


def test_a_cell_of_one_person_is_never_drawn_empty(result: Make) -> None:
    lone = [result("a-1", spd=4.0)]
    others = [result(f"p{number}-1", route="R2", spd=2.0) for number in range(30)]
    assert interval(lone + others, "spd") == (3.0, 3.0, 3.0)


def test_the_interval_does_not_depend_on_the_order_of_episodes(result: Make) -> None:
    rng = np.random.default_rng(0)
    cell = [result(f"p{n}-1", spd=float(rng.random())) for n in range(20)]
    assert interval(cell, "spd") == pytest.approx(interval(cell[::-1], "spd"))
