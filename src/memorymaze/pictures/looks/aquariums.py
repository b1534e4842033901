"""Aquariums, and exhibits of water and the deep sea."""

import math
from functools import cache

import numpy as np
from PIL import ImageDraw

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import blank, graded, pixels_of
from memorymaze.pictures.looks.materials import (
    BASALT,
    IRON,
    SEA,
    Pixels,
    Rgb,
    glass,
    metal,
    mixed,
    paint,
    picture,
    rgb255,
    shade,
)
from memorymaze.pictures.looks.shapes import (
    around,
    box,
    cylinder,
    extruded,
    lathed,
    span_between,
)
from memorymaze.pictures.looks.tubes import tube

FISH: tuple[Rgb, ...] = (
    (0.95, 0.5, 0.1),
    (0.95, 0.8, 0.2),
    (0.8, 0.85, 0.9),
    (0.85, 0.25, 0.3),
)


def aquarium_window(made: Assembly, order: Order) -> None:
    """Build a lit window into a tank: fish, weeds, bubbles, its words on the frame."""
    frame = min(0.06, 0.06 * order.length)
    made.box(paint(BASALT, 0.2), order.x.inset(0, 0.012), order.y, order.z)
    low = min(0.24, 0.2 * order.height) if order.text else frame
    pixels = _tank(order.length - 2 * frame, order.height - frame - low, order.variant)
    y = order.y.inset(frame)
    made.plate(
        picture(pixels, 0.45),
        order.x.inset(0.01, 0.006),
        y,
        (low, order.height - frame),
    )
    made.words(order.text, BASALT, order.x.inset(0.01, 0), y, (low * 0.08, low * 0.94))


def aquarium(made: Assembly, order: Order) -> None:
    """Build a fish tank on a cabinet: water, weeds, stones, fish, a lid with light."""
    base = order.height * 0.52
    back, front = order.x
    made.box(paint((0.3, 0.2, 0.14)), order.x.inset(0, 0.01), order.y, (0, base))
    for side in (-1, 1):
        y = span_between(side * 0.01, side * (order.length / 2 - 0.03))
        made.box(
            paint((0.36, 0.25, 0.17)), order.x.end(0.02), y, (0.05, base - 0.04), 0.006
        )
    lid = order.height - 0.07
    pixels = _tank(order.length, lid - base, order.variant)
    made.plate(
        picture(pixels, 0.35),
        order.x.inset(0.02),
        order.y.inset(0.01),
        (base, lid),
        both_sides=True,
    )
    made.box(paint(BASALT, 0.2), order.x, order.y, (lid, order.height), 0.012)
    for y in (order.y[0], order.y[1] - 0.02):
        for x in (back, front - 0.02):
            made.box(paint(BASALT, 0.2), (x, x + 0.02), (y, y + 0.02), (base, lid))


@cache
def _tank(width: float, height: float, variant: int) -> Pixels:
    """Draw fish among weeds over sand."""
    w, h = size = blank(width, height, SEA).size
    image = graded(size, (0.3, 0.7, 0.85), (0.02, 0.2, 0.42))
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


def wave_tank(made: Assembly, order: Order) -> None:
    """Build a long glass tank on legs with a wave in it and a paddle with a handle."""
    back, front = order.x
    left, right = order.y
    deck, top = order.height * 0.42, order.height - 0.1
    frame = metal(shade(IRON, 0.7))
    for x in (back, front - 0.04):
        for y in (left, right - 0.04):
            made.box(frame, (x, x + 0.04), (y, y + 0.04), (0, top))
        for z in (deck - 0.06, top - 0.03):
            made.box(frame, (x, x + 0.04), order.y, (z, z + 0.05))
    for y in (left, right - 0.04):
        made.box(frame, order.x, (y, y + 0.04), (top - 0.03, top + 0.02))
    made.box(frame, order.x, order.y, (deck - 0.05, deck))
    level = deck + 0.5 * (top - deck)
    long_way = order.length - 0.1
    outline = [(left + 0.05, deck), (right - 0.05, deck)]
    steps = 24
    for step in range(steps + 1):
        share = step / steps
        swing = math.sin(2.5 * math.tau * share) * math.exp(-2.0 * share)
        outline.append((
            right - 0.05 - long_way * share,
            level + 0.3 * (top - deck) * swing,
        ))
    water = mixed(order.colour(SEA), (0.55, 0.8, 0.95), 0.5)
    made.add(paint(water, 0.7), extruded(outline, order.x.inset(0.05), "x"))
    made.box(
        glass(alpha=0.22), order.x.end(0.03, 0.02), order.y.inset(0.04), (deck, top)
    )
    paddle = right - 0.25
    made.add(
        paint((0.9, 0.75, 0.1)),
        box(order.x.inset(0.06), around(paddle, 0.02), (deck + 0.05, top + 0.04)),
        tube([(0, paddle, top), (0, paddle - 0.3, order.height - 0.02)], 0.025, 6),
    )
    made.words(
        order.text,
        (0.1, 0.25, 0.45),
        order.x.end(0.02),
        around(0, order.length * 0.3),
        (deck - 0.04 - 0.2, deck - 0.04),
    )


