"""Looks of a building from the mesh it was imported from: a GLB beside its plan."""

import math
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.basics.errors import SettingsError
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.building_mesh import (
    MeshPiece,
    face_normals,
    levels,
    read_mesh,
)
from memorymaze.world.looks.materials import OPAQUE_FROM, Material
from memorymaze.world.looks.meshes import (
    BuildingMesh,
    Circle,
    MeshKind,
    PlacedMeshes,
)
from memorymaze.world.sites.records import Door, Site
from memorymaze.world.sites.scene_objects import SceneObject

LARGEST_TEXTURE = 2048
"""Pixels along a side."""
LEVEL = 0.9
"""Least share of a piece's mean normal that points up or down in floors and ceilings."""


def mesh_of(site: Site) -> Path:
    """Return the mesh that stands beside a site's plan, of the same name."""
    path = Path(site.source).with_suffix(".glb")
    if not site.source or not path.is_file():
        raise SettingsError(
            f"looks: expected the mesh of {site.name} beside its plan, {path}, got none; "
            "copy it there, or let things look `own`"
        )
    return path


def mesh_building(site: Site) -> list[BuildingMesh]:
    """Return a site's mesh: what has the id of no door or landmark, then these.

    Without parts are those whose id no node has.
    """
    path = mesh_of(site)
    found, _ = read_mesh(path, with_looks=True)
    pieces = [piece for piece in found if len(piece.faces)]
    floor, _ = levels(pieces)
    materials: dict[int, Material] = {}
    named: defaultdict[str, list[MeshPiece]] = defaultdict(list)
    for piece in pieces:
        named[piece.name].append(piece)
    things: list[BuildingMesh] = []
    for record in (*site.doors, *site.landmarks):
        kind = "door" if isinstance(record, Door) else "landmark"
        placed, circle = _placed(named.pop(record.id, ()), floor, materials)
        thing = SceneObject(kind, record)
        things.append(BuildingMesh(record.id, kind, placed, circle, thing))
    rest: list[BuildingMesh] = []
    for piece in (piece for group in named.values() for piece in group):
        placed, circle = _placed([piece], floor, materials)
        kind = _part_of_building(piece, floor)
        rest.append(BuildingMesh(piece.name, kind, placed, circle, shows_sky=True))
    return [*rest, *things]


def _part_of_building(piece: MeshPiece, floor: float) -> MeshKind:
    across = face_normals(piece)
    total = float(np.linalg.norm(across, axis=1).sum())
    if np.abs(across[:, 2]).sum() < LEVEL * total:
        return "wall"
    return "floor" if piece.vertices[:, 2].mean() < floor + 0.5 else "ceiling"


def _placed(
    pieces: Sequence[MeshPiece], floor: float, materials: dict[int, Material]
) -> tuple[PlacedMeshes, Circle]:
    """Return pieces around their middle on the plan, and their circle."""
    if not pieces:
        return PlacedMeshes(()), (0.0, 0.0, 0.0)
    corners = np.concatenate([piece.vertices[:, :2] for piece in pieces])
    low, high = corners.min(axis=0), corners.max(axis=0)
    x, y = ((low + high) / 2).tolist()
    parts = [
        _part(piece, piece.vertices - (x, y, floor), materials) for piece in pieces
    ]
    return PlacedMeshes(parts, x, y), (x, y, math.dist(low, high) / 2 + 0.1)


def _part(
    piece: MeshPiece, vertices: NDArray[np.float64], materials: dict[int, Material]
) -> MeshPart:
    made = getattr(piece.visual, "material", None)
    uv = getattr(piece.visual, "uv", None)
    key = id(made if made is not None else piece.visual)
    if key not in materials:
        materials[key] = _material(made, piece.visual, pictured=uv is not None)
    material = materials[key]
    return MeshPart(
        vertices.astype(np.float32),
        piece.faces.astype(np.int32),
        None,
        None
        if material.texture is None
        else (np.asarray(uv, dtype=np.float32) * (1, -1) + (0, 1)).astype(np.float32),
        material,
    )


def _material(made: Any, visual: Any, *, pictured: bool) -> Material:
    """Return a material of ours; of one without, the mean of its vertices' colours."""
    if made is None:
        mean = np.asarray(visual.vertex_colors).mean(axis=0) / 255
        return Material(tuple(mean.tolist()))
    factor = getattr(made, "baseColorFactor", None)
    shares = np.ones(4) if factor is None else np.asarray(factor, dtype=float) / 255
    # glTF's factors are shares of light; colours here are as screens have them.
    light = shares[:3]
    colour = np.where(
        light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055
    )
    alpha = float(shares[3]) if made.alphaMode == "BLEND" else 1.0
    glow = getattr(made, "emissiveFactor", None)
    image = getattr(made, "baseColorTexture", None) if pictured else None
    roughness = getattr(made, "roughnessFactor", None)
    red, green, blue = colour.tolist()
    return Material(
        (red, green, blue, alpha if alpha < OPAQUE_FROM else 1.0),
        None if image is None else _pixels(image),
        0.0 if glow is None else float(min(1.0, np.max(glow))),
        0.1 if roughness is None else float(1 - roughness),
    )


def _pixels(image: Image.Image) -> NDArray[np.uint8]:
    picture = image.convert("RGBA" if "A" in image.getbands() else "RGB")
    picture.thumbnail((LARGEST_TEXTURE, LARGEST_TEXTURE), Image.Resampling.LANCZOS)
    pixels = np.array(picture, dtype=np.uint8)
    pixels.flags.writeable = False
    return pixels
