"""Machines that stand about: vending, tickets, copying, drinks."""

from functools import cache

import numpy as np
from PIL import ImageDraw

from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import (
    Pixels,
    blank,
    pixels_of,
    sign_board,
)
from memorymaze.simulation.looks.colours import Rgb, ink_on, rgb255, shade
from memorymaze.simulation.looks.lettering import Field, write
from memorymaze.simulation.looks.paints import glass, glow, metal, paint, picture
from memorymaze.simulation.looks.primitives import (
    ball,
    box,
    cylinder,
    lathed,
    plate,
    tapered,
)

__all__ = [
    "capsule_machine",
    "coffee_machine",
    "photocopier",
    "printer",
    "ticket_machine",
    "vending_machine",
]

WHITE: Rgb = (0.9, 0.9, 0.9)
STEEL: Rgb = (0.68, 0.7, 0.72)
DARK: Rgb = (0.1, 0.1, 0.11)
GOODS: tuple[Rgb, ...] = (
    (0.85, 0.15, 0.15), (0.95, 0.75, 0.15), (0.15, 0.45, 0.8), (0.2, 0.6, 0.3),
    (0.95, 0.95, 0.93), (0.9, 0.5, 0.15), (0.45, 0.2, 0.5), (0.4, 0.25, 0.15),
)  # fmt: skip


def vending_machine(order: Order) -> Assembly:
    """Build a vending machine: lit goods behind a front with its words on top."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour((0.79, 0.13, 0.13))
    assembly.add(
        paint(colour, 0.3),
        box((back, front - 0.03), order.y, (0.06, order.height), 0.02),
    )
    assembly.add(
        paint(DARK),
        box(
            (back + 0.05, front - 0.08),
            (order.y[0] + 0.04, order.y[1] - 0.04),
            (0, 0.06),
        ),
    )
    words = order.text or ""
    boxed = any(word in words.lower() for word in ("snack", "food", "sandwich"))
    pixels = _vending_front(
        order.length, order.height - 0.1, words, colour, boxed, order.variant
    )
    assembly.add(
        picture(pixels, 0.3),
        plate(
            (front - 0.05, front - 0.01),
            (order.y[0] + 0.02, order.y[1] - 0.02),
            (0.08, order.height - 0.02),
        ),
    )
    left = order.y[0]
    assembly.add(
        paint(DARK),
        box(
            (front - 0.02, front),
            (left + 0.1 * order.length, left + 0.68 * order.length),
            (0.2, 0.36),
            0.008,
        ),
    )
    assembly.add(
        metal(STEEL),
        box(
            (front - 0.02, front),
            (left + 0.8 * order.length, left + 0.92 * order.length),
            (0.9, 1.02),
        ),
    )
    return assembly


def ticket_machine(order: Order) -> Assembly:
    """Build a ticket machine: words, a lit screen, keys, slots and a tray."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(STEEL)
    assembly.add(paint(colour, 0.4), box((back, front - 0.06), order.y, order.z, 0.03))
    wide = order.length * 0.86
    words = sign_board(wide, 0.3, order.text or "Tickets", (0.1, 0.3, 0.6))
    assembly.add(
        picture(words, 0.4),
        plate(
            (front - 0.1, front - 0.03),
            (-wide / 2, wide / 2),
            (order.height - 0.36, order.height - 0.06),
        ),
    )
    half = order.length * 0.3
    middle = order.height * 0.62
    assembly.add(
        paint(DARK),
        box(
            (front - 0.08, front - 0.04),
            (-half - 0.04, half + 0.04),
            (middle - 0.2, middle + 0.22),
            0.01,
        ),
    )
    for row in range(2):
        for column in range(3):
            y = -half + (column + 0.5) * 2 * half / 3
            z = middle + 0.12 - 0.16 * row
            tone = GOODS[(row * 3 + column) % 4]
            assembly.add(
                glow(shade(tone, 1.3), 0.5),
                box(
                    (front - 0.05, front - 0.034),
                    (y - half * 0.28, y + half * 0.28),
                    (z - 0.06, z + 0.06),
                ),
            )
    assembly.add(
        metal(DARK),
        box(
            (front - 0.07, front - 0.045),
            (half * 0.3, half),
            (middle - 0.32, middle - 0.27),
        ),
    )
    for row in range(4):
        for column in range(3):
            y, z = -half + 0.05 * column, middle - 0.3 - 0.045 * row
            assembly.add(
                paint((0.85, 0.85, 0.87)),
                box((front - 0.07, front - 0.045), (y, y + 0.036), (z, z + 0.034)),
            )
    tray = order.height * 0.24
    assembly.add(
        paint(DARK),
        box(
            (front - 0.07, front - 0.045),
            (-half * 0.8, half * 0.8),
            (tray, tray + 0.14),
        ),
    )
    assembly.add(
        metal(STEEL),
        tapered(
            (front - 0.07, front - 0.05),
            (-half * 0.85, half * 0.85),
            (tray - 0.03, tray + 0.06),
            (front - 0.07, front),
            (-half * 0.85, half * 0.85),
        ),
    )
    return assembly


