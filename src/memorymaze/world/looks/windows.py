"""Windows of the building, through which one sees what is behind them."""

import math

from memorymaze.world.looks.assembly import Assembly, ObjectModel
from memorymaze.world.looks.boards import sign_board
from memorymaze.world.looks.materials import Rgb, glass, paint, picture
from memorymaze.world.looks.shapes import around, box, pane
from memorymaze.world.sites.records import Landmark

WINDOW_CATEGORIES = frozenset({
    "large window",
    "shop window",
    "viewing window",
    "window",
})
"""Categories of landmarks that are windows."""
WINDOWS = frozenset({"window", "shop window", "viewing window"})
"""Archetypes that are made here."""
LONGEST_BAY = 1.3
"""Metres between upright bars, at most."""


def is_window(landmark: Landmark) -> bool:
    """Whether a landmark is a pane that one sees through."""
    return landmark.category in WINDOW_CATEGORIES


def window_model(
    category: str, size: tuple[float, float, float], text: str | None
) -> ObjectModel:
    """Return a window of a size, in the frame of `ObjectModel`."""
    length, depth, height = size
    front, half = depth / 2, length / 2
    dark = category != "window"
    metal: Rgb = (0.26, 0.27, 0.29) if dark else (0.90, 0.90, 0.88)
    frame = paint(metal, 0.3)
    rail = min(0.06, length / 8, height / 8)
    x = (-front, front)
    made = Assembly()
    made.add(
        frame,
        box(x, (-half, -half + rail), (0.0, height)),
        box(x, (half - rail, half), (0.0, height)),
        box(x, (-half + rail, half - rail), (0.0, rail)),
        box(x, (-half + rail, half - rail), (height - rail, height)),
    )
    bays = max(1, math.ceil((length - 2 * rail) / LONGEST_BAY))
    bar_x, inner = (-front, front - 0.004), (-half + rail, half - rail)
    for bar in range(1, bays):
        y = -half + rail + bar * (length - 2 * rail) / bays
        made.box(frame, bar_x, around(y, 0.02), (rail, height - rail))
    if height > 2.2:
        made.box(frame, bar_x, inner, (height - 0.75, height - 0.71))
    clear = glass((0.80, 0.91, 0.95), 0.12)
    made.add(clear, pane(front - 0.012, inner, (rail, height - rail)))
    if text:
        wide = min(length - 2 * rail, max(0.5, 0.075 * len(text)))
        tall = min(0.22, height / 5)
        z = (height - rail - 0.04 - tall, height - rail - 0.04)
        x = (front - 0.012, front - 0.002)
        board = sign_board(wide, tall, text, (0.10, 0.14, 0.22))
        made.plate(picture(board), x, around(0, wide / 2), z)
    return made.unstretched()
