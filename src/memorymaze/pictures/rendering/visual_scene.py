"""What a building looks like, as a MuJoCo model of its own; made only for cameras."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray
from shapely import Point, prepare

from memorymaze.geometry.pose import Pose
from memorymaze.pictures.furniture.models import Looks, check_looks
from memorymaze.pictures.looks import surfaces
from memorymaze.pictures.looks.assembly import MeshPart
from memorymaze.pictures.looks.catalogue import model_for_landmark, model_of
from memorymaze.pictures.looks.doors import model_for_door
from memorymaze.pictures.rendering.meshes import MeshBuilder
from memorymaze.pictures.rendering.mujoco_model import (
    OPAQUE_FROM,
    PlacedMeshes,
    SpecAssembler,
)
from memorymaze.pictures.rendering.sky import FACES, sky_dome, sky_faces
from memorymaze.pictures.rendering.structure import Structure, structure_of
from memorymaze.pictures.rendering.visibility import Sightlines
from memorymaze.simulation.obstacles.settings import Movable
from memorymaze.simulation.scene import SceneObject
from memorymaze.simulation.solids import door_solid, landmark_solid
from memorymaze.sites.records import Site

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
NOWHERE = (1e9, 1e9)
"""Where nothing is ever seen."""


@dataclass(frozen=True, eq=False)
class VisualScene:
    """A building for the eye; any number of cameras of one thread share it."""

    site: Site
    looks: Looks
    """How things look."""
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
    first_sky: int
    """From this geom on, geoms are the sky; they come last."""
    outlet_geoms: NDArray[np.intp]
    """Geoms through or beside which one may see the sky."""
    sightlines: Sightlines
    """The walls that hide things."""
    sky_places: NDArray[np.float64]
    """Where the sky's geoms are around a camera at the origin, (n, 3) metres."""
    movable_geoms: Mapping[str, NDArray[np.intp]]
    """Geoms of each thing or person that an episode places, and of its shadow."""

    def put_sky_around(self, x: float, y: float, z: float) -> None:
        """Let the sky's dome go along with a camera; metres."""
        self.data.geom_xpos[self.first_sky :] = self.sky_places + np.array([x, y, z])

    def place(self, places: Mapping[str, Pose]) -> None:
        """Put things and people where they are now, for the pictures that follow.

        Those not named by their ids are nowhere.
        """
        for name, geoms in self.movable_geoms.items():
            if name not in places:
                self.centres[geoms] = NOWHERE
        for name, pose in places.items():
            self.centres[self.movable_geoms[name]] = (pose.x, pose.y)
            half = pose.heading / 2
            for part, height in ((name, 0.0), (_shadow_of(name), SHADOW_HEIGHT)):
                body = self.model.body_mocapid[self.model.body(part).id]
                self.data.mocap_pos[body] = (pose.x, pose.y, height)
                self.data.mocap_quat[body] = (math.cos(half), 0, 0, math.sin(half))
        if self.movable_geoms:
            mujoco.mj_kinematics(self.model, self.data)


