"""Doors, rooms and things of a mesh, by what its nodes say or are called."""

import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from shapely import LineString, MultiPoint, Polygon
from shapely.geometry import shape

from memorymaze.importing.imported import ImportNotes
from memorymaze.importing.obstacles import box_around
from memorymaze.importing.shapes import moved
from memorymaze.pictures.building_mesh import MeshPiece
from memorymaze.sites.floor_rules import DOOR_OFF_WALL, ROOM_ON_FLOOR, THING_OFF_FLOOR
from memorymaze.sites.plan_writing import Feature, degrees, line_feature, point_feature
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


def features_on(
    floor: Polygon,
    height: float,
    pieces: Mapping[str, Sequence[MeshPiece]],
    notes: ImportNotes,
) -> list[Feature]:
    """Return rooms, doors and things as features; those left out are told."""
    found: dict[str, Feature] = {}
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
            made = next(_features_of(kind, piece, floor, height, rooms), None)
            if made is None:
                notes.miss(f"{noun}s {why}", piece.name)
                continue
            found[str(made["id"])] = made
        if kind == "room":
            rooms |= found.keys()
        if len(found) > before:
            notes.took.append(f"{counted(len(found) - before, noun)} by name")
    return list(found.values())


def _features_of(
    kind: str, piece: MeshPiece, floor: Polygon, height: float, rooms: set[str]
) -> Iterator[Feature]:
    """Yield the feature of a piece, if it fits on the floor."""
    told = _told(kind, piece.extras) if "geometry" in piece.extras else None
    whole: Feature = {
        "type": "Feature",
        "id": piece.name,
        "geometry": piece.extras.get("geometry"),
        "properties": told,
    }
    if kind == "room":
        covered = shape(piece.extras["geometry"]).intersection(floor).area
        if covered <= ROOM_ON_FLOOR:
            yield whole
    elif kind == "door":
        line = _onto_wall(door_line(piece), floor)
        if line is None:
            return
        ends = [(x, y) for x, y in line.coords]
        more: dict[str, Any] = {
            "room": None, "style": "wood", "color": "brown", "label": None, "state": "closed",
        }  # fmt: skip
        if told:
            more = {k: v for k, v in told.items() if k != "kind"}
            more["room"] = more["room"] if more["room"] in rooms else None
        yield line_feature(_identity(piece.name), "door", ends, **more)
    elif told:
        if told["mount"] != "floor" or _stands(piece, floor):
            yield whole
    else:
        low, high = piece.vertices[:, 2].min(), piece.vertices[:, 2].max()
        middle, length, depth, heading = _box(piece)
        if low - height <= STANDS < high - height and _stands(piece, floor):
            yield point_feature(
                _identity(piece.name),
                "landmark",
                middle,
                category=" ".join(
                    word for word in _words(piece.name) if word not in WORDLESS
                ),
                color=None,
                name=None,
                text=None,
                heading_deg=degrees(heading + math.pi / 2),
                size_m=[round(length, 2), round(depth, 2), round(high - low, 2)],
                mount="floor",
                obstacle=True,
            )


def _told(kind: str, extras: Mapping[str, Any]) -> dict[str, Any]:
    """Return the properties of a feature as our export wrote them."""
    members = {k: v for k, v in extras.items() if k not in ("id", "geometry")}
    return {**NULLS[kind], **members}


def _stands(piece: MeshPiece, floor: Polygon) -> bool:
    if "geometry" in piece.extras:
        place = shape(piece.extras["geometry"])
    else:
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


def _identity(name: str) -> str:
    return re.sub("[^a-z0-9]+", "_", name.lower()).strip("_") or "unnamed"
