"""Walls of glass, wind screens on terraces and balustrades."""

import math

from memorymaze.pictures.looks import surfaces
from memorymaze.pictures.looks.materials import Material
from memorymaze.pictures.rendering.slices import (
    Hole,
    Slice,
    foot_shade,
    solid_of,
    upright,
    wall_uv,
)
from memorymaze.pictures.rendering.wall_faces import WallFace
from memorymaze.simulation.scene import BALUSTRADE_HEIGHT

RAIL_BOTTOM, RAIL_TOP = 0.12, 0.22
"""Of glass walls: metres of frame below and above the panes."""
MODULE = 1.4
"""Width of a pane of a glass wall at most, metres."""
BAR = 0.05
"""Width of a bar between panes, metres."""


def glass_wall(made: Slice, face: WallFace, height: float) -> list[Hole]:
    """Glaze a wall between its windows and doors, and return the panes as holes."""
    metal = surfaces.solid(0.30, 0.31, 0.33)
    pane = surfaces.solid(0.78, 0.90, 0.94, 0.14)
    taken = sorted((h[0] - 0.09, h[1] + 0.09) for h in face.holes)
    free: list[tuple[float, float]] = []
    at = 0.0
    for low, high in taken:
        if low > at:
            free.append((at, low))
        at = max(at, high)
    if at < face.length:
        free.append((at, face.length))
    panes: list[Hole] = []
    top = height - RAIL_TOP
    for low, high in free:
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
    taken = sorted((h[0], h[1]) for h in face.holes)
    at = 0.0
    for low, high in [*taken, (face.length, face.length)]:
        if low - at > 0.1:
            upright(made.builders["wall", pane], face, (at, low), (low_wall, height), 0)
            count = max(1, math.ceil((low - at) / 1.8))
            for post in range(count + 1):
                x = at + (low - at - 0.05) * post / count
                _bar(made, metal, face, (x, x + 0.05), (low_wall, height))
            _bar(made, metal, face, (at, low), (low_wall, low_wall + 0.05))
            _bar(made, metal, face, (at, low), (height - 0.05, height))
        at = max(at, high)
    foot_shade(made, face, list(face.holes))


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