def capsule_machine(order: Order) -> Assembly:
    """Build a capsule toy machine: a clear dome of balls over a body with a knob."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour((0.9, 0.2, 0.2))
    waist = order.height * 0.5
    assembly.add(
        paint(colour, 0.3), box((back, front - 0.04), order.y, (0, waist), 0.03)
    )
    lid = order.height - 0.06
    assembly.add(
        paint(colour, 0.3),
        box((back, front - 0.02), order.y, (lid, order.height), 0.02),
    )
    rng = order.rng()
    half = order.length / 2 - 0.06
    r = min(0.062, half / 3.2)
    for layer in range(4):
        for row in range(3):
            for column in range(3):
                if layer == 3 and (row + column) % 2:
                    continue
                y = (column - 1) * half * 0.7 + rng.uniform(-0.01, 0.01)
                x = (row - 1) * (order.depth / 2 - 0.06) * 0.7
                z = waist + r + layer * 1.75 * r
                tone = GOODS[int(rng.integers(7))]
                if row == 2 or layer > 1:
                    assembly.add(paint(tone, 0.5), ball(r, 7, 5).moved(x, y, z))
    assembly.add(
        glass(alpha=0.22),
        box(
            (back + 0.02, front - 0.03),
            (order.y[0] + 0.02, order.y[1] - 0.02),
            (waist, lid),
        ),
    )
    words = sign_board(
        order.length * 0.88, waist * 0.4, order.text or "", ink_ground(colour)
    )
    wide = order.length * 0.44
    assembly.add(
        picture(words),
        plate(
            (front - 0.06, front - 0.03), (-wide, wide), (waist * 0.56, waist * 0.96)
        ),
    )
    knob = (
        cylinder(0.07, (0, 0.03), 14)
        .turned("y", 90)
        .moved(front - 0.05, 0.0, waist * 0.36)
    )
    assembly.add(paint(WHITE, 0.4), knob)
    assembly.add(
        paint(DARK),
        box(
            (front - 0.02, front),
            (-0.015, 0.015),
            (waist * 0.36 - 0.055, waist * 0.36 + 0.055),
        ),
    )
    assembly.add(
        paint(DARK),
        box(
            (front - 0.06, front - 0.03),
            (-0.09, 0.09),
            (waist * 0.03, waist * 0.18),
            0.01,
        ),
    )
    return assembly


def coffee_machine(order: Order) -> Assembly:
    """Build a coffee machine on its cabinet: a display, spouts, a cup, a drip tray."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    split = order.height * 0.52 if order.height > 1.0 else 0.0
    colour = order.colour((0.15, 0.15, 0.16))
    if split:
        assembly.add(
            paint((0.5, 0.42, 0.35)),
            box((back, front - 0.02), order.y, (0, split - 0.03)),
        )
        assembly.add(
            paint((0.2, 0.2, 0.2), 0.3), box(order.x, order.y, (split - 0.03, split))
        )
        assembly.add(
            metal(STEEL),
            box(
                (front - 0.02, front - 0.005),
                (right - 0.12, right - 0.1),
                (split * 0.5, split * 0.75),
            ),
        )
    top = order.height
    body = paint(colour, 0.5)
    tall = top - split
    y = (left + 0.04, right - 0.04)
    assembly.add(
        body,
        box((back + 0.02, back + 0.55 * order.depth), y, (split, top), 0.02),
        box((back + 0.1, front - 0.06), y, (split + 0.58 * tall, top - 0.01), 0.03),
        box((back + 0.1, front - 0.03), y, (split, split + 0.1 * tall), 0.01),
    )
    trim = ink_ground(colour)
    nose = front - 0.06
    assembly.add(
        glow((0.35, 0.65, 0.85), 0.5),
        box(
            (nose - 0.02, nose + 0.008),
            (-0.09, 0.09),
            (top - 0.26 * tall, top - 0.1 * tall),
        ),
    )
    assembly.add(
        metal(STEEL),
        cylinder(0.014, (0, 0.07), 8).moved(nose - 0.07, -0.03, split + 0.52 * tall),
        cylinder(0.014, (0, 0.07), 8).moved(nose - 0.07, 0.03, split + 0.52 * tall),
        box(
            (nose - 0.14, nose + 0.02),
            (left + 0.08, right - 0.08),
            (split + 0.1 * tall, split + 0.12 * tall),
        ),
    )
    assembly.add(
        paint(WHITE, 0.4),
        lathed([(0.03, 0), (0.042, 0.09), (0.038, 0.09), (0.027, 0.01)], 12).moved(
            nose - 0.07, 0.0, split + 0.12 * tall
        ),
    )
    assembly.add(
        paint(trim),
        box(
            (nose - 0.02, nose + 0.006),
            (-0.16, 0.16),
            (top - 0.36 * tall, top - 0.33 * tall),
        ),
    )
    hopper = glass((0.35, 0.22, 0.12), 0.8)
    assembly.add(
        hopper,
        tapered(
            (back + 0.06, back + 0.26),
            (-0.1, 0.1),
            (top - 0.005, top + 0.14),
            (back + 0.03, back + 0.3),
            (-0.13, 0.13),
        ),
    )
    return assembly


