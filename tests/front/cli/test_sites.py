import json
from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError, SitePlanError
from memorymaze.front.cli.main import DONE, command_line

Command = Callable[..., int]


@pytest.fixture
def command(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Command:
    """Run `memorymaze sites …` in an empty folder and return the exit code."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments: object) -> int:
        options = command_line().parse_args(["sites", *map(str, arguments)])
        return options.run(options) or DONE

    return run


def test_list_shows_the_benchmarks_floors_with_their_routes(
    command: Command, capsys: pytest.CaptureFixture[str]
):
    assert command("list") == 0
    out = capsys.readouterr().out
    assert "university: University: ABC Hall, DEF Hall and GHI Hall" in out
    assert "22 corridors, 10 areas, 34 turning points" in out
    assert "route_r2_reference       156.68 m  8 turns, to Professor's" in out
    assert out.count("m2 of floor") == 3


def test_list_shows_the_plans_of_a_folder(
    command: Command, tiny_sites_folder: Path, capsys: pytest.CaptureFixture[str]
):
    assert command("list", "--sites", tiny_sites_folder) == 0
    out = capsys.readouterr().out
    assert "corridor: One straight corridor" in out
    assert "1 corridor, 0 areas, 0 turning points, 4 rooms, 4 doors, 1 landmark" in out


def test_check_prints_problems_one_per_line_and_counts_on_stderr(
    command: Command, tiny_sites_folder: Path, capsys: pytest.CaptureFixture[str]
):
    plan = tiny_sites_folder / "loop.geojson"
    content = plan.read_text("utf-8").replace('"id": "box"', '"id": "The Box"')
    Path("ring.geojson").write_text(content, "utf-8")
    assert command("check", plan, "ring.geojson") == 0
    out, err = capsys.readouterr()
    told = [line.partition(": warning: ")[0] for line in out.splitlines()]
    assert told == [
        "ring.geojson:-:name-is-stem",
        "ring.geojson:The Box:id-snake-case",
    ]
    assert err == "2 plans: 0 errors, 2 warnings\n"


def test_check_takes_names_files_and_folders(
    command: Command, tiny_sites_folder: Path, capsys: pytest.CaptureFixture[str]
):
    loop = tiny_sites_folder / "loop.geojson"
    assert command("check", "museum_5f", loop, tiny_sites_folder) == 0
    assert capsys.readouterr().err.startswith("9 plans: 0 errors")


def test_new_writes_a_plan_without_a_warning_and_writes_it_once(
    command: Command, capsys: pytest.CaptureFixture[str]
):
    assert command("new", "annex", "--out", "buildings/annex.geojson") == 0
    assert capsys.readouterr().out == "buildings/annex.geojson\n"
    assert command("check", "buildings") == 0
    assert capsys.readouterr() == ("", "1 plan: 0 errors, 0 warnings\n")
    with pytest.raises(SettingsError, match="exists already"):
        command("new", "annex", "--out", "buildings/annex.geojson")


def test_generate_names_each_building_after_kind_and_seed(
    command: Command, capsys: pytest.CaptureFixture[str]
):
    kind = ("generate", "--kind", "school", "--seed", "4", "--count", "2")
    assert command(*kind, "--out", "made") == 0
    assert capsys.readouterr().out.splitlines() == [
        "made/school_0004.geojson",
        "made/school_0005.geojson",
    ]
    assert command("check", "made") == 0
    assert capsys.readouterr().err == "2 plans: 0 errors, 0 warnings\n"


def test_generate_of_no_buildings_is_told(command: Command):
    with pytest.raises(SettingsError, match="--count: expected at least 1, got 0"):
        command("generate", "--kind", "mall", "--count", "0", "--out", "made")


def test_check_fails_when_a_plan_has_an_error(
    command: Command, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    (tmp_path / "bad.geojson").write_text("{", encoding="utf-8")
    assert command("check", "bad.geojson", "museum_5f") == 1
    out, err = capsys.readouterr()
    assert out.startswith("bad.geojson:-:json: error: expected JSON, got a mistake in")
    assert err == "2 plans: 1 error, 0 warnings\n"


def test_a_site_that_is_nowhere_is_wrong_usage(command: Command):
    with pytest.raises(SettingsError, match=r"'universty'.*did you mean 'university'"):
        command("check", "universty")
    with pytest.raises(SettingsError, match="no such file"):
        command("draw", "nowhere.geojson")


def test_a_folder_without_plans_is_an_error(command: Command, tmp_path: Path):
    with pytest.raises(SitePlanError, match="at least one site plan"):
        command("check", tmp_path)


def test_draw_names_the_picture_after_the_plan(
    command: Command,
    tiny_sites_folder: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
):
    assert command("draw", tiny_sites_folder / "t_junction.geojson") == 0
    assert capsys.readouterr().out == "t_junction.png\n"
    assert (tmp_path / "t_junction.png").read_bytes().startswith(b"\x89PNG")


def test_draw_writes_the_chosen_route_to_the_chosen_file(
    command: Command, tiny_sites_folder: Path, tmp_path: Path
):
    plan = tiny_sites_folder / "t_junction.geojson"
    assert command("draw", plan, "--route", "R2", "--out", "r2.svg") == 0
    text = (tmp_path / "r2.svg").read_text(encoding="utf-8")
    assert "R2: 20.00 m" in text
    assert "R1: 20.00 m" not in text


def test_draw_refuses_a_plan_it_cannot_load(command: Command, tmp_path: Path):
    (tmp_path / "bad.geojson").write_text("[]", encoding="utf-8")
    with pytest.raises(SitePlanError, match=r"bad\.geojson: -: json"):
        command("draw", "bad.geojson")


@pytest.mark.parametrize("arguments", [(), ("check",), ("draw",), ("paint", "x")])
def test_incomplete_commands_are_wrong_usage(
    command: Command, arguments: tuple[str, ...]
):
    with pytest.raises(SystemExit) as caught:
        command(*arguments)
    assert caught.value.code == 2


@pytest.mark.parametrize("members", [{}, {"length_m": 1.0}])
def test_check_warns_of_things_that_have_no_look_of_their_own_beside_errors_too(
    command: Command,
    tiny_sites_folder: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    members: dict[str, float],
):
    plan = json.loads(next(tiny_sites_folder.glob("*.geojson")).read_text("utf-8"))
    for feature in plan["features"]:
        if feature["properties"]["kind"] == "landmark":
            feature["properties"]["category"] = "flux capacitor"
        if feature["properties"]["kind"] == "route":
            feature["properties"] |= members
    path = tmp_path / f"{plan['name']}.geojson"
    path.write_text(json.dumps(plan), "utf-8")
    assert command("check", path) == bool(members)
    warnings = [
        line for line in capsys.readouterr().out.splitlines() if ":known-look:" in line
    ]
    assert len(warnings) == 1
    assert "got 'flux capacitor', shown as a box with its name" in warnings[0]


@pytest.mark.parametrize("name", ["university", "museum_5f", "museum_7f"])
def test_everything_on_the_benchmarks_floors_has_a_look(
    command: Command, name: str, capsys: pytest.CaptureFixture[str]
):
    command("check", name)
    assert "known-look" not in capsys.readouterr().out
