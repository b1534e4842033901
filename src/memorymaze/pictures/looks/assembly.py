"""Putting shapes and materials together to a thing of the right size."""

from dataclasses import dataclass, field

import numpy as np

from memorymaze.pictures.looks.colours import Rgb, colours_of, is_wooden, shade
from memorymaze.pictures.looks.object_model import Material, MeshPart, ObjectModel
from memorymaze.pictures.looks.paints import paint, wood
from memorymaze.pictures.looks.primitives import Span
from memorymaze.pictures.looks.shape import Floats, Shape, joined
from memorymaze.sites.records import Mount

PICTURE_SPAN = 2.0
"""Metres that a picture covers where a shape does not say how it lies."""


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
    def x(self) -> Span:
        """From the back to the front."""
        return (-self.depth / 2, self.depth / 2)

    @property
    def y(self) -> Span:
        """From the thing's right to its left: a viewer's left to right."""
        return (-self.length / 2, self.length / 2)

    @property
    def z(self) -> Span:
        """From the bottom to the top."""
        return (0.0, self.height)

    def colour(self, otherwise: Rgb) -> Rgb:
        """Return the first colour it is said to have."""
        return next(iter(colours_of(self.colour_words)), otherwise)

    def second_colour(self, otherwise: Rgb) -> Rgb:
        """Return the second colour it is said to have."""
        return next(iter(colours_of(self.colour_words)[1:]), otherwise)

    def body(self, otherwise: Rgb, shininess: float = 0.15) -> Material:
        """Return its main material: wood where its colour names wood, else paint."""
        colour = self.colour(otherwise)
        if is_wooden(self.colour_words):
            return wood(colour)
        return paint(colour, shininess)

    def rng(self) -> np.random.Generator:
        """Return the source of whatever is left to chance about it."""
        return np.random.default_rng(self.variant)

    def shaded(self, otherwise: Rgb, factor: float) -> Material:
        """Return a darker (factor < 1) or lighter paint of its main colour."""
        return paint(shade(self.colour(otherwise), factor))


@dataclass(slots=True)
class Assembly:
    """Shapes so far, by material."""

    shapes: dict[Material, list[Shape]] = field(default_factory=dict)

    def add(self, material: Material, *shapes: Shape) -> None:
        """Add shapes of one material."""
        self.shapes.setdefault(material, []).extend(shapes)

    def include(
        self, other: "Assembly", x: float = 0.0, y: float = 0.0, z: float = 0.0
    ) -> None:
        """Add another assembly, shifted by metres."""
        for material, shapes in other.shapes.items():
            self.add(material, *(shape.moved(x, y, z) for shape in shapes))

    def turned(self, degrees: float) -> "Assembly":
        """Return it turned about the z axis, counter-clockwise from above."""
        turned = Assembly()
        for material, shapes in self.shapes.items():
            turned.add(material, *(shape.turned("z", degrees) for shape in shapes))
        return turned

    def model(self, length: float, depth: float, height: float) -> ObjectModel:
        """Return what was put together, stretched to fill its box exactly."""
        whole = {
            material: joined(*(_with_uv(shape, material) for shape in shapes))
            for material, shapes in self.shapes.items()
        }
        lows = [shape.vertices.min(axis=0) for shape in whole.values()]
        highs = [shape.vertices.max(axis=0) for shape in whole.values()]
        low, high = np.min(lows, axis=0), np.max(highs, axis=0)
        size = np.array((depth, length, height))
        scale = size / np.maximum(high - low, 1e-9)
        corner = np.array((-depth / 2, -length / 2, 0.0))
        parts = [
            _part(shape.moved(*-low).scaled(*scale).moved(*corner), material)
            for material, shape in whole.items()
        ]
        return ObjectModel(tuple(parts))


def _with_uv(shape: Shape, material: Material) -> Shape:
    if material.texture is None:
        return Shape(shape.vertices, shape.faces, shape.normals)
    if shape.uv is not None:
        return shape
    return Shape(shape.vertices, shape.faces, shape.normals, _from_the_sides(shape))


def _from_the_sides(shape: Shape) -> Floats:
    """Lay the picture on from the side that each corner faces, along its long side."""
    low, high = shape.vertices.min(axis=0), shape.vertices.max(axis=0)
    share = (shape.vertices - low) / max(PICTURE_SPAN, *(high - low))
    facing = np.argmax(np.abs(shape.normals), axis=1)
    long_way = int(np.argmax(high - low))
    along = np.where(facing == long_way, (long_way + 1) % 3, long_way)
    across = 3 - facing - along
    rows = np.arange(len(share))
    return np.column_stack([share[rows, along], 1 - share[rows, across]])


def _part(shape: Shape, material: Material) -> MeshPart:
    vertices = shape.vertices.astype(np.float32)
    faces = shape.faces.astype(np.int32)
    normals = shape.normals.astype(np.float32)
    uv = None if shape.uv is None else np.clip(shape.uv, 0, 1).astype(np.float32)
    for array in (vertices, faces, normals, uv):
        if array is not None:
            array.flags.writeable = False
    return MeshPart(vertices, faces, normals, uv, material)
