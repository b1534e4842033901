"""Windows that one sees through: frame, bars and panes; what is behind is not here."""

import numpy as np

from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.object_model import Material, MeshPart, ObjectModel
from memorymaze.pictures.looks.paints import glass, paint, picture
from memorymaze.pictures.looks.primitives import box, plate
from memorymaze.pictures.looks.shape import Shape, joined
from memorymaze.sites.records import Landmark

WINDOW_CATEGORIES = frozenset({
    "large window",
    "shop window",
    "viewing window",
    "window",
})
"""Categories of landmarks that are windows."""

BAY = 1.3
"""Metres between upright bars, at most."""


def is_window(landmark: Landmark) -> bool:
    """Whether a landmark is a pane that one sees through."""
    return landmark.category in WINDOW_CATEGORIES


def window_model(landmark: Landmark) -> ObjectModel:
    """Return a window of the landmark's size, in the frame of `ObjectModel`."""
    length, depth, height = landmark.size
    front, half = depth / 2, length / 2
    dark = landmark.category != "window"
    metal: Rgb = (0.26, 0.27, 0.29) if dark else (0.90, 0.90, 0.88)
    frame = paint(metal, 0.3)
    rail = min(0.06, length / 8, height / 8)
    x = (-front, front)
    shapes = [
        box(x, (-half, -half + rail), (0.0, height)),
        box(x, (half - rail, half), (0.0, height)),
        box(x, (-half + rail, half - rail), (0.0, rail)),
        box(x, (-half + rail, half - rail), (height - rail, height)),
    ]
    bays = max(1, int(np.ceil((length - 2 * rail) / BAY)))
    for bar in range(1, bays):
        y = -half + rail + bar * (length - 2 * rail) / bays
        shapes.append(
            box((-front, front - 0.004), (y - 0.02, y + 0.02), (rail, height - rail))
        )
    if height > 2.2:
        shapes.append(
            box(
                (-front, front - 0.004),
                (-half + rail, half - rail),
                (height - 0.75, height - 0.71),
            )
        )
    parts: list[tuple[Material, Shape]] = [(frame, joined(*_bare(shapes)))]
    tint: Rgb = (0.80, 0.91, 0.95)
    pane = np.array([
        (front - 0.012, -half + rail, rail),
        (front - 0.012, half - rail, rail),
        (front - 0.012, half - rail, height - rail),
        (front - 0.012, -half + rail, height - rail),
    ])
    parts.append((
        glass(tint, 0.12),
        Shape(pane, np.array([(0, 1, 2), (0, 2, 3)]), np.tile((1.0, 0.0, 0.0), (4, 1))),
    ))
    if landmark.text:
        wide = min(length - 2 * rail, max(0.5, 0.075 * len(landmark.text)))
        tall = min(0.22, height / 5)
        board = sign_board(wide, tall, landmark.text, (0.10, 0.14, 0.22))
        top = height - rail - 0.04
        parts.append((
            picture(board),
            plate(
                (front - 0.012, front - 0.002), (-wide / 2, wide / 2), (top - tall, top)
            ),
        ))
    return ObjectModel(
        tuple(
            MeshPart(
                shape.vertices.astype(np.float32),
                shape.faces.astype(np.int32),
                shape.normals.astype(np.float32),
                None if shape.uv is None else shape.uv.astype(np.float32),
                material,
            )
            for material, shape in parts
        )
    )


def _bare(shapes: list[Shape]) -> list[Shape]:
    return [Shape(each.vertices, each.faces, each.normals) for each in shapes]
