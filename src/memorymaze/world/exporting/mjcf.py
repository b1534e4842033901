"""A building as MJCF: a folder with one XML and its pictures, for MuJoCo alone."""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from memorymaze.basics.durable_files import new_folder
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.world.cameras.mujoco_model import SpecAssembler
from memorymaze.world.cameras.visual_scene import add_lights
from memorymaze.world.exporting.named_materials import png_of
from memorymaze.world.exporting.named_meshes import (
    NamedMesh,
    named_meshes,
    plan_members,
    site_file_stem,
)
from memorymaze.world.looks.meshes import PlacedMeshes
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.solids import Solid, landmark_solid, wall_solids

TEXTURES = "textures"
SEEN_GROUP, SOLID_GROUP = 1, 3
"""MuJoCo's viewer shows groups 0 to 2: what is seen, not the boxes one drives against."""


def write_mjcf(site: Site, out: Path) -> list[Path]:
    """Write a building as a folder with `NAME.xml`."""
    spec = mujoco.MjSpec()
    spec.modelname = site.name
    add_lights(spec)
    for name, solid in _solids(site):
        spec.worldbody.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=list(solid.half_size),
            pos=list(solid.position),
            quat=about_z(solid.heading),
            group=SOLID_GROUP,
        )
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[0, 0, 1],
        group=SOLID_GROUP,
    )
    assembler = SpecAssembler(spec)
    spec.add_text(name="plan", data=_text(plan_members(site)))
    for mesh in named_meshes(site):
        _add(assembler, mesh)
    assembler.finish()
    with new_folder(out) as folder:
        (folder / TEXTURES).mkdir()
        names = [f"{site_file_stem(site)}.xml"]
        for texture in spec.textures:
            pixels = np.frombuffer(bytes(texture.data), dtype=np.uint8)
            shape = (texture.height, texture.width, texture.nchannel)
            names.append(f"{TEXTURES}/{texture.name}.png")
            (folder / names[-1]).write_bytes(png_of(pixels.reshape(shape)))
            texture.file, texture.data = names[-1], b""
        # The XML is only written for what compiles, so it looks for the pictures.
        spec.modelfiledir = str(folder)
        (folder / names[0]).write_text(spec.to_xml(), encoding="utf-8")
    return [out / name for name in names]


def _solids(site: Site) -> Iterator[tuple[str, Solid]]:
    """Yield what a robot drives against, the same boxes as in our own scene."""
    for number, solid in enumerate(wall_solids(site)):
        yield f"wall_{number}/solid", solid
    for landmark in site.landmarks:
        if landmark.obstacle:
            yield f"{landmark.id}/solid", landmark_solid(landmark, site)


def _add(assembler: SpecAssembler, mesh: NamedMesh) -> None:
    """Add a body with what is seen of a feature, and a text with what it is."""
    placed = mesh.placed
    body = assembler.spec.worldbody.add_body(
        name=mesh.name,
        pos=[placed.x, placed.y, placed.z],
        quat=about_z(placed.heading),
    )
    assembler.add(PlacedMeshes(placed.parts), SEEN_GROUP, body=body)
    assembler.spec.add_text(name=mesh.name, data=_text(mesh.attributes))


def _text(attributes: object) -> str:
    return json.dumps(attributes, ensure_ascii=False)
