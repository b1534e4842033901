"""What there is to see in a scene, and to read: doors, landmarks, floors, things and people.

They are named and covered with points; whether they are seen from somewhere is decided in
`visibility.py`. How words are really painted is a matter of `looks`; here are its
rules of thumb, so that runs which never draw need none of it.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.physics_engine import mujoco
from memorymaze.robot.perception.appearance import parse_appearance
from memorymaze.robot.perception.camera_view import ObjectDescription, Wanted
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.senses.coverings import CoveredPiece, covered_pieces
from memorymaze.world.sites.records import Door, Landmark, Site
from memorymaze.world.sites.scene_objects import Movable

SPACING = 0.18
"""Metres between the points that cover a surface, at most."""
FEWEST, MOST = 4, 14
"""Points along each edge of a surface."""
THINNEST = 0.06
"""Narrower surfaces, such as the edge of a poster, are not looked at, metres."""
_DOOR_CATEGORY = {
    "elevator": "elevator door",
    "automatic_glass": "automatic door",
    "fire": "fire door",
}
_DOOR_MATERIAL = {
    "automatic_glass": "glass",
    "elevator": "steel",
    "fire": "steel",
}
CAPITAL = 0.73
"""Height of a capital letter as a share of the font's size."""
BOARD_DEPTH = 0.15
"""Metres; thinner things are boards that their words fill."""
LARGEST_FIELD = 0.45
"""Metres; words fill no more of a board's height."""
STRIP = 0.12
"""Metres; height of the strip for words on things that are no boards."""
LABEL_HEIGHT = 0.15
"""Metres; of the plate on a door."""
PIXELS_PER_METRE = 300


@dataclass(frozen=True, eq=False)
class SightTargets:
    """Things of a scene that can be seen, n of them, covered with N points in all."""

    descriptions: tuple[ObjectDescription, ...]
    geoms: NDArray[np.int32]
    """Geom id of each, (n,)."""
    centres: FloatArray
    """Metres, (n, 3)."""
    lengths: FloatArray
    """Longer side on the plan, metres, (n,)."""
    radii: FloatArray
    """Metres from the centre to a corner, (n,)."""
    written: NDArray[np.bool_]
    """Whether there are words on it, (n,)."""
    first_points: NDArray[np.int64]
    """Number of each one's first point, then N; (n + 1,)."""
    points: FloatArray
    """Middles of the tiles that cover the surfaces, metres, (N, 3)."""
    normals: FloatArray
    """Outward unit vectors, (N, 3)."""
    half_edges: FloatArray
    """Vectors from a tile's middle to the middles of two of its edges, (N, 2, 3)."""
    areas: FloatArray
    """Of the tiles, square metres, (N,)."""
    _asked_for: WeakKeyDictionary[Wanted, dict[int, bool]] = field(
        init=False, default_factory=WeakKeyDictionary[Wanted, dict[int, bool]]
    )

    def wanted(self, numbers: Iterable[int], wanted: Wanted) -> list[int]:
        """Return those that one looks for; each is asked about once."""
        known = self._asked_for.setdefault(wanted, {})
        for each in numbers:
            if each not in known:
                known[each] = wanted(self.descriptions[each])
        return [each for each in numbers if known[each]]


@lru_cache(maxsize=8)
def sight_targets(scene: Scene) -> SightTargets:
    """Return what there is to see of a site: its doors, landmarks and floors."""
    geoms = [
        geom
        for geom, thing in enumerate(scene.objects)
        if isinstance(thing.record, Door | Landmark)
    ]
    floors = [*covered_pieces(scene.site)]
    floor = next(n for n, thing in enumerate(scene.objects) if thing.kind == "floor")
    return _targets(
        [*geoms, *(floor for _ in floors)],
        [
            *(_describe(scene, geom) for geom in geoms),
            *(each.description for each in floors),
        ],
        [*scene.model.geom_pos[geoms], *(each.centre for each in floors)],
        [
            *(_half_size(scene, geom) for geom in geoms),
            *(each.half_size for each in floors),
        ],
        [*(_tiles(scene, geom) for geom in geoms), *map(_floor_tiles, floors)],
    )


def _floor_tiles(piece: CoveredPiece) -> "_Tiles":
    count = len(piece.points)
    east, north = np.diag([*piece.half_tile, 0.0])[:2]
    return _Tiles(
        piece.points,
        np.tile([0.0, 0.0, 1.0], (count, 1)),
        np.tile(np.stack([east, north]), (count, 1, 1)),
        np.full(count, 4 * piece.half_tile.prod()),
    )


