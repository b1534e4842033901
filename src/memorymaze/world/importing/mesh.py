"""A mesh of one floor: level faces to floor, what stands on it to walls, names to things."""

from pathlib import Path

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.wording import counted
from memorymaze.world.importing.centre_lines import centre_lines
from memorymaze.world.importing.imported import (
    CEILING,
    ImportedSite,
    ImportNotes,
    imported_building,
)
from memorymaze.world.importing.obstacles import boxes_on, without_obstacles
from memorymaze.world.importing.ways import plan_floor

BIT = 0.02
"""Square metres under which what stands free is nothing."""
DOOR_DEPTH = 0.02
"""Metres to both sides of a door's line that are no floor."""


def import_mesh(path: Path) -> ImportedSite:
    """Return the floor of a mesh as a building, in metres of the mesh's frame.

    A point (x, y, z) of a glTF file is (x, -z) on the plan.
    """
    require_extra("mesh", "trimesh", purpose="reading meshes")
    from memorymaze.world.importing.mesh_features import by_kind, door_line, parts_on
    from memorymaze.world.importing.mesh_floor import mesh_floor_of
    from memorymaze.world.looks.building_mesh import read_mesh

    pieces, guessed = read_mesh(path)
    kinds = by_kind(pieces)
    doors = [door_line(piece).buffer(DOOR_DEPTH) for piece in kinds["door"]]
    try:
        found = mesh_floor_of(kinds["building"], doors)
    except ImportFileError as error:
        raise ImportFileError(f"{path}: {error}") from None
    notes = ImportNotes(guessed=guessed)
    floor, standing = without_obstacles(found.polygon)
    planned = plan_floor(centre_lines(floor), notes, floor)
    parts = parts_on(planned.polygon, found.height, kinds, notes)
    boxes = list(
        boxes_on(planned.polygon, [each for each in standing if each.area >= BIT])
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
    parts = [*planned.parts, *parts, *boxes]
    ceiling = round(found.ceiling or CEILING, 2)
    site = imported_building(path, None, "ground floor", None, parts, ceiling)
    return notes.imported(site)
