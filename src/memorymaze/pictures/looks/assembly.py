"""Putting shapes and materials together to a thing of the right size."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Concatenate, ParamSpec

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.points import FloatArray
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.materials import (
    ANTHRACITE,
    STONE,
    Material,
    Rgb,
    colours_of,
    is_wooden,
    paint,
    picture,
    shade,
    wood,
)
from memorymaze.pictures.looks.shapes import (
    Axis,
    AxisSpan,
    Extent,
    Shape,
    around,
    ball,
    box,
    cylinder,
    joined,
    lathed,
    plate,
    span_within,
)
from memorymaze.pictures.looks.tubes import Point3, limb, tube
from memorymaze.sites.records import Mount

P = ParamSpec("P")
ORIGIN: Point3 = (0.0, 0.0, 0.0)
PICTURE_SPAN = 2.0
"""Metres that a picture covers where a shape does not say how it lies."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshPart:
    """Triangles of one material; all arrays are read-only."""

    vertices: NDArray[np.float32]
    """(N, 3) metres, in the model's frame."""
    faces: NDArray[np.int32]
    """(M, 3) vertex numbers, counter-clockwise as seen from outside."""
    normals: NDArray[np.float32] | None
    """(N, 3) unit vectors that point outwards; None: flat faces."""
    uv: NDArray[np.float32] | None
    """(N, 2): the share of the texture's width from the left, and of its height from
    the top; beyond [0, 1] the picture repeats. None where the material has no texture."""
    material: Material

    def with_normals(self) -> "MeshPart":
        """Return the part with a normal per vertex; flat faces get their own corners."""
        if self.normals is not None:
            return self
        corners = self.vertices[self.faces]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
        return MeshPart(
            corners.reshape(-1, 3),
            np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3),
            across.repeat(3, axis=0).astype(np.float32),
            None if self.uv is None else self.uv[self.faces].reshape(-1, 2),
            self.material,
        )


@dataclass(frozen=True, slots=True, eq=False)
class ObjectModel:
    """A thing in its own frame.

    Metres; the origin is the centre of the footprint, z = 0 the thing's bottom, +x the
    way its front faces, +y its left, +z up. Things that look the same share one model.
    """

    parts: tuple[MeshPart, ...]

    @property
    def triangle_count(self) -> int:
        """Triangles of all parts."""
        return sum(len(part.faces) for part in self.parts)

    def bounds(self) -> NDArray[np.float64]:
        """Return the lowest and the highest corner of its bounding box, (2, 3)."""
        points = np.concatenate([part.vertices for part in self.parts]).astype(float)
        return np.stack([points.min(axis=0), points.max(axis=0)])


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
    def x(self) -> Extent:
        """From the back to the front."""
        return Extent(-self.depth / 2, self.depth / 2)

    @property
    def y(self) -> Extent:
        """From the thing's right to its left: a viewer's left to right."""
        return Extent(-self.length / 2, self.length / 2)

    @property
    def z(self) -> Extent:
        """From the bottom to the top."""
        return Extent(0.0, self.height)

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

    def box(
        self,
        material: Material,
        x: AxisSpan,
        y: AxisSpan,
        z: AxisSpan,
        bevel: float = 0.0,
    ) -> None:
        """Add a box."""
        self.add(material, box(x, y, z, bevel))

    def plate(
        self,
        material: Material,
        x: AxisSpan,
        y: AxisSpan,
        z: AxisSpan,
        *,
        both_sides: bool = False,
    ) -> None:
        """Add a box whose front shows a whole picture."""
        self.add(material, plate(x, y, z, both_sides=both_sides))

    def words(
        self,
        text: str | None,
        ground: Rgb,
        x: AxisSpan,
        y: AxisSpan,
        z: AxisSpan,
        *,
        light: float = 0.0,
        both_sides: bool = False,
    ) -> None:
        """Add a plate whose front is a sign with words on a ground; none for None."""
        if text is not None:
            board = sign_board(y[1] - y[0], z[1] - z[0], text, ground)
            self.plate(picture(board, light), x, y, z, both_sides=both_sides)

    def cylinder(
        self,
        material: Material,
        radius: float,
        span: AxisSpan,
        sides: int = 16,
        top: float | None = None,
        *,
        along: Axis = "z",
        at: Point3 = ORIGIN,
    ) -> None:
        """Add a cylinder or a cone's stump."""
        self.add(material, cylinder(radius, span, sides, top, along=along).moved(*at))

    def ball(
        self,
        material: Material,
        radius: float,
        sides: int = 16,
        rings: int = 10,
        *,
        at: Point3 = ORIGIN,
    ) -> None:
        """Add a ball."""
        self.add(material, ball(radius, sides, rings).moved(*at))

    def lathed(
        self,
        material: Material,
        profile: Sequence[tuple[float, float]],
        sides: int = 16,
        *,
        radius: float = 1.0,
        height: float = 1.0,
        z: float = 0.0,
        at: Point3 = ORIGIN,
    ) -> None:
        """Add a solid turned about the z axis."""
        solid = lathed(profile, sides, radius=radius, height=height, z=z)
        self.add(material, solid.moved(*at))

    def tube(
        self,
        material: Material,
        path: Sequence[Point3],
        radius: float | Sequence[float],
        sides: int = 8,
    ) -> None:
        """Add a tube round a line, with flat ends."""
        self.add(material, tube(path, radius, sides))

    def limb(
        self,
        material: Material,
        path: Sequence[Point3],
        radius: float | Sequence[float],
        sides: int = 8,
    ) -> None:
        """Add a tube with round ends."""
        self.add(material, limb(path, radius, sides))

    def include(
        self, other: "Assembly", x: float = 0.0, y: float = 0.0, z: float = 0.0
    ) -> None:
        """Add another assembly, shifted by metres."""
        for material, shapes in other.shapes.items():
            self.add(material, *(shape.moved(x, y, z) for shape in shapes))

    def turn(self, degrees: float) -> None:
        """Turn it about the z axis, counter-clockwise from above."""
        for shapes in self.shapes.values():
            shapes[:] = [shape.turned("z", degrees) for shape in shapes]

    def model(self, length: float, depth: float, height: float) -> ObjectModel:
        """Return what was put together, stretched to fill its box exactly."""
        whole = self._whole()
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

    def unstretched(self) -> ObjectModel:
        """Return what was put together, as it stands."""
        return ObjectModel(
            tuple(_part(shape, material) for material, shape in self._whole().items())
        )

    def _whole(self) -> dict[Material, Shape]:
        return {
            material: joined(*(_with_uv(shape, material) for shape in shapes))
            for material, shapes in self.shapes.items()
        }