def movable_targets(
    scene: Scene, data: mujoco.MjData, eye: FloatArray, reach: float
) -> SightTargets:
    """Return the things and people whose middles are within reach of a point now.

    The geom poses of the physics state have to be up to date.
    """
    geoms = _movable_geoms(scene)
    distances = np.linalg.norm(data.geom_xpos[geoms].reshape(-1, 3) - eye, axis=1)
    near = [geom for geom, d in zip(geoms, distances, strict=True) if d <= reach]
    return _targets(
        near,
        [_describe(scene, geom) for geom in near],
        data.geom_xpos[near],
        [_half_size(scene, geom) for geom in near],
        [
            _moved(tiles, data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom])
            for geom in near
            for tiles in [_local_tiles(scene, geom)]
        ],
    )


@lru_cache(maxsize=8)
def _movable_geoms(scene: Scene) -> list[int]:
    return [
        geom
        for geom, thing in enumerate(scene.objects)
        if isinstance(thing.record, Movable)
    ]


@lru_cache(maxsize=2048)
def _local_tiles(scene: Scene, geom: int) -> "_Tiles":
    """Return the tiles of a movable in its own frame, which is its body's."""
    return _tiles(scene, geom)


def _moved(tiles: "_Tiles", turn: FloatArray, place: FloatArray) -> "_Tiles":
    return _Tiles(
        tiles.points @ turn.T + place,
        tiles.normals @ turn.T,
        tiles.half_edges @ turn.T,
        tiles.areas,
    )


def _targets(
    geoms: Sequence[int],
    descriptions: Sequence[ObjectDescription],
    centres: Sequence[FloatArray] | FloatArray,
    half_sizes: Sequence[FloatArray],
    tiles_of: "Sequence[_Tiles]",
) -> SightTargets:
    tiles = [_NO_TILES, *tiles_of]
    sizes = np.array(half_sizes).reshape(-1, 3)
    return SightTargets(
        tuple(descriptions),
        np.array(geoms, dtype=np.int32),
        np.array(centres).reshape(-1, 3),
        2 * sizes[:, :2].max(axis=1, initial=0.0),
        np.sqrt(np.square(sizes).sum(axis=1)),
        np.array([bool(each.text) for each in descriptions], dtype=np.bool_),
        np.cumsum([len(each.points) for each in tiles], dtype=np.int64),
        *(np.concatenate(column) for column in zip(*tiles, strict=True)),
    )


def _half_size(scene: Scene, geom: int) -> FloatArray:
    """Return half the extent of a box, or of the box around an upright cylinder."""
    size = scene.model.geom_size[geom]
    if scene.model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return np.array([size[0], size[0], size[1]])
    return np.array(size)


def _describe(scene: Scene, geom: int) -> ObjectDescription:
    record = scene.objects[geom].record
    if isinstance(record, Door):
        return describe_door(record, scene.site)
    if isinstance(record, Landmark):
        return describe_landmark(record)
    if isinstance(record, Movable):
        return ObjectDescription(record.category, color=record.color, text=record.text)
    raise TypeError(f"geom {geom}: expected something to see, got {record!r}")


def describe_landmark(landmark: Landmark) -> ObjectDescription:
    """Return how people could name a landmark."""
    return ObjectDescription(
        landmark.category,
        color=landmark.color,
        material=_material_named(landmark.category),
        name=landmark.name,
        text=landmark.text,
    )


def _material_named(category: str) -> str | None:
    """Return the material that a category names: `brick` of `brick floor`."""
    *before, _ = category.split()
    materials = parse_appearance(" ".join(before)).materials
    return " ".join(sorted(materials)) or None


def describe_door(door: Door, site: Site) -> ObjectDescription:
    """Return how people could name a door; its name is that of the room behind it."""
    room = next((room for room in site.rooms if room.id == door.room), None)
    return ObjectDescription(
        _DOOR_CATEGORY.get(door.style, "door"),
        color=door.color,
        material=_DOOR_MATERIAL.get(door.style, door.style),
        name=None if room is None else room.name,
        text=door.label,
        state=door.state,
    )


class _Tiles(NamedTuple):
    points: FloatArray
    normals: FloatArray
    half_edges: FloatArray
    areas: FloatArray


_NO_TILES = _Tiles(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2, 3)), np.zeros(0))


