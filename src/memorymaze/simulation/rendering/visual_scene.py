"""What a building looks like, as a MuJoCo model of its own; made only for cameras."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray
from shapely import Point, prepare

from memorymaze.simulation.furnishing import door_solid, landmark_solid
from memorymaze.simulation.looks import surfaces
from memorymaze.simulation.looks.catalogue import model_for_landmark
from memorymaze.simulation.looks.doors import model_for_door
from memorymaze.simulation.looks.object_model import MeshPart
from memorymaze.simulation.looks.windows import is_window, window_model
from memorymaze.simulation.rendering.assembling import PlacedMeshes, SpecAssembler
from memorymaze.simulation.rendering.meshes import MeshBuilder
from memorymaze.simulation.rendering.sight import Sightlines
from memorymaze.simulation.rendering.sky import FACES, sky_faces
from memorymaze.simulation.rendering.structure import Structure, structure_of
from memorymaze.simulation.scene import SceneObject
from memorymaze.sites.records import Door, Landmark, Site

__all__ = ["HIDDEN_GROUP", "SHOWN_GROUP", "VisualScene", "build_visual_scene"]

SHOWN_GROUP, HIDDEN_GROUP = 1, 5

LARGEST_PICTURE = 4096
"""Width and height up to which cameras may draw, pixels."""

FLOOR, CEILING, WALL = 0, 1, 2
_OWNERS = {
    "floor": FLOOR,
    "ceiling": CEILING,
    "wall": WALL,
    "beyond": WALL,
    "decal": FLOOR,
}

SHADOW_HEIGHT = 0.006
SHADOW_MARGIN = 0.16


@dataclass(frozen=True, eq=False)
class VisualScene:
    """A building for the eye; any number of cameras of one thread share it."""

    site: Site
    model: mujoco.MjModel
    """Only the groups of its geoms change: cameras leave out what cannot be seen."""
    data: mujoco.MjData
    objects: tuple[SceneObject, ...]
    """What can be seen; pictures of ids hold numbers of these."""
    geom_objects: NDArray[np.int32]
    """What each geom belongs to."""
    centres: NDArray[np.float64]
    """Where each geom is on the plan, (n, 2) metres."""
    radii: NDArray[np.float64]
    """Radius of each geom's circle on the plan, metres."""
    first_decal: int
    """From this geom on, geoms are mere shades, without depth or id."""
    outlet_geoms: NDArray[np.intp]
    """Geoms through or beside which one may see the sky."""
    sightlines: Sightlines
    """The walls that hide things."""


def build_visual_scene(site: Site) -> VisualScene:
    """Build what a site looks like. Takes a second or two; OpenGL is not needed.

    Args:
        site: A building that passed the checks of `memorymaze.sites`.
    """
    spec = mujoco.MjSpec()
    spec.modelname = f"{site.name}_looks"
    _add_light(spec)
    _add_sky(spec)
    structure = structure_of(site)
    things = _things(site)
    builder = _Builder(SpecAssembler(spec))
    outlets: list[int] = []
    for transparent in (False, True):
        for made in structure.slices:
            centre, radius = _circle(made.points)
            for kind, part in made.meshes():
                if kind != "decal":
                    if made.shows_sky:
                        outlets.append(builder.assembler.geom_count)
                    builder.add(
                        PlacedMeshes((part,)),
                        _OWNERS[kind],
                        centre,
                        radius,
                        transparent=transparent,
                    )
        for number, (_, placed, centre, radius) in enumerate(things, start=WALL + 1):
            builder.add(placed, number, centre, radius, transparent=transparent)
    first_decal = builder.assembler.geom_count
    _add_decals(builder, structure, site)
    builder.assembler.finish()
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    named = [SceneObject("floor", None), SceneObject("ceiling", None)]
    named.append(SceneObject("wall", None))
    return VisualScene(
        site,
        model,
        data,
        (*named, *(thing for thing, _, _, _ in things)),
        np.array(builder.owners, dtype=np.int32),
        np.array(builder.centres).reshape(-1, 2),
        np.array(builder.radii),
        first_decal,
        np.array(sorted({min(each, first_decal - 1) for each in outlets}), dtype=np.intp),
        Sightlines(structure.hiding),
    )


class _Builder:
    """Keeps the books on which geom belongs to what."""

    def __init__(self, assembler: SpecAssembler) -> None:
        self.assembler = assembler
        self.owners: list[int] = []
        self.centres: list[tuple[float, float]] = []
        self.radii: list[float] = []

    def add(
        self,
        placed: PlacedMeshes,
        owner: int,
        centre: tuple[float, float],
        radius: float,
        *,
        transparent: bool | None = None,
    ) -> None:
        count = self.assembler.add(placed, SHOWN_GROUP, transparent=transparent)
        self.owners += [owner] * count
        self.centres += [centre] * count
        self.radii += [radius] * count


