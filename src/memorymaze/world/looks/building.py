"""A building as the meshes that cameras draw and every export is made from."""

import math
from collections.abc import Iterator

import numpy as np
from shapely import Point, prepare

from memorymaze.world.looks import surfaces
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.catalogue import model_for_landmark
from memorymaze.world.looks.doors import model_for_door
from memorymaze.world.looks.kinds_of_looks import Looks
from memorymaze.world.looks.mesh_looks import mesh_building
from memorymaze.world.looks.meshes import (
    Building,
    BuildingMesh,
    MeshBuilder,
    PlacedMeshes,
)
from memorymaze.world.looks.structure import structure_of
from memorymaze.world.sites.checking import check_drawn
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.scene_objects import SceneObject
from memorymaze.world.sites.solids import door_solid, landmark_solid

SHADOW_HEIGHT = 0.006
SHADOW_MARGIN = 0.16
LOW = 0.3
"""Metres over the floor up to which a thing throws a shadow on it."""


def building(site: Site, looks: Looks) -> Building:
    """Build the meshes of a site that passed the checks of `memorymaze.world.sites`.

    Raises:
        SitePlanError: A floor, a wall or a door has a word that has no look.
    """
    if looks == "mesh":
        # What a mesh hides is not known beforehand.
        return Building(mesh_building(site), np.empty((0, 4)))
    check_drawn(site)
    around, hiding = structure_of(site)
    return Building([*around, *_things(site, looks), *_shades(site)], hiding)


def _things(site: Site, looks: Looks) -> Iterator[BuildingMesh]:
    """Yield all doors, then all landmarks, as the plan orders them."""
    floor = site.walkable_floor
    prepare(floor)
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
        thing = SceneObject("door", door)
        yield BuildingMesh(door.id, "door", placed, (x, y, reach), thing)
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
        thing = SceneObject("landmark", landmark)
        yield BuildingMesh(landmark.id, "landmark", placed, (x, y, radius), thing)


def _shades(site: Site) -> Iterator[BuildingMesh]:
    """Yield the shades on the floor, which what hangs high has none of."""
    for landmark in site.landmarks:
        solid = landmark_solid(landmark, site)
        x, y, z = solid.position
        hx, hy, hz = solid.half_size
        if landmark.mount == "floor" or z - hz <= LOW:
            placed = PlacedMeshes((shadow(hx, hy),), x, y, SHADOW_HEIGHT, solid.heading)
            radius = math.hypot(hx + SHADOW_MARGIN, hy + SHADOW_MARGIN)
            yield BuildingMesh(landmark.id, "decal", placed, (x, y, radius))


def shadow(half_x: float, half_y: float) -> MeshPart:
    """Return the shade of a thing with these half sizes, metres, around the origin."""
    half_x, half_y = half_x + SHADOW_MARGIN, half_y + SHADOW_MARGIN
    mesh = MeshBuilder()
    mesh.quad([
        (-half_x, -half_y, 0.0),
        (half_x, -half_y, 0.0),
        (half_x, half_y, 0.0),
        (-half_x, half_y, 0.0),
    ])
    return mesh.part(surfaces.blob_shadow())
