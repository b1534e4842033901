"""From a piece of a furniture library to a model: at most 4000 triangles, upright."""

import io
import warnings
from typing import Any
from zipfile import ZipFile

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.errors import SettingsError
from memorymaze.extras import require_extra
from memorymaze.pictures.furniture.cleaning import (
    Surface,
    cleaned,
    finished,
    thinned,
)
from memorymaze.pictures.furniture.libraries import Piece
from memorymaze.pictures.looks.assembly import MeshPart, ObjectModel
from memorymaze.pictures.looks.materials import Material

MOST_TRIANGLES = 4000
LARGEST_TEXTURE = 256
"""Pixels along a side."""
FEWEST = 12
"""Faces that even the smallest part keeps."""
TRIES = 10
AXES = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""From their frame (x to a viewer's right, y up, z to the front) to ours."""

_Look = tuple[tuple[float, float, float, float], bytes | None]


def check_tools() -> None:
    """Refuse to begin without the libraries that conversion needs.

    Raises:
        SettingsError: The extra `models` is not installed.
    """
    require_extra(
        "models", "fast_simplification", "trimesh", purpose="furniture models"
    )


def converted(piece: Piece, archive: ZipFile) -> ObjectModel:
    """Convert a piece: cleaned, at most `MOST_TRIANGLES`, in its catalogue's size.

    Raises:
        SettingsError: Its file cannot be read as a model.
    """
    surfaces, looks = _read(piece, archive)
    surfaces = [cleaned(each) for each in surfaces]
    total = sum(len(each.faces) for each in surfaces)
    if not total:
        raise SettingsError(f"furniture model {piece.id}: it has no faces")
    wanted = MOST_TRIANGLES
    parts: list[MeshPart] = []
    for _ in range(TRIES):
        share = min(1.0, wanted / total)
        rng = np.random.default_rng(0)
        parts = [
            _part(thinned(each, max(FEWEST, int(share * len(each.faces))), rng), look)
            for each, look in zip(surfaces, looks, strict=True)
        ]
        count = sum(len(part.faces) for part in parts)
        if count <= MOST_TRIANGLES:
            break
        wanted = int(min(wanted, total) * 0.95 * MOST_TRIANGLES / count)
    else:
        raise SettingsError(
            f"furniture model {piece.id}: it does not get below {MOST_TRIANGLES} "
            "triangles"
        )
    return ObjectModel(tuple(part for part in parts if len(part.faces)))


def _read(piece: Piece, archive: ZipFile) -> tuple[list[Surface], list[Material]]:
    """Return a surface for each look, in our frame and in metres."""
    scene = _loaded(piece, archive)
    found: dict[_Look, list[Surface]] = {}
    pictures: dict[bytes, NDArray[np.uint8]] = {}
    for mesh in scene.geometry.values():
        material = getattr(mesh.visual, "material", None)
        picture = _picture(getattr(material, "image", None))
        uv = getattr(mesh.visual, "uv", None)
        key = None
        if picture is not None and uv is not None:
            key = picture.tobytes()
            pictures[key] = picture
        surface = Surface(
            np.asarray(mesh.vertices, dtype=np.float64) @ piece.rotation.T @ AXES.T,
            np.asarray(mesh.faces, dtype=np.int64),
            None
            if key is None
            else np.asarray(uv, dtype=np.float64) * (1, -1) + (0, 1),
        )
        found.setdefault((_colour(material, key is not None), key), []).append(surface)
    low, high = _bounds([each for group in found.values() for each in group])
    length, depth, height = piece.size
    scale = np.array((depth, length, height)) / np.maximum(high - low, 1e-9)
    shift = np.array(((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]))
    surfaces = [_joined(group, shift, scale) for group in found.values()]
    looks = [
        Material(rgba, None if key is None else pictures[key]) for rgba, key in found
    ]
    return surfaces, looks


def _loaded(piece: Piece, archive: ZipFile) -> Any:
    import trimesh
    from trimesh.resolvers import Resolver

    folder = piece.member.rpartition("/")[0]

    class Inside(Resolver):
        """Finds materials and pictures beside the model in the archive."""

        def __init__(self) -> None:
            pass

        def get(self, key: str) -> bytes:
            return archive.read(f"{folder}/{key.strip().removeprefix('./')}")

        def keys(self) -> list[str]:
            return archive.namelist()

        def namespaced(self, namespace: str) -> "Inside":
            return self

        def write(self, name: str, data: Any) -> None:
            raise NotImplementedError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return trimesh.load_scene(
                io.BytesIO(archive.read(piece.member)),
                file_type="obj",
                resolver=Inside(),
                process=False,
            )
    except Exception as problem:  # the reader raises whatever the file brings about
        raise SettingsError(
            f"furniture model {piece.id}: {piece.member} cannot be read ({problem})"
        ) from None


def _colour(material: Any, has_picture: bool) -> tuple[float, float, float, float]:
    """Return the colour; pictures have theirs in themselves."""
    alpha = 1.0
    for value in getattr(material, "kwargs", {}).get("d", ()):
        alpha = min(max(float(value), 0.2), 1.0)
    if has_picture:
        return (1.0, 1.0, 1.0, alpha)
    diffuse = np.asarray(
        getattr(material, "diffuse", (160, 160, 160, 255)), dtype=float
    )
    red, green, blue = (float(each) for each in diffuse[:3] / 255)
    return (red, green, blue, alpha)


def _picture(image: Any) -> NDArray[np.uint8] | None:
    if image is None:
        return None
    image = image.convert("RGB")
    image.thumbnail((LARGEST_TEXTURE, LARGEST_TEXTURE), Image.Resampling.LANCZOS)
    pixels = np.array(image, dtype=np.uint8)
    pixels.flags.writeable = False
    return pixels


def _bounds(surfaces: list[Surface]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    points = np.concatenate([each.vertices[np.unique(each.faces)] for each in surfaces])
    return points.min(axis=0), points.max(axis=0)


def _joined(
    group: list[Surface], shift: NDArray[np.float64], scale: NDArray[np.float64]
) -> Surface:
    starts = np.cumsum([0, *(len(each.vertices) for each in group)])
    uv = [each.uv for each in group if each.uv is not None]
    return Surface(
        (np.concatenate([each.vertices for each in group]) - shift) * scale,
        np.concatenate([
            each.faces + start for each, start in zip(group, starts, strict=False)
        ]),
        np.concatenate(uv) if len(uv) == len(group) else None,
    )


def _part(surface: Surface, look: Material) -> MeshPart:
    vertices, faces, normals, uv = finished(surface)
    return MeshPart(
        vertices.astype(np.float32),
        faces.astype(np.int32),
        normals.astype(np.float32),
        None if uv is None else uv.astype(np.float32),
        look,
    )
