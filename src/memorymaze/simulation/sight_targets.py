"""What there is to see in a scene: doors and landmarks, named and covered with points.

Whether they are seen from somewhere is decided in `visibility.py`.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from memorymaze.perception.visible_object import ObjectDescription
from memorymaze.simulation.scene import Scene
from memorymaze.sites.records import Door, Landmark, Site

__all__ = ["SightTargets", "describe_door", "describe_landmark", "sight_targets"]

FloatArray = NDArray[np.float64]

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


@dataclass(frozen=True, eq=False)
class SightTargets:
    """Doors and landmarks of a scene, n of them, covered with N points in all."""

    descriptions: tuple[ObjectDescription, ...]
    geoms: NDArray[np.int32]
    """Geom id of each, (n,)."""
    centres: FloatArray
    """Metres, (n, 3)."""
    lengths: FloatArray
    """Longer side on the plan, metres, (n,)."""
    radii: FloatArray
    """Metres from the centre to a corner, (n,)."""
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


@lru_cache(maxsize=8)
def sight_targets(scene: Scene) -> SightTargets:
    """Return what there is to see in a scene."""
    descriptions: list[ObjectDescription] = []
    geoms: list[int] = []
    tiles: list[tuple[FloatArray, FloatArray, FloatArray, FloatArray]] = []
    for geom, thing in enumerate(scene.objects):
        record = thing.record
        if record is None:
            continue
        geoms.append(geom)
        descriptions.append(
            describe_door(record, scene.site)
            if isinstance(record, Door)
            else describe_landmark(record)
        )
        tiles.append(_tiles(scene, geom))
    counts = [len(points) for points, _, _, _ in tiles]
    sizes = scene.model.geom_size[geoms].reshape(-1, 3)
    return SightTargets(
        tuple(descriptions),
        np.array(geoms, dtype=np.int32),
        scene.model.geom_pos[geoms].reshape(-1, 3).copy(),
        2 * sizes[:, :2].max(axis=1, initial=0.0),
        np.linalg.norm(sizes, axis=1),
        np.concatenate([[0], np.cumsum(counts, dtype=np.int64)]),
        *(
            np.concatenate([each[i] for each in tiles]) if tiles else np.zeros(shape)
            for i, shape in enumerate([(0, 3), (0, 3), (0, 2, 3), (0,)])
        ),
    )


def describe_landmark(landmark: Landmark) -> ObjectDescription:
    """Return how people could name a landmark."""
    return ObjectDescription(
        landmark.category,
        color=landmark.color,
        name=landmark.name,
        text=landmark.text,
    )


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


def _tiles(
    scene: Scene, geom: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Cover a box's sides, top and bottom with tiles."""
    half = scene.model.geom_size[geom]
    w, _, _, z = scene.model.geom_quat[geom]
    heading = 2 * math.atan2(z, w)
    turn = np.array([
        [math.cos(heading), -math.sin(heading), 0.0],
        [math.sin(heading), math.cos(heading), 0.0],
        [0.0, 0.0, 1.0],
    ])
    faces = list(_faces(half))
    points = np.concatenate([points for points, _, _ in faces])
    normals = np.concatenate([np.tile(n, (len(p), 1)) for p, n, _ in faces])
    edges = np.concatenate([np.tile(e, (len(p), 1, 1)) for p, _, e in faces])
    areas = (
        4 * np.linalg.norm(edges[:, 0], axis=1) * np.linalg.norm(edges[:, 1], axis=1)
    )
    return (
        points @ turn.T + scene.model.geom_pos[geom],
        normals @ turn.T,
        edges @ turn.T,
        areas,
    )


def _faces(half: FloatArray) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
    """Yield points, outward normal and half edges of each face worth looking at."""
    order = sorted(range(3), key=lambda axis: half[axis])
    for axis in range(3):
        first, second = (other for other in range(3) if other != axis)
        is_largest = axis == order[0]
        if not is_largest and 2 * min(half[first], half[second]) < THINNEST:
            continue
        grids = [
            _middles(half[first], edge := np.zeros((2, 3)), 0, first),
            _middles(half[second], edge, 1, second),
        ]
        for side in (-1.0, 1.0):
            points = np.zeros((len(grids[0]) * len(grids[1]), 3))
            points[:, first] = np.repeat(grids[0], len(grids[1]))
            points[:, second] = np.tile(grids[1], len(grids[0]))
            points[:, axis] = side * half[axis]
            normal = np.zeros(3)
            normal[axis] = side
            yield points, normal, edge


def _middles(half: float, edges: FloatArray, row: int, axis: int) -> FloatArray:
    """Cut an edge into equal pieces; note half a piece, return their middles."""
    count = min(max(math.ceil(2 * half / SPACING), FEWEST), MOST)
    edges[row, axis] = half / count
    return (np.arange(count) + 0.5) * (2 * half / count) - half
