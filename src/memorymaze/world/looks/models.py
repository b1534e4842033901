"""Models of things from a GLB file: the one that fits, stretched, painted, with words.

A node is called as a kind of thing; `docs/seeing.md` tells what else a file may say.
"""

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.world.looks.assembly import (
    MeshPart,
    ObjectModel,
    read_only_part,
    uv_from_the_sides,
)
from memorymaze.world.looks.displays import DISPLAYS, Display
from memorymaze.world.looks.glb import GlbNode, GlbPrimitive, read_glb
from memorymaze.world.looks.materials import (
    Material,
    Rgb,
    colours_of,
    is_wooden,
    picture,
    shade,
    wood,
)
from memorymaze.world.sites.records import Mount

DIRECTIONS = ("length", "depth", "height")
"""The morph targets that show a thing one metre longer, deeper, higher."""
LEAST, MOST = 0.5, 3.0
"""How far targets act, as shares of a model's own size; what is left is scaled."""
NEARLY = 1.2
"""Models whose sizes fit by this factor less well than the best are as good as it."""
GRAINED = {"body", "body:wood", "trim", "wood"}
"""Materials that may become wood, whose picture is laid on when its size is known."""


@dataclass(frozen=True, slots=True)
class Order:
    """What a thing is to be; metres, in the frame of `ObjectModel`."""

    category: str
    length: float
    """Across the front, along y."""
    depth: float
    """Along x."""
    height: float
    """Along z."""
    colour_words: str | None = None
    text: str | None = None
    name: str | None = None
    mount: Mount = "floor"
    variant: int = 0
    """Tells things of one kind apart that nobody described."""

    @property
    def size(self) -> FloatArray:
        """Length, depth, height."""
        return np.array((self.length, self.depth, self.height))

    def described_by(self, words: Sequence[str]) -> bool:
        """Whether what the plan says of it has one of these words."""
        said = (self.category, self.name, self.text, self.colour_words)
        told = " ".join(filter(None, said)).lower()
        return any(word.lower() in told for word in words)

    @property
    def is_painted(self) -> bool:
        """Whether it is said to have a colour, and that is no wood's."""
        return bool(colours_of(self.colour_words)) and not is_wooden(self.colour_words)


class Surface(NamedTuple):
    """Triangles of a model, stretched to a thing."""

    primitive: GlbPrimitive
    vertices: FloatArray
    normals: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Module:
    """A part of a model that stands there as often as the thing is large."""

    group: str
    """Modules of one group take turns."""
    every: FloatArray
    """Metres of a thing for each: along, across, up; 0 where it stands there once."""
    mesh: "Mesh"


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Triangles that can be stretched; the origin is the middle of the footprint."""

    primitives: tuple[GlbPrimitive, ...]
    size: FloatArray
    """Length, depth, height, as the file has it."""

    def stretched(self, size: FloatArray) -> Iterator[Surface]:
        """Yield its triangles at another size: by its targets, scaled where it has none."""
        more = np.clip(size, LEAST * self.size, MOST * self.size) - self.size
        ratio = size / self.size
        for each in self.primitives:
            has = [direction in each.targets for direction in DIRECTIONS]
            vertices = each.vertices
            for direction, step in zip(DIRECTIONS, more.tolist(), strict=True):
                if direction in each.targets:
                    vertices = vertices + step * each.targets[direction]
            vertices = vertices * np.where(has, 1.0, ratio)[[1, 0, 2]]
            yield Surface(each, vertices, each.normals / ratio[[1, 0, 2]])


@dataclass(frozen=True, slots=True, eq=False)
class ThingModel:
    """A node of a file: how things of a kind look."""

    mesh: Mesh
    modules: tuple[Module, ...]
    mount: str | None
    """The only mount it is for."""
    words: tuple[str, ...]
    """It is for things that are described by one of these alone; empty: for all."""
    is_wooden: bool
    """Whether it is of wood where nobody says otherwise."""
    word_parts: int
    """Into how many parts it divides a thing's words; 0 where it shows none."""

    def surfaces(self, order: Order) -> Iterator[Surface]:
        """Yield its triangles, stretched, and its modules as often as they fit."""
        yield from self.mesh.stretched(order.size)
        groups: dict[str, list[Module]] = {}
        for module in self.modules:
            groups.setdefault(module.group, []).append(module)
        for modules in groups.values():
            yield from _repeated(modules, order)


def _repeated(modules: Sequence[Module], order: Order) -> Iterator[Surface]:
    every = modules[0].every
    counts = np.where(every > 0, np.round(order.size / np.maximum(every, 1e-9)), 1)
    counts = np.maximum(counts, 1).astype(int)
    cell = order.size / counts
    for i, j, k in product(*map(range, counts.tolist())):
        module = modules[(order.variant + i + 2 * j + 3 * k) % len(modules)]
        across = (np.array((i, j, k)) + 0.5) * cell - order.size / 2
        shift = np.array((across[1], across[0], k * cell[2]))
        for primitive, vertices, normals in module.mesh.stretched(cell):
            yield Surface(primitive, vertices + shift, normals)


