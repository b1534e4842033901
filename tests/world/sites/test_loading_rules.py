"""What `load_site` refuses: every hard rule, broken once in a tiny plan."""

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.geometry.grid import LARGEST_FLOOR
from memorymaze.world.sites import find_site_problems, load_site

Changed = Callable[[str, str, dict[str, Any]], Path]
SHAPE = "geometry.coordinates"
NAN, INFINITY = float("nan"), float("inf")
SQUARE = [[0, 0], [0.01, 0], [0.01, 0.01], [0, 0.01], [0, 0]]

BROKEN = [
    ("members", "loop", "-", {"title": ...}),
    ("members", "loop", "-", {"type": "Feature"}),
    ("members", "loop", "-", {"features": []}),
    ("members", "loop", "-", {"features": ...}),
    ("members", "loop", "-", {"ceiling_height_m": NAN}),
    ("members", "loop", "-", {"anchor": "Tokyo"}),
    ("members", "loop", "-", {"title": "half a character: \ud800"}),
    ("members", "loop", "box", {"properties.text": "\udfff"}),
    ("members", "loop", "box", {"properties.size_m": [1, 2]}),
    ("members", "loop", "box", {"properties.size_m": [1, 2, -3]}),
    ("members", "loop", "box", {"properties.obstacle": "yes"}),
    ("members", "loop", "box", {"properties.color": ...}),
    ("members", "loop", "box", {"properties.heading_deg": INFINITY}),
    ("members", "loop", "fountain", {"properties.mount": "table"}),
    ("members", "loop", "tp_sw", {"properties.exits": []}),
    ("members", "loop", "tp_sw", {"properties.shape": "star"}),
    ("members", "loop", "box", {SHAPE: [NAN, 1]}),
    ("members", "loop", "box", {SHAPE: [1]}),
    ("members", "loop", "box", {SHAPE: [3e9, 1]}),
    ("members", "loop", "box", {"geometry": None}),
    ("members", "loop", "box", {"geometry.type": "Polygon"}),
    ("members", "corridor", "door_1", {SHAPE: [[1, 1.5], [2, 1.5], [3, 1.5]]}),
    ("known-kind", "loop", "box", {"properties.kind": "wall"}),
    ("known-kind", "loop", "box", {"properties.kind": ...}),
    ("known-kind", "loop", "box", {"properties": ...}),
    ("ring-closed", "loop", "tp_sw", {SHAPE: [[[0, 0], [2, 0], [2, 2], [0, 2]]]}),
    ("ring-closed", "loop", "tp_sw", {SHAPE: [[[0, 0], [2, 0], [0, 0]]]}),
    (
        "polygon-valid",
        "loop",
        "tp_sw",
        {SHAPE: [[[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]]},
    ),
    ("polygon-valid", "loop", "tp_sw", {SHAPE: [SQUARE]}),
    (
        "line-steps",
        "loop",
        "route_r1_reference",
        {SHAPE: [[1, 4], [1, 4], [7, 13]]},
    ),
    (
        "corridor-four-corners",
        "loop",
        "south_way",
        {SHAPE: [[[0, 0], [14, 0], [14, 2], [9, 2], [0, 2], [0, 0]]]},
    ),
    (
        "corridor-convex",
        "loop",
        "south_way",
        {SHAPE: [[[0, 0], [14, 0], [5, 1], [0, 2], [0, 0]]]},
    ),
    ("known-reference", "loop", "tp_sw", {"properties.exits.0.to": "nowhere"}),
    ("known-reference", "loop", "tp_sw", {"properties.exits.0.to": "box"}),
    ("known-reference", "loop", "tp_sw", {"properties.exits.0.to": "tp_sw"}),
    ("known-reference", "corridor", "door_1", {"properties.room": "attic"}),
    (
        "known-reference",
        "l_shape",
        "route_r1_reference",
        {"properties.turns.0.at": "way_south"},
    ),
    (
        "known-reference",
        "l_shape",
        "route_r1_reference",
        {"properties.goal_landmark": "gold"},
    ),
    (
        "one-reference",
        "loop",
        "route_r1_alternative",
        {"properties.role": "reference"},
    ),
    ("one-reference", "loop", "route_r1_alternative", {"properties.route": "R2"}),
    (
        "route-on-floor",
        "corridor",
        "route_r1_reference",
        {SHAPE: [[-3, 0], [16.5, 0]]},
    ),
    (
        "route-on-floor",
        "corridor",
        "route_r1_reference",
        {SHAPE: [[3, 0], [9, 30], [16.5, 0]]},
    ),
    ("members", "loop", "box", {"properties.category": " \u00a0"}),
]


def _refused(path: Path, feature: str, rule: str) -> str:
    """Assert that checking and loading both blame a feature, and return the message."""
    found = [
        (each.feature, each.rule, each.severity) for each in find_site_problems(path)
    ]
    assert (feature, rule, "error") in found
    with pytest.raises(SitePlanError) as caught:
        load_site(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: {feature}: {rule}: ")
    assert "\n" not in message
    return message


@pytest.mark.parametrize(("rule", "name", "feature", "changes"), BROKEN)
def test_a_plan_that_cannot_be_used_is_refused_by_feature_and_rule(
    rule: str, name: str, feature: str, changes: dict[str, Any], changed: Changed
):
    _refused(changed(name, feature, changes), feature, rule)


def test_an_id_that_is_another_routes_name_is_refused(changed: Changed) -> None:
    told = changed("loop", "route_r1_alternative", {"id": "R1"})
    _refused(told, "R1", "one-reference")


def test_an_id_of_another_type_or_with_line_breaks_is_shown_safely(changed: Changed):
    _refused(changed("loop", "box", {"id": "a\nb"}), "'a\\nb'", "members")
    _refused(changed("loop", "box", {"id": 17}), "features[9]", "members")


def test_a_feature_that_is_no_object_is_refused(
    plan: Callable[[str], Any], write_plan: Callable[[Any], Path]
):
    content = plan("loop")
    content["features"].append(5)
    _refused(write_plan(content), "features[12]", "known-kind")


def test_two_features_of_the_same_id_are_refused(
    plan: Callable[[str], Any], write_plan: Callable[[Any], Path]
):
    content = plan("loop")
    content["features"].append(copy.deepcopy(content["features"][0]))
    _refused(write_plan(content), "south_way", "unique-id")


def test_a_floor_in_two_pieces_is_refused_with_the_place_of_the_gap(changed: Changed):
    ring = [[6.5, 2], [12, 2], [12, 4], [6.5, 4], [6.5, 2]]
    path = changed("two_rooms", "passage", {SHAPE: [ring]})
    message = _refused(path, "west_hall", "floor-connected")
    assert "36.00 m² at (3.00, 3.00), 0.500 m from the rest" in message


def test_a_plan_in_millimetres_is_told_that_metres_are_wanted(
    enlarged: Callable[[float], Path],
):
    message = _refused(enlarged(1000), "-", "floor-size")
    assert "at most 2000 m across, got 13000 m" in message
    assert "millimetres" in message


def test_a_hall_whose_distances_would_take_gigabytes_is_refused_with_its_size(
    enlarged: Callable[[float], Path],
):
    message = _refused(enlarged(100), "-", "floor-size")
    assert f"at most {LARGEST_FLOOR:,.0f} m², got 460,000 m²" in message


def test_a_floor_that_obstacles_cover_wholly_is_refused(changed: Changed):
    path = changed("t_junction", "chair", {"properties.size_m": [99, 99, 1]})
    _refused(path, "-", "floor-free")


def test_a_plan_of_degrees_is_told_that_metres_are_wanted(
    plan: Callable[[str], Any], write_plan: Callable[[Any], Path]
):
    content = plan("corridor")
    ring = [[139.0, 35.0], [139.0002, 35.0], [139.0002, 35.00003], [139.0, 35.00003]]
    content["features"][0]["geometry"]["coordinates"] = [[*ring, ring[0]]]
    message = _refused(write_plan(content), "corridor", "polygon-valid")
    assert "metres, not degrees of longitude and latitude" in message
