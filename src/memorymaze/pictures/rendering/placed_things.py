"""Doors, landmarks and their shadows, as meshes at their places."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from shapely import Point, prepare

from memorymaze.pictures.kinds_of_looks import Looks
from memorymaze.pictures.looks import surfaces
from memorymaze.pictures.looks.assembly import MeshPart
from memorymaze.pictures.looks.catalogue import model_for_landmark
from memorymaze.pictures.looks.doors import model_for_door
from memorymaze.pictures.rendering.meshes import MeshBuilder, MeshKind
from memorymaze.sites.records import Site
from memorymaze.sites.scene_objects import SceneObject
from memorymaze.sites.solids import door_solid, landmark_solid

SHADOW_HEIGHT = 0.006
SHADOW_MARGIN = 0.16
LOW = 0.3
"""Metres over the floor up to which a thing throws a shadow on it."""


@dataclass(frozen=True, slots=True, eq=False)
class PlacedMeshes:
    """Meshes of one thing at one place."""

    parts: Sequence[MeshPart]
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class BuildingMesh:
    """A piece of a building, small enough to be left out of pictures unseen."""

    owner: str
    """Id of the feature of the plan that it is or belongs to; of a piece of a building's own
    mesh the name that it has there."""
    kind: MeshKind | Literal["door", "landmark"]
    placed: PlacedMeshes
    centre: tuple[float, float]
    """Of its circle on the plan, metres."""
    radius: float
    """Metres."""
    thing: SceneObject | None = None
    """What it is, of a door or a landmark."""
    shows_sky: bool = False
    """Whether one may see the sky through it or past it."""


def placed_things(site: Site, looks: Looks) -> Iterator[BuildingMesh]:
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
        yield BuildingMesh(door.id, "door", placed, (x, y), reach, thing)
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
        yield BuildingMesh(landmark.id, "landmark", placed, (x, y), radius, thing)


def shadows(site: Site) -> Iterator[BuildingMesh]:
    """Yield the shades on the floor, which what hangs high has none of."""
    for landmark in site.landmarks:
        solid = landmark_solid(landmark, site)
        x, y, z = solid.position
        hx, hy, hz = solid.half_size
        if landmark.mount == "floor" or z - hz <= LOW:
            placed = PlacedMeshes((shadow(hx, hy),), x, y, SHADOW_HEIGHT, solid.heading)
            radius = math.hypot(hx + SHADOW_MARGIN, hy + SHADOW_MARGIN)
            yield BuildingMesh(landmark.id, "decal", placed, (x, y), radius)


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
