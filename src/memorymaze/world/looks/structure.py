"""Floor, walls and ceiling as meshes in slices small enough to be left out unseen."""

import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from shapely import Point, Polygon, STRtree
from shapely.geometry.polygon import orient

from memorymaze.world.looks import surfaces
from memorymaze.world.looks.behind_walls import (
    balustrade,
    glass_wall,
    outer_face,
    reveals_and_rooms,
    shaft,
    wind_screen,
)
from memorymaze.world.looks.floor_plan import (
    BAY,
    NEAR_WALL,
    FloorPart,
    Hole,
    WallFace,
    WallSurroundings,
    clear_of,
    floor_parts,
    openings_of,
    sliced,
    wall_faces,
)
from memorymaze.world.looks.materials import Material
from memorymaze.world.looks.meshes import (
    SKIRTING_HEIGHT,
    Building,
    MeshKind,
    Slice,
    ceiling_kind,
    shade_foot,
    solid_of,
    upright,
    wall_uv,
)
from memorymaze.world.looks.visibility import hiding_segments
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.solids import rings_with_things_above

SKIRTING_DEPTH = 0.01
LONG_WALL = 5.0
"""Metres of wall without anything on it that are dressed."""
ASIDE = 0.35
"""Metres that panels keep from what is beside them."""


def structure_of(site: Site) -> Building:
    """Build floors, ceilings and walls of a site."""
    parts = floor_parts(site)
    height = site.ceiling_height
    slices: list[Slice] = []
    middles: list[tuple[FloorPart, Polygon]] = []
    for part in parts:
        for polygon in sliced(part):
            slices.append(_floor_and_ceiling(part, polygon, height))
            middles.append((part, polygon))
    tree = STRtree([polygon for _, polygon in middles])
    open_rings = rings_with_things_above(site)
    surroundings = WallSurroundings(site)
    faces = list(wall_faces(site.walkable_floor, parts, openings_of(site)))
    slice_of: dict[WallFace, Slice] = {}
    for face in faces:
        made = slices[int(tree.nearest(Point(face.at(face.length / 2, 0.05))))]
        made.points = np.concatenate([
            made.points,
            [face.at(0.0), face.at(face.length)],
        ])
        if face.ring in open_rings:
            balustrade(made, face)
        elif face.part.open_air:
            wind_screen(made, face, height)
        else:
            _wall(made, face, height, surroundings)
            slice_of[face] = made
    for face, low, high, start in empty_stretches(list(slice_of), site):
        _dress(slice_of[face], face, (low, high), start, height)
    holes = orient(site.walkable_floor).interiors
    for ring in sorted(open_rings):
        slices.append(shaft(Polygon(holes[ring - 1]), height, f"hole_{ring}"))
    meshes = [mesh for made in slices for mesh in made.meshes()]
    return Building(meshes, hiding_segments(faces, open_rings, surroundings))


def empty_stretches(
    faces: Sequence[WallFace], site: Site
) -> Iterator[tuple[WallFace, float, float, float]]:
    """Yield the pieces of long plaster walls on which there is nothing.

    The faces come in their order along the floor. Told are a face, from where to where
    on it, and where on it the empty wall begins, metres.
    """
    used = [
        (door.line.interpolate(0.5, normalized=True), door.line.length / 2)
        for door in site.doors
    ]
    used += [
        (thing.position, max(thing.size[:2]) / 2)
        for thing in site.landmarks
        if thing.mount == "wall"
    ]
    walls: list[list[WallFace]] = []
    for face in faces:
        if face.part.wall_material != "plaster":
            continue
        before = walls[-1][-1] if walls else None
        if (
            before is None
            or math.dist(before.at(before.length), face.at(0.0)) > 0.01
            or face.starts_at_corner
        ):
            walls.append([])
        walls[-1].append(face)
    for wall in walls:
        first, ends = wall[0], np.cumsum([0.0, *(face.length for face in wall)])
        taken: list[tuple[float, float]] = []
        for face, start in zip(wall, ends.tolist(), strict=False):
            taken += [(start + a, start + b) for a, b, _, _ in face.holes]
        for place, half in used:
            along, behind = first.local(np.array([[place.x, place.y]]))[0].tolist()
            if abs(behind) < NEAR_WALL + 0.1 and -half < along < ends[-1] + half:
                taken.append((along - half, along + half))
        for low, high in clear_of(float(ends[-1]), taken):
            if high - low >= LONG_WALL:
                for face, start in zip(wall, ends.tolist(), strict=False):
                    a = max(low + ASIDE, start) - start
                    b = min(high - ASIDE, start + face.length) - start
                    if b - a > 0.05:
                        yield face, a, b, low - start


def _dress(
    made: Slice,
    face: WallFace,
    along: tuple[float, float],
    start: float,
    height: float,
) -> None:
    """Lay panels over a piece of wall: seen only, for decals have no depth and no id."""
    upright(
        made.builders["decal", surfaces.panelling(height)],
        face,
        along,
        (0.0, height),
        0.003,
        lambda s, z: ((s - start) / BAY, 1 - z / height),
    )