def read_models(
    path: Path, kind_of: Callable[[str], str | None]
) -> Mapping[str, tuple[ThingModel, ...]]:
    """Return the models of a file by kind.

    `kind_of` says for which kind of things a node of a name stands, if any.
    """
    found: dict[str, list[ThingModel]] = {}
    roots = read_glb(path)
    left = list(reversed(roots))
    while left:
        node = left.pop()
        kind = kind_of(_stem(node.name).replace("_", " ").lower())
        if kind is None:
            left.extend(reversed(node.children))
        else:
            found.setdefault(kind, []).append(_model(path, node))
    if not found:
        names = ", ".join(repr(each.name) for root in roots for each in root.all())
        raise SettingsError(
            f"{path}: expected nodes that are called as kinds of things, such as "
            f"'bench', got {names or 'no nodes'}; docs/seeing.md lists the kinds"
        )
    return {kind: tuple(group) for kind, group in found.items()}


def _stem(name: str) -> str:
    """Return a name without the number that tells it from others of the same name."""
    return re.sub(r"\.\d+$", "", name)


def _model(path: Path, node: GlbNode) -> ThingModel:
    modules = [each for each in node.all() if "repeat" in each.extras]
    inside = {id(each) for module in modules for each in module.all()}
    primitives = [
        primitive
        for each in node.all()
        if id(each) not in inside
        for primitive in each.primitives
    ]
    if not primitives:
        raise SettingsError(
            f"{path}: node {node.name!r}: expected a mesh of triangles, got none; give it "
            "one, or call it otherwise"
        )
    materials = [
        primitive.material
        for each in node.all()
        for primitive in each.primitives
        if _stem(primitive.material.name).startswith("words")
    ]
    return ThingModel(
        _mesh(path, node, primitives, node.place),
        tuple(_module(path, each, node.place) for each in modules),
        node.extras.get("mount"),
        tuple(filter(None, map(str.strip, str(node.extras.get("for", "")).split(",")))),
        any(_stem(each.material.name) == "body:wood" for each in primitives),
        len({each.extras.get("part") for each in materials}),
    )


def _module(path: Path, node: GlbNode, place: FloatArray) -> Module:
    every = _numbers(node.extras["repeat"])
    if every is None or (every < 0).any() or "size" not in node.extras:
        raise SettingsError(
            f"{path}: node {node.name!r}: expected as custom properties repeat, metres of a "
            "thing for each along length, depth and height, 0 for once, such as "
            f"[0.4, 0, 0], and size, its own three metres; got {dict(node.extras)}"
        )
    below = [primitive for each in node.all() for primitive in each.primitives]
    return Module(_stem(node.name), every, _mesh(path, node, below, place))


def _numbers(given: object) -> FloatArray | None:
    """Return a number for each direction; None where that is not what came."""
    try:
        numbers = np.array(given, dtype=float)
    except (TypeError, ValueError):
        return None
    return numbers if numbers.shape == (3,) and np.isfinite(numbers).all() else None


def _mesh(
    path: Path, node: GlbNode, primitives: Sequence[GlbPrimitive], place: FloatArray
) -> Mesh:
    points = np.concatenate([each.vertices for each in primitives])
    low, high = points.min(axis=0), points.max(axis=0)
    origin, size = (low + high) / 2, (high - low)[[1, 0, 2]]
    origin[2] = low[2]
    if "size" in node.extras:
        origin, size = place, _numbers(node.extras["size"])
    if size is None or not (size > 0).all():
        raise SettingsError(
            f"{path}: node {node.name!r}: expected a length, depth and height of more "
            f"than 0 m, got {node.extras.get('size', size)}; even a sheet needs some "
            "thickness"
        )
    return Mesh(tuple(each.moved(-origin) for each in primitives), size)


def model_of_kind(models: Sequence[ThingModel], order: Order) -> ObjectModel:
    """Return a thing as the model shows it that fits it best."""
    model = _fitting(models, order)
    shown: dict[Material, list[Surface]] = {}
    for surface in model.surfaces(order):
        material = _material(surface, order, model.word_parts)
        if material is not None:
            shown.setdefault(material, []).append(surface)
    return _filling(shown, order.size[[1, 0, 2]])


