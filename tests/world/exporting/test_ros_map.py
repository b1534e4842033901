import json
import math
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
import pytest
import yaml
from PIL import Image
from shapely import Point, Polygon

from memorymaze.basics.errors import SettingsError
from memorymaze.world.exporting import export_site
from memorymaze.world.sites import Site

FREE, OCCUPIED, UNKNOWN = 254, 0, 205


@pytest.fixture(scope="module")
def rooms_map(two_rooms: Site, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("ros") / "exported"
    files = export_site(two_rooms, "ros_map", out)
    assert files[0] == out / "map.yaml"
    return out


def shade_at(folder: Path, x: float, y: float) -> int:
    """Of the map at a place, looked up as `map_server` does."""
    told = yaml.safe_load((folder / "map.yaml").read_text(encoding="utf-8"))
    pixels = np.array(Image.open(folder / told["image"]))
    column = math.floor((x - told["origin"][0]) / told["resolution"])
    row = math.floor((y - told["origin"][1]) / told["resolution"])
    return int(pixels[len(pixels) - 1 - row, column])


def features_of(path: Path) -> list[dict[str, Any]]:
    return json.loads(path.read_text(encoding="utf-8"))["features"]


def route_graph(folder: Path) -> nx.DiGraph:
    """The graph as the GeoJSON loader of Nav2's Route Server reads it."""
    graph = nx.DiGraph()
    features = features_of(folder / "graph.geojson")
    for each in features:
        if each["geometry"]["type"] == "Point":
            told = each["properties"]
            assert told["frame"] == "map"
            graph.add_node(told["id"], at=each["geometry"]["coordinates"])
    identities = {each["properties"]["id"] for each in features}
    assert len(identities) == len(features)
    for each in features:
        if each["geometry"]["type"] in ("LineString", "MultiLineString"):
            start, end = each["properties"]["startid"], each["properties"]["endid"]
            assert {start, end} <= set(graph)
            graph.add_edge(start, end)
    return graph


def values_of(metadata: Any) -> list[Any]:
    if isinstance(metadata, dict):
        return [value for each in metadata.values() for value in values_of(each)]
    return metadata if isinstance(metadata, list) else [metadata]


def test_the_map_server_members_are_all_there(rooms_map: Path):
    told = yaml.safe_load((rooms_map / "map.yaml").read_text(encoding="utf-8"))
    assert told["image"] == "map.pgm"
    assert told["mode"] == "trinary"
    assert told["resolution"] == 0.05
    assert told["origin"][2] == 0.0
    assert 0 < told["free_thresh"] < told["occupied_thresh"] < 1
    assert told["negate"] == 0
    # The shades mean what the thresholds say.
    assert told["free_thresh"] > (255 - FREE) / 255
    assert told["free_thresh"] < (255 - UNKNOWN) / 255 < told["occupied_thresh"]


def test_floor_is_free_walls_and_things_are_not(rooms_map: Path, two_rooms: Site):
    start = two_rooms.routes[0].start
    assert shade_at(rooms_map, start.x, start.y) == FREE
    for thing in two_rooms.landmarks:
        if thing.obstacle:
            place = thing.position
            assert shade_at(rooms_map, place.x, place.y) == OCCUPIED
    west, south, _, north = two_rooms.walkable_floor.bounds
    assert shade_at(rooms_map, west - 0.05, (south + north) / 2) == OCCUPIED
    assert shade_at(rooms_map, west - 0.5, (south + north) / 2) == UNKNOWN


@pytest.mark.parametrize("resolution", [0.03, 0.1, 0.5])
def test_walls_have_no_gaps_at_any_resolution(
    l_site: Site, tmp_path: Path, resolution: float
):
    export_site(l_site, "ros_map", tmp_path / "map", resolution=resolution)
    pixels = np.array(Image.open(tmp_path / "map" / "map.pgm"))
    free = pixels == FREE
    around = np.zeros_like(free)
    for rows in (-1, 0, 1):
        for columns in (-1, 0, 1):
            around |= np.roll(free, (rows, columns), axis=(0, 1))
    assert not (around & (pixels == UNKNOWN)).any()


def test_the_route_graph_joins_everything_both_ways(rooms_map: Path):
    graph = route_graph(rooms_map)
    assert len(graph) > 3
    assert nx.is_strongly_connected(graph)
    assert all((b, a) in graph.edges for a, b in graph.edges)


def test_the_route_graph_has_only_values_that_nav2_can_read(rooms_map: Path):
    for each in features_of(rooms_map / "graph.geojson"):
        for value in values_of(each["properties"]["metadata"]):
            assert isinstance(value, (bool, int, float, str))


def test_a_robot_stands_on_free_floor_and_looks_at_the_thing(
    rooms_map: Path, two_rooms: Site
):
    things = {each.id: each for each in two_rooms.landmarks}
    features = features_of(rooms_map / "semantics.geojson")
    by_id = {each["properties"]["id"]: each["properties"] for each in features}
    assert set(by_id) == {
        each.id
        for features in (two_rooms.turning_points, two_rooms.rooms, two_rooms.landmarks)
        for each in features
    }
    assert not two_rooms.doors
    for name, thing in things.items():
        stand = by_id[name]["stand"]
        assert two_rooms.free_floor.contains(Point(stand["x"], stand["y"]))
        ahead = math.atan2(thing.position.y - stand["y"], thing.position.x - stand["x"])
        assert stand["yaw"] == pytest.approx(ahead)
        assert by_id[name]["category"] == thing.category


def test_one_goes_to_a_room_by_its_door(corridor_site: Site, tmp_path: Path):
    export_site(corridor_site, "ros_map", tmp_path / "map")
    by_id = {
        each["properties"]["id"]: each
        for each in features_of(tmp_path / "map" / "semantics.geojson")
    }
    door = corridor_site.doors[2]
    assert door.room is not None
    room = by_id[door.room]
    assert Polygon(room["geometry"]["coordinates"][0]).area > 1
    assert room["properties"]["stand"] == by_id[door.id]["properties"]["stand"]


def test_other_formats_have_no_resolution(corridor_site: Site, tmp_path: Path):
    with pytest.raises(SettingsError, match="only with --to ros_map"):
        export_site(corridor_site, "gltf", tmp_path / "a.glb", resolution=0.1)
    with pytest.raises(SettingsError, match=r"from 0\.01 to 0\.5, got 0"):
        export_site(corridor_site, "ros_map", tmp_path / "map", resolution=0)
