"""Invented buildings in the formats of others, and walks through what is made of them.

None of the buildings in `data/` exists; the files keep the exact formats.
"""

import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.testing import check_site
from memorymaze.world.importing.imported import ImportedSite
from memorymaze.world.importing.reference_route import reference_route
from memorymaze.world.sites import Site, load_site
from memorymaze.world.sites import find_site_problems as problems_of
from memorymaze.world.sites.plan import site_plan

DATA = Path(__file__).parent / "data"

Walk = Callable[..., Site]


@pytest.fixture(scope="session")
def quay_house() -> Path:
    """CaBot map data: a ring of four corridors on floor 2, two corridors on floor 1."""
    return DATA / "quay_house_MapData.geojson"


@pytest.fixture(scope="session")
def lantern_building() -> Path:
    """OpenStreetMap: on level 3 one outline for all hallways, on level 2 a corridor."""
    return DATA / "lantern_building.osm"


@pytest.fixture
def mill_court(tmp_path: Path) -> Path:
    """An IMDF archive: on level 1 a walkway like an H and a lobby, on G a walkway."""
    path = tmp_path / "mill_court.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for file in sorted((DATA / "mill_court").iterdir()):
            archive.write(file, f"Mill Court/{file.name}")
    return path


@pytest.fixture
def walked(tmp_path: Path) -> Walk:
    """Write a plan with a route and let the oracle walk it."""

    def walk(imported: ImportedSite, start: str, goal: str) -> Site:
        site = imported.site
        routed = replace(site, routes=(reference_route(site, start, goal),))
        path = tmp_path / f"{site.name}.geojson"
        routed.save(path)
        check_site(path)
        return load_site(path)

    return walk


@pytest.fixture
def loaded(tmp_path: Path) -> Callable[..., Site]:
    """Write an imported plan, see that it breaks no rule, and load it."""

    def load(imported: ImportedSite) -> Site:
        path = tmp_path / f"{imported.site.name}.geojson"
        imported.site.save(path)
        assert [each for each in problems_of(path) if each.severity == "error"] == []
        assert load_site(path) == imported.site
        return imported.site

    return load


@pytest.fixture
def kinds() -> Callable[[ImportedSite, str], list[dict[str, Any]]]:
    """Properties of the features of a kind in an imported plan."""

    def of(imported: ImportedSite, kind: str) -> list[dict[str, Any]]:
        features = site_plan(imported.site)["features"]
        properties = [each["properties"] for each in features]
        return [each for each in properties if each["kind"] == kind]

    return of
