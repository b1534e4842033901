import json
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.world.sites import find_site_problems, load_site
from memorymaze.world.sites.loading import new_plan

PAGE = Path(__file__).parents[3] / "docs" / "buildings.md"


def test_a_new_plan_breaks_no_rule(tmp_path: Path):
    path = tmp_path / "east_wing_2.geojson"
    path.write_bytes(new_plan("east_wing_2"))
    assert find_site_problems(path) == []
    site = load_site(path)
    assert (site.name, site.title) == ("east_wing_2", "East wing 2")
    assert site.find_route("R1").goal_landmark == "door_library"


def test_the_page_on_buildings_begins_with_the_new_plan():
    example = PAGE.read_text("utf-8").split("```json\n")[1].split("```")[0]
    assert example == new_plan("annex").decode()


def test_a_length_that_is_left_out_is_that_of_the_line(tmp_path: Path):
    path = tmp_path / "annex.geojson"
    path.write_bytes(new_plan("annex"))
    assert load_site(path).find_route("R1").length == pytest.approx(16.0)
    plan = json.loads(new_plan("annex"))
    plan["features"][-1]["properties"]["length_m"] = 17.0
    path.write_text(json.dumps(plan), "utf-8")
    [wrong] = [each for each in find_site_problems(path) if each.rule == "route-length"]
    assert "16.000 m, got 17.000 m" in wrong.message


@pytest.mark.parametrize("name", ["", "My annex", "a/b", '"', "annex.geojson"])
def test_a_name_that_instructions_could_not_use_is_refused(name: str):
    with pytest.raises(SettingsError, match="small letters, digits and underscores"):
        new_plan(name)
