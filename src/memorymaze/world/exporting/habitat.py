"""A building as a scene dataset for habitat-sim: a stage, its semantics, one scene.

The semantic mesh has a colour per vertex, and the descriptor is a text, as in HM3D.
"""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from shapely import Point, Polygon

from memorymaze.basics.durable_files import as_json, write_new_folder
from memorymaze.world.exporting.gltf import Glb
from memorymaze.world.exporting.named_materials import linear
from memorymaze.world.exporting.named_meshes import (
    NamedMesh,
    named_meshes,
    plan_members,
    site_file_stem,
)
from memorymaze.world.sites.records import Area, Corridor, Site, TurningPoint

HEADER = "HM3D Semantic Annotations"
UNLABELLED = ("shade", "beyond")
"""Kinds of meshes that are no things: shades on the floor, and what lies behind doors."""
SCATTER = 0x9E3779B1
"""Odd, so that no two numbers below 2**24 get the same colour, and neighbours differ."""
ORIENTATION: Mapping[str, object] = {"up": [0, 1, 0], "front": [0, 0, -1]}
"""Of our meshes; habitat-sim takes a GLB that says nothing for one with z up."""


class Instance(NamedTuple):
    """A mesh with a number and a colour of its own."""

    number: int
    mesh: NamedMesh
    region: int

    @property
    def colour(self) -> tuple[int, int, int]:
        """Red, green, blue in whole numbers up to 255."""
        value = self.number * SCATTER % 2**24
        return value >> 16, value >> 8 & 255, value & 255


def write_habitat(site: Site, out: Path) -> list[Path]:
    """Write a folder with `NAME.scene_dataset_config.json` and what it names."""
    meshes = list(named_meshes(site))
    regions: Sequence[Corridor | Area | TurningPoint] = (
        *site.turning_points,
        *site.areas,
        *site.corridors,
    )
    instances = list(_instances(meshes, regions))
    stage = Glb(site.name, plan_members(site))
    for mesh in meshes:
        stage.add(mesh)
    semantic = Glb(site.name, {})
    for each in instances:
        shades = linear(tuple(part / 255 for part in each.colour))
        semantic.add(each.mesh, (shades[0], shades[1], shades[2]))
    name = site_file_stem(site)
    semantics = {
        "semantic_asset": f"{name}.semantic.glb",
        "semantic_descriptor_filename": f"{name}.semantic.txt",
        "semantic_up": ORIENTATION["up"],
        "semantic_front": ORIENTATION["front"],
        "has_semantic_textures": False,
    }
    contents = {
        f"{name}.scene_dataset_config.json": as_json({
            "stages": {"paths": {".json": ["stages"]}},
            "scene_instances": {"paths": {".json": ["scenes"]}},
            "semantic_scene_descriptor_instances": {"paths": {".json": ["stages"]}},
        }),
        f"scenes/{name}.scene_instance.json": as_json({
            "stage_instance": {"template_name": f"stages/{name}"},
            "default_lighting": "no_lights",
            "semantic_scene_instance": f"stages/{name}.semantic_config.json",
        }),
        f"stages/{name}.stage_config.json": as_json({
            "render_asset": f"{name}.glb",
            "collision_asset": f"{name}.glb",
            **ORIENTATION,
            **semantics,
            "units_to_meters": 1.0,
            "force_flat_shading": True,
        }),
        f"stages/{name}.semantic_config.json": as_json({
            **semantics,
            "region_annotations": [_region(each, site) for each in regions],
        }),
        f"stages/{name}.glb": stage.content(),
        f"stages/{name}.semantic.glb": semantic.content(),
        f"stages/{name}.semantic.txt": _descriptor(instances),
        f"stages/{name}.instances.json": as_json([_told(each) for each in instances]),
    }
    return write_new_folder(out, contents)


def _instances(
    meshes: Sequence[NamedMesh], regions: Sequence[Corridor | Area | TurningPoint]
) -> Iterator[Instance]:
    numbers = {each.id: number for number, each in enumerate(regions)}
    labelled = [
        each for each in meshes if each.placed.parts and each.kind not in UNLABELLED
    ]
    for number, mesh in enumerate(labelled, start=1):
        part_of = str(mesh.attributes.get("part_of", mesh.name))
        region = numbers.get(part_of)
        if region is None:
            middle = np.concatenate([
                each.vertices[:, :2] for each in mesh.placed.parts
            ]).mean(axis=0)
            here = Point(mesh.placed.x + middle[0], mesh.placed.y + middle[1])
            region = min(
                range(len(regions)), key=lambda n: regions[n].polygon.distance(here)
            )
        yield Instance(number, mesh, region)


def _descriptor(instances: Sequence[Instance]) -> bytes:
    """Return the lines number, colour, category and region, which commas part."""
    lines = [HEADER]
    for each in instances:
        label = each.mesh.label.replace(",", " ").replace('"', "")
        red, green, blue = each.colour
        colour = f"{red:02X}{green:02X}{blue:02X}"
        lines.append(f'{each.number},{colour},"{label}",{each.region}')
    return "\n".join([*lines, ""]).encode()


def _told(instance: Instance) -> dict[str, Any]:
    """Return what the descriptor has no room for."""
    red, green, blue = instance.colour
    return {
        "instance": instance.number,
        "colour": f"{red:02X}{green:02X}{blue:02X}",
        **instance.mesh.attributes,
    }


def _region(part: Corridor | Area | TurningPoint, site: Site) -> dict[str, Any]:
    west, south, east, north = part.polygon.bounds
    return {
        "name": part.id,
        "label": part.name or type(part).__name__,
        "poly_loop": _loop(part.polygon),
        "floor_height": 0.0,
        "extrusion_height": site.ceiling_height,
        "min_bounds": [west, 0.0, -north],
        "max_bounds": [east, site.ceiling_height, -south],
    }


def _loop(polygon: Polygon) -> list[list[float]]:
    """Return the outline in the frame of the meshes, y up; without holes."""
    return [[x, 0.0, -y] for x, y, *_ in polygon.exterior.coords[:-1]]
