"""What only `find_site_problems` reports: every such rule, broken once in a tiny plan."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import pytest

from memorymaze.world.sites import (
    BUILTIN_SITE_NAMES,
    find_site_problems,
    load_site,
    plan_file,
)
from memorymaze.world.sites.problems import Rule, SiteProblem

Changed = Callable[[str, str, dict[str, Any]], Path]
DOCUMENT = Path(__file__).parents[3] / "docs" / "buildings.md"
SHAPE = "geometry.coordinates"
REFERENCE = "route_r1_reference"
ALTERNATIVE = "route_r1_alternative"
OUT_OF_ORDER = [
    {"at": "tp_se", "direction": "left"},
    {"at": "tp_sw", "direction": "left"},
]


def _rectangle(west: float, south: float, east: float, north: float) -> list[Any]:
    return [[west, south], [east, south], [east, north], [west, north], [west, south]]


ERRORS = [
    (
        "turning-point-convex",
        "loop",
        "tp_sw",
        {SHAPE: [[[0, 0], [2, 0], [0.3, 0.3], [0, 2], [0, 0]]]},
    ),
    ("exit-touches", "loop", "tp_sw", {"properties.exits.0.to": "north_way"}),
    ("exit-heading", "loop", "tp_sw", {"properties.exits.0.heading_deg": 225}),
    ("room-beside-floor", "corridor", "room_1", {SHAPE: [_rectangle(1, 1, 6, 5)]}),
    ("door-on-wall", "corridor", "door_1", {SHAPE: [[2.5, 1.0], [3.5, 1.0]]}),
    ("door-on-wall", "corridor", "door_1", {SHAPE: [[2.5, 1.5], [3.5, 1.2]]}),
    ("door-at-room", "corridor", "door_1", {"properties.room": "room_3"}),
    ("landmark-on-floor", "corridor", "bench", {SHAPE: [10, -3]}),
    (
        "landmark-inside-walls",
        "corridor",
        "bench",
        {"properties.size_m": [1.5, 2.0, 0.5]},
    ),
    ("landmark-on-wall", "t_junction", "sign", {SHAPE: [0, 0.2]}),
    ("landmark-faces-floor", "t_junction", "sign", {"properties.heading_deg": 90}),
    ("route-length", "corridor", REFERENCE, {"properties.length_m": 14.51}),
    ("route-clearance", "corridor", REFERENCE, {SHAPE: [[2, -0.6], [16.5, -0.6]]}),
    ("route-clearance", "corridor", REFERENCE, {SHAPE: [[2, 1.1], [16.5, 1.1]]}),
    ("route-goal", "corridor", REFERENCE, {"properties.goal_landmark": "door_1"}),
    ("turn-on-route", "loop", REFERENCE, {"properties.turns.0.at": "tp_se"}),
    (
        "turn-direction",
        "loop",
        REFERENCE,
        {"properties.turns.0.direction": "slight_left"},
    ),
]

WARNINGS = [
    ("corridor-width", "loop", "south_way", {SHAPE: [_rectangle(0, 0, 14, 1.6)]}),
    ("exit-apart", "loop", "tp_sw", {"properties.exits.0.heading_deg": 75}),
    ("door-width", "corridor", "door_1", {SHAPE: [[2.5, 1.5], [2.8, 1.5]]}),
    (
        "landmark-overhead",
        "t_junction",
        "clock",
        {"properties.obstacle": True, SHAPE: [-5, 0.75]},
    ),
    (
        "route-start-heading",
        "corridor",
        REFERENCE,
        {"properties.start_heading_deg": 180},
    ),
    ("turn-bends", "loop", ALTERNATIVE, {"properties.turns": OUT_OF_ORDER}),
    ("known-word", "loop", "south_way", {"properties.floor_material": "marble"}),
    ("known-word", "corridor", "room_1", {"properties.use": "pool"}),
    ("known-word", "corridor", "door_1", {"properties.style": "revolving"}),
    ("heading-range", "loop", "box", {"properties.heading_deg": -270}),
    ("name-is-stem", "loop", "-", {"name": "other"}),
]


def errors_in(path: Path) -> list[SiteProblem]:
    return [each for each in find_site_problems(path) if each.severity == "error"]


@pytest.mark.parametrize(("rule", "name", "feature", "changes"), ERRORS)
def test_a_plan_that_says_something_false_is_an_error_but_loads(
    rule: str, name: str, feature: str, changes: dict[str, Any], changed: Changed
):
    path = changed(name, feature, changes)
    assert (feature, rule) in {(each.feature, each.rule) for each in errors_in(path)}
    assert load_site(path).walkable_floor.area > 0


@pytest.mark.parametrize(("rule", "name", "feature", "changes"), WARNINGS)
def test_a_plan_that_is_only_unlike_the_benchmark_gets_a_warning(
    rule: str, name: str, feature: str, changes: dict[str, Any], changed: Changed
):
    path = changed(name, feature, changes)
    problems = find_site_problems(path)
    assert (feature, rule) in {(each.feature, each.rule) for each in problems}
    assert {each.severity for each in problems} == {"warning"}
    assert load_site(path).walkable_floor.area > 0


def test_an_id_that_is_not_in_snake_case_gets_a_warning(changed: Changed):
    problems = find_site_problems(changed("loop", "box", {"id": "The Box"}))
    assert ("The Box", "id-snake-case") in {
        (each.feature, each.rule) for each in problems
    }


def test_a_seam_open_by_a_millimetre_loads_and_is_an_error(changed: Changed):
    path = changed("two_rooms", "passage", {SHAPE: [_rectangle(6.001, 2, 12, 4)]})
    [problem] = errors_in(path)
    assert problem.rule == "floor-seams"
    assert load_site(path).walkable_floor.area == pytest.approx(84, abs=0.01)


def test_a_hole_that_no_block_fits_into_is_reported(changed: Changed):
    outline, sliver = _rectangle(0, 0, 6, 6), _rectangle(3, 1, 3.1, 1.1)
    path = changed("two_rooms", "west_hall", {SHAPE: [outline, sliver]})
    [seam] = [each for each in find_site_problems(path) if each.rule == "floor-seams"]
    assert "0.0100 m² at (3.05, 1.05)" in seam.message


def test_floor_behind_obstacles_that_a_robot_cannot_pass_is_reported(changed: Changed):
    path = changed(
        "two_rooms", "table", {SHAPE: [9, 3], "properties.size_m": [1.6, 1.6, 1]}
    )
    assert "floor-passable" in {each.rule for each in find_site_problems(path)}


def test_a_published_floor_keeps_its_published_route_lengths(changed: Changed):
    path = changed("loop", "-", {"name": "university"})
    [problem] = [
        each for each in find_site_problems(path) if each.rule == "published-length"
    ]
    assert (problem.feature, problem.severity) == (REFERENCE, "error")
    assert "expected 40.27 m" in problem.message


def test_every_rule_is_explained_in_the_document():
    rules = DOCUMENT.read_text(encoding="utf-8").split("\n## Rules")[1]
    documented = re.findall(r"^\| `([a-z-]+)` \|", rules, flags=re.MULTILINE)
    assert documented == list(get_args(Rule))


@pytest.mark.parametrize("name", BUILTIN_SITE_NAMES)
def test_the_benchmarks_floors_break_no_rule(name: str):
    assert find_site_problems(plan_file(name)) == []


def test_the_size_of_the_benchmark_is_asked_of_its_floors_alone(
    changed: Changed, tiny_sites_folder: Path
):
    for path in tiny_sites_folder.glob("*.geojson"):
        assert find_site_problems(path) == [], path
    named = find_site_problems(changed("loop", "-", {"name": "museum_5f"}))
    warned = {each.rule for each in named if each.severity == "warning"}
    sizes = {"floor-extent", "turning-point-count", "thing-count", "route-names"}
    assert warned - {"name-is-stem"} == sizes


def test_all_mistakes_are_found_at_once(
    plan: Callable[[str], Any], write_plan: Callable[[Any], Path]
):
    content = plan("corridor")
    features = {each["id"]: each for each in content["features"]}
    features["door_1"]["properties"]["room"] = "attic"
    features["door_2"]["properties"]["state"] = "ajar"
    features["door_3"]["geometry"]["coordinates"] = [[11.5, 1.2], [12.5, 1.2]]
    features["route_r1_reference"]["properties"]["length_m"] = 1.0
    errors = errors_in(write_plan(content))
    assert [(each.feature, each.rule) for each in errors] == [
        ("door_2", "members"),
        ("door_1", "known-reference"),
        ("door_3", "door-on-wall"),
        ("route_r1_reference", "route-length"),
    ]


def test_a_feature_that_refers_to_a_broken_one_is_not_blamed(changed: Changed):
    path = changed("corridor", "room_1", {"properties.use": 3})
    [error] = errors_in(path)
    assert (error.feature, error.rule) == ("room_1", "members")


def test_a_problem_is_one_line_with_file_feature_and_rule(changed: Changed):
    path = changed("corridor", "door_1", {"properties.room": "attic"})
    [problem] = errors_in(path)
    assert problem.line() == (
        f"{path}:door_1:known-reference: error: room: expected the id of a room in "
        "this plan, got 'attic'"
    )


def test_a_missing_plan_is_a_problem_and_no_exception(tmp_path: Path):
    [problem] = find_site_problems(tmp_path / "none.geojson")
    assert (problem.rule, problem.severity) == ("readable", "error")
