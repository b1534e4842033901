"""A building for CARLA: its roads, its mesh, what imports them, and its things as props.

CARLA's frame is left-handed: x east, y south, z up; metres, degrees clockwise.
"""

import math
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from memorymaze.basics.durable_files import as_json, write_new_folder
from memorymaze.basics.errors import SettingsError
from memorymaze.world.exporting.gltf import Glb
from memorymaze.world.exporting.named_meshes import (
    FLOOR_FEATURES,
    NamedMesh,
    named_meshes,
    plan_members,
    site_file_stem,
)
from memorymaze.world.exporting.opendrive import LANE_TYPES, LaneType, opendrive
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.things import kind_of_thing

ASSIMP = "assimp"
"""Command that converts the mesh; of the Debian package `assimp-utils`."""
WITHOUT_ASSIMP = (
    "not written: the .fbx that CARLA's import takes; for it, install the command "
    "assimp (sudo apt-get install assimp-utils) and export again"
)
CENTIMETRES = 100.0
"""Units of an FBX file in a metre: assimp writes numbers as they are, and calls them
centimetres."""
FLOOR_TAGS: Mapping[LaneType, str] = {
    "sidewalk": "Road_Sidewalk",
    "driving": "Road_Road",
}
"""Words in a mesh's name by which CARLA's import gives it the semantic tag `SideWalk` or
`Road`. It knows none for walls, doors and things."""
BLUEPRINTS: Mapping[str, str] = {
    "bench": "static.prop.bench01",
    "cardboard boxes": "static.prop.box01",
    "chair": "static.prop.plasticchair",
    "coffee table": "static.prop.table",
    "drinking fountain": "static.prop.streetfountain",
    "drop box": "static.prop.mailbox",
    "kiosk": "static.prop.kiosk_01",
    "planter": "static.prop.plantpot05",
    "potted plant": "static.prop.plantpot04",
    "queue barrier": "static.prop.chainbarrier",
    "recycling bin": "static.prop.bin",
    "recycling bins": "static.prop.bin",
    "round table": "static.prop.plastictable",
    "suitcase": "static.prop.travelcase",
    "table": "static.prop.table",
    "traffic cone": "static.prop.trafficcone01",
    "trash can": "static.prop.trashcan01",
    "trolley": "static.prop.shoppingtrolley",
    "vending machine": "static.prop.vendingmachine",
}
"""Blueprints of CARLA 0.9.16's catalogue of props, by the archetype of a thing."""


def write_carla(site: Site, out: Path, lanes: LaneType = "sidewalk") -> list[Path]:
    """Write a folder with `NAME.xodr`, `.glb`, `.fbx`, `.json` and `.props.json`.

    Without the command `assimp` there is no `.fbx`.
    """
    if lanes not in LANE_TYPES:
        expected = " or ".join(LANE_TYPES)
        raise SettingsError(f"--lanes: expected {expected}, got {lanes!r}")
    name = site_file_stem(site)
    meshes = list(named_meshes(site))
    glb = Glb(site.name, plan_members(site))
    for mesh in meshes:
        glb.add(mesh)
    package = {
        "maps": [
            {
                "name": name,
                "source": f"./{name}.fbx",
                "use_carla_materials": False,
                "xodr": f"./{name}.xodr",
            }
        ],
        "props": [],
    }
    props = {
        "frame": "x east, y south, z up; metres; yaw in degrees clockwise from above",
        "opendrive_generation_parameters": generation_parameters(site),
        "things": list(_things(site, meshes)),
    }
    contents = {
        f"{name}.xodr": opendrive(site, lanes).encode(),
        f"{name}.glb": glb.content(),
        f"{name}.json": as_json(package),
        f"{name}.props.json": as_json(props),
    }
    converted = _fbx(name, meshes, lanes)
    if converted is not None:
        contents[f"{name}.fbx"] = converted
    return write_new_folder(out, contents)


def generation_parameters(site: Site) -> dict[str, float | bool]:
    """Return members of `carla.OpendriveGenerationParameters` for a site.

    For `generate_opendrive_world`, which makes a world of the roads alone.
    """
    return {
        "vertex_distance": 0.5,
        "max_road_length": 50.0,
        "wall_height": site.ceiling_height,
        # Lanes in junctions get wider by as much, into the walls.
        "additional_width": 0.0,
        "smooth_junctions": False,
        "enable_mesh_visibility": True,
        "enable_pedestrian_navigation": True,
    }


def _things(site: Site, meshes: list[NamedMesh]) -> Iterator[dict[str, Any]]:
    """Yield every thing, with a blueprint where CARLA has a prop like it."""
    heights = {each.name: each.placed.z for each in meshes}
    for thing in site.landmarks:
        kind = kind_of_thing(thing.category)
        yield {
            "id": thing.id,
            "category": thing.category,
            "blueprint": BLUEPRINTS.get(kind.look) if kind else None,
            "x": thing.position.x,
            "y": -thing.position.y,
            "z": heights[thing.id],
            "yaw": -math.degrees(thing.heading),
            "size_m": thing.size,
            "obstacle": thing.obstacle,
        }


def _fbx(name: str, meshes: list[NamedMesh], lanes: LaneType) -> bytes | None:
    """Return the building as FBX with CARLA's names, or None without `assimp`."""
    command = shutil.which(ASSIMP)
    if command is None:
        return None
    glb = Glb(name, {}, scale=CENTIMETRES)
    for mesh in meshes:
        words = [name, re.sub(r"\W+", "_", mesh.name)]
        if mesh.kind in FLOOR_FEATURES:
            words.insert(1, FLOOR_TAGS[lanes])
        # It stops at attributes that hold lists or nothing.
        told = {
            key: each for key, each in mesh.attributes.items() if isinstance(each, str)
        }
        glb.add(replace(mesh, name="_".join(words), attributes=told))
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder) / f"{name}.glb", Path(folder) / f"{name}.fbx"
        source.write_bytes(glb.content())
        done = subprocess.run(
            [command, "export", str(source), str(target), "-ffbx"],
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
        )
        if done.returncode or not target.is_file():
            told = (done.stderr or done.stdout).strip().splitlines()
            raise SettingsError(
                f"{command}: expected an FBX file of {source.name}, got exit code "
                f"{done.returncode}: {told[-1] if told else 'no word'}; take the command "
                "off the path to export without it"
            )
        return target.read_bytes()
