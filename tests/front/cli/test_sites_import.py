import json
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.front.cli.main import DONE, command_line
from memorymaze.testing import check_site
from memorymaze.world.sites import load_site

DATA = Path(__file__).parents[2] / "world" / "importing" / "data"


@pytest.fixture
def command(monkeypatch, tmp_path):
    """Run `memorymaze sites import …` in an empty folder and return the exit code."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        options = command_line().parse_args(["sites", "import", *map(str, arguments)])
        return options.run(options) or DONE

    return run


def test_import_prints_what_came_and_writes_a_plan_that_can_be_walked(command, capsys):
    code = command(
        DATA / "quay_house_MapData.geojson", "--from", "cabot", "--floor", "2F",
        "--route", "Elevator", "Rope Workshop", "--route", "Stairs", "door_1",
        "--out", "plans/quay_house.geojson",
    )  # fmt: skip
    assert code == 0
    out, err = capsys.readouterr()
    assert "took: floor 2F: 18 links" in out
    assert "guessed: widths of 2 links: 1.5 m" in out
    assert "missing: facilities without an entrance (1): EDITOR_facil_6" in out
    assert err == "plans/quay_house.geojson: 0 errors, 1 warning\n"
    site = load_site("plans/quay_house.geojson")
    assert site.name == "quay_house"
    assert [route.goal for route in site.routes] == ["Rope Workshop", "Map Room"]
    check_site("plans/quay_house.geojson")


def test_import_without_a_floor_lists_those_there_are(command):
    with pytest.raises(SettingsError, match="choose one: --floor 2, 3"):
        command(DATA / "lantern_building.osm", "--from", "osm", "--out", "x.geojson")
    assert not Path("x.geojson").exists()


def test_import_takes_no_floor_of_a_format_that_has_one(command):
    with pytest.raises(SettingsError, match="--floor: expected with cabot, imdf, osm"):
        command("m.yaml", "--from", "ros_map", "--floor", "2", "--out", "x.geojson")


def test_import_names_the_plan_like_its_file(command):
    with pytest.raises(
        SettingsError, match=r"--out: expected small letters.*Quay\.json"
    ):
        command("m", "--from", "cabot", "--out", "Quay.json")


def test_import_leaves_a_plan_that_is_there(command):
    Path("mine.geojson").write_text("{}", "utf-8")
    with pytest.raises(SettingsError, match="exists already"):
        command(
            DATA / "lantern_building.osm", "--from", "osm", "--floor", "2",
            "--out", "mine.geojson",
        )  # fmt: skip
    assert json.loads(Path("mine.geojson").read_text("utf-8")) == {}


def test_a_route_of_an_import_may_begin_south_west_of_the_origin(command):
    code = command(
        DATA / "quay_house_MapData.geojson", "--from", "cabot", "--floor", "2",
        "--route", "-17.0,-7.5", "Rope Workshop", "--out", "quay_house.geojson",
    )  # fmt: skip
    assert code == 0
    [route] = load_site("quay_house.geojson").routes
    x, y = route.line.coords[0]
    assert (x, y) == pytest.approx((-17.0, -7.5), abs=0.5)


def test_import_says_which_places_a_route_can_join(command):
    with pytest.raises(SettingsError, match=r"route to 'Rope Workshp'.*did you mean"):
        command(
            DATA / "quay_house_MapData.geojson", "--from", "cabot", "--floor", "2",
            "--route", "Elevator", "Rope Workshp", "--out", "x.geojson",
        )  # fmt: skip
