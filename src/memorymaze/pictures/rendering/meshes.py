"""Collects quads and polygons of one material and makes one mesh of them."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from shapely import Polygon

from memorymaze.pictures.looks.assembly import MeshPart
from memorymaze.pictures.looks.materials import Material

Vector = tuple[float, float, float]


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
        """Add flat triangles.

        Args:
            vertices: (N, 3) metres.
            faces: (M, 3) numbers of these vertices.
            normal: Of all of them.
            uv: (N, 2), v downwards.
        """
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
        """Add a level polygon at a height.

        Args:
            polygon: Outline, metres.
            height: Metres.
            uv_of: Turns (x, y, 1) into (u, v), shape (3, 2).
            up: Whether it is seen from above, else from below.
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
        """Add an upright box.

        Args:
            start: Where it begins, metres.
            along: Unit vector of its length.
            length: Metres.
            out: Unit vector across it, to the right-hand rule's left of `along`.
            depth: From and to along `out`, metres.
            height: From and to, metres.
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