def build_visual_scene(
    site: Site, movables: Sequence[Movable] = (), looks: Looks | None = None
) -> VisualScene:
    """Build what a site looks like. Takes a second or two; OpenGL is not needed.

    Args:
        site: A building that passed the checks of `memorymaze.sites`.
        movables: Things and people that `VisualScene.place` will place.
        looks: How things look; None for models where they were converted.
    """
    looks = check_looks(looks)
    spec = mujoco.MjSpec()
    spec.modelname = f"{site.name}_looks"
    _add_light(spec)
    _add_sky(spec)
    structure = structure_of(site)
    things = _things(site, looks)
    builder = _Builder(SpecAssembler(spec))
    outlets: list[int] = []
    for transparent in (False, True):
        for made in structure.slices:
            centre, radius = _circle(made.points)
            for kind, part in made.meshes():
                if kind != "decal":
                    # One geom stands for its slice; without any it adds none.
                    if made.shows_sky and bool(transparent) == _is_clear(part):
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
    movable_geoms = _add_movables(builder, movables, len(things) + WALL + 1, looks)
    first_decal = builder.assembler.geom_count
    _add_decals(builder, structure, site)
    for each, geoms in zip(movables, movable_geoms, strict=True):
        geoms.append(builder.assembler.geom_count)
        _add_shadow_of(builder, each)
    first_sky = builder.assembler.geom_count
    dome = spec.worldbody.add_body(name="sky")
    builder.add(PlacedMeshes(sky_dome(), body=dome), FLOOR, NOWHERE, 0.0)
    builder.assembler.finish()
    model = spec.compile()
    data = mujoco.MjData(model)
    scene = VisualScene(
        site,
        looks,
        model,
        data,
        (
            SceneObject("floor", None),
            SceneObject("ceiling", None),
            SceneObject("wall", None),
            *(thing for thing, _, _, _ in things),
            *(SceneObject("person" if m.is_person else "thing", m) for m in movables),
        ),
        np.array(builder.owners, dtype=np.int32),
        np.array(builder.centres).reshape(-1, 2),
        np.array(builder.radii),
        first_decal,
        first_sky,
        np.array(outlets, dtype=np.intp),
        Sightlines(structure.hiding),
        np.zeros((model.ngeom - first_sky, 3)),
        {
            each.id: np.array(geoms, dtype=np.intp)
            for each, geoms in zip(movables, movable_geoms, strict=True)
        },
    )
    scene.place({})
    mujoco.mj_kinematics(model, data)
    scene.sky_places[:] = data.geom_xpos[first_sky:]
    return scene


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


def _things(site: Site, looks: Looks) -> list[_Thing]:
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
        placed = PlacedMeshes(
            model_for_landmark(landmark, looks).parts,
            x,
            y,
            z - solid.half_size[2],
            solid.heading,
        )
        radius = math.hypot(solid.half_size[0], solid.half_size[1])
        things.append((SceneObject("landmark", landmark), placed, (x, y), radius))
    return things


def _add_movables(
    builder: _Builder, movables: Sequence[Movable], first_owner: int, looks: Looks
) -> list[list[int]]:
    """Add a body for each, and return the geoms of each."""
    world = builder.assembler.spec.worldbody
    geoms: list[list[int]] = []
    for number, each in enumerate(movables):
        model = model_of(
            each.category,
            each.size,
            colour_words=each.color,
            text=each.text,
            variant=number,
            looks=looks,
        )
        body = world.add_body(name=each.id, mocap=True)
        before = builder.assembler.geom_count
        builder.add(
            PlacedMeshes(model.parts, body=body),
            first_owner + number,
            NOWHERE,
            math.hypot(each.size[0], each.size[1]) / 2,
        )
        geoms.append(list(range(before, builder.assembler.geom_count)))
    return geoms


def _add_shadow_of(builder: _Builder, movable: Movable) -> None:
    half_x, half_y = movable.size[1] / 2, movable.size[0] / 2
    part = _shadow(half_x + SHADOW_MARGIN, half_y + SHADOW_MARGIN)
    name = _shadow_of(movable.id)
    body = builder.assembler.spec.worldbody.add_body(name=name, mocap=True)
    radius = math.hypot(half_x, half_y) + SHADOW_MARGIN
    builder.add(PlacedMeshes((part,), body=body), FLOOR, NOWHERE, radius)


def _shadow_of(name: str) -> str:
    return f"{name}/shadow"


def _add_decals(builder: _Builder, structure: Structure, site: Site) -> None:
    # A body of their own, for the compiler sorts geoms by body, the ground's first.
    ground = builder.assembler.spec.worldbody.add_body(name="decals")
    for made in structure.slices:
        centre, radius = _circle(made.points)
        for kind, part in made.meshes():
            if kind == "decal":
                builder.add(PlacedMeshes((part,), body=ground), FLOOR, centre, radius)
    for landmark in site.landmarks:
        solid = landmark_solid(landmark, site)
        x, y, z = solid.position
        hx, hy, hz = solid.half_size
        if landmark.mount != "floor" and z - hz > 0.3:
            continue
        part = _shadow(hx + SHADOW_MARGIN, hy + SHADOW_MARGIN)
        radius = math.hypot(hx + SHADOW_MARGIN, hy + SHADOW_MARGIN)
        placed = PlacedMeshes((part,), x, y, SHADOW_HEIGHT, solid.heading, ground)
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


def _is_clear(part: MeshPart) -> bool:
    return part.material.rgba[3] < OPAQUE_FROM


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
