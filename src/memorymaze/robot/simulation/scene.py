"""A physics model of a building, made from its site plan; nothing moves in here.

Geom groups: 0 floor and ceiling, 1 walls, 2 doors, 3 landmarks, 4 things and people
whose places an episode sets, 5 the robot. Only walls and obstacles touch the robot; everything is seen by rays. No OpenGL is needed.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.robot.simulation.motion.clearance import Clearance
from memorymaze.robot.simulation.motion.kinematic_base import Touchables
from memorymaze.robot.simulation.motion.straight_ways import StraightWays
from memorymaze.robot.simulation.motion.wheeled_base import (
    FLOOR_CONTACT,
    ROBOT_GROUP,
    SOLID_CONTACT,
    add_wheeled_base,
)
from memorymaze.robot.simulation.obstacles.movables import people, things
from memorymaze.robot.simulation.obstacles.placing import stretches
from memorymaze.robot.simulation.obstacles.settings import ObstacleSettings
from memorymaze.robot.simulation.obstacles.walking import Walks
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.scene_objects import Movable, SceneObject
from memorymaze.world.sites.solids import (
    Solid,
    door_solid,
    landmark_solid,
    wall_solids,
    walls_around,
)

FLOOR_GROUP, WALL_GROUP, DOOR_GROUP, LANDMARK_GROUP = 0, 1, 2, 3
MOVABLE_GROUP = 4
"""Geom group of things and people."""
PARKED = -30.0
"""Height in metres at which those wait that an episode has no place for."""


@dataclass(frozen=True, eq=False)
class Scene:
    """A building as a compiled model, shared by any number of episodes."""

    site: Site
    model: mujoco.MjModel
    """Compiled; never changed after."""
    tangible: mujoco.MjModel
    """The model without what nothing touches: it moves the robot alike, but faster."""
    tangible_geoms: tuple[int, ...]
    """Geom ids in `model` of the geoms of `tangible`."""
    open_floor: mujoco.MjModel | None
    """The model of floor and robot alone: it moves one that is far from all else alike.
    None where things and people may come near."""
    objects: tuple[SceneObject, ...]
    """What each geom is, by geom id."""
    obstacles: ObstacleSettings | None = None
    """What the building is filled with beyond its plan; None for nothing."""

    @cached_property
    def geom_ids(self) -> Mapping[str, int]:
        """Geom id of each door, landmark, thing and person by its id."""
        return {
            each.record.id: number
            for number, each in enumerate(self.objects)
            if each.record is not None
        }

    @cached_property
    def movables(self) -> tuple[Movable, ...]:
        """Things and people that an episode may place."""
        return tuple(
            each.record for each in self.objects if isinstance(each.record, Movable)
        )

    @cached_property
    def mocap_ids(self) -> Mapping[str, int]:
        """Row of each thing and person in the physics' mocap arrays, by its id."""
        bodies = self.model.body_mocapid
        return {
            each.id: int(bodies[self.model.geom_bodyid[self.geom_ids[each.id]]])
            for each in self.movables
        }

    @cached_property
    def walks(self) -> Walks:
        """Ways on which people walk."""
        return Walks(self.site)

    @cached_property
    def clearance(self) -> Clearance:
        """Distances to walls and obstacles."""
        obstacles = [thing.footprint for thing in self.site.landmarks if thing.obstacle]
        return Clearance(self.site.walkable_floor, obstacles)

    @cached_property
    def touchables(self) -> Touchables:
        """What a robot without physics may touch."""
        walls = [geom for geom, it in enumerate(self.objects) if it.kind == "wall"]
        lines = [each.face for each in walls_around(self.site.walkable_floor)]
        return Touchables(
            zip(walls, lines, strict=True),
            (
                (self.geom_ids[each.id], each.footprint)
                for each in self.site.landmarks
                if each.obstacle
            ),
        )

    @cached_property
    def straight_ways(self) -> StraightWays:
        """Where a robot gets to that always drives straight on."""
        return StraightWays(self.site, self.clearance)


class _Same:
    """A site as a key: of equal ones from two files, each may have a mesh of its own."""

    def __init__(self, site: Site) -> None:
        self.site = site

    def __hash__(self) -> int:
        return id(self.site)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.site is self.site


def build_scene(site: Site, obstacles: ObstacleSettings | None = None) -> Scene:
    """Return the physics model of a site, with one robot in it; the last few are kept.

    Walls stand on the boundary of the walkable floor, up to the ceiling; round a hole
    over which something hangs from the ceiling (a globe in an atrium) only a
    balustrade stands. How high things hang is told in `sites.solids`.

    Args:
        site: A building that passed the checks of `memorymaze.world.sites`.
        obstacles: Things and people to have at hand; each episode places them anew.
    """
    return _built(_Same(site), obstacles)


