"""What is seen through walls: panes and rails, dim rooms, outer walls, shafts."""

import math
from itertools import pairwise

import numpy as np
from shapely import Polygon
from shapely.geometry.polygon import orient

from memorymaze.world.looks import surfaces
from memorymaze.world.looks.floor_plan import (
    BAY,
    DOUBLE_WALL,
    Hole,
    HollowOutline,
    WallFace,
    WallSurroundings,
    clear_of,
)
from memorymaze.world.looks.materials import Material
from memorymaze.world.looks.meshes import (
    Slice,
    ceiling_kind,
    shade_foot,
    solid_of,
    upright,
    wall_uv,
)
from memorymaze.world.sites.solids import BALUSTRADE_HEIGHT

RAIL_BOTTOM, RAIL_TOP = 0.12, 0.22
"""Of glass walls: metres of frame below and above the panes."""
MODULE = 1.4
"""Width of a pane of a glass wall at most, metres."""
BAR = 0.05
"""Width of a bar between panes, metres."""
VIEW_WIDTH, VIEW_HEIGHT = 3.2, 2.6
"""Metres that the picture of a dim room's far end covers."""
WIDER = 0.5
"""How far a room reaches to either side of the hole one sees it through, metres."""
SHAFT_DEPTH = 5.0
"""How far one looks down a hole with a balustrade, metres."""
OUTSIDE_TOP, OUTSIDE_BOTTOM = 0.5, -4.5
"""How far the outer walls reach over the ceiling and below the floor, metres."""
STOREY = 3.4
"""Metres of one of the windows painted on outer walls, with the wall round it."""
OUTSIDE_WALL, OUTSIDE_REACH = 0.12, 0.119
"""How far the outer face stands behind the inner, and reaches past corners, metres."""


def glass_wall(made: Slice, face: WallFace, height: float) -> list[Hole]:
    """Glaze a wall between its windows and doors, and return the panes as holes."""
    metal = surfaces.solid(0.30, 0.31, 0.33)
    pane = surfaces.solid(0.78, 0.90, 0.94, 0.14)
    taken = [(low - 0.09, high + 0.09) for low, high, _, _ in face.holes]
    panes: list[Hole] = []
    top = height - RAIL_TOP
    for low, high in clear_of(face.length, taken):
        count = max(1, math.ceil((high - low) / MODULE))
        wide = (high - low) / count
        if wide < 0.25:
            continue
        for number in range(count):
            a, b = low + number * wide, low + (number + 1) * wide
            inner = (a + BAR / 2, b - BAR / 2)
            panes.append((*inner, RAIL_BOTTOM, top))
            upright(made.builders["wall", pane], face, inner, (RAIL_BOTTOM, top), 0.0)
            for bar in (a, b - BAR / 2):
                _bar(made, metal, face, (bar, bar + BAR / 2), (RAIL_BOTTOM, top))
            if top > 2.4:
                _bar(made, metal, face, inner, (2.12, 2.16))
        _bar(made, metal, face, (low, high), (RAIL_BOTTOM - 0.04, RAIL_BOTTOM))
        _bar(made, metal, face, (low, high), (top, top + 0.05))
    return panes


def balustrade(made: Slice, face: WallFace) -> None:
    """Glass with a handrail round a hole over which something hangs."""
    pane = surfaces.solid(0.78, 0.90, 0.92, 0.2)
    metal = surfaces.solid(0.62, 0.64, 0.66)
    glass = made.builders["wall", pane]
    upright(glass, face, (0, face.length), (0.08, BALUSTRADE_HEIGHT - 0.05), 0.0)
    rail = made.builders["wall", metal]
    ahead, left = (face.ux, face.uy), (-face.uy, face.ux)
    top = (BALUSTRADE_HEIGHT - 0.05, BALUSTRADE_HEIGHT)
    rail.block(face.at(0), ahead, face.length, left, (-0.05, 0.012), top)
    rail.block(face.at(0), ahead, face.length, left, (-0.06, 0.01), (0.0, 0.08))
    count = max(1, round(face.length / 1.5))
    for post in range(count):
        at = face.at((post + 0.5) * face.length / count - 0.02)
        rail.block(at, ahead, 0.04, left, (-0.05, 0.0), (0.08, top[0]))


def wind_screen(made: Slice, face: WallFace, height: float) -> None:
    """A wind screen of glass on a low wall, round what lies in the open air."""
    wall = surfaces.wall(face.part.wall_material)
    builder = made.builders["wall", wall]
    low_wall = 0.9
    holes = [h for h in face.holes if h[2] < low_wall]
    for low, high, bottom, top in solid_of(face.length, low_wall, holes):
        upright(builder, face, (low, high), (bottom, top), 0.0, wall_uv(face, height))
    pane = surfaces.solid(0.80, 0.91, 0.94, 0.10)
    metal = surfaces.solid(0.55, 0.57, 0.59)
    for low, high in clear_of(face.length, [h[:2] for h in face.holes]):
        if high - low <= 0.1:
            continue
        upright(made.builders["wall", pane], face, (low, high), (low_wall, height), 0)
        count = max(1, math.ceil((high - low) / 1.8))
        for post in range(count + 1):
            x = low + (high - low - 0.05) * post / count
            _bar(made, metal, face, (x, x + 0.05), (low_wall, height))
        _bar(made, metal, face, (low, high), (low_wall, low_wall + 0.05))
        _bar(made, metal, face, (low, high), (height - 0.05, height))
    shade_foot(made, face, list(face.holes))


