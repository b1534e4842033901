"""Doors, rooms and things of a mesh, by what its nodes say or are called."""

import math
import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace

from shapely import LineString, MultiPoint, Point, Polygon

from memorymaze.importing.imported import ImportNotes
from memorymaze.importing.obstacles import box_around
from memorymaze.importing.shapes import moved
from memorymaze.pictures.building_mesh import MeshPiece
from memorymaze.sites.floor_rules import DOOR_OFF_WALL, ROOM_ON_FLOOR, THING_OFF_FLOOR
from memorymaze.sites.loading import part_of
from memorymaze.sites.records import Door, Landmark, PlanPart, Room
from memorymaze.wording import counted

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
SEEN_ONLY = frozenset({"beyond", "shade", "ceiling"})
"""Kinds of pieces of our export that are neither walked on nor in the way."""
THING_ACROSS = 3.0
"""Metres; what is longer is no thing, whatever it is called."""
STANDS = 0.3
"""Metres above the floor at which a thing that stands on it begins at most."""
DOOR_NEAR_WALL = 0.5
"""Metres from a door to the edge of the floor."""
NULLS: Mapping[str, Mapping[str, None]] = {
    "room": {},
    "door": {"room": None, "label": None},
    "landmark": {"color": None, "name": None, "text": None},
}
"""Kinds of features, and the members that our export leaves out where they are null."""


def by_kind(pieces: Sequence[MeshPiece]) -> Mapping[str, list[MeshPiece]]:
    """Return pieces as `door`, `landmark`, `room`, `seen_only` or `building`."""
    found: defaultdict[str, list[MeshPiece]] = defaultdict(list)
    for piece in pieces:
        found[_kind_of(piece)].append(piece)
    return found


def _kind_of(piece: MeshPiece) -> str:
    kind = piece.extras.get("kind")
    if kind in NULLS and "geometry" in piece.extras:
        return str(kind)
    if kind in SEEN_ONLY or not len(piece.faces):
        return "seen_only"
    words = _words(piece.name)
    if kind is None and {"door", "doors"} & set(words):
        return "door"
    if kind is not None or BUILDING & set(words) or not set(words) - WORDLESS:
        return "building"
    return "landmark" if _box(piece)[1] <= THING_ACROSS else "building"


def _words(name: str) -> list[str]:
    spaced = re.sub("(?<=[a-z])(?=[A-Z])", " ", name)
    return [word.lower() for word in re.findall("[A-Za-z]{2,}", spaced)]


def _box(piece: MeshPiece) -> tuple[tuple[float, float], float, float, float]:
    return box_around(MultiPoint(piece.vertices[:, :2]))


def door_line(piece: MeshPiece) -> LineString:
    """Return the line on the plan in which a door stands."""
    if "geometry" in piece.extras:
        return LineString(piece.extras["geometry"]["coordinates"])
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
    """Return rooms, doors and things; those left out are told."""
    found: dict[str, PlanPart] = {}
    rooms: set[str] = set()
    for kind, noun, why in (
        ("room", "room", "that lie on the floor"),
        ("door", "door", "at no edge of the floor"),
        ("landmark", "thing", "that do not stand on the floor"),
    ):
        before = len(found)
        # A node with several materials has several meshes.
        named = {piece.name: piece for piece in pieces.get(kind, ())}
        for piece in named.values():
            made = _part(kind, piece, floor, height, rooms)
            if made is None:
                notes.miss(f"{noun}s {why}", piece.name)
                continue
            found[made.id] = made
        if kind == "room":
            rooms |= found.keys()
        if len(found) > before:
            notes.took.append(f"{counted(len(found) - before, noun)} by name")
    return list(found.values())


def _part(
    kind: str, piece: MeshPiece, floor: Polygon, height: float, rooms: set[str]
) -> PlanPart | None:
    """Return what a piece is on the plan, if it fits on the floor."""
    told = _told(kind, piece)
    if isinstance(told, Room):
        beside = told.polygon.intersection(floor).area <= ROOM_ON_FLOOR
        return told if beside else None
    if kind == "door":
        line = _onto_wall(door_line(piece), floor)
        if line is None:
            return None
        identity = _identity(piece.name)
        if not isinstance(told, Door):
            return Door(identity, line, None, "wood", "brown", None, "closed")
        room = told.room if told.room in rooms else None
        return replace(told, id=identity, line=line, room=room)
    if isinstance(told, Landmark):
        stands = floor.distance(told.position) <= THING_OFF_FLOOR
        return told if told.mount != "floor" or stands else None
    if kind == "landmark":
        return _unwritten_thing(piece, floor, height)
    return None


def _unwritten_thing(
    piece: MeshPiece, floor: Polygon, height: float
) -> Landmark | None:
    low, high = piece.vertices[:, 2].min(), piece.vertices[:, 2].max()
    middle, length, depth, heading = _box(piece)
    if floor.distance(Point(middle)) > THING_OFF_FLOOR:
        return None
    if not low - height <= STANDS < high - height:
        return None
    words = [word for word in _words(piece.name) if word not in WORDLESS]
    return Landmark(
        _identity(piece.name),
        Point(middle),
        category=" ".join(words),
        color=None,
        name=None,
        text=None,
        heading=heading + math.pi / 2,
        size=(round(length, 2), round(depth, 2), round(float(high - low), 2)),
        mount="floor",
        obstacle=True,
    )


def _told(kind: str, piece: MeshPiece) -> PlanPart | None:
    """Return what our export wrote of a feature, if it did."""
    extras = piece.extras
    if "geometry" not in extras:
        return None
    members = {k: v for k, v in extras.items() if k not in ("id", "geometry")}
    return part_of({
        "type": "Feature",
        "id": piece.name,
        "geometry": extras["geometry"],
        "properties": {**NULLS[kind], **members},
    })


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


def _identity(name: str) -> str:
    return re.sub("[^a-z0-9]+", "_", name.lower()).strip("_") or "unnamed"
