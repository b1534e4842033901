"""A mesh of one floor: level faces to floor, what stands on it to walls, names to things."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import shapely
from shapely import LineString, MultiPoint

from memorymaze.errors import ImportFileError
from memorymaze.extras import require_extra
from memorymaze.importing.centre_lines import centre_lines
from memorymaze.importing.imported import (
    CEILING,
    CentreLine,
    ImportedSite,
    ImportNotes,
    site_plan,
)
from memorymaze.importing.obstacles import box_features, without_obstacles
from memorymaze.importing.ways import plan_floor
from memorymaze.wording import counted

BIT = 0.02
"""Square metres under which what stands free is nothing."""
DOOR_DEPTH = 0.02
"""Metres to both sides of a door's line that are no floor."""


def import_mesh(path: Path) -> ImportedSite:
    """Return the floor of a mesh as a plan, in metres of the mesh's frame.

    A point (x, y, z) of a glTF file is (x, -z) on the plan.
    """
    require_extra("mesh", "trimesh", purpose="reading meshes")
    from memorymaze.importing.mesh_features import by_kind, door_line, features_on
    from memorymaze.importing.mesh_floor import mesh_floor_of
    from memorymaze.pictures.building_mesh import read_mesh

    pieces, guessed = read_mesh(path)
    kinds = by_kind(pieces)
    doors = [door_line(piece).buffer(DOOR_DEPTH) for piece in kinds["door"]]
    try:
        found = mesh_floor_of(kinds["building"], doors)
    except ImportFileError as error:
        raise ImportFileError(f"{path}: {error}") from None
    notes = ImportNotes(guessed=guessed)
    floor, standing = without_obstacles(found.polygon)
    named = [
        (str(piece.extras["name"]), MultiPoint(piece.vertices[:, :2]).convex_hull)
        for piece in kinds["building"]
        if piece.extras.get("kind") == "corridor" and "name" in piece.extras
    ]
    lines = [_named(line, named) for line in centre_lines(floor)]
    planned = plan_floor(lines, notes, floor)
    features = features_on(planned.polygon, found.height, kinds, notes)
    boxes = list(
        box_features([each for each in standing if each.area >= BIT], planned.polygon)
    )
    bits = sum(each.area < BIT for each in standing)
    if bits:
        notes.guessed.append(f"{counted(bits, 'obstacle')} under {BIT:g} m²: floor")
    if boxes:
        notes.guessed.append(f"{counted(len(boxes), 'unnamed obstacle')}: boxes")
    if found.ceiling is None:
        notes.guessed.append(f"ceiling height: {CEILING} m, for the mesh has none")
    notes.guessed.append("materials")
    if found.left_out >= 1:
        notes.missing.append(
            f"{found.left_out:.0f} m² of other floor, behind walls or doors"
        )
    notes.missing.append("routes, and all names that the file's nodes do not have")
    said = next(
        (piece.extras for piece in pieces if "ceiling_height_m" in piece.extras), {}
    )
    plan = site_plan(
        path,
        said.get("title"),
        said.get("floor", "ground floor"),
        None,
        [*planned.features, *features, *boxes],
        round(found.ceiling or CEILING, 2),
    )
    return notes.imported({**plan, "anchor": said.get("anchor")})


def _named(
    line: CentreLine, named: Sequence[tuple[str, shapely.Geometry]]
) -> CentreLine:
    """Return a line with the name of the corridor that most of it lies in."""
    way = LineString(line.points)
    for name, corridor in named:
        if way.intersection(corridor).length > way.length / 2:
            return replace(line, name=name)
    return line