def _tiles(scene: Scene, geom: int) -> _Tiles:
    """Cover a box's sides, top and bottom with tiles."""
    faces = list(_faces(_half_size(scene, geom)))
    points = np.concatenate([points for points, _, _ in faces])
    normals = np.concatenate([np.tile(n, (len(p), 1)) for p, n, _ in faces])
    half_edges = np.concatenate([np.tile(e, (len(p), 1, 1)) for p, _, e in faces])
    areas = 4 * np.linalg.norm(half_edges, axis=2).prod(axis=1)
    w, _, _, z = scene.model.geom_quat[geom]
    heading = 2 * math.atan2(z, w)
    to_world = np.array([
        [math.cos(heading), math.sin(heading), 0.0],
        [-math.sin(heading), math.cos(heading), 0.0],
        [0.0, 0.0, 1.0],
    ])
    return _Tiles(
        points @ to_world + scene.model.geom_pos[geom],
        normals @ to_world,
        half_edges @ to_world,
        areas.astype(np.float64),
    )


def _faces(half: FloatArray) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
    """Yield points, outward normal and half edges of each face worth looking at."""
    across_largest_face = int(np.argmin(half))
    for axis in range(3):
        first, second = (other for other in range(3) if other != axis)
        is_thin = 2 * min(half[first], half[second]) < THINNEST
        if is_thin and axis != across_largest_face:
            continue
        rows, columns = _middles(half[first]), _middles(half[second])
        half_edges = np.zeros((2, 3))
        half_edges[0, first] = half[first] / len(rows)
        half_edges[1, second] = half[second] / len(columns)
        for side in (-1.0, 1.0):
            points = np.empty((len(rows) * len(columns), 3))
            points[:, first] = np.repeat(rows, len(columns))
            points[:, second] = np.tile(columns, len(rows))
            points[:, axis] = side * half[axis]
            normal = np.zeros(3)
            normal[axis] = side
            yield points, normal, half_edges


def _middles(half: float) -> FloatArray:
    """Cut an edge into equal pieces and return their middles."""
    count = min(max(math.ceil(2 * half / SPACING), FEWEST), MOST)
    return (np.arange(count, dtype=np.float64) + 0.5) * (2 * half / count) - half


class Inscription(NamedTuple):
    """What is written on a thing."""

    text: str
    letter_height: float
    """Of capital letters, metres."""
    both_sides: bool
    """Whether it can be read from behind as well."""
    fills_it: bool
    """Whether it is all over the thing, as on a board."""


@lru_cache(maxsize=4096)
def inscription(scene: Scene, geom: int) -> Inscription:
    """Return what is written on a door, landmark or thing that bears words."""
    record = scene.objects[geom].record
    if isinstance(record, Door) and record.label:
        (ax, ay), (bx, by) = [point[:2] for point in record.line.coords]
        room = math.hypot(bx - ax, by - ay) - 0.24
        width = min(0.062 * len(record.label) + 0.08, max(room, 0.3))
        height = _letter_height(record.label, width, LABEL_HEIGHT)
        return Inscription(record.label, height, both_sides=True, fills_it=False)
    text = getattr(record, "text", None)
    if not text:
        raise ValueError(f"geom {geom}: expected something with words, got {record!r}")
    length, depth, tall = record.size  # type: ignore[union-attr]
    is_board = depth <= BOARD_DEPTH
    field = min(tall, LARGEST_FIELD) if is_board else STRIP
    both = not isinstance(record, Landmark) or (
        record.mount == "ceiling" and not _points(text)
    )
    height = _letter_height(text, 0.9 * length, 0.9 * field)
    return Inscription(text, height, both, is_board)


def _points(text: str) -> bool:
    from memorymaze.basics.signposts import signposts

    return any(post.arrow is not None for post in signposts(text))


def _letter_height(text: str, width: float, height: float) -> float:
    """Return the height of capitals where a text fills a field; metres."""
    # The font is loaded only where somebody reads.
    from memorymaze.basics.signposts import signposts
    from memorymaze.world.looks.lettering import fitted

    posts = signposts(text)
    if width > 2.2 * height:
        width /= len(posts)
    else:
        height /= len(posts)
    sizes = [
        fitted(
            post.words,
            max(1, round(PIXELS_PER_METRE * width * (0.76 if post.arrow else 1.0))),
            max(1, round(PIXELS_PER_METRE * height)),
        ).size
        for post in posts
        if post.words
    ]
    return CAPITAL * min(sizes, default=0) / PIXELS_PER_METRE
