"""Tiny sites that every room's tests share; their plans are in `tiny_sites/`."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

from memorymaze.sites import Site, load_site, load_sites

# How long an example takes says more of the machine than of the code.
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

TINY_SITES = Path(__file__).parent / "tiny_sites"

# Furniture models that this user converted must not change what cameras see in tests.
os.environ["MEMORYMAZE_LOOKS"] = "own"


@pytest.fixture(scope="session")
def tiny_sites_folder() -> Path:
    """Folder with the plans of all tiny sites."""
    return TINY_SITES


@pytest.fixture(scope="session")
def tiny_sites() -> dict[str, Site]:
    """All tiny sites by name."""
    return load_sites(TINY_SITES)


@pytest.fixture(scope="session")
def builtin_sites() -> dict[str, Site]:
    """The three floors of the benchmark by name."""
    return load_sites()


@pytest.fixture(scope="session")
def corridor_site() -> Site:
    """One straight corridor, 20 m by 3 m along y = 0, no turning point.

    Four equal doors on the north side at x = 3, 7.5, 12, 16.5; a bench on the south
    side at x = 10. R1 runs from (2, 0) to the fourth door.
    """
    return load_site(TINY_SITES / "corridor.geojson")


@pytest.fixture(scope="session")
def l_site() -> Site:
    """East along y = 0, then a corner at (11, 0) that leaves only a left turn."""
    return load_site(TINY_SITES / "l_shape.geojson")


@pytest.fixture(scope="session")
def t_site() -> Site:
    """North along x = 0 to a T junction at (0, 0): R1 goes left, R2 right."""
    return load_site(TINY_SITES / "t_junction.geojson")


@pytest.fixture(scope="session")
def crossing_site() -> Site:
    """Two corridors that cross at (0, 0): R1 comes from the west and turns left."""
    return load_site(TINY_SITES / "crossing.geojson")


@pytest.fixture(scope="session")
def slanted_crossing_site() -> Site:
    """Ways west, east and south of (0, 0), and one at 50 degrees that R1 takes."""
    return load_site(TINY_SITES / "slanted_crossing.geojson")


@pytest.fixture(scope="session")
def two_rooms() -> Site:
    """Two halls, 6 m by 6 m, joined by a passage along y = 3; areas, no T or corner."""
    return load_site(TINY_SITES / "two_rooms.geojson")


@pytest.fixture(scope="session")
def loop_site() -> Site:
    """Four corridors round a block: R1 has a short reference and a long alternative."""
    return load_site(TINY_SITES / "loop.geojson")
