"""Windows of the building, and panes behind which something is painted."""

from functools import cache

import numpy as np
from PIL import ImageDraw

from memorymaze.pictures.looks.assembly import Assembly, ObjectModel, Order
from memorymaze.pictures.looks.boards import blank, graded, pixels_of
from memorymaze.pictures.looks.materials import (
    SHALE,
    Pixels,
    Rgb,
    glass,
    paint,
    picture,
    rgb255,
    shade,
)
from memorymaze.pictures.looks.shapes import around, box, pane
from memorymaze.sites.records import Landmark

WINDOW_CATEGORIES = frozenset({
    "large window",
    "shop window",
    "viewing window",
    "window",
})
"""Categories of landmarks that are windows."""
LONGEST_BAY = 1.3
"""Metres between upright bars, at most."""
FRAME: Rgb = (0.88, 0.88, 0.87)
SHOP_GOODS: tuple[Rgb, ...] = (
    (0.85, 0.3, 0.25), (0.25, 0.5, 0.8), (0.95, 0.8, 0.3), (0.4, 0.65, 0.4),
    (0.7, 0.45, 0.7), (0.95, 0.95, 0.92)
)  # fmt: skip


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
    made = Assembly()
    made.add(
        frame,
        box(x, (-half, -half + rail), (0.0, height)),
        box(x, (half - rail, half), (0.0, height)),
        box(x, (-half + rail, half - rail), (0.0, rail)),
        box(x, (-half + rail, half - rail), (height - rail, height)),
    )
    bays = max(1, int(np.ceil((length - 2 * rail) / LONGEST_BAY)))
    bar_x, inner = (-front, front - 0.004), (-half + rail, half - rail)
    for bar in range(1, bays):
        y = -half + rail + bar * (length - 2 * rail) / bays
        made.box(frame, bar_x, around(y, 0.02), (rail, height - rail))
    if height > 2.2:
        made.box(frame, bar_x, inner, (height - 0.75, height - 0.71))
    clear = glass((0.80, 0.91, 0.95), 0.12)
    made.add(clear, pane(front - 0.012, inner, (rail, height - rail)))
    if landmark.text:
        wide = min(length - 2 * rail, max(0.5, 0.075 * len(landmark.text)))
        tall = min(0.22, height / 5)
        z = (height - rail - 0.04 - tall, height - rail - 0.04)
        x = (front - 0.012, front - 0.002)
        made.words(landmark.text, (0.10, 0.14, 0.22), x, around(0, wide / 2), z)
    return made.unstretched()


def window(made: Assembly, order: Order) -> None:
    """Build a window with daylight: sky and trees behind a frame with bars."""
    panes = max(1, round(order.length / 1.0))
    _framed(
        made,
        order,
        _outdoors(order.length, order.height, order.variant),
        panes,
        FRAME,
        0.5,
    )


def shop_window(made: Assembly, order: Order) -> None:
    """Build a lit shop window: goods on shelves, the shop's words above."""
    pixels = _shop(order.length, order.height, order.variant)
    _framed(made, order, pixels, 1, SHALE, 0.35)


def viewing_window(made: Assembly, order: Order) -> None:
    """Build a window into a room with benches and machines, with words above."""
    pixels = _workshop(order.length, order.height, order.variant)
    _framed(made, order, pixels, max(1, round(order.length / 1.2)), SHALE, 0.3)


def _framed(
    made: Assembly, order: Order, pixels: Pixels, panes: int, frame: Rgb, light: float
) -> None:
    bar = min(0.06, 0.06 * order.length)
    head = max(bar, min(0.3, 0.16 * order.height)) if order.text else bar
    top = order.height - head
    y = order.y.inset(bar * 0.9)
    made.plate(
        picture(pixels, light), order.x.inset(0, 0.03), y, (bar * 0.9, top + 0.01)
    )
    material = paint(frame, 0.2)
    made.add(
        material,
        box(order.x, order.y, (0, bar)),
        box(order.x.inset(0, 0.004 * bool(order.text)), order.y, (top, order.height)),
        box(order.x, order.y.start(bar), (bar, top)),
        box(order.x, order.y.end(bar), (bar, top)),
    )
    for place in range(1, panes):
        middle = order.y[0] + order.length * place / panes
        made.box(
            material, order.x.inset(0, 0.008), around(middle, bar / 2.5), (bar, top)
        )
    made.words(
        order.text,
        shade(SHALE, 0.7),
        order.x,
        around(0, order.length * 0.48),
        (top + head * 0.05, top + head * 0.95),
        light=0.2,
    )


