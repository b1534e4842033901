"""Bins, and what is left in the way: boxes, barriers, cones, unknown things."""

import math
from itertools import pairwise

from memorymaze.pictures.looks.assembly import Assembly, Order, built
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.materials import (
    JET,
    SNOW,
    STEEL,
    Rgb,
    ink_on,
    metal,
    paint,
    picture,
    shade,
)
from memorymaze.pictures.looks.shapes import around, box, lathed, plate, tapered

CARDBOARD: Rgb = (0.72, 0.55, 0.36)


def recycling_bin(made: Assembly, order: Order) -> None:
    """Build a tapered bin with a round hole, its words and three chasing arrows."""
    _bin(made, order, order.colour((0.13, 0.36, 0.75)), order.text or "")


def recycling_bins(made: Assembly, order: Order) -> None:
    """Build a bin for each thing its words list, side by side."""
    names = [name.strip() for name in (order.text or "Cans / Paper").split("/")]
    colours = (
        order.colour((0.14, 0.52, 0.26)),
        (0.13, 0.36, 0.75),
        (0.9, 0.72, 0.12),
        (0.5, 0.5, 0.52),
    )
    wide = order.length / len(names)
    for place, name in enumerate(names):
        one = Order(order.category, wide - 0.02, order.depth, order.height)
        y = order.y[0] + (place + 0.5) * wide
        made.include(built(_bin, one, colours[place % 4], name), y=y)


def trash_can(made: Assembly, order: Order) -> None:
    """Build a round bin with a swing lid, or an open basket where it is low."""
    radius = 0.5
    top = order.height
    colour = order.colour((0.5, 0.51, 0.53))
    if top < 0.7:
        wall = [
            (radius * 0.78, 0),
            (radius, top),
            (radius * 0.94, top),
            (radius * 0.74, 0.02),
            (0, 0.02),
        ]
        basket = lathed(wall, 18).scaled(order.depth, order.length, 1.0)
        made.add(paint(colour), basket)
        bag = lathed(
            [(0.9, 0.75), (0.93, 0.985), (0.0, 0.8)], 18, radius=radius, height=top
        )
        made.add(
            paint((0.8, 0.82, 0.85), 0.3), bag.scaled(order.depth, order.length, 1.0)
        )
        return
    rim = 0.76 * top
    body = lathed([(radius * 0.86, 0), (radius * 0.92, 0.02), (radius * 0.97, rim)], 20)
    lid = lathed(
        [
            (radius, rim - 0.02),
            (radius, rim + 0.05),
            (radius * 0.85, top - 0.08),
            (radius * 0.4, top - 0.01),
            (0, top),
        ],
        20,
    )
    ring = lathed(
        [(0.96, 0.3), (0.985, 0.3), (0.985, 0.34), (0.96, 0.34)],
        20,
        radius=radius,
        height=top,
    )
    made.add(metal(colour), body.scaled(order.depth, order.length, 1.0))
    made.add(
        paint(shade(colour, 0.5)),
        lid.scaled(order.depth, order.length, 1.0),
        ring.scaled(order.depth, order.length, 1.0),
    )
    flap = tapered(
        (0.2, 0.5 * order.depth - 0.005),
        (-0.14, 0.14),
        (rim + 0.03, rim + 0.14),
        (0.2, 0.42 * order.depth),
        (-0.12, 0.12),
    )
    made.add(paint(JET), flap)


def _bin(made: Assembly, order: Order, colour: Rgb, words: str) -> None:
    lid = order.height * 0.86
    body = tapered(
        order.x.inset(0.04, 0.05),
        order.y.inset(0.04),
        (0, lid),
        order.x.inset(0.01, 0.02),
        order.y.inset(0.01),
    )
    made.add(paint(colour, 0.2), body)
    made.box(
        paint(shade(colour, 0.7), 0.2),
        order.x.inset(0, 0.012),
        order.y,
        (lid, order.height),
        0.03,
    )
    hole = min(0.1, 0.2 * order.length)
    made.cylinder(paint(JET), hole, order.z.end(0.02, -0.003), 16, at=(0.03, 0, 0))
    wide = order.length * 0.38
    ground = SNOW if ink_on(colour)[0] > 0.5 else (0.12, 0.12, 0.14)
    if words:
        made.words(
            words,
            ground,
            order.x.end(0.06),
            (-wide, wide),
            (0.56 * order.height, 0.82 * order.height),
        )
    size = min(0.11, 0.2 * order.length)
    middle = 0.32 * order.height
    for turn in range(3):
        angle = math.pi / 2 + turn * 2 * math.pi / 3
        y, z = size * 0.75 * math.cos(angle), middle + size * 0.75 * math.sin(angle)
        bar = box(
            order.x.end(0.07, 0.022), (-size * 0.55, size * 0.3), around(0, size * 0.16)
        )
        tip = tapered(
            order.x.end(0.07, 0.022),
            around(0, size * 0.4),
            (0, size * 0.5),
            order.x.end(0.07, 0.022),
            (-0.002, 0.002),
        )
        head = tip.turned("x", -90).moved(y=size * 0.28)
        degrees = math.degrees(angle) - 90
        made.add(
            paint(ground),
            bar.turned("x", degrees).moved(0, y, z),
            head.turned("x", degrees).moved(0, y, z),
        )


