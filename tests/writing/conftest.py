"""Routes of every site at hand, ready to be described."""

from pathlib import Path

import pytest

from memorymaze.sites import load_sites
from memorymaze.writing.route_facts import RouteFacts
from memorymaze.writing.turning_point_graph import TurningPointGraph

TINY_SITES = Path(__file__).parents[1] / "tiny_sites"


@pytest.fixture(scope="session")
def all_facts() -> list[RouteFacts]:
    """All routes of the shipped and the tiny sites."""
    sites = [*load_sites().values(), *load_sites(TINY_SITES).values()]
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
