"""What is seen through openings: dim rooms, outer walls, the floor below an atrium."""

import math
from itertools import pairwise

import numpy as np
from shapely import Polygon
from shapely.geometry.polygon import orient

from memorymaze.pictures.looks import surfaces
from memorymaze.pictures.looks.materials import Material
from memorymaze.pictures.rendering.floor_parts import BAY
from memorymaze.pictures.rendering.openings import DOUBLE_WALL, Surroundings
from memorymaze.pictures.rendering.slices import (
    Hole,
    Slice,
    ceiling_kind,
    solid_of,
    upright,
)
from memorymaze.pictures.rendering.wall_faces import WallFace

SHAFT_DEPTH = 5.0
"""How far one looks down a hole with a balustrade, metres."""
OUTSIDE_TOP, OUTSIDE_BOTTOM = 0.5, -4.5
"""How far the outer walls reach over the ceiling and below the floor, metres."""
STOREY = 3.4
"""Metres of one of the windows painted on outer walls, with the wall round it."""
OUTSIDE_WALL, OUTSIDE_REACH = 0.12, 0.119
"""How far the outer face stands behind the inner, and reaches past corners, metres."""


def reveal_and_view(
    made: Slice,
    face: WallFace,
    hole: Hole,
    height: float,
    surroundings: Surroundings,
) -> None:
    """Add the thickness of the wall round a hole, and a dim room where one is."""
    low, high, bottom, top = hole
    x, y = face.at((low + high) / 2)
    behind, depth = surroundings.behind(x, y, face.heading + math.pi)
    reveal = surfaces.solid(0.74, 0.73, 0.70)
    if behind == "outdoors":
        made.shows_sky = True
        _box_inside(
            made, face, (low, high), (bottom, top), 0.12, reveal, reveal, reveal
        )
        return
    # A room is wider and higher than the hole through which one looks into it.
    wall = surfaces.dim_wall()
    _box_inside(
        made,
        face,
        (low, high),
        (bottom if bottom > 0.3 else 0.0, min(top, height)),
        depth,
        wall,
        surfaces.solid(0.20, 0.19, 0.18),
        surfaces.solid(0.34, 0.34, 0.34),
    )
    upright(
        made.builders["beyond", surfaces.dim_view()],
        face,
        (low, high),
        (bottom if bottom > 0.3 else 0.0, top),
        -depth,
        lambda s, z: ((low + face.x + face.y + s) / 3.2, 1 - z / 2.6),
    )


def outer_face(
    made: Slice,
    face: WallFace,
    height: float,
    holes: list[Hole],
    surroundings: Surroundings,
) -> None:
    """Add the outer face of a wall; one sees it from other windows."""
    inwards = face.heading + math.pi
    if surroundings.behind(*face.at(face.length / 2), inwards)[1] < DOUBLE_WALL:
        return
    builder = made.builders["beyond", surfaces.facade()]
    shifted = [
        (a, b, z0 - OUTSIDE_BOTTOM, z1 - OUTSIDE_BOTTOM)
        for a, b, z0, z1 in holes
        if surroundings.behind(*face.at((a + b) / 2), inwards)[0] == "outdoors"
    ]
    whole = height + OUTSIDE_TOP - OUTSIDE_BOTTOM
    for low, high, bottom, top in solid_of(face.length, whole, shifted):
        # Faces that meet at a corner reach out to close it.
        start = -OUTSIDE_REACH if low == 0 and face.starts_at_corner else low
        end = high
        if high == face.length and face.ends_at_corner:
            end += OUTSIDE_REACH
        upright(
            builder,
            face,
            (start, end),
            (bottom + OUTSIDE_BOTTOM, top + OUTSIDE_BOTTOM),
            -OUTSIDE_WALL,
            lambda along, z: (along / STOREY, 1 - z / STOREY),
            outwards=True,
        )


def shaft(hole: Polygon, height: float) -> Slice:
    """The inside of a hole with a balustrade, down to a floor below."""
    made = Slice(np.array(hole.exterior.coords)[:, :2])
    flat = np.array([[1 / BAY, 0.0], [0.0, 1 / BAY], [0.0, 0.0]])
    made.builders["beyond", surfaces.floor("tile")].polygon(
        hole, -SHAFT_DEPTH, flat, up=True
    )
    kind = ceiling_kind(height)
    made.builders["ceiling", surfaces.ceiling(kind)].polygon(
        hole, height, flat, up=False
    )
    wall = made.builders["beyond", surfaces.solid(0.62, 0.61, 0.59)]
    ring = orient(hole).exterior.coords
    for (ax, ay, *_), (bx, by, *_) in pairwise(ring):
        wall.quad([
            (bx, by, -SHAFT_DEPTH),
            (ax, ay, -SHAFT_DEPTH),
            (ax, ay, 0.0),
            (bx, by, 0.0),
        ])
    return made


def _box_inside(
    made: Slice,
    face: WallFace,
    along: tuple[float, float],
    height: tuple[float, float],
    depth: float,
    sides: Material,
    floor: Material,
    ceiling: Material,
) -> None:
    """Add the four sides of a box that opens to the floor, seen from within."""
    (a, b), (z0, z1) = along, height
    front = [face.at(a), face.at(b)]
    back = [face.at(a, -depth), face.at(b, -depth)]
    side = made.builders["beyond", sides]
    uv = [(0.0, 1.0), (depth / BAY, 1.0), (depth / BAY, 0.0), (0.0, 0.0)]
    left = [(*front[0], z0), (*back[0], z0), (*back[0], z1), (*front[0], z1)]
    right = [(*front[1], z0), (*back[1], z0), (*back[1], z1), (*front[1], z1)]
    side.quad(left, uv)
    side.quad(right[::-1], uv[::-1])
    made.builders["beyond", floor].quad(
        [
            (*front[0], z0),
            (*front[1], z0),
            (*back[1], z0),
            (*back[0], z0),
        ][::-1]
    )
    made.builders["beyond", ceiling].quad([
        (*front[0], z1),
        (*front[1], z1),
        (*back[1], z1),
        (*back[0], z1),
    ])