_Thing = tuple[SceneObject, PlacedMeshes, tuple[float, float], float]


def _things(site: Site) -> list[_Thing]:
    floor = site.walkable_floor
    prepare(floor)
    things: list[_Thing] = []
    for door in site.doors:
        solid = door_solid(door, site)
        x, y, _ = solid.position
        heading = solid.heading
        ahead = Point(x + 0.2 * math.cos(heading), y + 0.2 * math.sin(heading))
        if not floor.contains(ahead):
            heading += math.pi
        placed = PlacedMeshes(model_for_door(door).parts, x, y, 0.0, heading)
        # An open leaf swings as far as the door is wide.
        reach = door.line.length + 0.3
        things.append((SceneObject("door", door), placed, (x, y), reach))
    for landmark in site.landmarks:
        solid = landmark_solid(landmark, site)
        x, y, z = solid.position
        made = window_model if is_window(landmark) else model_for_landmark
        placed = PlacedMeshes(
            made(landmark).parts, x, y, z - solid.half_size[2], solid.heading
        )
        radius = math.hypot(solid.half_size[0], solid.half_size[1])
        things.append((SceneObject("landmark", landmark), placed, (x, y), radius))
    return things


def _add_decals(builder: _Builder, structure: Structure, site: Site) -> None:
    for made in structure.slices:
        centre, radius = _circle(made.points)
        for kind, part in made.meshes():
            if kind == "decal":
                builder.add(PlacedMeshes((part,)), FLOOR, centre, radius)
    for landmark in site.landmarks:
        solid = landmark_solid(landmark, site)
        x, y, z = solid.position
        hx, hy, hz = solid.half_size
        if landmark.mount != "floor" and z - hz > 0.3:
            continue
        part = _shadow(hx + SHADOW_MARGIN, hy + SHADOW_MARGIN)
        radius = math.hypot(hx + SHADOW_MARGIN, hy + SHADOW_MARGIN)
        placed = PlacedMeshes((part,), x, y, SHADOW_HEIGHT, solid.heading)
        builder.add(placed, FLOOR, (x, y), radius)


def _shadow(half_x: float, half_y: float) -> MeshPart:
    mesh = MeshBuilder()
    mesh.quad([
        (-half_x, -half_y, 0.0),
        (half_x, -half_y, 0.0),
        (half_x, half_y, 0.0),
        (-half_x, half_y, 0.0),
    ])
    return mesh.part(surfaces.blob_shadow())


def _circle(points: NDArray[np.float64]) -> tuple[tuple[float, float], float]:
    low, high = points.min(axis=0), points.max(axis=0)
    centre = (low + high) / 2
    radius = float(np.hypot(*(points - centre).T).max())
    return (float(centre[0]), float(centre[1])), radius + 0.1


def _add_light(spec: mujoco.MjSpec) -> None:
    """A rig without shadows: enough to tell the sides of things apart."""
    visual = spec.visual
    visual.headlight.active = 1
    visual.headlight.ambient = [0.80, 0.80, 0.80]
    visual.headlight.diffuse = [0.12, 0.12, 0.12]
    visual.headlight.specular = [0, 0, 0]
    # Depth is metric only when planes do not scale with the model's extent.
    spec.stat.extent = 1.0
    visual.map.znear = 0.05
    visual.map.zfar = 100.0
    visual.global_.offwidth = LARGEST_PICTURE
    visual.global_.offheight = LARGEST_PICTURE
    visual.quality.offsamples = 0
    visual.quality.shadowsize = 0
    rig: Sequence[tuple[tuple[float, float, float], float]] = (
        ((0.12, 0.07, -1.0), 0.46),
        ((-0.10, 0.15, 1.0), 0.36),
        ((1.0, 0.35, -0.25), 0.34),
        ((-1.0, -0.30, -0.25), 0.24),
        ((0.30, -1.0, -0.25), 0.42),
        ((-0.35, 1.0, -0.25), 0.30),
    )
    for direction, strength in rig:
        size = math.sqrt(sum(each * each for each in direction))
        spec.worldbody.add_light(
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            dir=[each / size for each in direction],
            diffuse=[strength] * 3,
            ambient=[0, 0, 0],
            specular=[0, 0, 0],
            castshadow=False,
        )


def _add_sky(spec: mujoco.MjSpec) -> None:
    faces = sky_faces()
    edge = len(faces[0])
    texture = spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        width=edge,
        height=edge * len(FACES),
        nchannel=3,
    )
    texture.data = np.concatenate(faces).tobytes()
