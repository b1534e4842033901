"""Converted furniture models in the user's cache, and the one that fits a thing best."""

import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, get_args

import numpy as np
from pydantic import TypeAdapter, ValidationError

from memorymaze.errors import SettingsError
from memorymaze.extras import command_here
from memorymaze.pictures.kinds_of_looks import Looks
from memorymaze.pictures.looks.assembly import MeshPart, ObjectModel, Order
from memorymaze.pictures.looks.materials import Material, Rgb, colours_of
from memorymaze.pictures.tables import read_table

FORMAT = 1
"""Of the cache; another format has another folder."""
INDEX, CREDITS = "index.json", "CREDITS.md"
MOST_STRETCH = 1.8
"""A model may become this much longer in one direction, compared with another."""
NEARLY = 1.2
"""Models that are stretched this much more than the best one are as good as it."""


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


@dataclass(frozen=True, slots=True)
class FurnitureChoice:
    """Which pieces of the furniture libraries stand for which archetypes of ours.

    Only where they are recognised at least as well, and no words have to stand on them.
    """

    pieces: dict[str, tuple[str, ...]]
    """Archetype of `looks.catalogue`: pieces, by library and file."""
    sideways: frozenset[str]
    """Archetypes whose front, in site plans, is the pieces' left side."""
    unpainted: frozenset[str]
    """Archetypes no one can paint: the piece nearest to the wanted colour is taken."""


@cache
def choice() -> FurnitureChoice:
    """Return what `furniture.json` says; read once."""
    return read_table("furniture.json", FurnitureChoice)


def cache_folder() -> Path:
    """Return where converted models are kept for this user.

    `MEMORYMAZE_CACHE` names another folder than the one in the user's cache.
    """
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = Path(os.environ.get("MEMORYMAZE_CACHE") or home / "memorymaze")
    return folder / f"sweethome3d-{FORMAT}"


def check_looks(looks: Looks | None) -> Looks:
    """Return how things are to look; None is `models` where a user has converted them."""
    there = (cache_folder() / INDEX).is_file()
    if looks is None:
        return "models" if there else "own"
    if looks not in get_args(Looks):
        raise SettingsError(
            f"looks: expected one of {', '.join(get_args(Looks))}; got {looks!r}"
        )
    if looks == "models" and not there:
        raise SettingsError(
            f"looks: expected converted models in {cache_folder()}, got none; type: "
            f"{command_here()} sites models"
        )
    return looks


@cache
def credits_in(folder: Path) -> Mapping[str, tuple[Credit, ...]]:
    """Return the converted models of a cache by archetype; read once."""
    try:
        content = json.loads((folder / INDEX).read_text(encoding="utf-8"))
        models = _CREDITS.validate_python(content["models"])
    except (OSError, ValueError, KeyError, TypeError, ValidationError) as problem:
        raise SettingsError(
            f"{folder / INDEX}: expected an index of furniture models, got a damaged "
            f"file ({problem}); type: {command_here()} sites models"
        ) from None
    found: dict[str, list[Credit]] = {}
    for each in models:
        found.setdefault(each.archetype, []).append(each)
    return {archetype: tuple(group) for archetype, group in found.items()}


def forget_models() -> None:
    """Read the cache anew when it is asked next."""
    credits_in.cache_clear()
    load_model.cache_clear()


@cache
def load_model(folder: Path, name: str) -> ObjectModel:
    """Read a converted model; the same arrays every time."""
    path = file_of(folder, name)
    try:
        with np.load(path) as arrays:
            count = int(arrays["parts"])
            return ObjectModel(
                tuple(_loaded_part(arrays, number) for number in range(count))
            )
    except (OSError, ValueError, KeyError) as problem:
        raise SettingsError(
            f"{path}: expected a converted model, got a damaged file ({problem}); "
            f"type: {command_here()} sites models"
        ) from None


def file_of(folder: Path, name: str) -> Path:
    """Return where a converted model is kept."""
    return folder / f"{name.replace('/', '-')}.npz"


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


def area_of(part: MeshPart) -> float:
    """Return the area of a part, square metres."""
    a, b, c = (part.vertices[part.faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def furniture_for(archetype: str, order: Order) -> ObjectModel | None:
    """Return a converted model that fills the box of a thing exactly.

    None where the user's cache has none, none has about the thing's proportions, or
    words have to stand on it.
    """
    folder = cache_folder()
    pieces = credits_in(folder).get(archetype, ())
    if order.text or not pieces:
        return None
    sideways = archetype in choice().sideways
    stretched = sorted(
        (_stretch(each, order, sideways=sideways), number)
        for number, each in enumerate(pieces)
    )
    best = stretched[0][0]
    if best > MOST_STRETCH:
        return None
    good = [
        pieces[n] for how, n in stretched if how <= min(best * NEARLY, MOST_STRETCH)
    ]
    colour = next(iter(colours_of(order.colour_words)), None)
    if colour is None or archetype not in choice().unpainted:
        piece = good[order.variant % len(good)]
    else:
        piece = min(good, key=lambda each: math.dist(each.colour, colour))
    model = load_model(folder, piece.id)
    if sideways:
        model = _turned(model)
    model = _filling(model, order)
    if colour is not None and archetype not in choice().unpainted:
        model = _painted(model, colour)
    return model


def _stretch(piece: Credit, order: Order, *, sideways: bool) -> float:
    length, depth, height = piece.size
    if sideways:
        length, depth = depth, length
    ratios = (order.length / length, order.depth / depth, order.height / height)
    return max(ratios) / min(ratios)


def _turned(model: ObjectModel) -> ObjectModel:
    """Turn a model so that its left side faces the front."""
    to_right = np.array(((0, 1, 0), (-1, 0, 0), (0, 0, 1)), dtype=np.float32)
    return _moved(model, to_right, to_right, np.zeros(3, dtype=np.float32))


def _filling(model: ObjectModel, order: Order) -> ObjectModel:
    low, high = model.bounds()
    size = np.array((order.depth, order.length, order.height))
    scale = size / np.maximum(high - low, 1e-9)
    corner = np.array((-order.depth / 2, -order.length / 2, 0.0))
    return _moved(model, np.diag(scale), np.diag(1 / scale), corner - low * scale)


def _moved(
    model: ObjectModel, shape: np.ndarray, normals: np.ndarray, shift: np.ndarray
) -> ObjectModel:
    parts: list[MeshPart] = []
    for part in model.parts:
        assert part.normals is not None
        turned = part.normals @ normals.T
        turned /= np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-12)
        vertices = (part.vertices @ shape.T + shift).astype(np.float32)
        turned = turned.astype(np.float32)
        vertices.flags.writeable = turned.flags.writeable = False
        parts.append(MeshPart(vertices, part.faces, turned, part.uv, part.material))
    return ObjectModel(tuple(parts))


def _painted(model: ObjectModel, colour: Rgb) -> ObjectModel:
    """Give the largest part a colour; light and dark of its picture remain."""
    main = max(model.parts, key=area_of)
    texture = main.material.texture
    if texture is None:
        paint = Material((*colour, main.material.rgba[3]))
    else:
        light = texture.astype(np.float64).mean(axis=2, keepdims=True)
        light /= max(float(light.mean()), 1.0)
        pixels = np.clip(255 * light * np.array(colour), 0, 255).astype(np.uint8)
        pixels.flags.writeable = False
        paint = Material(main.material.rgba, pixels)
    return ObjectModel(
        tuple(
            MeshPart(part.vertices, part.faces, part.normals, part.uv, paint)
            if part is main
            else part
            for part in model.parts
        )
    )