@lru_cache(maxsize=4)
def _built(same: _Same, obstacles: ObstacleSettings | None) -> Scene:
    site = same.site
    spec = mujoco.MjSpec()
    spec.modelname = site.name
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.visual.map.znear = 0.02
    spec.visual.map.zfar = 200.0
    spec.stat.extent = 1.0
    world = spec.worldbody
    objects: list[SceneObject] = []

    for height, quat, contact in (
        (0.0, [1, 0, 0, 0], FLOOR_CONTACT),
        (site.ceiling_height, [0, 1, 0, 0], 0),
    ):
        world.add_geom(
            type=mujoco.mjtGeom.mjGEOM_PLANE,
            size=[0, 0, 1],
            pos=[0, 0, height],
            quat=quat,
            group=FLOOR_GROUP,
            contype=contact,
            conaffinity=0,
        )
    objects += [SceneObject("floor", None), SceneObject("ceiling", None)]

    for solid in wall_solids(site):
        _add_box(world, solid, WALL_GROUP, touches=True)
        objects.append(SceneObject("wall", None))

    for door in site.doors:
        solid = door_solid(door, site)
        _add_box(world, solid, DOOR_GROUP, touches=False)
        objects.append(SceneObject("door", door))
    for landmark in site.landmarks:
        solid = landmark_solid(landmark, site)
        _add_box(world, solid, LANDMARK_GROUP, touches=landmark.obstacle)
        objects.append(SceneObject("landmark", landmark))

    movables = [] if obstacles is None else _movables(site, obstacles)
    add_movables(spec, movables)
    objects += [
        SceneObject("person" if each.is_person else "thing", each) for each in movables
    ]

    add_wheeled_base(spec)
    model = spec.compile()
    robot = SceneObject("robot", None)
    objects.extend([robot] * (model.ngeom - len(objects)))
    if any(
        (model.geom_group[i] == ROBOT_GROUP) != (each.kind == "robot")
        for i, each in enumerate(objects)
    ):
        raise RuntimeError("the physics engine reordered the scene's geoms")
    tangible, ids, open_floor = model, tuple(range(model.ngeom)), None
    if not movables:
        tangible, ids = _tangible(spec, model)
        open_floor = _open_floor(spec)
    return Scene(site, model, tangible, ids, open_floor, tuple(objects), obstacles)


def _tangible(
    # Any: the stubs know neither the lists of the one nor all arrays of the other.
    spec: Any,
    model: Any,
) -> tuple[mujoco.MjModel, tuple[int, ...]]:
    """Leave out of a compiled spec what nothing touches; say which geoms stay."""
    touched = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    stays = touched | (model.geom_bodyid != 0)
    for number, geom in enumerate(list(spec.worldbody.geoms)):
        if not stays[number]:
            spec.delete(geom)
    tangible = spec.compile()
    # What stands still is then not placed anew at each step; robots never sleep.
    tangible.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP
    return tangible, tuple(np.flatnonzero(stays).tolist())


# Any: the stubs do not know the lists.
def _open_floor(spec: Any) -> mujoco.MjModel:
    """Leave everything out of a spec but the floor and the robot."""
    for geom in list(spec.worldbody.geoms)[1:]:
        spec.delete(geom)
    model = spec.compile()
    # The robot's contacts are one island, and its parts are few: neither is looked for.
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_MIDPHASE
    return model


def _movables(site: Site, obstacles: ObstacleSettings) -> list[Movable]:
    length = sum(each.line.length for each in stretches(site))
    return [
        *things(obstacles.things_on(length), obstacles.kinds),
        *people(obstacles.people_on(site.walkable_floor.area)),
    ]


def _add_box(body: mujoco.MjsBody, solid: Solid, group: int, *, touches: bool) -> None:
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=list(solid.half_size),
        pos=list(solid.position),
        quat=about_z(solid.heading),
        group=group,
        contype=SOLID_CONTACT if touches else 0,
        conaffinity=0,
    )


def add_movables(spec: mujoco.MjSpec, movables: Sequence[Movable]) -> None:
    """Add a body per movable, driven from outside, with one geom; of its name.

    A thing is a box, a person an upright cylinder. Both touch the robot.
    """
    kinds = mujoco.mjtGeom
    for number, each in enumerate(movables):
        length, depth, height = each.size
        body = spec.worldbody.add_body(
            name=each.id, mocap=True, pos=[3.0 * number, 0, PARKED]
        )
        body.add_geom(
            type=kinds.mjGEOM_CYLINDER if each.is_person else kinds.mjGEOM_BOX,
            size=[each.radius, height / 2, 0]
            if each.is_person
            else [depth / 2, length / 2, height / 2],
            group=MOVABLE_GROUP,
            contype=SOLID_CONTACT,
            conaffinity=0,
        )
