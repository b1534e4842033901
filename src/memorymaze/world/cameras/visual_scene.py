"""What a building looks like, as a MuJoCo model of its own; made only for cameras."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.world.cameras.mujoco_model import SpecAssembler
from memorymaze.world.cameras.sky import FACES, sky_dome, sky_faces
from memorymaze.world.looks.building import (
    SHADOW_HEIGHT,
    SHADOW_MARGIN,
    building,
    shadow,
)
from memorymaze.world.looks.catalogue import check_looks, model_of
from memorymaze.world.looks.kinds_of_looks import OWN, Looks
from memorymaze.world.looks.meshes import Circle, PlacedMeshes
from memorymaze.world.looks.visibility import Sightlines
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.scene_objects import Movable, SceneObject

SHOWN_GROUP, HIDDEN_GROUP = 1, 5

LARGEST_PICTURE = 4096
"""Width and height up to which cameras may draw, pixels."""

FLOOR, CEILING, WALL = 0, 1, 2
_OWNERS = {"floor": FLOOR, "ceiling": CEILING, "wall": WALL, "beyond": WALL}

NOWHERE = (1e9, 1e9)
"""Where nothing is ever seen."""


@dataclass(frozen=True, eq=False)
class VisualScene:
    """A building for the eye; any number of cameras of one thread share it."""

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
    extent: tuple[float, float]
    """Heights between which everything is but the sky, metres."""
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
            for part, height in ((name, 0.0), (_shadow_of(name), SHADOW_HEIGHT)):
                body = self.model.body_mocapid[self.model.body(part).id]
                self.data.mocap_pos[body] = (pose.x, pose.y, height)
                self.data.mocap_quat[body] = about_z(pose.heading)
        if self.movable_geoms:
            mujoco.mj_kinematics(self.model, self.data)


def build_visual_scene(
    site: Site, movables: Sequence[Movable] = (), looks: Looks = OWN
) -> VisualScene:
    """Build what a site looks like. Takes a second or two; OpenGL is not needed.

    Args:
        site: A building that passed the checks of `memorymaze.world.sites`.
        movables: Things and people that `VisualScene.place` will place.
        looks: How things look: `own`, the path of a GLB file with models, or `mesh` for
            the building's own mesh, which stands beside its plan.
    """
    looks = check_looks(looks)
    spec = mujoco.MjSpec()
    spec.modelname = f"{site.name}_looks"
    add_lights(spec)
    _add_sky(spec)
    made = building(site, looks)
    things = [mesh.thing for mesh in made.meshes if mesh.thing is not None]
    numbers = count(WALL + 1)
    solid = [
        (mesh, _OWNERS[mesh.kind] if mesh.thing is None else next(numbers))
        for mesh in made.meshes
        if mesh.kind != "decal"
    ]
    builder = _Builder(SpecAssembler(spec))
    outlets: list[int] = []
    for transparent in (False, True):
        for mesh, owner in solid:
            first = builder.assembler.geom_count
            builder.add(mesh.placed, owner, mesh.circle, transparent=transparent)
            if mesh.shows_sky:
                outlets += range(first, builder.assembler.geom_count)
    movable_geoms = _add_movables(builder, movables, len(things) + WALL + 1, looks)
    first_decal = builder.assembler.geom_count
    # A body of their own, for the compiler sorts geoms by body, the ground's first.
    ground = spec.worldbody.add_body(name="decals")
    for mesh in made.meshes:
        if mesh.kind == "decal":
            builder.add(mesh.placed, FLOOR, mesh.circle, body=ground)
    for each, geoms in zip(movables, movable_geoms, strict=True):
        geoms.append(builder.assembler.geom_count)
        _add_shadow_of(builder, each)
    first_sky = builder.assembler.geom_count
    dome = spec.worldbody.add_body(name="sky")
    builder.add(PlacedMeshes(sky_dome()), FLOOR, (*NOWHERE, 0.0), body=dome)
    builder.assembler.finish()
    model = spec.compile()
    data = mujoco.MjData(model)
    circles = np.array(builder.circles).reshape(-1, 3)
    mujoco.mj_kinematics(model, data)
    scene = VisualScene(
        model,
        data,
        (
            SceneObject("floor", None),
            SceneObject("ceiling", None),
            SceneObject("wall", None),
            *things,
            *(SceneObject("person" if m.is_person else "thing", m) for m in movables),
        ),
        np.array(builder.owners, dtype=np.int32),
        circles[:, :2].copy(),
        circles[:, 2].copy(),
        first_decal,
        first_sky,
        _extent(model, data, first_sky),
        np.array(outlets, dtype=np.intp),
        Sightlines(made.hiding),
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
        self.circles: list[Circle] = []

    def add(
        self,
        placed: PlacedMeshes,
        owner: int,
        circle: Circle,
        *,
        body: mujoco.MjsBody | None = None,
        transparent: bool | None = None,
    ) -> None:
        count = self.assembler.add(
            placed, SHOWN_GROUP, body=body, transparent=transparent
        )
        self.owners += [owner] * count
        self.circles += [circle] * count


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
            PlacedMeshes(model.parts),
            first_owner + number,
            (*NOWHERE, math.hypot(each.size[0], each.size[1]) / 2),
            body=body,
        )
        geoms.append(list(range(before, builder.assembler.geom_count)))
    return geoms


def _add_shadow_of(builder: _Builder, movable: Movable) -> None:
    half_x, half_y = movable.size[1] / 2, movable.size[0] / 2
    name = _shadow_of(movable.id)
    body = builder.assembler.spec.worldbody.add_body(name=name, mocap=True)
    radius = math.hypot(half_x, half_y) + SHADOW_MARGIN
    placed = PlacedMeshes((shadow(half_x, half_y),))
    builder.add(placed, FLOOR, (*NOWHERE, radius), body=body)


def _shadow_of(name: str) -> str:
    return f"{name}/shadow"


def _extent(
    model: mujoco.MjModel, data: mujoco.MjData, first_sky: int
) -> tuple[float, float]:
    boxes, turned = model.geom_aabb[:first_sky], data.geom_xmat[:first_sky, 6:]
    middles = data.geom_xpos[:first_sky, 2] + (boxes[:, :3] * turned).sum(axis=1)
    halves = (boxes[:, 3:] * np.abs(turned)).sum(axis=1)
    return float((middles - halves).min()), float((middles + halves).max())


def add_lights(spec: mujoco.MjSpec) -> None:
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
