import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from memorymaze.basics.errors import SettingsError
from memorymaze.world.construction import BUILDING_KINDS, BuildingKind
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site, plan_file
from memorymaze.world.sites.plan import (
    degrees_of,
    heading_of,
    in_millimetres,
    site_plan,
)


@pytest.mark.parametrize("name", BUILTIN_SITE_NAMES)
def test_the_plan_of_a_shipped_building_is_what_its_file_says(name: str):
    assert site_plan(load_site(name)) == json.loads(plan_file(name).read_bytes())


def test_a_building_that_is_saved_is_loaded_as_the_same_building(
    builtin_sites: dict[str, Site],
    tiny_sites: dict[str, Site],
    made_building: Callable[[BuildingKind], Site],
    tmp_path: Path,
):
    made = map(made_building, BUILDING_KINDS)
    for site in (*builtin_sites.values(), *tiny_sites.values(), *made):
        path = tmp_path / f"{site.name}.geojson"
        site.save(path)
        again = load_site(path)
        assert again == site
        assert site_plan(again) == site_plan(site)


numbers = st.floats(-500, 500)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.floats(-360, 720),
    st.floats(0.001, 100),
    st.tuples(numbers, numbers),
    st.text(st.characters(codec="utf-8"), min_size=1),
    st.dictionaries(
        st.text("abc", min_size=1), st.none() | st.booleans() | st.text() | numbers
    ),
)
def test_whatever_a_plan_says_of_a_thing_is_saved(
    l_site: Site,
    tmp_path: Path,
    degrees: float,
    height: float,
    place: tuple[float, float],
    text: str,
    more: dict[str, object],
):
    plan = site_plan(l_site)
    (plant,) = (each for each in plan["features"] if each["id"] == "plant")
    plant["geometry"]["coordinates"] = list(place)
    plant["properties"] |= {"heading_deg": degrees, "text": text, "obstacle": False}
    plant["properties"]["size_m"][2] = height
    plant["properties"] = more | plant["properties"]
    path = tmp_path / "l_shape.geojson"
    path.write_text(json.dumps(plan))
    site = load_site(path)
    site.save(path)
    again = load_site(path)
    (thing,) = (each for each in again.landmarks if each.id == "plant")
    (was,) = (each for each in site.landmarks if each.id == "plant")
    turned = abs(math.remainder(thing.heading - was.heading, 2 * math.pi))
    assert turned < 1e-14
    assert replace(thing, heading=was.heading) == was
    assert thing.more == was.more


@given(st.integers(0, 35_999))
def test_headings_of_makers_are_written_with_two_digits(hundredths: int):
    assert degrees_of(heading_of(hundredths / 100)) == hundredths / 100


def test_what_is_made_is_rounded_to_whole_millimetres(l_site: Site):
    thing = replace(l_site.landmarks[0], heading=1.0)
    shifted = replace(l_site, landmarks=(thing,))
    (made,) = in_millimetres(shifted).landmarks
    assert made.heading == heading_of(57.3)
    assert in_millimetres(in_millimetres(shifted)) == in_millimetres(shifted)


def test_where_nothing_can_be_written_is_told(l_site: Site, tmp_path: Path):
    with pytest.raises(SettingsError, match=r"none.geojson: cannot be written"):
        l_site.save(tmp_path / "missing" / "none.geojson")
