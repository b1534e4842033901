import math

import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.budgets import default_time_budget, perfect_time
from memorymaze.simulation import SimulationSettings
from memorymaze.sites import Site


def test_the_perfect_time_equals_one_worked_by_hand(l_site: Site) -> None:
    [route] = l_site.routes
    settings = SimulationSettings(
        max_speed=1.0,
        max_acceleration=2.0,
        max_turn_rate=0.5 * math.pi,
        max_turn_acceleration=math.pi,
    )
    # Two pieces of together 16 m at 1 m/s, half a second each to get going and halt;
    # a quarter turn at 90 degrees per second, and half a second of its own.
    assert perfect_time(route, settings) == pytest.approx(16 + 2 * 0.5 + 1 + 0.5)


def test_the_budget_is_three_times_the_slowest_route_in_whole_seconds(
    tiny_sites: dict[str, Site],
) -> None:
    settings = SimulationSettings()
    routes = [route for site in tiny_sites.values() for route in site.routes]
    slowest = max(perfect_time(route, settings) for route in routes)
    budget = default_time_budget(routes, settings)
    assert 3 * slowest <= budget < 3 * slowest + 1
    assert budget == int(budget)


def test_without_routes_there_is_no_budget() -> None:
    with pytest.raises(SettingsError, match="no routes"):
        default_time_budget([], SimulationSettings())