def _pattern(part: FloorPart) -> NDArray[np.float64]:
    """Return the matrix (3, 2) that lays a bay's picture on the plan."""
    cosine, sine = math.cos(part.heading), math.sin(part.heading)
    along = (cosine / BAY, sine / BAY, -(part.x * cosine + part.y * sine) / BAY)
    across = (-sine / BAY, cosine / BAY, -(-part.x * sine + part.y * cosine) / BAY)
    return np.column_stack([along, across])


def _floor_and_ceiling(part: FloorPart, polygon: Polygon, height: float) -> Slice:
    made = Slice(np.array(polygon.exterior.coords)[:, :2], part.id)
    # Parts that touch leave rounding gaps; a hair of overlap closes them.
    wide = polygon.buffer(0.004, join_style="mitre")
    pattern = _pattern(part)
    key: tuple[MeshKind, Material] = ("floor", surfaces.floor(part.floor_material))
    made.builders[key].polygon(wide, 0.0, pattern, up=True)
    if part.open_air:
        made.shows_sky = True
        return made
    kind = ceiling_kind(height)
    made.builders["ceiling", surfaces.ceiling(kind)].polygon(
        wide, height, pattern, up=False
    )
    _lamps(made, part, polygon, height)
    return made


def _lamps(made: Slice, part: FloorPart, polygon: Polygon, height: float) -> None:
    """Add a lamp in the middle of each bay of a corridor, in a grid in a hall."""
    rows = 1 if not part.is_hall and part.width < 3.6 else 0
    low, high = _extent(part, polygon)
    first = math.ceil(low[0] / BAY - 0.5)
    glow = surfaces.solid(1.0, 0.99, 0.95, 1.0, 1.0)
    rim = surfaces.solid(0.80, 0.81, 0.82)
    hang = 0.55 if ceiling_kind(height) == "slats" else 0.0
    bottom = height - hang - 0.03
    inner = polygon.buffer(1e-6)
    for bay in range(first, math.ceil(high[0] / BAY - 0.5)):
        x = (bay + 0.5) * BAY
        if rows:
            places = [0.0]
        else:
            begin = math.ceil(low[1] / BAY - 0.5)
            places = [
                (row + 0.5) * BAY
                for row in range(begin, math.ceil(high[1] / BAY - 0.5))
            ]
        for y in places:
            centre = part.world(np.array([[x, y]]))[0]
            corners = part.world(
                np.array([(x + sx * 0.6, y + sy * 0.15) for sx, sy in _SQUARE])
            )
            lamp = Polygon(corners)
            if not inner.covers(Polygon([tuple(centre)] * 3).buffer(0.01)):
                continue
            if not part.polygon.buffer(0.05).covers(lamp):
                continue
            made.builders["ceiling", glow].polygon(
                lamp, bottom - 0.001, np.zeros((3, 2)), up=False
            )
            (ax, ay), (bx, by) = corners[0], corners[1]
            along = ((bx - ax) / 1.2, (by - ay) / 1.2)
            made.builders["ceiling", rim].block(
                (ax - along[0] * 0.02, ay - along[1] * 0.02),
                along,
                1.24,
                (-along[1], along[0]),
                (-0.02, 0.32),
                (bottom, bottom + 0.06 if hang else height),
            )


_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def _extent(
    part: FloorPart, polygon: Polygon
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    local = part.local(np.array(polygon.exterior.coords)[:, :2])
    return local.min(axis=0), local.max(axis=0)


def _wall(
    made: Slice, face: WallFace, height: float, surroundings: WallSurroundings
) -> None:
    holes = list(face.holes)
    if face.part.wall_material == "glass":
        holes += glass_wall(made, face, height)
    builder = made.builders["wall", surfaces.wall(face.part.wall_material)]
    for low, high, bottom, top in solid_of(face.length, height, holes):
        upright(builder, face, (low, high), (bottom, top), 0.0, wall_uv(face, height))
    _skirting(made, face, holes)
    shade_foot(made, face, holes)
    reveals_and_rooms(made, face, holes, height, surroundings)
    if face.ring == 0:
        outer_face(made, face, height, holes, surroundings)


def _skirting(made: Slice, face: WallFace, holes: list[Hole]) -> None:
    colours = {
        "wood_panel": (0.24, 0.16, 0.10),
        "brick": (0.30, 0.29, 0.28),
        "concrete": (0.36, 0.36, 0.36),
        "glass": (0.30, 0.31, 0.33),
    }
    colour = colours.get(face.part.wall_material, (0.38, 0.37, 0.36))
    builder = made.builders["wall", surfaces.solid(*colour)]
    for low, high, bottom, _ in solid_of(face.length, SKIRTING_HEIGHT, holes):
        if bottom > 0:
            continue
        upright(builder, face, (low, high), (0.0, SKIRTING_HEIGHT), SKIRTING_DEPTH)
        (ax, ay), (bx, by) = face.at(low), face.at(high)
        (cx, cy), (dx, dy) = (
            face.at(high, SKIRTING_DEPTH),
            face.at(low, SKIRTING_DEPTH),
        )
        z = SKIRTING_HEIGHT
        builder.quad([(dx, dy, z), (ax, ay, z), (bx, by, z), (cx, cy, z)][::-1])
