"""Meshes of a building: records, a builder, slices seen or left out together, walls."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from shapely import Polygon

from memorymaze.world.looks import surfaces
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.floor_plan import BAY, Hole, WallFace
from memorymaze.world.looks.materials import Material
from memorymaze.world.sites.scene_objects import SceneObject

Vector = tuple[float, float, float]
Circle = tuple[float, float, float]
"""On the plan: x, y and radius, metres."""
MeshKind = Literal["floor", "ceiling", "wall", "beyond", "decal"]
"""What a mesh belongs to; `beyond` is seen through glass, `decal` is a mere shade."""
Uv = Callable[[float, float], tuple[float, float]]
"""What gives a point of a wall, along and above, its place in the picture."""
SKIRTING_HEIGHT = 0.09
"""Metres."""
HIGH_CEILING = 4.0
"""Ceilings from here on are slats with hanging lamps, metres."""
SHADE_WIDTH = 0.28


class MeshBuilder:
    """Grows a mesh; triangles are counter-clockwise as seen from outside."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self._vertices: list[NDArray[np.float64]] = []
        self._normals: list[NDArray[np.float64]] = []
        self._uv: list[NDArray[np.float64]] = []
        self._faces: list[NDArray[np.int64]] = []
        self._count = 0

    def add(
        self, vertices: ArrayLike, faces: ArrayLike, normal: Vector, uv: ArrayLike
    ) -> None:
        """Add flat triangles (M, 3) of vertices (N, 3); v of (N, 2) goes downwards."""
        points = np.asarray(vertices, dtype=np.float64)
        self._vertices.append(points)
        self._normals.append(
            np.tile(np.array(normal, dtype=np.float64), (len(points), 1))
        )
        self._uv.append(np.asarray(uv, dtype=np.float64))
        self._faces.append(np.asarray(faces, dtype=np.int64) + self._count)
        self._count += len(points)

    def quad(
        self,
        corners: Sequence[Vector],
        uv: Sequence[tuple[float, float]] | None = None,
    ) -> None:
        """Add a flat four-sided face, its corners counter-clockwise from outside."""
        a, b, c = (np.array(corner) for corner in corners[:3])
        across = np.cross(b - a, c - b)
        size = float(np.linalg.norm(across))
        if size < 1e-9:
            return
        normal = (across / size).tolist()
        if uv is None:
            uv = ((0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0))
        self.add(corners, ((0, 1, 2), (0, 2, 3)), tuple(normal), uv)

    def polygon(
        self, polygon: Polygon, height: float, uv_of: NDArray[np.float64], *, up: bool
    ) -> None:
        """Add a level polygon at a height, seen from above (`up`) or from below.

        `uv_of` (3, 2) turns (x, y, 1) into (u, v).
        """
        triangles = shapely.constrained_delaunay_triangles(polygon)
        for triangle in triangles.geoms:
            points = shapely.get_coordinates(triangle)[:3]
            first, second = points[1] - points[0], points[2] - points[0]
            if (first[0] * second[1] - first[1] * second[0] > 0) != up:
                points = points[::-1]
            with_one = np.column_stack([points, np.ones(3)])
            self.add(
                np.column_stack([points, np.full(3, height)]),
                ((0, 1, 2),),
                (0.0, 0.0, 1.0 if up else -1.0),
                with_one @ uv_of,
            )

    def block(
        self,
        start: tuple[float, float],
        along: tuple[float, float],
        length: float,
        out: tuple[float, float],
        depth: tuple[float, float],
        height: tuple[float, float],
    ) -> None:
        """Add an upright box from a place `along` a unit vector for a length in metres.

        `depth` is from and to along `out`, the unit vector to the left of `along`.
        """

        def corner(a: float, d: float, z: float) -> Vector:
            return (
                start[0] + along[0] * a + out[0] * d,
                start[1] + along[1] * a + out[1] * d,
                z,
            )

        (d0, d1), (z0, z1), n = depth, height, length
        faces = (
            ((0, d1, z0), (n, d1, z0), (n, d1, z1), (0, d1, z1)),
            ((n, d0, z0), (0, d0, z0), (0, d0, z1), (n, d0, z1)),
            ((0, d0, z0), (0, d1, z0), (0, d1, z1), (0, d0, z1)),
            ((n, d1, z0), (n, d0, z0), (n, d0, z1), (n, d1, z1)),
            ((0, d1, z1), (n, d1, z1), (n, d0, z1), (0, d0, z1)),
            ((0, d0, z0), (n, d0, z0), (n, d1, z0), (0, d1, z0)),
        )
        # `out` lies to the left of `along`, seen from above: mirror the winding.
        for face in faces:
            self.quad([corner(*each) for each in reversed(face)])

    @property
    def is_empty(self) -> bool:
        """Whether nothing was added."""
        return not self._count

    def part(self, material: Material) -> MeshPart:
        """Return the mesh."""
        return MeshPart(
            np.concatenate(self._vertices).astype(np.float32),
            np.concatenate(self._faces).astype(np.int32),
            np.concatenate(self._normals).astype(np.float32),
            np.concatenate(self._uv).astype(np.float32),
            material,
        )


@dataclass(frozen=True, slots=True, eq=False)
class PlacedMeshes:
    """Meshes of one thing at one place."""

    parts: Sequence[MeshPart]
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class BuildingMesh:
    """A piece of a building, small enough to be left out of pictures unseen."""

    owner: str
    """Id of the feature of the plan that it is or belongs to; of a piece of a building's own
    mesh the name that it has there."""
    kind: MeshKind | Literal["door", "landmark"]
    placed: PlacedMeshes
    circle: Circle
    """What it keeps within on the plan."""
    thing: SceneObject | None = None
    """What it is, of a door or a landmark."""
    shows_sky: bool = False
    """Whether one may see the sky through it or past it."""


class Building(NamedTuple):
    """What a building looks like, or all of it but its doors and landmarks."""

    meshes: Sequence[BuildingMesh]
    """Floor with all around it; doors and landmarks, in the plan's order; their shades."""
    hiding: NDArray[np.float64]
    """Pieces of wall that hide what is behind, (n, 4): x, y to x, y, metres."""


@dataclass(eq=False)
class Slice:
    """Meshes that are seen or left out together."""

    points: NDArray[np.float64]
    """Corners of what it covers on the plan, (N, 2) metres."""
    part_of: str
    """Id of the area, corridor or turning point it belongs to."""
    shows_sky: bool = False
    """Whether one may see the sky through it or over it."""
    builders: dict[tuple[MeshKind, Material], MeshBuilder] = field(
        default_factory=lambda: defaultdict(MeshBuilder)
    )

    def meshes(self) -> Iterator[BuildingMesh]:
        """Yield its meshes."""
        middle = (self.points.min(axis=0) + self.points.max(axis=0)) / 2
        reach = np.hypot(*(self.points - middle).T).max() + 0.1
        circle = (float(middle[0]), float(middle[1]), float(reach))
        for (kind, material), builder in self.builders.items():
            if not builder.is_empty:
                placed = PlacedMeshes((builder.part(material),))
                yield BuildingMesh(
                    self.part_of, kind, placed, circle, shows_sky=self.shows_sky
                )


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


def shade_foot(made: Slice, face: WallFace, holes: list[Hole]) -> None:
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
