"""The plan that is drawn: floor in parts, faces of walls, what breaks them.

Plain geometry: no mesh, no material.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from shapely import (
    LineString,
    Point,
    Polygon,
    STRtree,
    box,
    get_coordinates,
    prepare,
    transform,
    unary_union,
)
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from memorymaze.world.looks.doors import is_seen_through as door_is_seen_through
from memorymaze.world.looks.windows import is_window
from memorymaze.world.sites.floor_surfaces import cut_up, polygons_of, surface_pieces
from memorymaze.world.sites.records import Area, Corridor, Site
from memorymaze.world.sites.solids import door_solid, landmark_solid

BAY = 2.4
"""Metres between lamps; the pictures of floors, walls and ceilings repeat with it."""
SLICE = 6.0
"""Longest edge of the pieces into which parts are cut, metres."""
Behind = Literal["outdoors", "room"]
HollowOutline = list[tuple[float, float]]
"""Of what is hollow behind a wall, closed: metres along and behind it."""
DEEPEST = 2.6
"""Metres that a room is seen deep."""
SHALLOWEST = 0.12
CLEAR = 0.02
"""Metres that what is seen behind a wall keeps off the floor."""
ROOM_WALL = 0.5
"""Metres of wall between a room of the plan and the floor, at most."""
DOUBLE_WALL = 0.8
"""Between floors nearer than this there is wall, not open air, metres."""
NEAR_WALL = 0.4
"""Metres between a wall and the middle of what breaks it, at most."""
STEP = 0.05
"""Metres from the wall at which the floor beside it is looked up."""
SHORTEST = 0.01


@dataclass(frozen=True, eq=False)
class FloorPart:
    """A piece of floor that no other part overlaps."""

    id: str
    """Of the area, corridor or turning point it is a piece of."""
    polygon: Polygon
    floor_material: str
    wall_material: str
    open_air: bool
    x: float
    """Where its pattern begins, metres."""
    y: float
    """Where its pattern begins, metres."""
    heading: float
    """Along which its pattern runs, radians."""
    width: float
    """Metres across the heading."""
    is_hall: bool
    """Whether it is an area or the middle of one, not a way."""

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points along and across the part's pattern, metres, (N, 2)."""
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        offsets = points - np.array([self.x, self.y])
        return offsets @ np.array([[cosine, -sine], [sine, cosine]])

    def world(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where points along and across the pattern lie in the world, (N, 2)."""
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        return points @ np.array([[cosine, sine], [-sine, cosine]]) + (self.x, self.y)


def floor_parts(site: Site) -> list[FloorPart]:
    """Cut the walkable floor into parts: areas first, then corridors, then the rest."""
    return [_part(*piece) for piece in surface_pieces(site)]


def sliced(part: FloorPart) -> Iterator[Polygon]:
    """Yield the part in pieces of at most `SLICE` by `SLICE`, along its own heading."""
    yield from cut_up(part.polygon, SLICE, part.heading, (part.x, part.y))


def _part(identity: str, source: Area | Corridor, piece: Polygon) -> FloorPart:
    if isinstance(source, Corridor):
        (ax, ay), (bx, by) = source.centre_line.coords
        heading = math.atan2(by - ay, bx - ax)
        x, y, width = ax, ay, source.width
        # Lamps stand in the middles of bays: share the corridor's length evenly.
        spare = source.length % BAY
        x += math.cos(heading) * spare / 2
        y += math.sin(heading) * spare / 2
        open_air = False
    else:
        heading, width = _long_direction(source.polygon)
        x, y = source.polygon.centroid.coords[0]
        open_air = source.open_air
    return FloorPart(
        identity,
        piece,
        source.floor_material,
        source.wall_material,
        open_air,
        x,
        y,
        heading,
        width,
        isinstance(source, Area),
    )


def _long_direction(polygon: Polygon) -> tuple[float, float]:
    """Return heading of the longest side, and the extent across it."""
    ring = np.array(polygon.exterior.coords)[:, :2]
    edges = np.diff(ring, axis=0)
    longest = edges[int(np.argmax(np.hypot(edges[:, 0], edges[:, 1])))]
    heading = math.atan2(longest[1], longest[0])
    across = ring @ np.array([-math.sin(heading), math.cos(heading)])
    return heading, float(across.max() - across.min())


@dataclass(frozen=True, slots=True)
class Opening:
    """A rectangle in a wall that is not wall."""

    x: float
    """Middle, metres."""
    y: float
    """Middle, metres."""
    heading: float
    """Across the wall, to either side, radians."""
    half_width: float
    """Metres."""
    bottom: float
    """Metres over the floor."""
    top: float
    """Metres over the floor."""


def openings_of(site: Site) -> list[Opening]:
    """Return where windows, glazed doors and open doors break the walls."""
    openings: list[Opening] = []
    for door in site.doors:
        if door_is_seen_through(door):
            solid = door_solid(door, site)
            x, y, _ = solid.position
            _, half, half_height = solid.half_size
            openings.append(
                Opening(x, y, solid.heading, half - 0.02, 0.0, 2 * half_height - 0.02)
            )
    for landmark in site.landmarks:
        if is_window(landmark):
            solid = landmark_solid(landmark, site)
            x, y, z = solid.position
            _, half, half_height = solid.half_size
            openings.append(
                Opening(
                    x,
                    y,
                    solid.heading,
                    half - 0.03,
                    z - half_height + 0.03,
                    z + half_height - 0.03,
                )
            )
    return openings


@dataclass(frozen=True, slots=True)
class _Edge:
    """A straight piece of the floor's boundary, with the floor to its left."""

    x: float
    """Where it begins, metres."""
    y: float
    ux: float
    """Unit vector along it."""
    uy: float
    length: float
    """Metres."""

    def at(self, along: float, out: float = 0.0) -> tuple[float, float]:
        """Return a point along it, `out` metres before it, on the floor's side."""
        return (
            self.x + self.ux * along - self.uy * out,
            self.y + self.uy * along + self.ux * out,
        )

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points as metres along it and behind it, (N, 2)."""
        offsets = points - (self.x, self.y)
        return offsets @ np.array([[self.ux, self.uy], [self.uy, -self.ux]])

    @property
    def heading(self) -> float:
        """From the wall into the floor, radians."""
        return math.atan2(self.ux, -self.uy)


Hole = tuple[float, float, float, float]
"""An opening in a wall: from and to along it, bottom and top, metres."""


@dataclass(frozen=True, slots=True)
class WallFace(_Edge):
    """A straight, upright rectangle beside one part of the floor."""

    part: FloorPart
    """The floor beside it."""
    ring: int
    """0 on the floor's outer boundary, n on that of its n-th hole."""
    starts_at_corner: bool
    """Whether the wall bends where it begins."""
    ends_at_corner: bool
    holes: tuple[Hole, ...]
    """Openings within its length."""


def wall_faces(
    floor: Polygon, parts: Sequence[FloorPart], openings: Sequence[Opening]
) -> Iterator[WallFace]:
    """Yield the faces along the floor's boundary, at most `SLICE` metres long.

    The floor's parts tell the material of the wall beside each.
    """
    tree = STRtree([part.polygon for part in parts])
    turned = orient(floor)
    for number, ring in enumerate([turned.exterior, *turned.interiors]):
        corners = [(x, y) for x, y, *_ in ring.coords]
        for (ax, ay), (bx, by) in pairwise(corners):
            length = math.hypot(bx - ax, by - ay)
            if length < SHORTEST:
                continue
            edge = _Edge(ax, ay, (bx - ax) / length, (by - ay) / length, length)
            holes = list(_holes(edge, openings))
            for low, high, part in _pieces(edge, parts, tree):
                inside = tuple(
                    (max(a, low) - low, min(b, high) - low, z0, z1)
                    for a, b, z0, z1 in holes
                    if min(b, high) - max(a, low) > SHORTEST
                )
                yield WallFace(
                    *edge.at(low),
                    edge.ux,
                    edge.uy,
                    high - low,
                    part,
                    number,
                    low == 0.0,
                    high == length,
                    inside,
                )


def _holes(edge: _Edge, openings: Sequence[Opening]) -> Iterator[Hole]:
    for each in openings:
        dx, dy = each.x - edge.x, each.y - edge.y
        along, out = dx * edge.ux + dy * edge.uy, -dx * edge.uy + dy * edge.ux
        facing = -math.cos(each.heading) * edge.uy + math.sin(each.heading) * edge.ux
        if abs(out) > NEAR_WALL or abs(facing) < 0.95:
            continue
        low = max(along - each.half_width, 0.0)
        high = min(along + each.half_width, edge.length)
        if high - low > 0.05:
            yield low, high, each.bottom, each.top


def _pieces(
    edge: _Edge, parts: Sequence[FloorPart], tree: STRtree
) -> Iterator[tuple[float, float, FloorPart]]:
    """Cut an edge where the floor beside it changes, and into handy lengths."""
    inside = LineString([edge.at(0.0, STEP), edge.at(edge.length, STEP)])
    cuts = {0.0, edge.length}
    for index in tree.query(inside):
        shared = parts[index].polygon.intersection(inside)
        for piece in getattr(shared, "geoms", [shared]):
            if isinstance(piece, LineString) and not piece.is_empty:
                for x, y in (piece.coords[0], piece.coords[-1]):
                    along = (x - edge.x) * edge.ux + (y - edge.y) * edge.uy
                    cuts.add(min(max(along, 0.0), edge.length))
    for low, high in pairwise(_merged(sorted(cuts))):
        count = max(1, math.ceil((high - low) / SLICE))
        part = parts[int(tree.nearest(Point(edge.at((low + high) / 2, STEP))))]
        for number in range(count):
            start = low + (high - low) * number / count
            yield start, low + (high - low) * (number + 1) / count, part


def clear_of(
    length: float, taken: Iterable[tuple[float, float]]
) -> Iterator[tuple[float, float]]:
    """Yield what is left of a length without some stretches of it."""
    at = 0.0
    for low, high in [*sorted(taken), (length, length)]:
        if low > at:
            yield at, low
        at = max(at, high)


def _merged(cuts: list[float]) -> list[float]:
    kept = [cuts[0]]
    for cut in cuts[1:-1]:
        if cut - kept[-1] > SHORTEST and cuts[-1] - cut > SHORTEST:
            kept.append(cut)
    return [*kept, cuts[-1]]


class WallSurroundings:
    """Tells what is behind a place on a wall."""

    def __init__(self, site: Site) -> None:
        """Look at a site's rooms and floor."""
        self._floor: BaseGeometry = site.walkable_floor
        self._rooms = [room.polygon for room in site.rooms]
        outdoors = [area.polygon for area in site.areas if area.open_air]
        self._voids = [
            void
            for void in map(Polygon, site.walkable_floor.interiors)
            if all(void.distance(each) > DOUBLE_WALL for each in outdoors)
        ]
        prepare(self._floor)

    def behind(self, x: float, y: float, heading: float) -> tuple[Behind, float]:
        """Return what is behind a wall, and how many metres deep one can look into it."""
        dx, dy = math.cos(heading), math.sin(heading)
        near = Point(x + 0.5 * dx, y + 0.5 * dy)
        ray = LineString([
            (x + 0.08 * dx, y + 0.08 * dy),
            (x + 12 * dx, y + 12 * dy),
        ])
        crossed = ray.intersection(self._floor)
        way = 12.0
        if not crossed.is_empty:
            way = crossed.distance(Point(x, y))
        # A hole in the floor of a building is some part of it that the plan leaves out.
        hole = any(each.contains(near) for each in (*self._rooms, *self._voids))
        if hole or way < DOUBLE_WALL:
            return "room", max(SHALLOWEST, min(DEEPEST, way - 0.12))
        return "outdoors", way

    def hollow(
        self,
        face: WallFace,
        along: tuple[float, float],
        depth: float,
        *,
        room: bool = False,
    ) -> list[HollowOutline]:
        """Return what is hollow behind a piece of wall: no floor, of a room only it.

        It reaches `along` the wall from where to where, and so many metres deep at
        most. For a `room` only what rooms cover counts, where there are rooms.
        """
        low, high = along
        corners = [face.at(low), face.at(high), face.at(high, -depth)]
        strip = Polygon([*corners, face.at(low, -depth)])
        taken = self._floor.intersection(strip.buffer(2 * CLEAR))
        hollow = box(low, 0.0, high, depth).difference(
            transform(taken, face.local).buffer(CLEAR, join_style="mitre")
        )
        indoors = (*self._rooms, *self._voids)
        near = [each for each in indoors if each.distance(strip) < ROOM_WALL]
        if room and near:
            rooms = transform(unary_union(near), face.local)
            hollow = hollow.intersection(rooms.buffer(ROOM_WALL, join_style="mitre"))
        outlines: list[HollowOutline] = []
        for piece in polygons_of(hollow):
            outer = [(x, y) for x, y, *_ in orient(piece).exterior.coords]
            if min(y for _, y in outer) < 2 * CLEAR:
                outlines.append([(x, 0.0 if y < 2 * CLEAR else y) for x, y in outer])
        return outlines

    def off_floor(
        self, face: WallFace, along: tuple[float, float], behind: float
    ) -> list[tuple[float, float]]:
        """Return the stretches of a line behind a wall that do not lie in the floor."""
        line = LineString([face.at(each, -behind) for each in along])
        rest = line.difference(self._floor)
        stretches = [
            face.local(get_coordinates(piece))[:, 0]
            for piece in getattr(rest, "geoms", [rest])
            if not piece.is_empty
        ]
        return [(float(each.min()), float(each.max())) for each in stretches]
