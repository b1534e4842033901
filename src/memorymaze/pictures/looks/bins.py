"""Bins for waste and recycling."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, ink_on, shade
from memorymaze.pictures.looks.paints import metal, paint, picture
from memorymaze.pictures.looks.primitives import box, cylinder, lathed, plate, tapered

DARK: Rgb = (0.08, 0.08, 0.09)
STEEL: Rgb = (0.7, 0.71, 0.73)
WHITE: Rgb = (0.96, 0.96, 0.95)


def recycling_bin(order: Order) -> Assembly:
    """Build a tapered bin with a round hole, its words and three chasing arrows."""
    return _bin(order, order.colour((0.13, 0.36, 0.75)), order.text or "")


def recycling_bins(order: Order) -> Assembly:
    """Build a bin for each thing its words list, side by side."""
    assembly = Assembly()
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
        assembly.include(_bin(one, colours[place % 4], name), y=y)
    return assembly


def trash_can(order: Order) -> Assembly:
    """Build a round bin with a swing lid, or an open basket where it is low."""
    assembly = Assembly()
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
        assembly.add(paint(colour), basket)
        bag = lathed(
            [
                (radius * 0.9, 0.75 * top),
                (radius * 0.93, top * 0.985),
                (0.0, 0.8 * top),
            ],
            18,
        )
        assembly.add(
            paint((0.8, 0.82, 0.85), 0.3), bag.scaled(order.depth, order.length, 1.0)
        )
        return assembly
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
        [
            (radius * 0.96, 0.3 * top),
            (radius * 0.985, 0.3 * top),
            (radius * 0.985, 0.34 * top),
            (radius * 0.96, 0.34 * top),
        ],
        20,
    )
    assembly.add(metal(colour), body.scaled(order.depth, order.length, 1.0))
    assembly.add(
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
    assembly.add(paint(DARK), flap)
    return assembly


def _bin(order: Order, colour: Rgb, words: str) -> Assembly:
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    lid = order.height * 0.86
    body = tapered(
        (back + 0.04, front - 0.05),
        (left + 0.04, right - 0.04),
        (0, lid),
        (back + 0.01, front - 0.02),
        (left + 0.01, right - 0.01),
    )
    assembly.add(paint(colour, 0.2), body)
    assembly.add(
        paint(shade(colour, 0.7), 0.2),
        box((back, front - 0.012), order.y, (lid, order.height), 0.03),
    )
    hole = min(0.1, 0.2 * order.length)
    assembly.add(
        paint(DARK),
        cylinder(hole, (order.height - 0.02, order.height + 0.003), 16).moved(x=0.03),
    )
    wide = order.length * 0.38
    ground = WHITE if ink_on(colour)[0] > 0.5 else (0.12, 0.12, 0.14)
    if words:
        pixels = sign_board(2 * wide, 0.26 * order.height, words, ground)
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.06, front),
                (-wide, wide),
                (0.56 * order.height, 0.82 * order.height),
            ),
        )
    size = min(0.11, 0.2 * order.length)
    middle = 0.32 * order.height
    for turn in range(3):
        angle = math.pi / 2 + turn * 2 * math.pi / 3
        y, z = size * 0.75 * math.cos(angle), middle + size * 0.75 * math.sin(angle)
        bar = box(
            (front - 0.07, front - 0.022),
            (-size * 0.55, size * 0.3),
            (-size * 0.16, size * 0.16),
        )
        tip = tapered(
            (front - 0.07, front - 0.022),
            (-size * 0.4, size * 0.4),
            (0, size * 0.5),
            (front - 0.07, front - 0.022),
            (-0.002, 0.002),
        )
        head = tip.turned("x", -90).moved(y=size * 0.28)
        degrees = math.degrees(angle) - 90
        assembly.add(
            paint(ground),
            bar.turned("x", degrees).moved(0, y, z),
            head.turned("x", degrees).moved(0, y, z),
        )
    return assembly