def photocopier(order: Order) -> Assembly:
    """Build an office copier: paper drawers, an output bay, a lid and a panel."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    colour = order.colour(WHITE)
    body, dark = paint(colour, 0.2), paint((0.25, 0.27, 0.3))
    inner = (left + 0.16 * order.length, right - 0.16 * order.length)
    waist, lid = order.height * 0.62, order.height * 0.86
    assembly.add(body, box((back, front - 0.06), inner, (0.05, waist), 0.02))
    assembly.add(
        dark,
        box((back + 0.05, front - 0.1), (inner[0] + 0.03, inner[1] - 0.03), (0, 0.05)),
    )
    for row in range(3):
        z = 0.07 + row * (waist - 0.1) / 3
        assembly.add(
            paint(shade(colour, 0.92), 0.2),
            box(
                (front - 0.09, front - 0.045),
                (inner[0] + 0.02, inner[1] - 0.02),
                (z + 0.01, z + (waist - 0.1) / 3 - 0.01),
                0.006,
            ),
        )
        assembly.add(
            dark, box((front - 0.06, front - 0.04), (-0.1, 0.1), (z + 0.1, z + 0.12))
        )
    assembly.add(body, box((back, back + 0.3 * order.depth), inner, (waist, lid)))
    assembly.add(
        body, box((back, front - 0.08), (inner[0], inner[0] + 0.1), (waist, lid))
    )
    assembly.add(
        paint((0.97, 0.97, 0.96)),
        box(
            (back + 0.2, front - 0.14),
            (inner[0] + 0.16, inner[1] - 0.05),
            (waist, waist + 0.02),
        ),
    )
    assembly.add(body, box((back, front - 0.06), inner, (lid - 0.06, lid), 0.015))
    assembly.add(
        dark,
        box(
            (back + 0.02, front - 0.12),
            (inner[0] + 0.02, inner[1] - 0.02),
            (lid, order.height),
            0.03,
        ),
    )
    panel = tapered(
        (front - 0.16, front),
        (inner[1] - 0.34, inner[1]),
        (lid - 0.05, lid - 0.02),
        (front - 0.16, front),
        (inner[1] - 0.34, inner[1]),
    )
    assembly.add(dark, panel)
    assembly.add(
        glow((0.3, 0.6, 0.85), 0.5),
        box(
            (front - 0.13, front - 0.04),
            (inner[1] - 0.3, inner[1] - 0.14),
            (lid - 0.03, lid - 0.012),
        ),
    )
    assembly.add(
        paint((0.2, 0.7, 0.3)),
        box(
            (front - 0.1, front - 0.05),
            (inner[1] - 0.1, inner[1] - 0.04),
            (lid - 0.03, lid - 0.01),
        ),
    )
    tray = paint(shade(colour, 0.85))
    assembly.add(
        tray,
        box(
            (back + 0.12, front - 0.16),
            (left, inner[0] + 0.02),
            (waist * 0.8, waist * 0.8 + 0.03),
        ),
    )
    assembly.add(
        tray,
        box(
            (back + 0.12, front - 0.16),
            (inner[1] - 0.02, right),
            (waist * 0.6, waist * 0.6 + 0.03),
        ),
    )
    return assembly


def printer(order: Order) -> Assembly:
    """Build a printer, on a cabinet where it stands on the floor."""
    assembly = Assembly()
    back, front = order.x
    low = order.height * 0.55 if order.height > 0.8 else 0.0
    if low:
        assembly.add(
            paint((0.6, 0.5, 0.4)), box((back + 0.02, front - 0.04), order.y, (0, low))
        )
        assembly.add(
            metal(STEEL),
            box((front - 0.05, front - 0.03), (-0.06, 0.06), (low * 0.7, low * 0.75)),
        )
    colour = order.colour((0.55, 0.56, 0.58))
    tall = order.height - low
    y = (order.y[0] + 0.03, order.y[1] - 0.03)
    assembly.add(
        paint(colour, 0.2), box((back, front - 0.06), y, (low, low + 0.85 * tall), 0.03)
    )
    assembly.add(
        paint(DARK),
        box(
            (front - 0.12, front - 0.055),
            (y[0] + 0.06, y[1] - 0.06),
            (low + 0.45 * tall, low + 0.62 * tall),
        ),
    )
    assembly.add(
        paint((0.97, 0.97, 0.95)),
        box(
            (front - 0.2, front),
            (y[0] + 0.1, y[1] - 0.1),
            (low + 0.46 * tall, low + 0.48 * tall),
        ),
    )
    assembly.add(
        paint(shade(colour, 0.7)),
        box(
            (front - 0.08, front - 0.05),
            (y[0] + 0.03, y[1] - 0.03),
            (low + 0.06 * tall, low + 0.32 * tall),
            0.01,
        ),
    )
    feeder = box(
        (back + 0.02, back + 0.05),
        (y[0] + 0.1, y[1] - 0.1),
        (low + 0.8 * tall, order.height),
    )
    assembly.add(paint((0.97, 0.97, 0.95)), feeder)
    assembly.add(
        glow((0.3, 0.6, 0.85), 0.5),
        box(
            (front - 0.1, front - 0.056),
            (y[1] - 0.16, y[1] - 0.04),
            (low + 0.68 * tall, low + 0.78 * tall),
        ),
    )
    return assembly


def ink_ground(colour: Rgb) -> Rgb:
    """Return white on dark machines and a dark tone on light ones."""
    return (0.96, 0.96, 0.94) if ink_on(colour)[0] > 0.5 else shade(colour, 0.35)


@cache
def _vending_front(
    width: float, height: float, words: str, colour: Rgb, boxed: bool, variant: int
) -> Pixels:
    """Draw words over rows of cans, bottles or bags, with keys and a slot."""
    image = blank(width, height, colour)
    draw = ImageDraw.Draw(image)
    w, h = image.size
    head = 0.17 * h if words else 0.04 * h
    write(image, Field(0, 0, w, head).inset(0.1), words, ink_on(colour))
    glass_field = Field(0.06 * w, head, 0.74 * w, 0.8 * h)
    draw.rectangle([*glass_field], rgb255((0.9, 0.94, 0.97)))
    rng = np.random.default_rng(variant + 2)
    rows, columns = (5, 5) if boxed else (4, 6)
    dx, dy = glass_field.width / columns, glass_field.height / rows
    for row in range(rows):
        y = glass_field.top + (row + 1) * dy - 0.12 * dy
        draw.rectangle(
            [glass_field.left, y, glass_field.right, y + 0.09 * dy],
            rgb255((0.45, 0.47, 0.5)),
        )
        tone = GOODS[int(rng.integers(len(GOODS)))]
        for column in range(columns):
            if column % 2 == 0:
                tone = GOODS[int(rng.integers(len(GOODS)))]
            x = glass_field.left + (column + 0.5) * dx
            half = (0.36 if boxed else 0.22) * dx
            top = y - (0.66 if boxed else 0.78) * dy
            if not boxed:
                draw.rectangle(
                    [x - half * 0.5, top, x + half * 0.5, top + 0.2 * dy],
                    rgb255(shade(tone, 0.7)),
                )
                top += 0.14 * dy
            draw.rounded_rectangle(
                [x - half, top, x + half, y - 1], max(1, int(half * 0.5)), rgb255(tone)
            )
            label = top + (y - top) * 0.45
            draw.rectangle(
                [x - half * 0.8, label, x + half * 0.8, label + 0.14 * dy],
                rgb255(shade(tone, 1.5)),
            )
    for row in range(6):
        y = head + (0.06 + 0.06 * row) * h
        draw.rectangle(
            [0.8 * w, y, 0.92 * w, y + 0.035 * h], rgb255((0.85, 0.86, 0.88))
        )
    draw.rectangle(
        [0.79 * w, head + 0.01 * h, 0.93 * w, head + 0.045 * h],
        rgb255((0.1, 0.5, 0.35)),
    )
    return pixels_of(image)
