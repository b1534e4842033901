import json
import os
import subprocess
import sys

import pytest
from tests.construction.conftest import made_building

from memorymaze.construction import BUILDING_KINDS, make_building
from memorymaze.errors import SettingsError
from memorymaze.sites import find_site_problems


@pytest.mark.parametrize("kind", BUILDING_KINDS)
def test_a_made_building_breaks_no_rule(kind, tmp_path):
    building = made_building(kind)
    path = tmp_path / f"{building.name}.geojson"
    path.write_bytes(building.plan)
    assert find_site_problems(path) == []


def test_the_same_seed_gives_the_same_bytes_in_another_process():
    program = (
        "import sys; from memorymaze.construction import make_building; "
        "sys.stdout.buffer.write(make_building('hospital', 2).plan)"
    )
    environment = {**os.environ, "PYTHONHASHSEED": "77"}
    other = subprocess.run(
        [sys.executable, "-c", program],
        env=environment,
        check=True,
        capture_output=True,
    )
    assert other.stdout == made_building("hospital").plan


def test_another_seed_gives_another_building():
    buildings = (made_building("hospital"), make_building("hospital", 1))
    plans = [json.loads(building.plan) for building in buildings]
    assert plans[0]["features"][0]["geometry"] != plans[1]["features"][0]["geometry"]


def test_an_unknown_kind_is_told_with_those_there_are():
    with pytest.raises(
        SettingsError, match=r"expected one of .*hospital.*did you mean"
    ):
        make_building("hospitl", 0)
