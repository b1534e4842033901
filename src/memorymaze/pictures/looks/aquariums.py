"""Fish behind glass."""

import math
from functools import cache

import numpy as np
from PIL import Image, ImageDraw

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import Pixels, blank, pixels_of, sign_board
from memorymaze.pictures.looks.colours import Rgb, rgb255, shade
from memorymaze.pictures.looks.paints import paint, picture
from memorymaze.pictures.looks.primitives import box, plate

DARK: Rgb = (0.13, 0.14, 0.16)
SEA: Rgb = (0.1, 0.4, 0.62)
FISH: tuple[Rgb, ...] = (
    (0.95, 0.5, 0.1),
    (0.95, 0.8, 0.2),
    (0.8, 0.85, 0.9),
    (0.85, 0.25, 0.3),
)


def aquarium_window(order: Order) -> Assembly:
    """Build a lit window into a tank: fish, weeds, bubbles, its words on the frame."""
    assembly = Assembly()
    back, front = order.x
    frame = min(0.06, 0.06 * order.length)
    assembly.add(paint(DARK, 0.2), box((back, front - 0.012), order.y, order.z))
    low = min(0.24, 0.2 * order.height) if order.text else frame
    pixels = _tank(order.length - 2 * frame, order.height - frame - low, order.variant)
    y = (order.y[0] + frame, order.y[1] - frame)
    assembly.add(
        picture(pixels, 0.45),
        plate((back + 0.01, front - 0.006), y, (low, order.height - frame)),
    )
    if order.text:
        words = sign_board(order.length - 2 * frame, low * 0.86, order.text, DARK)
        assembly.add(
            picture(words), plate((back + 0.01, front), y, (low * 0.08, low * 0.94))
        )
    return assembly


def aquarium(order: Order) -> Assembly:
    """Build a fish tank on a cabinet: water, weeds, stones, fish, a lid with light."""
    assembly = Assembly()
    base = order.height * 0.52
    back, front = order.x
    assembly.add(paint((0.3, 0.2, 0.14)), box((back, front - 0.01), order.y, (0, base)))
    for side in (-1, 1):
        y = sorted((side * 0.01, side * (order.length / 2 - 0.03)))
        assembly.add(
            paint((0.36, 0.25, 0.17)),
            box((front - 0.02, front), (y[0], y[1]), (0.05, base - 0.04), 0.006),
        )
    lid = order.height - 0.07
    pixels = _tank(order.length, lid - base, order.variant)
    assembly.add(
        picture(pixels, 0.35),
        plate(
            (back + 0.02, front - 0.02),
            (order.y[0] + 0.01, order.y[1] - 0.01),
            (base, lid),
            both_sides=True,
        ),
    )
    assembly.add(paint(DARK, 0.2), box(order.x, order.y, (lid, order.height), 0.012))
    for y in (order.y[0], order.y[1] - 0.02):
        for x in (back, front - 0.02):
            assembly.add(
                paint(DARK, 0.2), box((x, x + 0.02), (y, y + 0.02), (base, lid))
            )
    return assembly


@cache
def _tank(width: float, height: float, variant: int) -> Pixels:
    """Draw fish among weeds over sand."""
    w, h = blank(width, height, SEA).size
    rows = np.linspace(0, 1, h)[:, None, None]
    water = np.array((0.3, 0.7, 0.85)) * (1 - rows) + np.array((0.02, 0.2, 0.42)) * rows
    image = Image.fromarray(
        np.broadcast_to(255 * water, (h, w, 3)).astype(np.uint8).copy()
    )
    draw = ImageDraw.Draw(image)
    rng = np.random.default_rng(variant + 19)
    draw.rectangle([0, 0.9 * h, w, h], rgb255((0.82, 0.72, 0.5)))
    for x, tall in rng.random((max(4, w // 40), 2)):
        points = [
            (x * w + 5 * math.sin(step), h * (0.93 - 0.07 * step * (0.5 + tall)))
            for step in range(7)
        ]
        draw.line(points, rgb255((0.12, 0.5, 0.22)), max(3, w // 90), "curve")
    for x, y, r in rng.random((14, 3)):
        size = 1.5 + 3 * r
        box_ = [x * w - size, y * h * 0.8 - size, x * w + size, y * h * 0.8 + size]
        draw.ellipse(box_, outline=(200, 235, 245))
    count = max(3, round(4 * w / h))
    for place in range(count):
        tone = FISH[int(rng.integers(len(FISH)))]
        long_way = min(0.13 * w, 0.15 * h) * float(rng.uniform(0.8, 1.3))
        x = w * (place + 0.5) / count
        y = h * float(rng.uniform(0.18, 0.72))
        ahead = 1 if rng.random() < 0.5 else -1
        tail = [
            (x - ahead * 0.7 * long_way, y),
            (x - ahead * 1.4 * long_way, y - 0.5 * long_way),
            (x - ahead * 1.4 * long_way, y + 0.5 * long_way),
        ]
        draw.polygon(tail, rgb255(shade(tone, 0.8)))
        draw.ellipse(
            [x - long_way, y - 0.5 * long_way, x + long_way, y + 0.5 * long_way],
            rgb255(tone),
        )
        band = 0.12 * long_way
        draw.rectangle(
            [x - band, y - 0.46 * long_way, x + band, y + 0.46 * long_way],
            (245, 245, 245),
        )
        eye = x + ahead * 0.6 * long_way
        r = max(1.5, 0.1 * long_way)
        draw.ellipse([eye - r, y - 2 * r, eye + r, y], (10, 10, 10))
    return pixels_of(image)
