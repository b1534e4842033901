from collections.abc import Callable
from dataclasses import replace

import pytest

from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.episode import run_episode
from memorymaze.evaluation.oracle import OracleAgent
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.settings import RunSettings
from memorymaze.instructions import episodes
from memorymaze.sites import Site

ROUTES = {
    "university": [
        "route_r1_reference",
        "route_r1_alternative_1",
        "route_r2_reference",
        "route_r2_alternative_1",
        "route_r2_alternative_2",
        "route_r2_alternative_3",
    ],
    "museum_5f": [
        "route_r1_reference",
        "route_r2_reference",
        "route_r2_alternative_1",
    ],
    "museum_7f": [
        "route_r1_reference",
        "route_r1_alternative_1",
        "route_r2_reference",
        "route_r2_alternative_1",
    ],
}


def test_these_are_all_routes_of_the_benchmark(builtin_sites: dict[str, Site]) -> None:
    assert {
        name: [route.id for route in site.routes]
        for name, site in builtin_sites.items()
    } == ROUTES


@pytest.mark.parametrize("site_name", ROUTES)
def test_the_oracle_reaches_every_goal_on_the_way_described(
    site_name: str,
    builtin_sites: dict[str, Site],
    tiny_plan: Callable[..., RunPlan],
    settings: RunSettings,
) -> None:
    site = builtin_sites[site_name]
    arena = Arena(site)
    told = tiny_plan("stop").episodes[0].instruction
    for route_id in ROUTES[site_name]:
        route = site.route(route_id)
        described = replace(
            told,
            id=route_id,
            site=site_name,
            route=route.route,
            reference_route=route_id,
        )
        [episode] = episodes([described], builtin_sites)
        agent = OracleAgent(episode.reference_path)
        result = run_episode(agent, episode, arena, settings).result
        assert result.success, route_id
        assert result.cls >= 0.9, route_id
        assert result.collisions == 0, route_id
        assert result.turns_in_order == 1.0, route_id
        assert result.duration_s < settings.simulation.time_budget / 2.5