def _fitting(models: Sequence[ThingModel], order: Order) -> ThingModel:
    """Choose by mount, by what is said of the thing, by size, then by its variant."""
    said = 0 if order.text is None else order.text.count("/") + 1
    rules: tuple[Callable[[ThingModel], bool], ...] = (
        lambda model: model.mount == order.mount,
        lambda model: model.mount is None,
        lambda model: order.described_by(model.words),
        lambda model: not model.words,
        lambda model: model.word_parts == said,
        lambda model: bool(model.word_parts) == bool(said),
        lambda model: model.is_wooden != order.is_painted,
    )
    left = list(models)
    for either, other in (rules[0:2], rules[2:4], rules[4:6], rules[6:] * 2):
        left = list(filter(either, left)) or list(filter(other, left)) or left
    sizes = np.array([model.mesh.size for model in left])
    misfit = np.abs(np.log(order.size / sizes)).max(axis=1)
    good = np.flatnonzero(misfit <= misfit.min() + math.log(NEARLY))
    return left[int(good[order.variant % len(good)])]


def _material(surface: Surface, order: Order, word_parts: int) -> Material | None:
    """Return what a surface is made of; None for words that a thing has not."""
    made = surface.primitive.material
    role, look = _stem(made.name), made.look
    red, green, blue, _ = look.rgba
    colour: Rgb = (red, green, blue)
    named = colours_of(order.colour_words)
    factor = made.extras.get("shade")
    if role in DISPLAYS:
        text = _text_on(made.extras, role, order, word_parts)
        if text is None:
            return None
        ground = shade(named[0], factor) if named and factor is not None else colour
        on = Display(
            *_picture_size(surface),
            text,
            order.category,
            ground,
            named[1] if len(named) > 1 else None,
            order.variant,
        )
        return _displaying(role, on, look.emission)
    match role:
        case "body" | "body:wood" if named:
            painted = shade(named[0], 1.0 if factor is None else factor)
            if is_wooden(order.colour_words):
                return wood(painted)
            return _painted(look, painted)
        case "trim" if is_wooden(order.colour_words):
            return wood(named[0])
        case "second" if len(named) > 1:
            return _painted(look, named[1])
        case "wood" | "body:wood":
            return wood(colour)
        case _:
            return look


def _text_on(
    extras: Mapping[str, Any], role: str, order: Order, word_parts: int
) -> str | None:
    if role.startswith("picture"):
        return order.text or ""
    text = order.text
    if text is not None and "part" in extras:
        parts = text.split("/", word_parts - 1)
        text = parts[extras["part"]].strip() if extras["part"] < len(parts) else None
    elif text is None and "text" in extras:
        text = str(extras["text"]).replace("{category}", order.category)
    return text


@cache
def _painted(look: Material, colour: Rgb) -> Material:
    return Material((*colour, look.rgba[3]), None, look.emission, look.shininess)


@cache
def _displaying(role: str, on: Display, emission: float) -> Material:
    return picture(DISPLAYS[role](on), emission)


def _picture_size(surface: Surface) -> tuple[float, float]:
    """Return how many metres wide and high a surface's whole picture is."""
    uv = surface.primitive.uv
    if uv is None:
        return 1.0, 1.0
    faces = surface.primitive.faces
    ways = np.diff(uv[faces], axis=1)
    largest = int(np.argmax(np.abs(np.linalg.det(ways))))
    if abs(np.linalg.det(ways[largest])) < 1e-9:
        return 1.0, 1.0
    steps = np.diff(surface.vertices[faces[largest]], axis=0)
    right, down = np.linalg.inv(ways[largest]) @ steps
    wide, high = float(np.linalg.norm(right)), float(np.linalg.norm(down))
    return max(round(wide, 3), 0.01), max(round(high, 3), 0.01)


def _uv(surface: Surface) -> FloatArray:
    """Return where its picture lies: as the file has it, but for grain."""
    uv = surface.primitive.uv
    if uv is None or _stem(surface.primitive.material.name) in GRAINED:
        return uv_from_the_sides(surface.vertices, surface.normals)
    return uv


def _filling(
    shown: Mapping[Material, Sequence[Surface]], size: FloatArray
) -> ObjectModel:
    """Return what was put together, stretched to fill its box exactly."""
    points = [piece.vertices for pieces in shown.values() for piece in pieces]
    low = np.min([each.min(axis=0) for each in points], axis=0)
    high = np.max([each.max(axis=0) for each in points], axis=0)
    scale = size / np.maximum(high - low, 1e-9)
    corner = size * (-0.5, -0.5, 0.0) - low * scale
    parts: list[MeshPart] = []
    for material, pieces in shown.items():
        vertices = np.concatenate([each.vertices for each in pieces]) * scale + corner
        normals = np.concatenate([each.normals for each in pieces]) / scale
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        starts = np.cumsum([0, *(len(each.vertices) for each in pieces)])
        faces = [
            each.primitive.faces + start
            for each, start in zip(pieces, starts, strict=False)
        ]
        uv = None
        if material.texture is not None:
            uv = np.concatenate([_uv(each) for each in pieces])
        parts.append(
            read_only_part(vertices, np.concatenate(faces), normals, uv, material)
        )
    return ObjectModel(tuple(parts))
