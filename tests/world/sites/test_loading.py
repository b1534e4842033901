import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError, SitePlanError
from memorymaze.world.sites import (
    BUILTIN_SITE_NAMES,
    Site,
    load_site,
    load_sites,
)

Plan = dict[str, Any]
ReadPlan = Callable[[str], Plan]
WritePlan = Callable[..., Path]
Changed = Callable[[str, str, Plan], Path]


def test_the_three_floors_of_the_benchmark_have_the_published_route_lengths(
    builtin_sites: dict[str, Site],
):
    lengths = {
        (name, route): site.find_route(route).line.length
        for name, site in builtin_sites.items()
        for route in ("R1", "R2")
    }
    assert tuple(builtin_sites) == BUILTIN_SITE_NAMES
    assert lengths == {
        ("university", "R1"): pytest.approx(40.27, abs=0.005),
        ("university", "R2"): pytest.approx(156.68, abs=0.005),
        ("museum_5f", "R1"): pytest.approx(71.18, abs=0.005),
        ("museum_5f", "R2"): pytest.approx(44.05, abs=0.005),
        ("museum_7f", "R1"): pytest.approx(86.10, abs=0.005),
        ("museum_7f", "R2"): pytest.approx(79.40, abs=0.005),
    }


def test_loading_keeps_all_that_a_plan_says(t_site: Site):
    assert (t_site.title, t_site.floor) == ("A T junction", "ground floor")
    assert t_site.ceiling_height == 2.8
    assert t_site.anchor is None
    assert t_site.turning_points[0].id == "tp_junction"
    door = next(door for door in t_site.doors if door.id == "door_library")
    assert (door.room, door.style, door.color, door.label, door.state) == (
        "room_library",
        "glass",
        "clear",
        "Library",
        "closed",
    )
    chair = next(thing for thing in t_site.landmarks if thing.id == "chair")
    assert (chair.category, chair.color, chair.mount) == ("chair", "red", "floor")
    assert chair.size == (0.5, 0.5, 0.9)
    route = t_site.find_route("route_r2_reference")
    assert [(turn.at, turn.direction) for turn in route.turns] == [
        ("tp_junction", "right")
    ]


def test_degrees_become_radians_in_the_half_open_circle(t_site: Site):
    exits = {way.heading for way in t_site.turning_points[0].exits}
    assert exits == {0.0, math.pi, -math.pi / 2}


def test_an_anchor_is_read(corridor_site: Site):
    assert corridor_site.anchor is not None
    assert corridor_site.anchor.latitude == 35.0
    assert corridor_site.anchor.bearing == 0.0


def test_members_the_format_does_not_know_are_accepted(
    plan: ReadPlan, write_plan: WritePlan, l_site: Site
):
    content = plan("l_shape")
    content["crs"] = {"type": "name", "properties": {"name": "none"}}
    content["bbox"] = [0, 0, 12, 12]
    content["features"][0]["bbox"] = [0, 0, 1, 1]
    content["features"][0]["properties"]["stroke"] = "#ff0000"
    assert load_site(write_plan(content)) == l_site


def test_a_member_nobody_reads_may_hold_anything_and_is_kept_in_the_plan(
    plan: ReadPlan, write_plan: WritePlan, tmp_path: Path
):
    content = plan("l_shape") | {"remark": "half a character: \ud800"}
    site = load_site(write_plan(content))
    site.save(tmp_path / "l_shape.geojson")
    assert (
        json.loads((tmp_path / "l_shape.geojson").read_bytes())["remark"]
        == content["remark"]
    )


def test_heights_in_positions_are_passed_over(
    plan: ReadPlan, write_plan: WritePlan, corridor_site: Site
):
    content = plan("corridor")
    for feature in content["features"]:
        if feature["geometry"]["type"] == "Point":
            feature["geometry"]["coordinates"].append(3.5)
    assert load_site(write_plan(content)) == corridor_site


