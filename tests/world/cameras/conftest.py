"""Looks of the tiny sites, and one camera for all tests of a size."""

from collections.abc import Iterator

import pytest

from memorymaze.world.cameras import (
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.world.sites import Site


@pytest.fixture(scope="session")
def corridor_looks(corridor_site: Site) -> VisualScene:
    """Looks of the straight corridor with four doors and a bench."""
    return build_visual_scene(corridor_site)


@pytest.fixture(scope="session")
def l_looks(l_site: Site) -> VisualScene:
    """Looks of the way with a corner."""
    return build_visual_scene(l_site)


@pytest.fixture(scope="session")
def corridor_camera(corridor_looks: VisualScene) -> Iterator[RenderedCamera]:
    """A small camera in the corridor, 90 degrees wide."""
    with RenderedCamera(corridor_looks, 160, 120) as camera:
        yield camera


@pytest.fixture(scope="session")
def l_camera(l_looks: VisualScene) -> Iterator[RenderedCamera]:
    """A small camera in the way with a corner."""
    with RenderedCamera(l_looks, 160, 120) as camera:
        yield camera
