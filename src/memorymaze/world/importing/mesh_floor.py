"""The walkable floor of a mesh: its level faces, cut by what stands in the way."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString, Polygon
from trimesh import Trimesh
from trimesh.intersections import mesh_plane

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.world.importing.shapes import polygons
from memorymaze.world.looks.building_mesh import (
    FLAT,
    MeshPiece,
    face_normals,
    levels,
)
from memorymaze.world.sites.floor_rules import PASSABLE_RADIUS

STEP = 0.1
"""Metres that a floor may rise or fall and still be walked over."""
SLICES = (0.15, 0.3, 0.5, 0.75, 1.0, 1.25, 1.5)
"""Metres above the floor at which walls and obstacles are looked for."""
CRACK = 0.02
"""Metres by half of gaps between faces that are closed."""
BACK_TO_WALL = 1.5
"""Radii of the robot beside where its middle can be that are floor: its corners too."""


@dataclass(frozen=True)
class MeshFloor:
    """The largest floor in a mesh."""

    polygon: Polygon
    height: float
    """Metres in the mesh."""
    ceiling: float | None
    """Metres above the floor; None where the mesh has none."""
    left_out: float
    """Square metres of other floor that a robot could drive on, behind walls or doors."""


def mesh_floor_of(
    pieces: Sequence[MeshPiece], doors: Sequence[Polygon] = ()
) -> MeshFloor:
    """Return the largest floor that a robot drives over; doors are closed."""
    height, ceiling = levels(pieces)
    ground = shapely.union_all(
        list(_level_shapes(pieces, height - STEP, height + STEP))
    )
    ground = ground.buffer(CRACK, join_style="mitre").buffer(-CRACK, join_style="mitre")
    standing = shapely.union_all([
        *shapely.buffer(_walls(pieces, height), CRACK, quad_segs=1, cap_style="square"),
        *_level_shapes(pieces, height + SLICES[0], height + SLICES[-1]),
        *doors,
    ])
    free = [
        part.buffer(CRACK, join_style="mitre") for part in polygons(ground - standing)
    ]
    reached = sorted(
        (found for part in free if (found := _driven(part)) is not None),
        key=lambda part: -part.area,
    )
    if not reached:
        raise ImportFileError(
            f"expected floor for a robot of {PASSABLE_RADIUS:g} m radius, got none at the "
            f"height {height:.2f}, where the mesh has most level faces"
        )
    beside = standing.buffer(3 * CRACK, quad_segs=1)
    walled = [part for part in reached if _is_walled(part, beside)] or reached
    left_out = sum(part.area for part in walled[1:])
    return MeshFloor(walled[0], height, ceiling, left_out)


def _is_walled(part: Polygon, walls: shapely.Geometry) -> bool:
    """Tell whether walls stand around a piece of floor; else it is the ground outside."""
    edge = part.exterior
    return edge.intersection(walls).length > edge.length / 2


def _level_shapes(
    pieces: Sequence[MeshPiece], low: float, high: float
) -> Iterator[Polygon]:
    """Yield what level faces between two heights cover of the plan."""
    for piece in pieces:
        across = face_normals(piece)
        level = np.abs(across[:, 2]) > FLAT * np.linalg.norm(across, axis=1)
        heights = piece.triangles[:, :, 2].mean(axis=1)
        chosen = level & (heights > low) & (heights < high) & (across[:, 2] != 0)
        yield from map(Polygon, piece.triangles[chosen][:, :, :2])


def _walls(pieces: Sequence[MeshPiece], floor: float) -> list[LineString]:
    """Return the lines in which level planes cut the mesh."""
    cuts: list[FloatArray] = []
    for piece in pieces:
        mesh = Trimesh(piece.vertices, piece.faces, process=False)
        for height in SLICES:
            found = np.asarray(mesh_plane(mesh, (0, 0, 1), (0, 0, floor + height)))
            cuts.append(np.round(found.reshape(-1, 2, 3)[:, :, :2], 3).astype(float))
    lines = np.concatenate(cuts)
    turned = (lines[:, 0] > lines[:, 1]).any(axis=1)  # the same from both sides
    lines[turned] = lines[turned, ::-1]
    return [LineString(line) for line in np.unique(lines, axis=0)]


def _driven(part: Polygon) -> Polygon | None:
    """Return what a robot drives over of a piece of floor."""
    core = polygons(part.buffer(-PASSABLE_RADIUS))
    if not core:
        return None
    near = core[0].buffer(BACK_TO_WALL * PASSABLE_RADIUS).intersection(part)
    around = [
        polygon
        for each in polygons(near)
        for polygon in polygons(each.simplify(CRACK / 2))
    ]
    return around[0] if around else None
