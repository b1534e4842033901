"""Aquariums, tanks and what dives."""

import math
from functools import cache

import numpy as np
from PIL import Image, ImageDraw

from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import Pixels, blank, pixels_of, sign_board
from memorymaze.simulation.looks.colours import Rgb, mixed, rgb255, shade
from memorymaze.simulation.looks.paints import glass, metal, paint, picture
from memorymaze.simulation.looks.primitives import (
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.simulation.looks.tubes import limb, tube

__all__ = ["aquarium", "aquarium_window", "submersible", "wave_tank"]

DARK: Rgb = (0.13, 0.14, 0.16)
STEEL: Rgb = (0.66, 0.68, 0.7)
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


def wave_tank(order: Order) -> Assembly:
    """Build a long tank on legs with a wave in it and a paddle with a handle."""
    assembly = Assembly()
    back, front = order.x
    deck = order.height * 0.42
    frame = metal(STEEL)
    for x in (back + 0.05, front - 0.05):
        for y in (order.y[0] + 0.06, order.y[1] - 0.06):
            assembly.add(
                frame, box((x - 0.03, x + 0.03), (y - 0.03, y + 0.03), (0, deck))
            )
    assembly.add(frame, box(order.x, order.y, (deck - 0.05, deck)))
    level = deck + 0.5 * (order.height - deck)
    outline = [(order.y[0] + 0.03, deck), (order.y[1] - 0.03, deck)]
    steps = 24
    for step in range(steps + 1):
        y = order.y[1] - 0.03 - (order.length - 0.06) * step / steps
        wave = (
            0.16
            * (order.height - deck)
            * math.sin(2.5 * math.tau * step / steps)
            * math.exp(-2.0 * step / steps)
        )
        outline.append((y, level + wave))
    assembly.add(
        paint(mixed(order.colour(SEA), (1, 1, 1), 0.15), 0.7),
        extruded(outline, (back + 0.03, front - 0.03), "x"),
    )
    assembly.add(
        glass(alpha=0.25),
        box((front - 0.02, front - 0.008), order.y, (deck, order.height - 0.06)),
    )
    paddle = order.y[1] - 0.2
    assembly.add(
        paint((0.9, 0.75, 0.1)),
        box(
            (back + 0.06, front - 0.06),
            (paddle - 0.015, paddle + 0.015),
            (deck + 0.05, order.height - 0.05),
        ),
        tube(
            [(0, paddle, order.height - 0.06), (0, paddle - 0.25, order.height - 0.02)],
            0.02,
            6,
        ),
    )
    if order.text:
        wide = order.length * 0.6
        tall = 0.2
        pixels = sign_board(wide, tall, order.text, (0.1, 0.25, 0.45))
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.02, front),
                (-wide / 2, wide / 2),
                (deck - 0.04 - tall, deck - 0.04),
            ),
        )
    return assembly


def submersible(order: Order) -> Assembly:
    """Build a deep-sea vessel from its side: a hull, a bubble, a screw, arms, words."""
    assembly = Assembly()
    low = 0.14 * order.height
    half = order.length / 2
    deep = order.depth / 2
    tall = order.height - low
    r = 0.4 * tall
    middle = low + r
    hull = paint(order.colour((0.96, 0.79, 0.13)), 0.4)
    profile = [
        (0, -0.72 * half),
        (r * 0.5, -0.7 * half),
        (r * 0.85, -0.58 * half),
        (r, -0.4 * half),
        (r, 0.35 * half),
        (r * 0.8, 0.62 * half),
        (r * 0.4, 0.84 * half),
        (r * 0.15, 0.9 * half),
    ]
    body = lathed(profile, 24).turned("x", -90).scaled(deep * 0.86 / r, 1, 1)
    assembly.add(hull, body.moved(z=middle))
    tower = box(
        (-deep * 0.4, deep * 0.4),
        (-0.25 * half, 0.25 * half),
        (middle + 0.7 * r, order.height),
        0.08,
    )
    assembly.add(paint((0.9, 0.25, 0.15), 0.3), tower)
    nose = -0.6 * half
    assembly.add(
        paint((0.1, 0.25, 0.4), 0.95), ball(r * 0.55, 16, 12).moved(0, nose, middle)
    )
    for side in (-1, 1):
        port = cylinder(r * 0.24, (0, 0.05), 18).turned("y", 90 * side)
        pane = cylinder(r * 0.18, (0, 0.06), 16).turned("y", 90 * side)
        for y in (-0.36, -0.12):
            x = side * deep * 0.82
            assembly.add(metal(STEEL), port.moved(x, y * half, middle + 0.2 * r))
            assembly.add(
                paint((0.1, 0.2, 0.35), 0.9), pane.moved(x, y * half, middle + 0.2 * r)
            )
        assembly.add(
            paint(shade(order.colour((0.96, 0.79, 0.13)), 0.8)),
            box(
                (side * deep * 0.55 - 0.12, side * deep * 0.55 + 0.12),
                (-0.5 * half, 0.5 * half),
                (0, 0.1),
            ),
        )
        for y in (-0.35, 0.35):
            assembly.add(
                metal(DARK),
                tube(
                    [
                        (side * deep * 0.55, y * half, 0.08),
                        (side * deep * 0.4, y * half, low + 0.3 * r),
                    ],
                    0.05,
                    6,
                ),
            )
        arm = [
            (side * deep * 0.5, -0.5 * half, middle - 0.6 * r),
            (side * deep * 0.6, -0.82 * half, middle - 0.7 * r),
            (side * deep * 0.3, -half * 0.98, middle - 0.5 * r),
        ]
        assembly.add(metal(STEEL), limb(arm, 0.05, 6))
        assembly.add(
            metal((0.9, 0.9, 0.8)),
            ball(0.1, 8, 6).moved(side * deep * 0.45, -0.66 * half, middle + 0.6 * r),
        )
        fin = box(
            (side * deep * 0.5 - 0.3, side * deep * 0.5 + 0.3),
            (0.55 * half, 0.8 * half),
            (middle - 0.03, middle + 0.03),
            0.02,
        )
        assembly.add(hull, fin)
    assembly.add(
        hull,
        box(
            (-0.04, 0.04),
            (0.5 * half, 0.85 * half),
            (middle - r * 0.8, middle + r * 1.1),
            0.03,
        ),
    )
    hub = 0.93 * half
    assembly.add(metal((0.72, 0.55, 0.28)), ball(0.1, 10, 8).moved(0, hub, middle))
    for blade in range(4):
        shape = box((-0.07, 0.07), (-0.02, 0.02), (0.05, 0.55 * r), 0.02).turned(
            "y", 90.0 * blade
        )
        assembly.add(metal((0.72, 0.55, 0.28)), shape.moved(0, hub, middle))
    guard = lathed(
        [(r * 0.62, -0.1), (r * 0.66, -0.1), (r * 0.66, 0.1), (r * 0.62, 0.1)], 20
    ).turned("x", 90)
    assembly.add(paint(DARK, 0.3), guard.moved(0, half - 0.1, middle))
    if order.text:
        wide, high = 0.62 * half, 0.5 * r
        pixels = sign_board(wide, high, order.text, (0.12, 0.12, 0.2))
        assembly.add(
            picture(pixels),
            plate(
                (0, deep * 0.93),
                (0.02 * half, 0.02 * half + wide),
                (middle - 0.35 * r, middle - 0.35 * r + high),
            ),
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
