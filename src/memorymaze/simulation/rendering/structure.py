"""Floor, walls and ceiling as meshes in slices small enough to be left out unseen."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from shapely import Point, Polygon, STRtree
from shapely.geometry.polygon import orient

from memorymaze.simulation.looks import surfaces
from memorymaze.simulation.looks.object_model import Material, MeshPart
from memorymaze.simulation.rendering.floor_parts import (
    BAY,
    FloorPart,
    floor_parts,
    sliced,
)
from memorymaze.simulation.rendering.meshes import MeshBuilder
from memorymaze.simulation.rendering.openings import DOUBLE_WALL, Surroundings, openings_of
from memorymaze.simulation.rendering.sight import hiding_segments
from memorymaze.simulation.rendering.wall_faces import WallFace, wall_faces
from memorymaze.simulation.scene import BALUSTRADE_HEIGHT, rings_with_things_above
from memorymaze.sites.records import Site

__all__ = ["Kind", "Slice", "Structure", "structure_of"]

Kind = Literal["floor", "ceiling", "wall", "beyond", "decal"]
"""What a mesh belongs to; `beyond` is seen through glass, `decal` is a mere shade."""

SKIRTING_HEIGHT, SKIRTING_DEPTH = 0.09, 0.01
RAIL_BOTTOM, RAIL_TOP = 0.12, 0.22
"""Of glass walls: metres of frame below and above the panes."""
MODULE = 1.4
"""Width of a pane of a glass wall at most, metres."""
BAR = 0.05
HIGH_CEILING = 4.0
"""Ceilings from here on are slats with hanging lamps, metres."""
SHAFT_DEPTH = 5.0
"""How far one looks down a hole with a balustrade, metres."""
OUTSIDE_TOP, OUTSIDE_BOTTOM = 0.5, -4.5
"""How far the outer walls reach over the ceiling and below the floor, metres."""
SHADE_WIDTH = 0.28

Hole = tuple[float, float, float, float]
Uv = Callable[[float, float], tuple[float, float]]


@dataclass(eq=False)
class Slice:
    """Meshes that are seen or left out together."""

    points: NDArray[np.float64]
    """Corners of what it covers on the plan, (N, 2) metres."""
    shows_sky: bool = False
    """Whether one may see the sky through it or over it."""
    builders: dict[tuple[Kind, Material], MeshBuilder] = field(
        default_factory=lambda: defaultdict(MeshBuilder)
    )

    def meshes(self) -> Iterator[tuple[Kind, MeshPart]]:
        """Yield its meshes with what they belong to."""
        for (kind, material), builder in self.builders.items():
            if not builder.is_empty:
                yield kind, builder.part(material)


@dataclass(frozen=True, eq=False)
class Structure:
    """All of a building but its doors and landmarks."""

    slices: list[Slice]
    hiding: NDArray[np.float64]
    """Pieces of wall that hide what is behind, (n, 4): x, y to x, y, metres."""


def structure_of(site: Site) -> Structure:
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
    surroundings = Surroundings(site)
    faces = list(wall_faces(site.walkable_floor, parts, openings_of(site)))
    for face in faces:
        made = slices[int(tree.nearest(Point(face.at(face.length / 2, 0.05))))]
        made.points = np.concatenate([
            made.points,
            [face.at(0.0), face.at(face.length)],
        ])
        if face.ring in open_rings:
            _balustrade(made, face)
        elif face.part.open_air:
            _parapet(made, face, height)
        else:
            _wall(made, face, height, surroundings)
    holes = orient(site.walkable_floor).interiors
    for ring in sorted(open_rings):
        slices.append(_shaft(Polygon(holes[ring - 1]), height))
    return Structure(slices, hiding_segments(faces, open_rings, surroundings))


def _pattern(part: FloorPart) -> NDArray[np.float64]:
    """Return the matrix (3, 2) that lays a bay's picture on the plan."""
    cosine, sine = math.cos(part.heading), math.sin(part.heading)
    along = (cosine / BAY, sine / BAY, -(part.x * cosine + part.y * sine) / BAY)
    across = (-sine / BAY, cosine / BAY, -(-part.x * sine + part.y * cosine) / BAY)
    return np.column_stack([along, across])


def _floor_and_ceiling(part: FloorPart, polygon: Polygon, height: float) -> Slice:
    made = Slice(np.array(polygon.exterior.coords)[:, :2])
    # Parts that touch leave rounding gaps; a hair of overlap closes them.
    wide = polygon.buffer(0.004, join_style="mitre")
    if not isinstance(wide, Polygon):
        wide = polygon
    pattern = _pattern(part)
    key: tuple[Kind, Material] = ("floor", surfaces.floor(part.floor_material))
    made.builders[key].polygon(wide, 0.0, pattern, up=True)
    if part.open_air:
        made.shows_sky = True
        return made
    kind = "slats" if height >= HIGH_CEILING else "panels"
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
    hang = 0.55 if height >= HIGH_CEILING else 0.0
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
    made: Slice, face: WallFace, height: float, surroundings: Surroundings
) -> None:
    holes = list(face.holes)
    if face.part.wall_material == "glass":
        holes += _panes(made, face, height)
    builder = made.builders["wall", surfaces.wall(face.part.wall_material)]
    for low, high, bottom, top in _solid_of(face.length, height, holes):
        _upright(builder, face, (low, high), (bottom, top), 0.0, _wall_uv(face, height))
    _skirting(made, face, holes)
    _shade(made, face, holes)
    for hole in holes:
        _reveal_and_view(made, face, hole, height, surroundings)
    if face.ring == 0:
        _outside(made, face, height, holes, surroundings)


