"""What doors of several styles have in common: frames, leaves, handles."""

from collections.abc import Callable

import numpy as np

from memorymaze.pictures.looks.colours import Rgb, colours_of
from memorymaze.pictures.looks.object_model import Material, MeshPart, ObjectModel
from memorymaze.pictures.looks.paints import glass, metal
from memorymaze.pictures.looks.primitives import box
from memorymaze.pictures.looks.shape import Floats, Shape, joined
from memorymaze.simulation.solids import DOOR_HEIGHT, DOOR_PROUD
from memorymaze.sites.records import Door

STEEL: Rgb = (0.70, 0.71, 0.73)
DARK: Rgb = (0.16, 0.17, 0.18)
DOUBLE_FROM = 1.35
"""Doorways this wide, metres, have two leaves."""
FRONT = DOOR_PROUD
CASING = 0.07
"""Width of the frame beside and above the doorway, metres."""
CASING_FRONT = 0.034
AJAR_DEG = 100.0
"""How far an open leaf is swung into the room."""

Parts = dict[Material, list[Shape]]


def leaves(length: float) -> list[tuple[float, float, float]]:
    """Return from, to and the hinge's side (-1, 1) of each leaf, along y."""
    half = length / 2 - 0.005
    if length < DOUBLE_FROM:
        return [(-half, half, -1.0)]
    return [(-half, -0.003, -1.0), (0.003, half, 1.0)]


def casing(parts: Parts, length: float, material: Material) -> None:
    """Add the frame beside and above the doorway."""
    half = length / 2
    for side in (-1, 1):
        add(
            parts,
            material,
            box(
                (-0.05, CASING_FRONT),
                ordered(side * half, side * (half + CASING)),
                (0.0, DOOR_HEIGHT + CASING),
            ),
        )
    add(
        parts,
        material,
        box(
            (-0.05, CASING_FRONT),
            (-half, half),
            (DOOR_HEIGHT - 0.005, DOOR_HEIGHT + CASING),
        ),
    )


def handle(parts: Parts, y: float, towards: float) -> None:
    """Add a lever at 1.05 m that points to its hinge."""
    steel = metal(STEEL)
    add(
        parts,
        steel,
        box((FRONT, FRONT + 0.008), (y - 0.02, y + 0.02), (0.93, 1.13)),
        box((FRONT, FRONT + 0.05), (y - 0.01, y + 0.01), (1.04, 1.06)),
        box(
            (FRONT + 0.035, FRONT + 0.055),
            ordered(y, y + towards * 0.12),
            (1.035, 1.06),
            0.008,
        ),
    )


def swinging(
    parts: Parts,
    door: Door,
    length: float,
    leaf: Callable[[float, float, float], Parts],
) -> None:
    """Add leaves, swung into the room where the door is open."""
    for low, high, hinge in leaves(length):
        made = leaf(low, high, hinge)
        at = low if hinge < 0 else high
        for material, shapes in made.items():
            for shape in shapes:
                if door.state == "open":
                    swung = shape.moved(-FRONT, -at).turned("z", -hinge * AJAR_DEG)
                    shape = swung.moved(-0.06, at - hinge * 0.03)
                add(parts, material, shape)
    if door.state == "open":
        threshold_pane(parts, length)


def threshold_pane(parts: Parts, length: float) -> None:
    """Add what tells the doorway from what is behind it, hardly to be seen."""
    clear = glass((0.8, 0.9, 0.95), 0.03)
    half = length / 2
    add(parts, clear, pane(0.0, (-half, half), (0.0, DOOR_HEIGHT)))


def frame_line(x: float, y: tuple[float, float], z: tuple[float, float]) -> Shape:
    """Return four thin grooves round a rectangle."""
    wide = 0.008
    return joined(
        pane(x, (y[0], y[0] + wide), z),
        pane(x, (y[1] - wide, y[1]), z),
        pane(x, y, (z[0], z[0] + wide)),
        pane(x, y, (z[1] - wide, z[1])),
    )


def pane(x: float, y: tuple[float, float], z: tuple[float, float]) -> Shape:
    """Return a single rectangle that is seen from the front."""
    points = np.array([
        (x, y[0], z[0]),
        (x, y[1], z[0]),
        (x, y[1], z[1]),
        (x, y[0], z[1]),
    ])
    return Shape(
        points,
        np.array([(0, 1, 2), (0, 2, 3)]),
        np.tile((1.0, 0.0, 0.0), (4, 1)),
    )


def upright_grain(
    x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]
) -> Shape:
    """Return a box whose picture stands upright on its front and back."""
    shape = box(x, y, z)
    across = (shape.vertices[:, 1] - y[0]) / (y[1] - y[0])
    up = (shape.vertices[:, 2] - z[0]) / (z[1] - z[0])
    return Shape(
        shape.vertices, shape.faces, shape.normals, np.column_stack([up, across])
    )


def add(parts: Parts, material: Material, *shapes: Shape) -> None:
    """Add shapes of a material."""
    parts.setdefault(material, []).extend(shapes)


def ordered(a: float, b: float) -> tuple[float, float]:
    """Return two numbers, the smaller first."""
    return (a, b) if a < b else (b, a)


def door_model(parts: Parts) -> ObjectModel:
    """Return the model that the parts make up."""
    made: list[MeshPart] = []
    for material, shapes in parts.items():
        if material.texture is None:
            shapes = [Shape(s.vertices, s.faces, s.normals) for s in shapes]
        whole = joined(*shapes)
        uv: Floats | None = whole.uv
        made.append(
            MeshPart(
                whole.vertices.astype(np.float32),
                whole.faces.astype(np.int32),
                whole.normals.astype(np.float32),
                None if uv is None else uv.astype(np.float32),
                material,
            )
        )
    return ObjectModel(tuple(made))


def door_colour(door: Door, otherwise: Rgb) -> Rgb:
    """Return the first colour that the plan names for a door."""
    return next(iter(colours_of(door.color)), otherwise)