def submersible(made: Assembly, order: Order) -> None:
    """Build a deep-sea vessel from its side: a hull, a bubble, a screw, arms, words."""
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
    body = lathed(profile, 18).turned("x", -90).scaled(deep * 0.86 / r, 1, 1)
    made.add(hull, body.moved(z=middle))
    tower = box(
        around(0, deep * 0.4),
        around(0, 0.25 * half),
        (middle + 0.7 * r, order.height),
        0.08,
    )
    made.add(paint((0.9, 0.25, 0.15), 0.3), tower)
    nose = -0.6 * half
    made.ball(paint((0.1, 0.25, 0.4), 0.95), r * 0.55, 12, 9, at=(0, nose, middle))
    for side in (-1, 1):
        port = cylinder(r * 0.24, (0, 0.05), 9).turned("y", 90 * side)
        pane = cylinder(r * 0.18, (0, 0.06), 8).turned("y", 90 * side)
        for y in (-0.36, -0.12):
            x = side * deep * 0.82
            made.add(metal(IRON), port.moved(x, y * half, middle + 0.2 * r))
            made.add(
                paint((0.1, 0.2, 0.35), 0.9), pane.moved(x, y * half, middle + 0.2 * r)
            )
        made.box(
            paint(shade(order.colour((0.96, 0.79, 0.13)), 0.8)),
            around(side * deep * 0.55, 0.12),
            around(0, 0.5 * half),
            (0, 0.1),
        )
        for y in (-0.35, 0.35):
            made.tube(
                metal(BASALT),
                [
                    (side * deep * 0.55, y * half, 0.08),
                    (side * deep * 0.4, y * half, low + 0.3 * r),
                ],
                0.05,
                6,
            )
        arm = [
            (side * deep * 0.5, -0.5 * half, middle - 0.6 * r),
            (side * deep * 0.6, -0.82 * half, middle - 0.7 * r),
            (side * deep * 0.3, -half * 0.98, middle - 0.5 * r),
        ]
        made.limb(metal(IRON), arm, 0.05, 5)
        made.ball(
            metal((0.9, 0.9, 0.8)),
            0.1,
            7,
            5,
            at=(side * deep * 0.45, -0.66 * half, middle + 0.6 * r),
        )
        fin = box(
            around(side * deep * 0.5, 0.3),
            (0.55 * half, 0.8 * half),
            around(middle, 0.03),
            0.02,
        )
        made.add(hull, fin)
    made.box(
        hull,
        (-0.04, 0.04),
        (0.5 * half, 0.85 * half),
        (middle - r * 0.8, middle + r * 1.1),
        0.03,
    )
    hub = 0.93 * half
    made.ball(metal((0.72, 0.55, 0.28)), 0.1, 7, 5, at=(0, hub, middle))
    for blade in range(3):
        shape = box((-0.07, 0.07), (-0.02, 0.02), (0.05, 0.55 * r), 0.02).turned(
            "y", 120.0 * blade
        )
        made.add(metal((0.72, 0.55, 0.28)), shape.moved(0, hub, middle))
    guard = lathed(
        [(r * 0.62, -0.1), (r * 0.66, -0.1), (r * 0.66, 0.1), (r * 0.62, 0.1)], 20
    ).turned("x", 90)
    made.add(paint(BASALT, 0.3), guard.moved(0, half - 0.1, middle))
    made.words(
        order.text,
        (0.12, 0.12, 0.2),
        (0, deep * 0.93),
        (0.02 * half, 0.02 * half + 0.62 * half),
        (middle - 0.35 * r, middle - 0.35 * r + 0.5 * r),
    )