def _wall_uv(face: WallFace, height: float) -> Uv:
    """Lay the picture so that its lamp stands where the floor's lamp stands."""
    part = face.part
    along = math.cos(part.heading) * face.ux + math.sin(part.heading) * face.uy
    start = 0.0
    if abs(along) > 0.8:
        local = part.local(np.array([[face.x, face.y]]))[0]
        start = float(local[0]) * (1.0 if along > 0 else -1.0)

    def uv(s: float, z: float) -> tuple[float, float]:
        return (start + s) / BAY, 1 - z / height

    return uv


def _upright(
    builder: MeshBuilder,
    face: WallFace,
    along: tuple[float, float],
    height: tuple[float, float],
    out: float,
    uv: Uv | None = None,
    *,
    outwards: bool = False,
) -> None:
    """Add a rectangle parallel to a wall, seen from the floor or from behind."""
    (a, b), (z0, z1) = along, height
    (ax, ay), (bx, by) = face.at(a, out), face.at(b, out)
    corners = [(ax, ay, z0), (bx, by, z0), (bx, by, z1), (ax, ay, z1)]
    pictured = None
    if uv is not None:
        pictured = [uv(a, z0), uv(b, z0), uv(b, z1), uv(a, z1)]
    # The floor is to the left of the face, so from there it runs right to left.
    if not outwards:
        corners = corners[::-1]
        pictured = None if pictured is None else pictured[::-1]
    builder.quad(corners, pictured)


def _solid_of(
    length: float, height: float, holes: list[Hole]
) -> Iterator[tuple[float, float, float, float]]:
    """Yield the rectangles that are left of a wall without its holes."""
    cuts = sorted({0.0, length, *(h[0] for h in holes), *(h[1] for h in holes)})
    for low, high in zip(cuts, cuts[1:], strict=False):
        if high - low < 1e-6:
            continue
        middle = (low + high) / 2
        over = sorted((h[2], h[3]) for h in holes if h[0] < middle < h[1])
        floor = 0.0
        for bottom, top in over:
            if bottom > floor + 1e-6:
                yield low, high, floor, min(bottom, height)
            floor = max(floor, top)
        if floor < height - 1e-6:
            yield low, high, floor, height


def _panes(made: Slice, face: WallFace, height: float) -> list[Hole]:
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
            _upright(made.builders["wall", pane], face, inner, (RAIL_BOTTOM, top), 0.0)
            for bar in (a, b - BAR / 2):
                _bar(made, metal, face, (bar, bar + BAR / 2), (RAIL_BOTTOM, top))
            if top > 2.4:
                _bar(made, metal, face, inner, (2.12, 2.16))
        _bar(made, metal, face, (low, high), (RAIL_BOTTOM - 0.04, RAIL_BOTTOM))
        _bar(made, metal, face, (low, high), (top, top + 0.05))
    return panes


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


def _skirting(made: Slice, face: WallFace, holes: list[Hole]) -> None:
    colours = {
        "wood_panel": (0.24, 0.16, 0.10),
        "brick": (0.30, 0.29, 0.28),
        "concrete": (0.36, 0.36, 0.36),
        "glass": (0.30, 0.31, 0.33),
    }
    colour = colours.get(face.part.wall_material, (0.38, 0.37, 0.36))
    builder = made.builders["wall", surfaces.solid(*colour)]
    for low, high, bottom, _ in _solid_of(face.length, SKIRTING_HEIGHT, holes):
        if bottom > 0:
            continue
        _upright(builder, face, (low, high), (0.0, SKIRTING_HEIGHT), SKIRTING_DEPTH)
        (ax, ay), (bx, by) = face.at(low), face.at(high)
        (cx, cy), (dx, dy) = (
            face.at(high, SKIRTING_DEPTH),
            face.at(low, SKIRTING_DEPTH),
        )
        z = SKIRTING_HEIGHT
        builder.quad([(dx, dy, z), (ax, ay, z), (bx, by, z), (cx, cy, z)][::-1])


