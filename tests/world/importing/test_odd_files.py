"""Whatever is in a file, it is imported with what is odd told, or refused."""

import json
import math
import random
import zipfile
from copy import deepcopy
from functools import cache
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.world.importing.cabot import import_cabot
from memorymaze.world.importing.imdf import import_imdf
from memorymaze.world.importing.osm import import_osm
from memorymaze.world.sites.checking import plan_problems
from memorymaze.world.sites.plan import plan_bytes
from memorymaze.world.sites.reading import understand_plan

DATA = Path(__file__).parent / "data"
ODD = (
    None, True, 0, -1, 1e308, math.nan, math.inf, "", "2", "\x00", "\ud800", "🛗", [], {},
    [[]], [None, "a"], {"en": None}, [1e9, 1e9], [180, 90], "Point",
)  # fmt: skip
"""What files hold that nobody expected."""

odd_seeds = st.integers(0, 10_000_000)
few = settings(
    max_examples=10,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def broken(value, rng, share):
    """Return JSON with some of its values exchanged for odd ones, or left out."""
    if rng.random() < share:
        return rng.choice(ODD)
    if isinstance(value, dict):
        return {
            name: broken(each, rng, share)
            for name, each in value.items()
            if rng.random() > share / 2
        }
    if isinstance(value, list):
        return [broken(each, rng, share) for each in value if rng.random() > share / 2]
    if isinstance(value, float) and rng.random() < share:
        return value + rng.gauss(0, 10 ** rng.uniform(-6, 2))
    return value


def imported_or_refused(importer, path, floor):
    """Import a file; a plan that comes of it has no error, and all else is told."""
    try:
        imported = importer(path, floor)
    except MemoryMazeError as error:
        refusal = str(error)
    else:
        refusal = ""
    if refusal:
        assert str(path) in refusal
        return
    site = imported.site
    plan = understand_plan(json.loads(plan_bytes(site)))
    problems = plan_problems(plan, Path(f"{site.name}.geojson"))
    assert [each.line() for each in problems if each.severity == "error"] == []
    assert imported.took


@cache
def _map_data():
    return json.loads((DATA / "quay_house_MapData.geojson").read_text("utf-8"))


@few
@given(odd_seeds, st.sampled_from([0.001, 0.01, 0.1]))
def test_odd_map_data_of_cabot(tmp_path, seed, share):
    rng = random.Random(seed)
    path = tmp_path / "MapData.geojson"
    path.write_text(json.dumps(broken(deepcopy(_map_data()), rng, share)), "utf-8")
    imported_or_refused(import_cabot, path, "2")


@few
@given(odd_seeds, st.sampled_from([0.001, 0.01, 0.1]))
def test_odd_archives_of_imdf(tmp_path, seed, share):
    rng = random.Random(seed)
    path = tmp_path / "venue.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for file in sorted((DATA / "mill_court").iterdir()):
            document = json.loads(file.read_text("utf-8"))
            archive.writestr(file.name, json.dumps(broken(document, rng, share)))
    imported_or_refused(import_imdf, path, "1")


@few
@given(odd_seeds, st.sampled_from([0.0005, 0.005, 0.05]))
def test_odd_files_of_openstreetmap(tmp_path, seed, share):
    rng = random.Random(seed)
    lines = (DATA / "lantern_building.osm").read_text("utf-8").splitlines()
    text = "\n".join(line for line in lines if rng.random() > share)
    for said in ('k="indoor"', 'k="level"', "lon=", "ref=", "v="):
        parts = text.split(said)
        text = parts[0] + "".join(
            (
                said
                if rng.random() > share
                else f'{rng.choice("abc")}="{rng.choice("127e")}" '
            )
            + part
            for part in parts[1:]
        )
    path = tmp_path / "map.osm"
    path.write_text(text, "utf-8")
    imported_or_refused(import_osm, path, "3")


@few
@given(st.binary(max_size=200))
@pytest.mark.parametrize("importer", [import_cabot, import_imdf, import_osm])
def test_bytes_of_any_kind_are_refused(tmp_path, importer, content):
    path = tmp_path / "file.osm"
    path.write_bytes(content)
    imported_or_refused(importer, path, None)