def built(
    build: Callable[Concatenate[Assembly, P], None], *args: P.args, **named: P.kwargs
) -> Assembly:
    """Return what a builder makes on its own, to be shifted or turned."""
    made = Assembly()
    build(made, *args, **named)
    return made


def _with_uv(shape: Shape, material: Material) -> Shape:
    if material.texture is None:
        return Shape(shape.vertices, shape.faces, shape.normals)
    if shape.uv is not None:
        return shape
    return Shape(shape.vertices, shape.faces, shape.normals, _from_the_sides(shape))


def _from_the_sides(shape: Shape) -> FloatArray:
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


def plinth(made: Assembly, order: Order, height: float, colour: Rgb = STONE) -> None:
    """Build a stone base over the order's footprint, its words on the front."""
    stone = paint(colour, 0.05)
    front = order.x[1]
    lip = min(0.03, 0.1 * height)
    made.box(stone, order.x, order.y, (0, lip))
    made.box(
        stone, span_within(order.x, 0.03), span_within(order.y, 0.03), (lip, height)
    )
    if order.text:
        wide = order.length * 0.84
        tall = min(0.75 * (height - lip), 0.42 * wide)
        tall = max(tall, min(0.1, height - lip))
        middle = lip + (height - lip) / 2
        made.words(
            order.text,
            (0.1, 0.1, 0.12),
            (front - 0.05, front - 0.015),
            around(0, wide / 2),
            around(middle, tall / 2),
        )


def header(made: Assembly, order: Order, z: AxisSpan, front: float) -> None:
    """Add a strip with the order's words, if it has any, to the front of a thing."""
    if not order.text:
        return
    colour = order.colour((0.3, 0.3, 0.32))
    ground = shade(colour, 0.45) if not is_wooden(order.colour_words) else ANTHRACITE
    half = order.length * 0.48
    made.words(order.text, ground, (front - 0.02, front + 0.012), (-half, half), z)
