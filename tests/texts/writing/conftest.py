"""Routes of every site at hand, ready to be described."""

import pytest

from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph
from memorymaze.world.sites import Site


@pytest.fixture(scope="session")
def all_facts(
    builtin_sites: dict[str, Site], tiny_sites: dict[str, Site]
) -> list[RouteFacts]:
    """All routes of the shipped and the tiny sites."""
    sites = [*builtin_sites.values(), *tiny_sites.values()]
    return [
        RouteFacts(floor, route)
        for floor in map(TurningPointGraph, sites)
        for route in floor.site.routes
    ]


@pytest.fixture(scope="session")
def university_r1(all_facts: list[RouteFacts]) -> RouteFacts:
    """Four turns to the library: right, left, right, left."""
    return next(
        each
        for each in all_facts
        if (each.graph.site.name, each.route.id) == ("university", "route_r1_reference")
    )