@cache
def _outdoors(width: float, height: float, variant: int) -> Pixels:
    w, h = size = blank(width, height, FRAME).size
    image = graded(size, (0.55, 0.75, 0.95), (0.92, 0.96, 1.0))
    draw = ImageDraw.Draw(image)
    rng = np.random.default_rng(variant + 5)
    for x, y in rng.random((4, 2)):
        for puff in range(4):
            cx, cy, r = (
                x * w + puff * 0.04 * w,
                (0.1 + 0.25 * y) * h,
                (0.03 + 0.012 * (puff % 2)) * w,
            )
            draw.ellipse([cx - r, cy - r * 0.6, cx + r, cy + r * 0.6], (250, 252, 255))
    draw.rectangle([0, 0.86 * h, w, h], rgb255((0.45, 0.62, 0.35)))
    for x, size in rng.random((max(4, w // 50), 2)):
        r = (0.07 + 0.09 * size) * h
        cy = 0.82 * h - r * 0.5
        tone = rgb255(shade((0.25, 0.48, 0.24), 0.85 + 0.4 * size))
        draw.rectangle([x * w - 2, cy, x * w + 2, 0.88 * h], rgb255((0.35, 0.26, 0.18)))
        draw.ellipse([x * w - r, cy - r, x * w + r, cy + r], tone)
    return pixels_of(image)


@cache
def _shop(width: float, height: float, variant: int) -> Pixels:
    image = blank(width, height, (0.96, 0.92, 0.82))
    draw = ImageDraw.Draw(image)
    w, h = image.size
    rng = np.random.default_rng(variant + 23)
    rows = 4
    for row in range(rows):
        floor = h * (row + 1) / rows - 0.03 * h
        draw.rectangle([0, floor, w, floor + 0.02 * h], rgb255((0.55, 0.4, 0.27)))
        x = 0.03 * w
        while x < 0.94 * w:
            wide = float(rng.uniform(0.04, 0.09)) * w
            tall = float(rng.uniform(0.08, 0.19)) * h
            tone = rgb255(SHOP_GOODS[int(rng.integers(len(SHOP_GOODS)))])
            if rng.random() < 0.5:
                draw.rectangle([x, floor - tall, x + wide, floor], tone, (90, 80, 70))
            else:
                draw.ellipse([x, floor - wide, x + wide, floor], tone, (90, 80, 70))
            x += wide + 0.015 * w
    return pixels_of(image)


@cache
def _workshop(width: float, height: float, variant: int) -> Pixels:
    image = blank(width, height, (0.72, 0.78, 0.82))
    draw = ImageDraw.Draw(image)
    w, h = image.size
    rng = np.random.default_rng(variant + 31)
    draw.rectangle([0, 0.72 * h, w, h], rgb255((0.5, 0.52, 0.54)))
    for place in range(4):
        x = w * (0.05 + 0.24 * place)
        tall = float(rng.uniform(0.2, 0.42)) * h
        tone = SHOP_GOODS[int(rng.integers(len(SHOP_GOODS)))]
        draw.rectangle(
            [x, 0.8 * h - tall, x + 0.16 * w, 0.8 * h],
            rgb255(shade(tone, 0.8)),
            (60, 60, 60),
        )
        draw.rectangle(
            [x + 0.03 * w, 0.83 * h - tall, x + 0.13 * w, 0.8 * h - 0.6 * tall],
            rgb255((0.1, 0.3, 0.4)),
        )
    for x in (0.2, 0.5, 0.8):
        draw.rectangle(
            [x * w - 0.08 * w, 0.04 * h, x * w + 0.08 * w, 0.07 * h], (255, 255, 250)
        )
    return pixels_of(image)