def cardboard_boxes(made: Assembly, order: Order) -> None:
    """Build a pile of taped cardboard boxes."""
    split = order.height * (0.58 if order.height > 0.5 else 1.0)
    _carton(made, order.colour(CARDBOARD), order.x, order.y, (0.0, split))
    if split < order.height:
        shift = 0.1 * order.length * (1 if order.variant % 2 else -1)
        y = (
            order.y[0] + 0.15 * order.length + shift,
            order.y[1] - 0.2 * order.length + shift,
        )
        x = order.x.inset(0.06 * order.depth, 0.14 * order.depth)
        _carton(made, shade(order.colour(CARDBOARD), 1.1), x, y, (split, order.height))
    made.words(
        order.text,
        (0.95, 0.93, 0.88),
        order.x.end(0.02, -0.003),
        around(0, order.length * 0.3),
        (split * 0.2, split * 0.55),
    )


def queue_barrier(made: Assembly, order: Order) -> None:
    """Build posts with round feet and a belt between them."""
    r = min(0.17, order.depth / 2)
    posts = max(2, round(order.length / 1.6) + 1)
    reach = order.length - 2 * r
    for place in range(posts):
        y = -reach / 2 + reach * place / (posts - 1)
        post = lathed(
            [
                (r, 0),
                (r, 0.02),
                (0.05, 0.05),
                (0.03, 0.07),
                (0.03, order.height - 0.08),
                (0.04, order.height - 0.08),
                (0.04, order.height),
            ],
            16,
        )
        made.add(metal(STEEL), post.moved(y=y))
    belt = order.height - 0.06
    made.box(
        paint(order.colour((0.7, 0.1, 0.12))),
        (-0.006, 0.006),
        around(0, reach / 2),
        around(belt, 0.025),
    )
    if order.text:
        wide = min(0.5, reach * 0.5)
        words = sign_board(wide, 0.24, order.text, (0.95, 0.95, 0.93))
        made.plate(
            picture(words),
            (-0.01, 0.012),
            around(0, wide / 2),
            (belt - 0.32, belt - 0.05),
            both_sides=True,
        )


def traffic_cone(made: Assembly, order: Order) -> None:
    """Build a cone with white bands on a square foot."""
    r = min(order.length, order.depth) * 0.4
    h = order.height
    orange = paint(order.colour((0.95, 0.4, 0.05)), 0.1)
    made.box(orange, order.x, order.y, (0, 0.04), 0.01)
    marks = (0.04, 0.3 * h, 0.48 * h, 0.62 * h, 0.76 * h, h)
    for place, (low, high) in enumerate(pairwise(marks)):
        a, b = (r * (1 - 0.88 * each / h) for each in (low, high))
        tone = orange if place % 2 == 0 else paint((0.96, 0.96, 0.95))
        made.lathed(tone, [(a, low), (b, high)], 18)


def placeholder(made: Assembly, order: Order) -> None:
    """Build a striped box with the name of its kind on all that can be seen of it."""
    body = paint(order.colour((0.62, 0.64, 0.67)))
    rim = min(0.06, *(0.12 * side for side in (order.length, order.height)))
    step = min(0.012, 0.2 * order.depth)
    made.box(body, order.x.inset(step), order.y, order.z)
    stripe = paint((0.95, 0.75, 0.1))
    words = sign_board(
        order.length - 2 * rim,
        order.height - 2 * rim,
        f"{order.category}?",
        (0.96, 0.96, 0.94),
    )
    for x in (order.x.end(2 * step, 0.5 * step), order.x.start(0.5 * step, 2 * step)):
        made.box(stripe, x, order.y, order.z)
    sheet = picture(words)
    y = order.y.inset(rim)
    front_sheet = plate(order.x.end(2 * step), y, (rim, order.height - rim))
    made.add(sheet, front_sheet, front_sheet.turned("z", 180))


def _carton(
    made: Assembly,
    colour: Rgb,
    x: tuple[float, float],
    y: tuple[float, float],
    z: tuple[float, float],
) -> None:
    made.box(paint(colour, 0.0), x, y, z, 0.008)
    middle = (y[0] + y[1]) / 2
    tape = paint(shade(colour, 1.25), 0.3)
    made.box(
        tape,
        (x[0] - 0.002, x[1] + 0.002),
        around(middle, 0.03),
        (z[1] - 0.12 * (z[1] - z[0]), z[1] + 0.001),
    )
    made.box(
        paint(shade(colour, 0.6), 0.0),
        (x[1] - 0.01, x[1] + 0.003),
        (y[0] + 0.06 * (y[1] - y[0]), y[0] + 0.2 * (y[1] - y[0])),
        (z[0] + 0.1 * (z[1] - z[0]), z[0] + 0.3 * (z[1] - z[0])),
    )