def test_a_byte_order_mark_does_no_harm(tmp_path: Path, plan_texts: dict[str, str]):
    path = tmp_path / "loop.geojson"
    path.write_text(plan_texts["loop"], encoding="utf-8-sig")
    assert load_site(path).name == "loop"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param(b"", "got an empty file", id="empty"),
        pytest.param(b" \n\t", "got an empty file", id="blank"),
        pytest.param(b"\x89PNG\r\n\x1a\n\x00\xff", "UTF-8", id="binary"),
        pytest.param(b'{"type": "Feat', "mistake in column 10", id="cut off"),
        pytest.param(b"[1, 2]", "at the top, got [1, 2]", id="a list"),
        pytest.param(b"null", "at the top, got null", id="null"),
        pytest.param(b"{}", "expected this member", id="nothing in it"),
    ],
)
def test_a_file_that_is_no_plan_gives_one_clear_line(
    content: bytes, message: str, tmp_path: Path
):
    path = tmp_path / "odd.geojson"
    path.write_bytes(content)
    with pytest.raises(SitePlanError) as caught:
        load_site(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: -: ")
    assert message in text
    assert "\n" not in text


def test_a_missing_file_and_a_folder_give_clear_messages(tmp_path: Path):
    with pytest.raises(SettingsError, match="no such file"):
        load_site(tmp_path / "none.geojson")
    with pytest.raises(SettingsError, match="no such file"):
        load_site("a\0b.geojson")
    with pytest.raises(SitePlanError, match="got a directory"):
        load_site(tmp_path)
    with pytest.raises(SitePlanError, match="got a device or pipe"):
        load_site("/dev/zero")


def test_a_long_list_of_mistakes_is_told_by_the_first_and_a_count(
    plan: ReadPlan, write_plan: WritePlan
):
    content = plan("corridor")
    del content["title"]
    content["features"][0]["properties"]["name"] = 7
    with pytest.raises(SitePlanError) as caught:
        load_site(write_plan(content))
    message = str(caught.value)
    assert ": -: members: title: expected this member, got none" in message
    assert "(1 more: see them all with `memorymaze sites check" in message


def test_the_message_names_file_feature_rule_and_what_came(changed: Changed):
    path = changed("t_junction", "chair", {"properties.heading_deg": "north"})
    with pytest.raises(SitePlanError) as caught:
        load_site(path)
    assert str(caught.value) == (
        f"{path}: chair: members: properties.heading_deg: expected a valid number, "
        "got 'north'"
    )


def test_a_folder_gives_its_plans_by_name(tiny_sites: dict[str, Site]):
    assert list(tiny_sites) == [
        "corridor",
        "crossing",
        "l_shape",
        "loop",
        "slanted_crossing",
        "t_junction",
        "two_rooms",
    ]
    assert all(name == site.name for name, site in tiny_sites.items())


def test_a_folder_without_plans_is_an_error(tmp_path: Path):
    (tmp_path / "notes.txt").write_text("no plan", encoding="utf-8")
    with pytest.raises(SitePlanError, match="at least one site plan"):
        load_sites(tmp_path)
    with pytest.raises(SitePlanError, match="no such folder"):
        load_sites(tmp_path / "none")
    with pytest.raises(SitePlanError, match="got a file"):
        load_sites(tmp_path / "notes.txt")


def test_two_plans_of_the_same_name_are_an_error(
    tmp_path: Path, plan_texts: dict[str, str]
):
    for stem in ("first", "second"):
        (tmp_path / f"{stem}.geojson").write_text(plan_texts["loop"], encoding="utf-8")
    with pytest.raises(SitePlanError, match=r"second\.geojson.*'loop'.*first\.geojson"):
        load_sites(tmp_path)


def test_an_unknown_floor_is_answered_with_those_there_are():
    with pytest.raises(SettingsError, match="university, museum_5f, museum_7f"):
        load_site("museum_6f")


def test_an_unsound_plan_among_others_stops_loading_the_folder(changed: Changed):
    changed("l_shape", "-", {})
    path = changed("loop", "tp_sw", {"properties.exits.0.to": "nowhere"})
    with pytest.raises(SitePlanError, match=r"tp_sw: known-reference: .*'nowhere'"):
        load_sites(path.parent)