def _shade(made: Slice, face: WallFace, holes: list[Hole]) -> None:
    """Darken the floor along the foot of the wall."""
    builder = made.builders["decal", surfaces.foot_shade()]
    for low, high, bottom, _ in _solid_of(face.length, SKIRTING_HEIGHT, holes):
        if bottom > 0:
            continue
        (ax, ay), (bx, by) = face.at(low), face.at(high)
        (cx, cy), (dx, dy) = face.at(high, SHADE_WIDTH), face.at(low, SHADE_WIDTH)
        z = 0.004
        builder.quad(
            [(ax, ay, z), (bx, by, z), (cx, cy, z), (dx, dy, z)],
            [(0.5, 0.02), (0.5, 0.02), (0.5, 0.98), (0.5, 0.98)],
        )


def _reveal_and_view(
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
    _upright(
        made.builders["beyond", surfaces.dim_view()],
        face,
        (low, high),
        (bottom if bottom > 0.3 else 0.0, top),
        -depth,
        lambda s, z: ((low + face.x + face.y + s) / 3.2, 1 - z / 2.6),
    )


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


def _outside(
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
    builder = made.builders["beyond", surfaces.solid(0.70, 0.67, 0.62)]
    shifted = [
        (a, b, z0 - OUTSIDE_BOTTOM, z1 - OUTSIDE_BOTTOM)
        for a, b, z0, z1 in holes
        if surroundings.behind(*face.at((a + b) / 2), inwards)[0] == "outdoors"
    ]
    whole = height + OUTSIDE_TOP - OUTSIDE_BOTTOM
    for low, high, bottom, top in _solid_of(face.length, whole, shifted):
        _upright(
            builder,
            face,
            (low, high),
            (bottom + OUTSIDE_BOTTOM, top + OUTSIDE_BOTTOM),
            -0.12,
            outwards=True,
        )


def _balustrade(made: Slice, face: WallFace) -> None:
    """Glass with a handrail round a hole over which something hangs."""
    pane = surfaces.solid(0.78, 0.90, 0.92, 0.2)
    metal = surfaces.solid(0.62, 0.64, 0.66)
    glass = made.builders["wall", pane]
    _upright(glass, face, (0, face.length), (0.08, BALUSTRADE_HEIGHT - 0.05), 0.0)
    rail = made.builders["wall", metal]
    ahead, left = (face.ux, face.uy), (-face.uy, face.ux)
    top = (BALUSTRADE_HEIGHT - 0.05, BALUSTRADE_HEIGHT)
    rail.block(face.at(0), ahead, face.length, left, (-0.05, 0.012), top)
    rail.block(face.at(0), ahead, face.length, left, (-0.06, 0.01), (0.0, 0.08))
    count = max(1, round(face.length / 1.5))
    for post in range(count):
        at = face.at((post + 0.5) * face.length / count - 0.02)
        rail.block(at, ahead, 0.04, left, (-0.05, 0.0), (0.08, top[0]))


def _parapet(made: Slice, face: WallFace, height: float) -> None:
    """A wind screen of glass on a low wall, round what lies in the open air."""
    wall = surfaces.wall(face.part.wall_material)
    builder = made.builders["wall", wall]
    low_wall = 0.9
    holes = [h for h in face.holes if h[2] < low_wall]
    for low, high, bottom, top in _solid_of(face.length, low_wall, holes):
        _upright(builder, face, (low, high), (bottom, top), 0.0, _wall_uv(face, height))
    pane = surfaces.solid(0.80, 0.91, 0.94, 0.10)
    metal = surfaces.solid(0.55, 0.57, 0.59)
    taken = sorted((h[0], h[1]) for h in face.holes)
    at = 0.0
    for low, high in [*taken, (face.length, face.length)]:
        if low - at > 0.1:
            _upright(
                made.builders["wall", pane], face, (at, low), (low_wall, height), 0
            )
            count = max(1, math.ceil((low - at) / 1.8))
            for post in range(count + 1):
                x = at + (low - at - 0.05) * post / count
                _bar(made, metal, face, (x, x + 0.05), (low_wall, height))
            _bar(made, metal, face, (at, low), (low_wall, low_wall + 0.05))
            _bar(made, metal, face, (at, low), (height - 0.05, height))
        at = max(at, high)
    _shade(made, face, list(face.holes))


def _shaft(hole: Polygon, height: float) -> Slice:
    """The inside of a hole with a balustrade, down to a floor below."""
    made = Slice(np.array(hole.exterior.coords)[:, :2])
    flat = np.array([[1 / BAY, 0.0], [0.0, 1 / BAY], [0.0, 0.0]])
    made.builders["beyond", surfaces.floor("tile")].polygon(
        hole, -SHAFT_DEPTH, flat, up=True
    )
    kind = "slats" if height >= HIGH_CEILING else "panels"
    made.builders["ceiling", surfaces.ceiling(kind)].polygon(
        hole, height, flat, up=False
    )
    wall = made.builders["beyond", surfaces.solid(0.62, 0.61, 0.59)]
    ring = orient(hole).exterior.coords
    for (ax, ay, *_), (bx, by, *_) in zip(ring, ring[1:], strict=False):
        wall.quad([
            (bx, by, -SHAFT_DEPTH),
            (ax, ay, -SHAFT_DEPTH),
            (ax, ay, 0.0),
            (bx, by, 0.0),
        ])
    return made
