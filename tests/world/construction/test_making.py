import os
import subprocess
import sys

import pytest
from shapely import Polygon

from memorymaze.basics.errors import SettingsError
from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.sites import find_site_problems
from memorymaze.world.sites.plan import plan_bytes


@pytest.mark.parametrize("kind", BUILDING_KINDS)
def test_a_made_building_breaks_no_rule(kind, made_building, tmp_path):
    building = made_building(kind)
    path = tmp_path / f"{building.name}.geojson"
    building.save(path)
    assert find_site_problems(path) == []


def test_the_same_seed_gives_the_same_bytes_in_another_process(made_building):
    program = (
        "import sys; from memorymaze.world.construction import make_building; "
        "from memorymaze.world.sites.plan import plan_bytes; "
        "sys.stdout.buffer.write(plan_bytes(make_building('hospital', 2)))"
    )
    environment = {**os.environ, "PYTHONHASHSEED": "77"}
    other = subprocess.run(
        [sys.executable, "-c", program],
        env=environment,
        check=True,
        capture_output=True,
    )
    assert other.stdout == plan_bytes(made_building("hospital"))


def test_another_seed_gives_another_building(made_building):
    one, other = made_building("hospital"), make_building("hospital", 1)
    assert one.corridors[0].polygon != other.corridors[0].polygon


def test_specks_at_slanted_seams_are_no_holes_in_the_floor():
    floor = make_building("office", 7_300_001).walkable_floor
    assert floor.is_valid
    assert all(Polygon(hole).area > 0.1 for hole in floor.interiors)


def test_an_unknown_kind_is_told_with_those_there_are():
    with pytest.raises(
        SettingsError, match=r"expected one of .*hospital.*did you mean"
    ):
        make_building("hospitl", 0)
