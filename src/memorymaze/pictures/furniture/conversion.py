"""From furniture libraries of Sweet Home 3D (`.sh3f`) to models in the user's cache."""

import io
import json
import re
import shutil
import tempfile
import warnings
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any
from zipfile import BadZipFile, ZipFile

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.errors import SettingsError
from memorymaze.extras import require_extra
from memorymaze.pictures.furniture.mesh_cleaning import (
    MaterialSurface,
    cleaned,
    finished,
    thinned,
)
from memorymaze.pictures.furniture.models import (
    CREDITS,
    FORMAT,
    INDEX,
    Credit,
    area_of,
    cache_folder,
    choice,
    file_of,
    forget_models,
)
from memorymaze.pictures.looks.assembly import MeshPart, ObjectModel
from memorymaze.pictures.looks.materials import Material

DEBIAN_FOLDER = Path("/usr/share/sweethome3d/furniture")
INSTALLING = "apt-get install sweethome3d-furniture"

CATALOGUE = "PluginFurnitureCatalog.properties"
LICENCES = {
    "BlendSwap-CC-0": "CC0 1.0",
    "BlendSwap-CC-BY": "CC BY 3.0",
    "KatorLegaz": "CC BY 3.0 US",
    "Reallusion": "CC BY 3.0 US",
    "Scopia": "CC BY 3.0",
}
"""Of the libraries that Debian ships, as its copyright file tells."""
MOST_TRIANGLES = 4000
LARGEST_TEXTURE = 256
"""Pixels along a side."""
FEWEST = 12
"""Faces that even the smallest part keeps."""
TRIES = 10
AXES = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""From their frame (x to a viewer's right, y up, z to the front) to ours."""

_Look = tuple[tuple[float, float, float, float], bytes | None]


def build_cache(
    folder: Path = DEBIAN_FOLDER, told: Callable[[str], None] = lambda _: None
) -> tuple[Credit, ...]:
    """Convert the chosen models of a folder's libraries, and replace earlier ones.

    `told` hears about each model, and why one is left out.
    """
    libraries = library_files(folder)
    check_tools()
    pieces = {
        piece.id: (piece, library)
        for library in libraries
        for piece in library_pieces(library).values()
    }
    place = cache_folder()
    place.parent.mkdir(parents=True, exist_ok=True)
    made: list[Credit] = []
    with tempfile.TemporaryDirectory(dir=place.parent) as workshop:
        for archetype, chosen in choice().pieces.items():
            for name in chosen:
                if name not in pieces:
                    told(f"{name}: not in {folder}; left out")
                    continue
                piece, library = pieces[name]
                try:
                    with ZipFile(library) as archive:
                        model = converted(piece, archive)
                except SettingsError as problem:
                    told(f"{problem}; left out")
                    continue
                _save(model, file_of(Path(workshop), name))
                made.append(_credit(piece, archetype, model))
                told(f"{name}: {model.triangle_count} triangles, for {archetype}")
        content = {"format": FORMAT, "models": [asdict(each) for each in made]}
        text = json.dumps(content, indent=1, ensure_ascii=False)
        (Path(workshop) / INDEX).write_text(text, encoding="utf-8")
        (Path(workshop) / CREDITS).write_text(_credits_page(made), encoding="utf-8")
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(workshop, place)
    forget_models()
    return tuple(made)


@dataclass(frozen=True, slots=True)
class FurniturePiece:
    """An entry of a library's catalogue."""

    id: str
    """Library and file, such as `Scopia/ficus`."""
    name: str
    """As people call it."""
    member: str
    """Its OBJ file in the archive."""
    size: tuple[float, float, float]
    """Length across the front, depth and height, metres."""
    rotation: NDArray[np.float64]
    """(3, 3), to be applied to the vertices of the file before all else."""
    creator: str
    licence: str


def library_files(folder: Path = DEBIAN_FOLDER) -> list[Path]:
    """Return the libraries in a folder whose licence is known."""
    files = [folder / f"{name}.sh3f" for name in LICENCES]
    found = [file for file in files if file.is_file()]
    if not found:
        raise SettingsError(
            f"furniture models: expected {', '.join(f'{n}.sh3f' for n in LICENCES)} in "
            f"{folder}, got none of them; on Debian and Ubuntu: {INSTALLING}"
        )
    return found


def library_pieces(library: Path) -> dict[str, FurniturePiece]:
    """Return the pieces of a library by id."""
    try:
        with ZipFile(library) as archive:
            text = archive.read(CATALOGUE).decode("latin-1")
            members = set(archive.namelist())
    except (BadZipFile, KeyError, OSError) as problem:
        raise SettingsError(
            f"{library}: expected a furniture library of Sweet Home 3D with "
            f"{CATALOGUE}, got {problem}"
        ) from None
    name = library.stem
    pieces = (_piece(name, entry) for entry in _entries(text))
    return {piece.id: piece for piece in pieces if piece.member in members}


def _entries(text: str) -> Iterator[dict[str, str]]:
    """Read `key#number=value` lines, a dictionary for each number."""
    entries: dict[int, dict[str, str]] = {}
    for key, number, value in re.findall(
        r"^(\w+)#(\d+)[ \t]*=[ \t]*(.*?)\s*$", text, re.MULTILINE
    ):
        plain = re.sub(
            r"\\u([0-9a-fA-F]{4})", lambda code: chr(int(code[1], 16)), value
        )
        entries.setdefault(int(number), {})[key] = plain
    for _, entry in sorted(entries.items()):
        if "model" in entry:
            yield entry


def _piece(library: str, entry: dict[str, str]) -> FurniturePiece:
    member = entry["model"].lstrip("/")
    centimetres = (float(entry[key]) for key in ("width", "depth", "height"))
    length, depth, height = (each / 100 for each in centimetres)
    turned = [float(each) for each in entry.get("modelRotation", "").split()]
    rotation = np.array(turned).reshape(3, 3) if turned else np.eye(3)
    return FurniturePiece(
        f"{library}/{Path(member).stem}",
        entry.get("name", Path(member).stem),
        member,
        (length, depth, height),
        rotation,
        entry.get("creator") or library,
        LICENCES.get(library, "unknown"),
    )


def check_tools() -> None:
    """Refuse to begin without the libraries that conversion needs."""
    require_extra(
        "models", "fast_simplification", "trimesh", purpose="furniture models"
    )


def converted(piece: FurniturePiece, archive: ZipFile) -> ObjectModel:
    """Convert a piece: cleaned, at most `MOST_TRIANGLES`, in its catalogue's size."""
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


def _read(
    piece: FurniturePiece, archive: ZipFile
) -> tuple[list[MaterialSurface], list[Material]]:
    """Return a surface for each look, in our frame and in metres."""
    scene = _loaded(piece, archive)
    found: dict[_Look, list[MaterialSurface]] = {}
    pictures: dict[bytes, NDArray[np.uint8]] = {}
    for mesh in scene.geometry.values():
        material = getattr(mesh.visual, "material", None)
        picture = _picture(getattr(material, "image", None))
        uv = getattr(mesh.visual, "uv", None)
        key = None
        if picture is not None and uv is not None:
            key = picture.tobytes()
            pictures[key] = picture
        surface = MaterialSurface(
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


def _loaded(piece: FurniturePiece, archive: ZipFile) -> Any:
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


def _bounds(
    surfaces: list[MaterialSurface],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    points = np.concatenate([each.vertices[np.unique(each.faces)] for each in surfaces])
    return points.min(axis=0), points.max(axis=0)


def _joined(
    group: list[MaterialSurface], shift: NDArray[np.float64], scale: NDArray[np.float64]
) -> MaterialSurface:
    starts = np.cumsum([0, *(len(each.vertices) for each in group)])
    uv = [each.uv for each in group if each.uv is not None]
    return MaterialSurface(
        (np.concatenate([each.vertices for each in group]) - shift) * scale,
        np.concatenate([
            each.faces + start for each, start in zip(group, starts, strict=False)
        ]),
        np.concatenate(uv) if len(uv) == len(group) else None,
    )


def _part(surface: MaterialSurface, look: Material) -> MeshPart:
    vertices, faces, normals, uv = finished(surface)
    return MeshPart(
        vertices.astype(np.float32),
        faces.astype(np.int32),
        normals.astype(np.float32),
        None if uv is None else uv.astype(np.float32),
        look,
    )


def _save(model: ObjectModel, path: Path) -> None:
    arrays: dict[str, Any] = {"parts": np.array(len(model.parts))}
    for number, part in enumerate(model.parts):
        arrays[f"vertices_{number}"] = part.vertices
        arrays[f"faces_{number}"] = part.faces
        arrays[f"normals_{number}"] = part.normals
        arrays[f"rgba_{number}"] = np.array(part.material.rgba)
        if part.uv is not None and part.material.texture is not None:
            arrays[f"uv_{number}"] = part.uv
            arrays[f"texture_{number}"] = part.material.texture
    np.savez_compressed(path, **arrays)


def _credit(piece: FurniturePiece, archetype: str, model: ObjectModel) -> Credit:
    main = max(model.parts, key=area_of).material
    red, green, blue = main.rgba[:3]
    if main.texture is not None:
        red, green, blue = (main.texture.reshape(-1, 3).mean(axis=0) / 255).tolist()
    return Credit(
        piece.id,
        piece.name,
        archetype,
        piece.size,
        piece.creator,
        piece.licence,
        model.triangle_count,
        (red, green, blue),
    )


def _credits_page(models: list[Credit]) -> str:
    rows = "\n".join(
        f"| {each.id} | {each.name} | {each.archetype} | {each.creator} | "
        f"{each.licence} | {each.triangles} |"
        for each in models
    )
    return (
        "# Furniture models\n\n"
        "Converted from the furniture libraries of Sweet Home 3D (Debian package\n"
        "sweethome3d-furniture). CC BY 3.0: "
        "https://creativecommons.org/licenses/by/3.0/,\n"
        "CC0 1.0: https://creativecommons.org/publicdomain/zero/1.0/. Changes: double "
        "faces\ndropped, reduced to the triangles given, pictures shrunk to 256 pixels; "
        "when shown,\nstretched to the size of the thing they stand for, and painted "
        "where a plan says so.\n\n"
        "| model | name | stands for | creator | licence | triangles |\n"
        "|---|---|---|---|---|---|\n"
        f"{rows}\n"
    )
