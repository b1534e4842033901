"""Machines that take coins: drinks, snacks, tickets, toys."""

from functools import cache

import numpy as np
from PIL import ImageDraw

from memorymaze.pictures.looks.appliances import ink_ground
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import blank, pixels_of
from memorymaze.pictures.looks.lettering import Field, write
from memorymaze.pictures.looks.materials import (
    ALUMINIUM,
    BLACK,
    PALE_GREY,
    Pixels,
    Rgb,
    glass,
    glow,
    ink_on,
    metal,
    paint,
    picture,
    rgb255,
    shade,
)
from memorymaze.pictures.looks.shapes import around, cylinder, tapered

GOODS: tuple[Rgb, ...] = (
    (0.85, 0.15, 0.15), (0.95, 0.75, 0.15), (0.15, 0.45, 0.8), (0.2, 0.6, 0.3),
    (0.95, 0.95, 0.93), (0.9, 0.5, 0.15), (0.45, 0.2, 0.5), (0.4, 0.25, 0.15)
)  # fmt: skip


def vending_machine(made: Assembly, order: Order) -> None:
    """Build a vending machine: lit goods behind a front with its words on top."""
    colour = order.colour((0.79, 0.13, 0.13))
    made.box(
        paint(colour, 0.3), order.x.inset(0, 0.03), order.y, (0.06, order.height), 0.02
    )
    made.box(paint(BLACK), order.x.inset(0.05, 0.08), order.y.inset(0.04), (0, 0.06))
    words = order.text or ""
    boxed = any(word in words.lower() for word in ("snack", "food", "sandwich"))
    pixels = _vending_front(
        order.length, order.height - 0.1, words, colour, boxed, order.variant
    )
    made.plate(
        picture(pixels, 0.3),
        order.x.end(0.05, 0.01),
        order.y.inset(0.02),
        (0.08, order.height - 0.02),
    )
    made.box(
        paint(BLACK),
        order.x.end(0.02),
        order.y.start(0.1 * order.length, 0.68 * order.length),
        (0.2, 0.36),
        0.008,
    )
    made.box(
        metal(ALUMINIUM),
        order.x.end(0.02),
        order.y.start(0.8 * order.length, 0.92 * order.length),
        (0.9, 1.02),
    )


def ticket_machine(made: Assembly, order: Order) -> None:
    """Build a ticket machine: words, a lit screen, keys, slots and a tray."""
    colour = order.colour(ALUMINIUM)
    made.box(paint(colour, 0.4), order.x.inset(0, 0.06), order.y, order.z, 0.03)
    wide = order.length * 0.86
    made.words(
        order.text or "Tickets",
        (0.1, 0.3, 0.6),
        order.x.end(0.1, 0.03),
        around(0, wide / 2),
        order.z.end(0.36, 0.06),
        light=0.4,
    )
    half = order.length * 0.3
    middle = order.height * 0.62
    made.box(
        paint(BLACK),
        order.x.end(0.08, 0.04),
        (-half - 0.04, half + 0.04),
        (middle - 0.2, middle + 0.22),
        0.01,
    )
    for row in range(2):
        for column in range(3):
            y = -half + (column + 0.5) * 2 * half / 3
            z = middle + 0.12 - 0.16 * row
            tone = GOODS[(row * 3 + column) % 4]
            made.box(
                glow(shade(tone, 1.3), 0.5),
                order.x.end(0.05, 0.034),
                around(y, half * 0.28),
                around(z, 0.06),
            )
    made.box(
        metal(BLACK),
        order.x.end(0.07, 0.045),
        (half * 0.3, half),
        (middle - 0.32, middle - 0.27),
    )
    for row in range(4):
        for column in range(3):
            y, z = -half + 0.05 * column, middle - 0.3 - 0.045 * row
            made.box(
                paint((0.85, 0.85, 0.87)),
                order.x.end(0.07, 0.045),
                (y, y + 0.036),
                (z, z + 0.034),
            )
    tray = order.height * 0.24
    made.box(
        paint(BLACK),
        order.x.end(0.07, 0.045),
        around(0, half * 0.8),
        (tray, tray + 0.14),
    )
    made.add(
        metal(ALUMINIUM),
        tapered(
            order.x.end(0.07, 0.05),
            around(0, half * 0.85),
            (tray - 0.03, tray + 0.06),
            order.x.end(0.07),
            around(0, half * 0.85),
        ),
    )


def capsule_toy_machine(made: Assembly, order: Order) -> None:
    """Build a capsule toy machine: a clear dome of balls over a body with a knob."""
    front = order.x[1]
    colour = order.colour((0.9, 0.2, 0.2))
    waist = order.height * 0.5
    made.box(paint(colour, 0.3), order.x.inset(0, 0.04), order.y, (0, waist), 0.03)
    lid = order.height - 0.06
    made.box(
        paint(colour, 0.3), order.x.inset(0, 0.02), order.y, (lid, order.height), 0.02
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
                    made.ball(paint(tone, 0.5), r, 7, 5, at=(x, y, z))
    made.box(
        glass(alpha=0.22), order.x.inset(0.02, 0.03), order.y.inset(0.02), (waist, lid)
    )
    wide = order.length * 0.44
    made.words(
        order.text or "",
        ink_ground(colour),
        order.x.end(0.06, 0.03),
        (-wide, wide),
        (waist * 0.56, waist * 0.96),
    )
    knob = cylinder(0.07, (0, 0.03), 14, along="x").moved(
        front - 0.05, 0.0, waist * 0.36
    )
    made.add(paint(PALE_GREY, 0.4), knob)
    made.box(
        paint(BLACK), order.x.end(0.02), (-0.015, 0.015), around(waist * 0.36, 0.055)
    )
    made.box(
        paint(BLACK),
        order.x.end(0.06, 0.03),
        (-0.09, 0.09),
        (waist * 0.03, waist * 0.18),
        0.01,
    )


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
