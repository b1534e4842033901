"""Counters to be served at and to cook at."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, is_wooden, shade
from memorymaze.pictures.looks.paints import metal, paint, picture, wood
from memorymaze.pictures.looks.primitives import box, plate

WHITE: Rgb = (0.9, 0.9, 0.88)
OAK: Rgb = (0.7, 0.52, 0.33)
STEEL: Rgb = (0.66, 0.68, 0.7)
DARK: Rgb = (0.2, 0.2, 0.22)


def counter(order: Order) -> Assembly:
    """Build a counter to be served at, with its words across the front."""
    assembly = Assembly()
    back, front = order.x
    top = order.height
    body = order.body(WHITE)
    assembly.add(
        body,
        box(
            (back, front - 0.08),
            (order.y[0] + 0.03, order.y[1] - 0.03),
            (0.1, top - 0.05),
        ),
    )
    assembly.add(
        paint(DARK),
        box(
            (back + 0.04, front - 0.13),
            (order.y[0] + 0.06, order.y[1] - 0.06),
            (0, 0.1),
        ),
    )
    slab = (
        wood(OAK)
        if not is_wooden(order.colour_words)
        else paint((0.92, 0.92, 0.9), 0.4)
    )
    assembly.add(slab, box(order.x, order.y, (top - 0.05, top), 0.012))
    if order.text:
        tall = min(0.55 * top, 0.3 * order.length, 0.5)
        wide = min(order.length * 0.9, tall * max(2.0, 0.75 * len(order.text)))
        middle = 0.52 * top
        ground = (
            shade(order.colour(WHITE), 0.35)
            if not is_wooden(order.colour_words)
            else DARK
        )
        pixels = sign_board(wide, tall, order.text, ground)
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.1, front - 0.065),
                (-wide / 2, wide / 2),
                (middle - tall / 2, middle + tall / 2),
            ),
        )
    return assembly


def kitchen_counter(order: Order) -> Assembly:
    """Build kitchen base cabinets with doors, handles and a worktop."""
    assembly = Assembly()
    back, front = order.x
    top = order.height
    colour = order.colour(WHITE)
    assembly.add(
        paint(shade(colour, 0.85)),
        box((back, front - 0.04), order.y, (0.1, top - 0.04)),
    )
    assembly.add(paint(DARK), box((back, front - 0.1), order.y, (0, 0.1)))
    assembly.add(
        paint((0.45, 0.43, 0.42), 0.4), box(order.x, order.y, (top - 0.04, top), 0.01)
    )
    doors = max(2, round(order.length / 0.5))
    step = order.length / doors
    for place in range(doors):
        y = (order.y[0] + place * step + 0.008, order.y[0] + (place + 1) * step - 0.008)
        assembly.add(
            paint(colour, 0.3),
            box((front - 0.05, front - 0.02), y, (0.12, top - 0.22), 0.006),
        )
        assembly.add(
            paint(colour, 0.3),
            box((front - 0.05, front - 0.02), y, (top - 0.2, top - 0.06), 0.006),
        )
        middle = sum(y) / 2
        for z in (top - 0.3, top - 0.14):
            assembly.add(
                metal(STEEL),
                box(
                    (front - 0.02, front - 0.002),
                    (middle - 0.06, middle + 0.06),
                    (z, z + 0.015),
                ),
            )
    return assembly
