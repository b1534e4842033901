"""Meshes of one floor from a file: named pieces with z up, in metres."""

import io
import re
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.input_files import read_file

FORMATS = (".glb", ".obj")
MOST_TRIANGLES = 2_000_000
STOREY = (1.8, 15.0)
"""Metres that the mesh of one floor is high."""
UNITS = {"metres": 1.0, "centimetres": 0.01, "millimetres": 0.001}
BIN = 0.05
"""Metres of height in which level faces count as one level."""
LARGE = 0.4
"""Of the largest level's area that makes a level a floor or a ceiling."""
LEAST_HEADROOM = 1.8
"""Metres between floor and ceiling."""
FLAT = 0.98
"""Least share of a face's normal that points up or down where it is level."""

Faces = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class MeshPiece:
    """A node of a scene with its mesh, in metres, z up."""

    name: str
    vertices: FloatArray
    faces: Faces
    visual: Any = None
    """How it looks, as trimesh has it."""

    @property
    def triangles(self) -> FloatArray:
        """Corners, (n, 3, 3)."""
        return self.vertices[self.faces]


def read_mesh(
    path: Path, *, with_looks: bool = False
) -> tuple[list[MeshPiece], list[str]]:
    """Return the pieces of a GLB or OBJ file, and what was guessed of its frame."""
    if path.suffix.lower() not in FORMATS:
        raise ImportFileError(
            f"{path}: expected a mesh as {' or '.join(FORMATS)}, got {path.suffix!r}"
        )
    kind = path.suffix.lower()[1:]
    pieces = list(_pieces(_scene(path, kind, with_looks=with_looks)))
    count = sum(len(piece.faces) for piece in pieces)
    if not 0 < count <= MOST_TRIANGLES:
        raise ImportFileError(
            f"{path}: expected 1 to {MOST_TRIANGLES:,} triangles, got {count:,}"
        )
    if not all(np.isfinite(piece.vertices).all() for piece in pieces):
        raise ImportFileError(f"{path}: expected finite coordinates, got others")
    guessed: list[str] = []
    if kind == "glb" or _level_area(pieces, 1) > _level_area(pieces, 2):
        # (x, y, z) with y up is (x, -z, y) with z up.
        pieces = [
            _changed(piece, piece.vertices[:, [0, 2, 1]] * (1, -1, 1))
            for piece in pieces
        ]
        guessed += ["up: along y, where most faces are level"] if kind == "obj" else []
    elif kind == "obj":
        guessed.append("up: along z, where most faces are level")
    heights = np.concatenate([piece.vertices[:, 2] for piece in pieces])
    high = float(heights.max() - heights.min())
    unit = next(
        (name for name, size in UNITS.items() if STOREY[0] <= high * size <= STOREY[1]),
        None,
    )
    if unit is None:
        raise ImportFileError(
            f"{path}: expected the mesh of one floor, {STOREY[0]:g} to {STOREY[1]:g} m high "
            f"(or in cm or mm), got {high:.3g}; cut out one floor, or scale it to metres"
        )
    if unit != "metres" or kind == "obj":
        guessed.append(f"unit: {unit}, as the mesh is {high:.4g} high")
    size = UNITS[unit]
    return [_changed(piece, piece.vertices * size) for piece in pieces], guessed


def _scene(path: Path, kind: str, *, with_looks: bool) -> Any:
    """Return what trimesh reads; other files that this one names are not read."""
    import trimesh

    content = read_file(path, ImportFileError)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return trimesh.load_scene(
                io.BytesIO(content),
                file_type=kind,
                process=False,
                skip_materials=not with_looks,
            )
    except Exception as problem:  # the reader raises whatever the file brings about
        raise ImportFileError(
            f"{path}: expected a mesh as {kind.upper()}, got: {problem}"
        ) from None


def _pieces(scene: Any) -> Iterator[MeshPiece]:
    """Yield a piece for each node that has a mesh, and material of it."""
    parents = scene.graph.transforms.parents
    for node in scene.graph.nodes:
        matrix, name = scene.graph.get(node)
        mesh = scene.geometry.get(name)
        faces = getattr(mesh, "faces", ())
        if not len(faces):
            continue
        corners = np.asarray(mesh.vertices, dtype=np.float64)
        vertices = corners @ matrix[:3, :3].T + matrix[:3, 3]
        numbers = np.asarray(faces, dtype=np.int64).reshape(-1, 3)
        # Of a mesh of several materials trimesh makes nodes within its node.
        whole = str(parents.get(node))
        part = re.fullmatch(re.escape(whole) + "_[0-9a-f]{6}", str(node))
        yield MeshPiece(
            whole if part else str(node),
            vertices,
            numbers,
            getattr(mesh, "visual", None),
        )


def _changed(piece: MeshPiece, vertices: FloatArray) -> MeshPiece:
    return replace(piece, vertices=vertices)


def _level_area(pieces: list[MeshPiece], axis: int) -> float:
    """Return the area of faces that are level if an axis points up."""
    return (
        sum(
            float(
                np.linalg.norm(n, axis=1)[
                    np.abs(n[:, axis]) > FLAT * np.linalg.norm(n, axis=1)
                ].sum()
            )
            for n in map(face_normals, pieces)
        )
        / 2
    )


def face_normals(piece: MeshPiece) -> FloatArray:
    """Return the normals of a piece's faces, twice their area long."""
    a, b, c = piece.triangles.transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def levels(pieces: Sequence[MeshPiece]) -> tuple[float, float | None]:
    """Return the heights of the floor and, above it, of the ceiling."""
    heights = np.concatenate([
        piece.triangles[:, :, 2].mean(axis=1) for piece in pieces
    ])
    across = np.concatenate([face_normals(piece) for piece in pieces])
    areas = np.linalg.norm(across, axis=1) / 2
    slopes = across[:, 2] / np.maximum(2 * areas, 1e-12)
    up = slopes > FLAT
    if areas[up].sum() < 0.1 * areas[np.abs(slopes) > FLAT].sum():
        up = np.abs(slopes) > FLAT  # its faces do not tell their sides
    floors = _large_levels(heights[up], areas[up])
    if not floors:
        raise ImportFileError("expected level faces to walk on, got none")
    floor = floors[0]
    level = np.abs(slopes) > FLAT
    above = level & (heights > floor + LEAST_HEADROOM)
    ceilings = _large_levels(heights[above], areas[above])
    return floor, ceilings[0] - floor if ceilings else None


def _large_levels(heights: FloatArray, areas: FloatArray) -> list[float]:
    """Return the heights at which there is much area, the lowest first."""
    if not len(heights) or areas.sum() <= 0:
        return []
    bins = np.round(heights / BIN).astype(int)
    lowest = bins.min()
    found = np.bincount(bins - lowest, weights=areas)
    sums = np.bincount(bins - lowest, weights=areas * heights)
    large = np.flatnonzero(found >= LARGE * found.max())
    return [float(sums[each] / found[each]) for each in large]
