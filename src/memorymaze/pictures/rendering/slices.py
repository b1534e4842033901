"""Pieces of a building that are seen or left out together, and rectangles on walls."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from memorymaze.pictures.looks import surfaces
from memorymaze.pictures.looks.assembly import MeshPart
from memorymaze.pictures.looks.materials import Material
from memorymaze.pictures.rendering.floor_parts import BAY
from memorymaze.pictures.rendering.meshes import MeshBuilder
from memorymaze.pictures.rendering.wall_faces import WallFace

Kind = Literal["floor", "ceiling", "wall", "beyond", "decal"]
"""What a mesh belongs to; `beyond` is seen through glass, `decal` is a mere shade."""

Hole = tuple[float, float, float, float]
Uv = Callable[[float, float], tuple[float, float]]
"""What gives a point of a wall, along and above, its place in the picture."""

SKIRTING_HEIGHT = 0.09
"""Metres."""
HIGH_CEILING = 4.0
"""Ceilings from here on are slats with hanging lamps, metres."""
SHADE_WIDTH = 0.28


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


def ceiling_kind(height: float) -> str:
    """Return the kind of ceiling that suits a height in metres."""
    return "slats" if height >= HIGH_CEILING else "panels"


def upright(
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


def solid_of(
    length: float, height: float, holes: list[Hole]
) -> Iterator[tuple[float, float, float, float]]:
    """Yield the rectangles that are left of a wall without its holes."""
    cuts = sorted({0.0, length, *(h[0] for h in holes), *(h[1] for h in holes)})
    for low, high in pairwise(cuts):
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


def wall_uv(face: WallFace, height: float) -> Uv:
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


def foot_shade(made: Slice, face: WallFace, holes: list[Hole]) -> None:
    """Darken the floor along the foot of the wall."""
    builder = made.builders["decal", surfaces.foot_shade()]
    for low, high, bottom, _ in solid_of(face.length, SKIRTING_HEIGHT, holes):
        if bottom > 0:
            continue
        (ax, ay), (bx, by) = face.at(low), face.at(high)
        (cx, cy), (dx, dy) = face.at(high, SHADE_WIDTH), face.at(low, SHADE_WIDTH)
        z = 0.004
        builder.quad(
            [(ax, ay, z), (bx, by, z), (cx, cy, z), (dx, dy, z)],
            [(0.5, 0.02), (0.5, 0.02), (0.5, 0.98), (0.5, 0.98)],
        )
