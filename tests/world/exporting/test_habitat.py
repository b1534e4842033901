import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from memorymaze.world.exporting import export_site
from memorymaze.world.sites import Site

Errors = Callable[[Path], list[dict[str, Any]]]

# As in habitat-sim's documentation, docs/pages/attributesJSON.rst, and in what its
# managers of attributes read.
DATASET_MEMBERS = {"stages", "scene_instances", "semantic_scene_descriptor_instances"}
SCENE_MEMBERS = {"stage_instance", "default_lighting", "semantic_scene_instance"}
SEMANTIC_MEMBERS = {
    "semantic_asset", "semantic_descriptor_filename", "semantic_up", "semantic_front",
    "has_semantic_textures",
}  # fmt: skip
STAGE_MEMBERS = SEMANTIC_MEMBERS | {
    "render_asset", "collision_asset", "up", "front", "units_to_meters",
    "force_flat_shading",
}  # fmt: skip
REGION_MEMBERS = {
    "name", "label", "poly_loop", "floor_height", "extrusion_height", "min_bounds",
    "max_bounds",
}  # fmt: skip


@pytest.fixture(scope="module")
def dataset(l_site: Site, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("habitat") / "exported"
    files = export_site(l_site, "habitat", out)
    assert files[0] == out / "l_shape.scene_dataset_config.json"
    assert sorted(files) == sorted(each for each in out.rglob("*") if each.is_file())
    return out


def read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def test_configurations_have_the_documented_members_and_name_files_that_are_there(
    dataset: Path,
):
    config = read(dataset / "l_shape.scene_dataset_config.json")
    assert set(config) == DATASET_MEMBERS
    for group in config.values():
        (folder,) = group["paths"][".json"]
        assert (dataset / folder).is_dir()
    scene = read(dataset / "scenes" / "l_shape.scene_instance.json")
    assert set(scene) == SCENE_MEMBERS
    stage_path = (
        dataset / f"{scene['stage_instance']['template_name']}.stage_config.json"
    )
    stage = read(stage_path)
    assert set(stage) == STAGE_MEMBERS
    semantics = read(dataset / scene["semantic_scene_instance"])
    assert set(semantics) == {*SEMANTIC_MEMBERS, "region_annotations"}
    assert {name: stage[name] for name in SEMANTIC_MEMBERS} == {
        name: semantics[name] for name in SEMANTIC_MEMBERS
    }
    for name in ("render_asset", "collision_asset", "semantic_asset"):
        assert (stage_path.parent / stage[name]).is_file()
    assert (stage_path.parent / stage["semantic_descriptor_filename"]).is_file()


def test_the_stage_says_that_y_is_up(dataset: Path):
    # habitat-sim takes a GLB for one with z up, unless it is told.
    stage = read(dataset / "stages" / "l_shape.stage_config.json")
    assert stage["up"] == stage["semantic_up"] == [0, 1, 0]
    assert stage["front"] == stage["semantic_front"] == [0, 0, -1]


def descriptor_of(dataset: Path) -> dict[str, tuple[int, str, int]]:
    """Instance, category and region by colour, read as habitat-sim reads HM3D."""
    path = dataset / "stages" / "l_shape.semantic.txt"
    header, *lines = path.read_text(encoding="utf-8").splitlines()
    assert header == "HM3D Semantic Annotations"
    found: dict[str, tuple[int, str, int]] = {}
    for line in lines:
        number, colour, category, region = line.split(",")
        assert colour not in found
        found[colour] = (int(number), category.replace('"', ""), int(region))
    return found


def painted(path: Path) -> dict[str, str]:
    """The one colour of each node, in 8 bits of sRGB, as habitat-sim makes it."""
    content = path.read_bytes()
    (length,) = struct.unpack_from("<I", content, 12)
    document, binary = json.loads(content[20 : 20 + length]), content[28 + length :]
    found: dict[str, str] = {}
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        colours: set[str] = set()
        for each in document["meshes"][node["mesh"]]["primitives"]:
            accessor = document["accessors"][each["attributes"]["COLOR_0"]]
            start = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
            values = np.frombuffer(binary, "<f4", 3 * accessor["count"], start)
            bent = np.where(
                values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055
            )
            bits = np.round(255 * bent).astype(int).reshape(-1, 3)
            colours |= {"".join(f"{part:02X}" for part in row) for row in bits.tolist()}
        (found[node["name"]],) = colours
    return found


def test_colours_of_the_semantic_mesh_are_those_of_the_descriptor(dataset: Path):
    instances = descriptor_of(dataset)
    colours = painted(dataset / "stages" / "l_shape.semantic.glb")
    assert set(colours.values()) == set(instances)
    told = read(dataset / "stages" / "l_shape.instances.json")
    assert {each["id"]: each["colour"] for each in told} == colours
    assert {each["instance"] for each in told} == {
        number for number, _, _ in instances.values()
    }


def test_things_doors_and_floor_have_their_categories(dataset: Path, l_site: Site):
    instances = descriptor_of(dataset)
    colours = painted(dataset / "stages" / "l_shape.semantic.glb")
    for thing in l_site.landmarks:
        assert instances[colours[thing.id]][1] == thing.category
    for door in l_site.doors:
        assert instances[colours[door.id]][1] == "door"
    for corridor in l_site.corridors:
        assert instances[colours[corridor.id]][1] == "floor"


def test_regions_are_the_parts_of_the_floor(dataset: Path, l_site: Site):
    semantics = read(dataset / "stages" / "l_shape.semantic_config.json")
    regions = semantics["region_annotations"]
    assert all(set(each) == REGION_MEMBERS for each in regions)
    names = [each["name"] for each in regions]
    instances = descriptor_of(dataset)
    colours = painted(dataset / "stages" / "l_shape.semantic.glb")
    for corridor in l_site.corridors:
        assert names[instances[colours[corridor.id]][2]] == corridor.id
        region = regions[names.index(corridor.id)]
        west, south, east, north = corridor.polygon.bounds
        assert region["min_bounds"] == [west, 0.0, -north]
        assert region["max_bounds"] == [east, l_site.ceiling_height, -south]


def test_khronos_finds_nothing_wrong_with_both_meshes(
    dataset: Path, gltf_errors: Errors
):
    for path in dataset.glob("stages/*.glb"):
        assert gltf_errors(path) == []
