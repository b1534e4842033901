import json
import math
import struct
from collections.abc import Callable
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from memorymaze.world.construction import make_building
from memorymaze.world.exporting import export_site
from memorymaze.world.sites import Site
from memorymaze.world.sites.plan import site_plan

Errors = Callable[[Path], list[dict[str, Any]]]


@pytest.fixture(scope="module")
def corridor_glb(corridor_site: Site, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("gltf") / "corridor.glb"
    assert export_site(corridor_site, "gltf", out) == [out]
    return out


def json_of(glb: Path) -> dict[str, Any]:
    content = glb.read_bytes()
    (length,) = struct.unpack_from("<I", content, 12)
    return json.loads(content[20 : 20 + length])


def test_khronos_finds_nothing_wrong_with_a_small_building(
    corridor_glb: Path, gltf_errors: Errors
):
    assert gltf_errors(corridor_glb) == []


def test_khronos_finds_nothing_wrong_with_the_models_of_things(gltf_errors: Errors):
    with as_file(files("memorymaze.world.looks") / "data" / "things.glb") as path:
        assert gltf_errors(path) == []


def test_khronos_would_find_what_is_wrong(
    corridor_glb: Path, gltf_errors: Errors, tmp_path: Path
):
    damaged = tmp_path / "damaged.glb"
    damaged.write_bytes(
        corridor_glb.read_bytes().replace(b'"NORMAL":1', b'"NORMAL":0', 1)
    )
    codes = {each["code"] for each in gltf_errors(damaged)}
    assert "ACCESSOR_VECTOR3_NON_UNIT" in codes


def test_every_feature_is_a_node_with_its_id_and_properties(
    corridor_glb: Path, corridor_site: Site
):
    nodes = {node["name"]: node for node in json_of(corridor_glb)["nodes"]}
    for feature in site_plan(corridor_site)["features"]:
        wanted = {k: v for k, v in feature["properties"].items() if v is not None}
        if wanted["kind"] == "route":
            continue
        extras = nodes[feature["id"]]["extras"]
        assert extras["geometry"] == feature["geometry"]
        assert {name: extras[name] for name in wanted} == wanted
    assert nodes["site/corridor"]["extras"]["title"] == corridor_site.title
    assert [each["id"] for each in nodes["site/corridor"]["extras"]["routes"]] == [
        each.id for each in corridor_site.routes
    ]


def test_things_stand_where_the_plan_has_them_with_y_up(
    corridor_glb: Path, corridor_site: Site
):
    document = json_of(corridor_glb)
    nodes = {node["name"]: node for node in document["nodes"]}
    for thing in corridor_site.landmarks:
        node = nodes[thing.id]
        positions = [
            document["accessors"][each["attributes"]["POSITION"]]
            for each in document["meshes"][node["mesh"]]["primitives"]
        ]
        box = np.array([[each["min"], each["max"]] for each in positions])
        corners = np.array([box[:, 0].min(axis=0), box[:, 1].max(axis=0)])
        frame = trimesh.transformations.quaternion_matrix(np.roll(node["rotation"], 1))
        corners = trimesh.transform_points(corners, frame) + node["translation"]
        west, south, east, north = thing.footprint.bounds
        expected = [[west, 0.0, -north], [east, thing.size[2], -south]]
        found = np.array([corners.min(axis=0), corners.max(axis=0)])
        assert found == pytest.approx(np.array(expected), abs=1e-3)


def test_the_way_a_things_front_faces_is_the_x_axis_of_its_node(
    corridor_glb: Path, corridor_site: Site
):
    nodes = {node["name"]: node for node in json_of(corridor_glb)["nodes"]}
    thing = corridor_site.landmarks[0]
    x, y, z, w = nodes[thing.id]["rotation"]
    assert (x, z) == (0.0, 0.0)
    turned = 2 * math.atan2(y, w) - thing.heading
    assert math.cos(turned) == pytest.approx(1.0)


def test_equal_things_share_a_mesh_and_textures_are_inside(corridor_glb: Path):
    document = json_of(corridor_glb)
    assert all("uri" not in image for image in document["images"])
    used = [node["mesh"] for node in document["nodes"] if "mesh" in node]
    assert len(set(used)) == len(document["meshes"])
    assert len({m["name"] for m in document["materials"]}) == len(document["materials"])


@pytest.mark.proof
def test_khronos_finds_nothing_wrong_with_large_buildings(
    builtin_sites: dict[str, Site], gltf_errors: Errors, tmp_path: Path
):
    for site in (*builtin_sites.values(), make_building("hospital", 3)):
        (path,) = export_site(site, "gltf", tmp_path / f"{site.name}.glb")
        assert gltf_errors(path) == [], site.name
