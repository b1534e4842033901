import math
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.budgets import (
    fair_steps,
    perfect_steps,
    perfect_time,
    time_budget_for,
)
from memorymaze.world.sites import Site


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
    budget = time_budget_for(frozenset(), routes, settings)
    assert 3 * slowest <= budget < 3 * slowest + 1
    assert budget == int(budget)


def test_without_routes_there_is_no_budget() -> None:
    with pytest.raises(SettingsError, match="no routes"):
        time_budget_for(frozenset(), [], SimulationSettings())


def route(*points: tuple[float, float]) -> Any:
    return SimpleNamespace(line=LineString(points))


@pytest.mark.parametrize(
    ("points", "steps", "answers"),
    [
        pytest.param([(0, 0), (10, 0)], 40, 14 + 1, id="straight"),
        pytest.param([(0, 0), (10.1, 0)], 41, 14 + 1, id="not a whole number"),
        pytest.param(
            [(0, 0), (10, 0), (10, 5)], 40 + 3 + 20, 14 + 1 + 7 + 1, id="corner"
        ),
        pytest.param(
            [(0, 0), (1, 0), (2, 1)], 4 + 2 + 6, 2 + 1 + 2 + 1, id="45 degrees"
        ),
    ],
)
def test_steps_and_answers_of_a_walk_without_a_mistake(
    points: list[tuple[float, float]], steps: int, answers: int
) -> None:
    assert perfect_steps(route(*points)) == steps
    assert perfect_steps(route(*points), 0.75, 90) + 1 == answers


places = st.tuples(st.integers(-50, 50), st.integers(-50, 50))


@given(st.lists(places, min_size=2, max_size=6, unique=True))
def test_steps_suffice_for_the_length(points: list[tuple[float, float]]) -> None:
    way = route(*points)
    assert perfect_steps(way) * 0.25 >= way.line.length - 1e-3
    assert perfect_steps(way, turn_deg=15) >= perfect_steps(way)


def test_the_fair_budget_goes_by_the_longest_route_and_tells_no_other() -> None:
    short, long = route((0, 0), (5, 0)), route((0, 0), (9, 0))
    assert fair_steps([short, long]) == fair_steps([long]) == 3 * 36
    with pytest.raises(SettingsError, match="no routes"):
        fair_steps([])


def test_released_budgets_are_too_short_for_the_longest_route(
    builtin_sites: dict[str, Site],
) -> None:
    longest = builtin_sites["university"].find_route("R2")
    assert perfect_steps(longest) > 500


def test_only_agents_that_drive_by_steps_get_their_time(
    builtin_sites: dict[str, Site],
) -> None:
    routes = builtin_sites["university"].routes
    settings = SimulationSettings()
    usual = time_budget_for(frozenset(), routes, settings)

    stepping = time_budget_for(frozenset({"steps"}), routes, settings)
    assert stepping > usual
    assert stepping >= 1.4 * 3 * max(each.length for each in routes) / 0.25
