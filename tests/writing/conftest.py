"""Routes of every site at hand, ready to be described."""

from pathlib import Path

import pytest

from memorymaze.sites import load_sites
from memorymaze.writing.reading import RouteReading
from memorymaze.writing.walks import WalkMap

TINY_SITES = Path(__file__).parents[1] / "tiny_sites"


@pytest.fixture(scope="session")
def readings() -> list[RouteReading]:
    """All routes of the shipped and the tiny sites."""
    sites = [*load_sites().values(), *load_sites(TINY_SITES).values()]
    return [
        RouteReading(floor, route)
        for floor in map(WalkMap, sites)
        for route in floor.site.routes
    ]


@pytest.fixture(scope="session")
def university_r1(readings: list[RouteReading]) -> RouteReading:
    """Four turns to the library: right, left, right, left."""
    return next(
        each
        for each in readings
        if (each.floor.site.name, each.route.id) == ("university", "route_r1_reference")
    )
