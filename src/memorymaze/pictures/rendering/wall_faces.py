"""The faces of the walls towards the floor, with what breaks them; plain geometry."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.polygon import orient

from memorymaze.pictures.rendering.floor_parts import SLICE, FloorPart
from memorymaze.pictures.rendering.openings import Opening

NEAR_WALL = 0.4
"""Metres between a wall and the middle of what breaks it, at most."""
STEP = 0.05
"""Metres from the wall at which the floor beside it is looked up."""
SHORTEST = 0.01


@dataclass(frozen=True, slots=True)
class WallFace:
    """A straight, upright rectangle beside one part of the floor."""

    x: float
    """Where it begins, metres; the floor is to the left of its direction."""
    y: float
    ux: float
    """Unit vector along it."""
    uy: float
    length: float
    """Metres."""
    part: FloorPart
    """The floor beside it."""
    ring: int
    """0 on the floor's outer boundary, n on that of its n-th hole."""
    starts_at_corner: bool
    """Whether the wall bends where it begins."""
    ends_at_corner: bool
    holes: tuple[tuple[float, float, float, float], ...]
    """Openings: from and to along it, bottom and top, metres; within its length."""

    def at(self, along: float, out: float = 0.0) -> tuple[float, float]:
        """Return a point along it, `out` metres before it, on the floor's side."""
        return (
            self.x + self.ux * along - self.uy * out,
            self.y + self.uy * along + self.ux * out,
        )

    @property
    def heading(self) -> float:
        """From the wall into the floor, radians."""
        return math.atan2(self.ux, -self.uy)


def wall_faces(
    floor: Polygon, parts: Sequence[FloorPart], openings: Sequence[Opening]
) -> Iterator[WallFace]:
    """Yield the faces along the floor's boundary, at most `SLICE` metres long.

    Args:
        floor: Walkable floor.
        parts: Its parts, for the material of the wall beside each.
        openings: What breaks the walls.
    """
    tree = STRtree([part.polygon for part in parts])
    turned = orient(floor)
    for number, ring in enumerate([turned.exterior, *turned.interiors]):
        corners = [(x, y) for x, y, *_ in ring.coords]
        for (ax, ay), (bx, by) in pairwise(corners):
            length = math.hypot(bx - ax, by - ay)
            if length < SHORTEST:
                continue
            ux, uy = (bx - ax) / length, (by - ay) / length
            holes = list(_holes(ax, ay, ux, uy, length, openings))
            yield from _pieces(ax, ay, ux, uy, length, parts, tree, number, holes)


def _holes(
    ax: float,
    ay: float,
    ux: float,
    uy: float,
    length: float,
    openings: Sequence[Opening],
) -> Iterator[tuple[float, float, float, float]]:
    for each in openings:
        dx, dy = each.x - ax, each.y - ay
        along, out = dx * ux + dy * uy, -dx * uy + dy * ux
        facing = -math.cos(each.heading) * uy + math.sin(each.heading) * ux
        if abs(out) > NEAR_WALL or abs(facing) < 0.95:
            continue
        low = max(along - each.half_width, 0.0)
        high = min(along + each.half_width, length)
        if high - low > 0.05:
            yield low, high, each.bottom, each.top


def _pieces(
    ax: float,
    ay: float,
    ux: float,
    uy: float,
    length: float,
    parts: Sequence[FloorPart],
    tree: STRtree,
    ring: int,
    holes: Sequence[tuple[float, float, float, float]],
) -> Iterator[WallFace]:
    """Cut an edge where the floor beside it changes, and into handy lengths."""
    inside = LineString([
        (ax - uy * STEP, ay + ux * STEP),
        (ax + ux * length - uy * STEP, ay + uy * length + ux * STEP),
    ])
    cuts = {0.0, length}
    for index in tree.query(inside):
        shared = parts[index].polygon.intersection(inside)
        for piece in getattr(shared, "geoms", [shared]):
            if isinstance(piece, LineString) and not piece.is_empty:
                for x, y in (piece.coords[0], piece.coords[-1]):
                    cuts.add(min(max((x - ax) * ux + (y - ay) * uy, 0.0), length))
    ends = _merged(sorted(cuts))
    for low, high in pairwise(ends):
        count = max(1, math.ceil((high - low) / SLICE))
        middle = (low + high) / 2
        beside = Point(ax + ux * middle - uy * STEP, ay + uy * middle + ux * STEP)
        part = parts[int(tree.nearest(beside))]
        for number in range(count):
            start = low + (high - low) * number / count
            end = low + (high - low) * (number + 1) / count
            yield WallFace(
                ax + ux * start,
                ay + uy * start,
                ux,
                uy,
                end - start,
                part,
                ring,
                start == 0.0,
                end == length,
                tuple(
                    (max(a, start) - start, min(b, end) - start, z0, z1)
                    for a, b, z0, z1 in holes
                    if min(b, end) - max(a, start) > SHORTEST
                ),
            )


def _merged(cuts: list[float]) -> list[float]:
    kept = [cuts[0]]
    for cut in cuts[1:-1]:
        if cut - kept[-1] > SHORTEST and cuts[-1] - cut > SHORTEST:
            kept.append(cut)
    return [*kept, cuts[-1]]
