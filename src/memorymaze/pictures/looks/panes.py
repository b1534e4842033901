"""Windows as things on a wall, where a plan names them as landmarks."""

from functools import cache

import numpy as np
from PIL import Image, ImageDraw

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import Pixels, blank, pixels_of, sign_board
from memorymaze.pictures.looks.colours import Rgb, rgb255, shade
from memorymaze.pictures.looks.paints import paint, picture
from memorymaze.pictures.looks.primitives import box, plate

FRAME: Rgb = (0.88, 0.88, 0.87)
DARK: Rgb = (0.2, 0.21, 0.23)
GOODS: tuple[Rgb, ...] = (
    (0.85, 0.3, 0.25), (0.25, 0.5, 0.8), (0.95, 0.8, 0.3), (0.4, 0.65, 0.4),
    (0.7, 0.45, 0.7), (0.95, 0.95, 0.92),
)  # fmt: skip


def window(order: Order) -> Assembly:
    """Build a window with daylight: sky and trees behind a frame with bars."""
    panes = max(1, round(order.length / 1.0))
    return _framed(
        order, _outdoors(order.length, order.height, order.variant), panes, FRAME, 0.5
    )


def shop_window(order: Order) -> Assembly:
    """Build a lit shop window: goods on shelves, the shop's words above."""
    pixels = _shop(order.length, order.height, order.variant)
    return _framed(order, pixels, 1, DARK, 0.35)


def viewing_window(order: Order) -> Assembly:
    """Build a window into a room with benches and machines, with words above."""
    pixels = _workshop(order.length, order.height, order.variant)
    return _framed(order, pixels, max(1, round(order.length / 1.2)), DARK, 0.3)


def _framed(
    order: Order, pixels: Pixels, panes: int, frame: Rgb, light: float
) -> Assembly:
    assembly = Assembly()
    back, front = order.x
    bar = min(0.06, 0.06 * order.length)
    head = max(bar, min(0.3, 0.16 * order.height)) if order.text else bar
    top = order.height - head
    y = (order.y[0] + bar * 0.9, order.y[1] - bar * 0.9)
    assembly.add(
        picture(pixels, light), plate((back, front - 0.03), y, (bar * 0.9, top + 0.01))
    )
    material = paint(frame, 0.2)
    assembly.add(
        material,
        box((back, front), order.y, (0, bar)),
        box((back, front - 0.004 * bool(order.text)), order.y, (top, order.height)),
        box((back, front), (order.y[0], order.y[0] + bar), (bar, top)),
        box((back, front), (order.y[1] - bar, order.y[1]), (bar, top)),
    )
    for place in range(1, panes):
        middle = order.y[0] + order.length * place / panes
        assembly.add(
            material,
            box(
                (back, front - 0.008),
                (middle - bar / 2.5, middle + bar / 2.5),
                (bar, top),
            ),
        )
    if order.text:
        wide = order.length * 0.96
        words = sign_board(wide, head * 0.9, order.text, shade(DARK, 0.7))
        assembly.add(
            picture(words, 0.2),
            plate(
                (back, front),
                (-wide / 2, wide / 2),
                (top + head * 0.05, top + head * 0.95),
            ),
        )
    return assembly


@cache
def _outdoors(width: float, height: float, variant: int) -> Pixels:
    w, h = blank(width, height, FRAME).size
    rows = np.linspace(0, 1, h)[:, None, None]
    sky = np.array((0.55, 0.75, 0.95)) * (1 - rows) + np.array((0.92, 0.96, 1.0)) * rows
    image = Image.fromarray(
        np.broadcast_to(255 * sky, (h, w, 3)).astype(np.uint8).copy()
    )
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
            tone = rgb255(GOODS[int(rng.integers(len(GOODS)))])
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
        tone = GOODS[int(rng.integers(len(GOODS)))]
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
