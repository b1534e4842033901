"""Doors and things of a mesh, by what its nodes are called."""

import math
import re
from collections import defaultdict
from collections.abc import Container, Mapping, Sequence
from itertools import count

import numpy as np
from shapely import LineString, MultiPoint, Point, Polygon

from memorymaze.basics.geometry.pose import moved
from memorymaze.basics.wording import counted
from memorymaze.world.importing.imported import ImportNotes
from memorymaze.world.importing.mesh_floor import STEP
from memorymaze.world.importing.obstacles import box_around
from memorymaze.world.looks.building_mesh import MeshPiece
from memorymaze.world.sites.floor_rules import DOOR_OFF_WALL, THING_OFF_FLOOR
from memorymaze.world.sites.records import Door, Landmark, PlanPart

BUILDING = frozenset([
    "wall",
    "walls",
    "floor",
    "floors",
    "ceiling",
    "ceilings",
    "roof",
    "slab",
    "ground",
    "window",
    "windows",
    "glass",
    "stairs",
    "stair",
    "column",
    "pillar",
    "beam",
    "building",
    "level",
    "storey",
    "room",
    "rooms",
    "site",
    "skirting",
    "frame",
    "corridor",
])
"""Words in names of what is the building itself."""
WORDLESS = frozenset([
    "mesh",
    "object",
    "node",
    "cube",
    "plane",
    "group",
    "geometry",
    "material",
    "obj",
    "default",
    "polygon",
    "shape",
    "box",
    "cylinder",
    "scene",
    "model",
    "layer",
    "untitled",
    "root",
    "world",
    "instance",
    "static",
])
"""Words in names that programs give."""
ENDINGS = ("/wall", "/ceiling", "/beyond", "/shade")
"""How names end of what exports make around the floor of a place."""
THING_ACROSS = 3.0
"""Metres; what is longer is no thing, whatever it is called."""
STANDS = 0.3
"""Metres above the floor at which a thing that stands on it begins at most."""
DOOR_NEAR_WALL = 0.5
"""Metres from a door to the edge of the floor."""


def by_kind(pieces: Sequence[MeshPiece]) -> Mapping[str, list[MeshPiece]]:
    """Return pieces as `door`, `landmark` or `building`, those of one name in one."""
    named: defaultdict[str, list[MeshPiece]] = defaultdict(list)
    for piece in pieces:
        named[piece.name].append(piece)
    found: defaultdict[str, list[MeshPiece]] = defaultdict(list)
    for piece in map(_joined, named.values()):
        found[_kind_of(piece)].append(piece)
    return found


def _joined(parts: Sequence[MeshPiece]) -> MeshPiece:
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return MeshPiece(
        parts[0].name,
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([
            part.faces + start for part, start in zip(parts, starts, strict=False)
        ]),
    )


def _kind_of(piece: MeshPiece) -> str:
    if np.ptp(piece.vertices[:, 2]) < STEP or piece.name.endswith(ENDINGS):
        return "building"
    words = set(_words(piece.name))
    if {"door", "doors"} & words:
        return "door"
    if BUILDING & words or not words - WORDLESS:
        return "building"
    return "landmark" if _box(piece)[1] <= THING_ACROSS else "building"


def _words(name: str) -> list[str]:
    spaced = re.sub("(?<=[a-z])(?=[A-Z])", " ", name)
    return [word.lower() for word in re.findall("[A-Za-z]{2,}", spaced)]


def _box(piece: MeshPiece) -> tuple[tuple[float, float], float, float, float]:
    return box_around(MultiPoint(piece.vertices[:, :2]))


def door_line(piece: MeshPiece) -> LineString:
    """Return the line on the plan in which a door stands."""
    middle, width, _, heading = _box(piece)
    return LineString([
        moved(middle, heading, -width / 2),
        moved(middle, heading, width / 2),
    ])


def parts_on(
    floor: Polygon,
    height: float,
    pieces: Mapping[str, Sequence[MeshPiece]],
    notes: ImportNotes,
) -> list[PlanPart]:
    """Return doors and things; those left out are told."""
    found: dict[str, PlanPart] = {}
    for kind, noun, why in (
        ("door", "door", "at no edge of the floor"),
        ("landmark", "thing", "that do not stand on the floor"),
    ):
        before = len(found)
        for piece in pieces.get(kind, ()):
            identity = _identity(piece.name, found)
            made = (
                _door(piece, floor, identity)
                if kind == "door"
                else _thing(piece, floor, height, identity)
            )
            if made is None:
                notes.miss(f"{noun}s {why}", piece.name)
                continue
            found[identity] = made
        if len(found) > before:
            notes.took.append(f"{counted(len(found) - before, noun)} by name")
    return list(found.values())


def _door(piece: MeshPiece, floor: Polygon, identity: str) -> Door | None:
    line = _onto_wall(door_line(piece), floor)
    if line is None:
        return None
    return Door(identity, line, None, "wood", "brown", None, "closed")


def _thing(
    piece: MeshPiece, floor: Polygon, height: float, identity: str
) -> Landmark | None:
    low, high = piece.vertices[:, 2].min(), piece.vertices[:, 2].max()
    middle, length, depth, heading = _box(piece)
    if not low - height <= STANDS < high - height or not _stands(piece, floor):
        return None
    return Landmark(
        identity,
        Point(middle),
        category=" ".join(word for word in _words(piece.name) if word not in WORDLESS),
        color=None,
        name=None,
        text=None,
        heading=heading + math.pi / 2,
        size=(round(length, 2), round(depth, 2), round(float(high - low), 2)),
        mount="floor",
        obstacle=True,
    )


def _stands(piece: MeshPiece, floor: Polygon) -> bool:
    place = MultiPoint(piece.vertices[:, :2]).minimum_rotated_rectangle.centroid
    return floor.distance(place) <= THING_OFF_FLOOR


def _onto_wall(line: LineString, floor: Polygon) -> LineString | None:
    """Return a door on the edge of the floor, moved there if it is near."""
    edge = floor.boundary
    band = edge.buffer(DOOR_OFF_WALL * 0.9)
    if band.covers(line):
        return line
    if edge.distance(line.centroid) > DOOR_NEAR_WALL:
        return None
    ends = [edge.interpolate(edge.project(end)) for end in line.boundary.geoms]
    drawn = LineString(ends)
    return drawn if drawn.length > line.length / 2 and band.covers(drawn) else None


def _identity(name: str, taken: Container[str]) -> str:
    """Return a name as an id, with a number where another has that."""
    stem = re.sub("[^a-z0-9]+", "_", name.lower()).strip("_") or "unnamed"
    if stem not in taken:
        return stem
    return next(f"{stem}_{n}" for n in count(2) if f"{stem}_{n}" not in taken)