def _bar(
    made: Slice,
    material: Material,
    face: WallFace,
    along: tuple[float, float],
    height: tuple[float, float],
) -> None:
    made.builders["wall", material].block(
        face.at(along[0]),
        (face.ux, face.uy),
        along[1] - along[0],
        (-face.uy, face.ux),
        (-0.06, 0.012),
        height,
    )


def reveals_and_rooms(
    made: Slice,
    face: WallFace,
    holes: list[Hole],
    height: float,
    surroundings: WallSurroundings,
) -> None:
    """Add the thickness of the wall round its holes, and dim rooms where they are."""
    rooms: list[tuple[float, float, float]] = []
    for low, high, bottom, top in _joined(holes):
        x, y = face.at((low + high) / 2)
        behind, depth = surroundings.behind(x, y, face.heading + math.pi)
        if behind == "outdoors":
            made.shows_sky = True
            for outline in surroundings.hollow(face, (low, high), OUTSIDE_WALL):
                _reveal(made, face, outline, (bottom, top))
        elif rooms and low - rooms[-1][1] < 2 * WIDER:
            start, _, reach = rooms.pop()
            rooms.append((start, high, max(reach, depth)))
        else:
            rooms.append((low, high, depth))
    for low, high, depth in rooms:
        # A room is wider and higher than the hole through which one looks into it.
        along = (max(low - WIDER, 0.0), min(high + WIDER, face.length))
        covered = 0.0
        for outline in surroundings.hollow(face, along, depth, room=True):
            _room(made, face, outline, height)
            covered += sum(
                abs(b - a) for (a, p), (b, q) in pairwise(outline) if p == q == 0.0
            )
        if covered < along[1] - along[0] - BAR:
            made.shows_sky = True


def _joined(holes: list[Hole]) -> list[Hole]:
    """Join openings that only a bar parts."""
    runs: list[Hole] = []
    for low, high, bottom, top in sorted(holes):
        if runs and low - runs[-1][1] < 2 * BAR and runs[-1][2:] == (bottom, top):
            low = runs.pop()[0]
        runs.append((low, high, bottom, top))
    return runs


def _reveal(
    made: Slice, face: WallFace, outline: HollowOutline, height: tuple[float, float]
) -> None:
    """Add the sides of a hole, which is open at its far end."""
    plaster = surfaces.solid(0.74, 0.73, 0.70)
    _floor_and_ceiling(made, face, outline, height, (plaster, plaster))
    builder = made.builders["beyond", plaster]
    for start, end in pairwise(outline):
        if not _runs_along(start, end):
            builder.quad(_upright(face, start, end, height))


def _room(made: Slice, face: WallFace, outline: HollowOutline, height: float) -> None:
    """Add a room whose lights are off, open to the wall."""
    colours = (surfaces.solid(0.20, 0.19, 0.18), surfaces.solid(0.34, 0.34, 0.34))
    _floor_and_ceiling(made, face, outline, (0.0, height), colours)
    plain = made.builders["beyond", surfaces.dim_wall()]
    view = made.builders["beyond", surfaces.dim_view()]
    top = min(height, VIEW_HEIGHT)
    for start, end in pairwise(outline):
        if max(start[1], end[1]) == 0.0:
            continue
        if not _runs_along(start, end):
            plain.quad(_upright(face, start, end, (0.0, height)))
            continue
        a, b = ((face.x + face.y + along) / VIEW_WIDTH for along in (start[0], end[0]))
        rise = 1 - top / VIEW_HEIGHT
        pictured = [(a, 1.0), (b, 1.0), (b, rise), (a, rise)]
        view.quad(_upright(face, start, end, (0.0, top)), pictured)
        if height > top:
            plain.quad(_upright(face, start, end, (top, height)))


def _floor_and_ceiling(
    made: Slice,
    face: WallFace,
    outline: HollowOutline,
    height: tuple[float, float],
    materials: tuple[Material, Material],
) -> None:
    ground = Polygon([face.at(along, -behind) for along, behind in outline])
    for material, z, up in zip(materials, height, (True, False), strict=True):
        made.builders["beyond", material].polygon(ground, z, np.zeros((3, 2)), up=up)


def _runs_along(start: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether a side of an outline faces the wall, more or less."""
    return abs(end[1] - start[1]) < 0.1 * abs(end[0] - start[0])


def _upright(
    face: WallFace,
    start: tuple[float, float],
    end: tuple[float, float],
    height: tuple[float, float],
) -> list[tuple[float, float, float]]:
    """Return the corners of a side of an outline, seen from within."""
    (ax, ay), (bx, by) = face.at(start[0], -start[1]), face.at(end[0], -end[1])
    low, high = height
    return [(ax, ay, low), (bx, by, low), (bx, by, high), (ax, ay, high)]


def outer_face(
    made: Slice,
    face: WallFace,
    height: float,
    holes: list[Hole],
    surroundings: WallSurroundings,
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
        for stretch in surroundings.off_floor(face, (start, end), OUTSIDE_WALL):
            upright(
                builder,
                face,
                stretch,
                (bottom + OUTSIDE_BOTTOM, top + OUTSIDE_BOTTOM),
                -OUTSIDE_WALL,
                lambda along, z: (along / STOREY, 1 - z / STOREY),
                outwards=True,
            )


def shaft(hole: Polygon, height: float, name: str) -> Slice:
    """The inside of a hole with a balustrade, down to a floor below."""
    made = Slice(np.array(hole.exterior.coords)[:, :2], name)
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
