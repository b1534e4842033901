"""Floors with a shape that each test of distances needs, named once."""

import pytest
import shapely
from shapely import Polygon

from memorymaze.basics.geometry.grid import FloorGrid


@pytest.fixture(scope="session")
def u_floor() -> Polygon:
    """Two halls, 3 m by 8 m, joined at their south ends, a wall of 2 m between."""
    return shapely.box(0, 0, 8, 8) - shapely.box(3, 2, 5, 8)


@pytest.fixture(scope="session")
def pillar_floor() -> Polygon:
    """A hall of 10 m by 10 m with a pillar of 4 m by 4 m in its middle."""
    return shapely.box(0, 0, 10, 10) - shapely.box(3, 3, 7, 7)


@pytest.fixture(scope="session")
def screen_floor() -> Polygon:
    """A hall of 10 m by 6 m with a screen of 0.1 m at x = 5.2, open 2 m in the south."""
    return shapely.box(0, 0, 10, 6) - shapely.box(5.2, 2, 5.3, 6)


@pytest.fixture(scope="session")
def pillar_grid(pillar_floor: Polygon) -> FloorGrid:
    """The 0.5 m grid of the hall with a pillar."""
    return FloorGrid.from_polygon(pillar_floor)


@pytest.fixture(scope="session")
def screen_grid(screen_floor: Polygon) -> FloorGrid:
    """The 0.5 m grid of the hall with a screen."""
    return FloorGrid.from_polygon(screen_floor)
