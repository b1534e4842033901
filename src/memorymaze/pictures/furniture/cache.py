"""Converted furniture models in the user's cache, with their creators and licences."""

import json
import os
import shutil
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal, get_args
from zipfile import ZipFile

import numpy as np
from pydantic import TypeAdapter, ValidationError

from memorymaze.errors import SettingsError
from memorymaze.pictures.furniture.choice import CHOICE
from memorymaze.pictures.furniture.libraries import (
    DEBIAN_FOLDER,
    Piece,
    library_files,
    pieces_of,
)
from memorymaze.pictures.looks.assembly import MeshPart, ObjectModel
from memorymaze.pictures.looks.materials import Material

Looks = Literal["own", "sweethome3d"]
"""How things look: as made by this project's code alone, or by furniture models too."""

LOOKS_VARIABLE = "MEMORYMAZE_LOOKS"
FORMAT = 1
"""Of the cache; another format has another folder."""
INDEX, CREDITS = "index.json", "CREDITS.md"


@dataclass(frozen=True, slots=True)
class Credit:
    """A converted model: what it is, what it serves for, and who made it."""

    id: str
    """Library and file, such as `Scopia/ficus`."""
    name: str
    archetype: str
    size: tuple[float, float, float]
    """Length across the front, depth and height, metres."""
    creator: str
    licence: str
    triangles: int
    colour: tuple[float, float, float]
    """Of the material with the largest area, its mean."""


_CREDITS = TypeAdapter(tuple[Credit, ...])


def cache_folder() -> Path:
    """Return where converted models are kept for this user."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "memorymaze" / f"sweethome3d-{FORMAT}"


def looks_in_use() -> Looks:
    """Return how things look in this process.

    `sweethome3d` where models were converted, else `own`; the environment variable
    `MEMORYMAZE_LOOKS` decides otherwise.

    Raises:
        SettingsError: The variable asks for something else, or for models that were
            not converted.
    """
    wanted = os.environ.get(LOOKS_VARIABLE)
    there = (cache_folder() / INDEX).is_file()
    if not wanted:
        return "sweethome3d" if there else "own"
    if wanted not in get_args(Looks):
        raise SettingsError(
            f"{LOOKS_VARIABLE}: expected one of {', '.join(get_args(Looks))}, got "
            f"{wanted!r}"
        )
    if wanted == "sweethome3d" and not there:
        raise SettingsError(
            f"{LOOKS_VARIABLE}: expected converted models in {cache_folder()}, got "
            "none; type: memorymaze sites models"
        )
    return "own" if wanted == "own" else "sweethome3d"


def build_cache(
    folder: Path = DEBIAN_FOLDER, told: Callable[[str], None] = lambda _: None
) -> tuple[Credit, ...]:
    """Convert all chosen models, and put them in the place of those that were there.

    Args:
        folder: With the furniture libraries (`.sh3f`).
        told: Hears about each model, and why one is left out.

    Raises:
        SettingsError: There are no libraries, or a tool to convert them is missing.
    """
    from memorymaze.pictures.furniture.conversion import check_tools, converted

    libraries = library_files(folder)
    check_tools()
    pieces = {
        piece.id: (piece, library)
        for library in libraries
        for piece in pieces_of(library).values()
    }
    place = cache_folder()
    place.parent.mkdir(parents=True, exist_ok=True)
    made: list[Credit] = []
    with tempfile.TemporaryDirectory(dir=place.parent) as workshop:
        for archetype, chosen in CHOICE.items():
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
                _save(model, _file(Path(workshop), name))
                made.append(_credit(piece, archetype, model))
                told(f"{name}: {model.triangle_count} triangles, for {archetype}")
        content = {"format": FORMAT, "models": [asdict(each) for each in made]}
        text = json.dumps(content, indent=1, ensure_ascii=False)
        (Path(workshop) / INDEX).write_text(text, encoding="utf-8")
        (Path(workshop) / CREDITS).write_text(_credits_page(made), encoding="utf-8")
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(workshop, place)
    _read_credits.cache_clear()
    load_model.cache_clear()
    return tuple(made)


def credits_in(folder: Path) -> Mapping[str, tuple[Credit, ...]]:
    """Return the converted models of a cache by archetype; read once.

    Raises:
        SettingsError: The folder is damaged.
    """
    return _read_credits(folder)


@cache
def _read_credits(folder: Path) -> dict[str, tuple[Credit, ...]]:
    try:
        content = json.loads((folder / INDEX).read_text(encoding="utf-8"))
        models = _CREDITS.validate_python(content["models"])
    except (OSError, ValueError, KeyError, TypeError, ValidationError) as problem:
        raise SettingsError(
            f"{folder / INDEX}: expected an index of furniture models, got a damaged "
            f"file ({problem}); type: memorymaze sites models"
        ) from None
    found: dict[str, list[Credit]] = {}
    for each in models:
        found.setdefault(each.archetype, []).append(each)
    return {archetype: tuple(group) for archetype, group in found.items()}


@cache
def load_model(folder: Path, name: str) -> ObjectModel:
    """Read a converted model; the same arrays every time.

    Raises:
        SettingsError: Its file is missing or damaged.
    """
    path = _file(folder, name)
    try:
        with np.load(path) as arrays:
            count = int(arrays["parts"])
            return ObjectModel(
                tuple(_loaded_part(arrays, number) for number in range(count))
            )
    except (OSError, ValueError, KeyError) as problem:
        raise SettingsError(
            f"{path}: expected a converted model, got a damaged file ({problem}); "
            "type: memorymaze sites models"
        ) from None


def _file(folder: Path, name: str) -> Path:
    return folder / f"{name.replace('/', '-')}.npz"


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


def _loaded_part(arrays: Mapping[str, Any], number: int) -> MeshPart:
    for name in ("vertices", "faces", "normals"):
        arrays[f"{name}_{number}"].flags.writeable = False
    red, green, blue, alpha = (float(each) for each in arrays[f"rgba_{number}"])
    texture = uv = None
    if f"texture_{number}" in arrays:
        texture, uv = arrays[f"texture_{number}"], arrays[f"uv_{number}"]
    return MeshPart(
        arrays[f"vertices_{number}"],
        arrays[f"faces_{number}"],
        arrays[f"normals_{number}"],
        uv,
        Material((red, green, blue, alpha), texture),
    )


def _credit(piece: Piece, archetype: str, model: ObjectModel) -> Credit:
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


def area_of(part: MeshPart) -> float:
    """Return the area of a part, square metres."""
    a, b, c = (part.vertices[part.faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


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
