"""Water and soap in corridors: fountains, eyewashes, sanitizers."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import glass, metal, paint, picture
from memorymaze.pictures.looks.primitives import (
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.pictures.looks.tubes import tube

WHITE: Rgb = (0.93, 0.93, 0.93)
STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.1, 0.1, 0.11)
WATER: Rgb = (0.35, 0.62, 0.85)


def drinking_fountain(order: Order) -> Assembly:
    """Build a drinking fountain: a steel cabinet with a basin, a spout, a push bar."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    colour = order.colour(STEEL)
    steel = metal(colour)
    rim = order.height * 0.9
    tub = min(0.16, 0.2 * order.height)
    low = rim - tub
    assembly.add(
        paint(shade(colour, 0.62), 0.3),
        box((back, front - 0.1), (left * 0.8, right * 0.8), (0.06, low)),
    )
    assembly.add(
        paint(DARK), box((back, front - 0.14), (left * 0.7, right * 0.7), (0, 0.06))
    )
    for row in range(4):
        z = 0.2 * low + 0.05 * row
        vent = box(
            (front - 0.11, front - 0.097), (left * 0.5, right * 0.5), (z, z + 0.018)
        )
        assembly.add(paint(shade(colour, 0.35)), vent)
    assembly.add(steel, box((back, front), (left, right), (low, low + 0.05), 0.02))
    for y in ((left, left + 0.03), (right - 0.03, right)):
        assembly.add(steel, box((back, front), y, (low, rim), 0.008))
    assembly.add(
        steel, box((front - 0.03, front), (left, right), (low, rim - 0.004), 0.01)
    )
    assembly.add(
        steel, box((back, back + 0.06), (left, right), (low, order.height), 0.01)
    )
    assembly.add(
        paint((0.3, 0.31, 0.33), 0.4), cylinder(0.035, (low + 0.05, low + 0.056), 12)
    )
    spout = [
        (back * 0.4, left * 0.55, low + 0.05),
        (back * 0.4, left * 0.55, rim + 0.01),
        (back * 0.4, left * 0.3, rim + 0.04),
    ]
    assembly.add(metal((0.85, 0.86, 0.88)), tube(spout, 0.017, 7))
    jet = [
        (back * 0.4, left * 0.3, rim + 0.04),
        (back * 0.4, left * 0.1, rim + 0.06),
        (back * 0.4, right * 0.25, low + 0.05),
    ]
    assembly.add(paint(WATER, 0.8), tube(jet, 0.011, 5))
    bar = box(
        (front - 0.03, front + 0.012),
        (left * 0.55, right * 0.55),
        (low + 0.02, low + 0.08),
    )
    assembly.add(paint((0.12, 0.3, 0.65)), bar)
    drop = extruded(
        [(0.0, 0.045), (0.022, 0.0), (0.012, -0.018), (-0.012, -0.018), (-0.022, 0.0)],
        (back, back + 0.065),
        "x",
    )
    assembly.add(paint((0.12, 0.3, 0.65)), drop.moved(z=order.height - 0.05))
    return assembly


def eyewash_station(order: Order) -> Assembly:
    """Build an emergency eyewash: a sign over a bowl with two jets and a lever."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour((0.1, 0.5, 0.3))
    tall = 0.42 * order.height
    pixels = sign_board(order.length, tall, order.text or "EYE WASH", (0.0, 0.48, 0.24))
    assembly.add(
        picture(pixels),
        plate((back, back + 0.02), order.y, (order.height - tall, order.height)),
    )
    rim = order.height * 0.42
    bowl = lathed(
        [
            (0.2, rim - 0.16),
            (0.8, rim - 0.06),
            (1.0, rim),
            (0.9, rim),
            (0.3, rim - 0.1),
            (0, rim - 0.11),
        ],
        18,
    ).scaled(order.depth * 0.45, order.length * 0.48, 1.0)
    assembly.add(paint((0.9, 0.85, 0.2), 0.4), bowl.moved(x=order.depth * 0.05))
    assembly.add(
        paint(colour),
        tube([(back + 0.03, 0, 0), (back + 0.03, 0, rim + 0.08)], 0.025, 8),
    )
    for side in (-1, 1):
        y = side * 0.07
        assembly.add(
            paint(colour),
            tube(
                [
                    (back + 0.03, y, rim),
                    (0.02, y, rim + 0.0),
                    (0.03, y * 0.9, rim + 0.06),
                ],
                0.014,
                6,
            ),
        )
        assembly.add(
            glass(WATER, 0.6),
            tube([(0.03, y * 0.9, rim + 0.06), (0.02, y * 0.5, rim + 0.13)], 0.01, 5),
        )
    assembly.add(
        metal(STEEL),
        box(
            (front - 0.12, front),
            (order.y[1] - 0.06, order.y[1] - 0.02),
            (rim - 0.03, rim + 0.03),
            0.01,
        ),
    )
    return assembly


def hand_sanitizer(order: Order) -> Assembly:
    """Build a soap dispenser for the wall: a white body, a window, a lever."""
    assembly = Assembly()
    back, front = order.x
    top = order.height
    assembly.add(
        paint(order.colour(WHITE), 0.3),
        box((back, front - 0.025), order.y, (0.22 * top, top), 0.02),
    )
    half = order.length * 0.22
    assembly.add(
        paint((0.35, 0.65, 0.85), 0.6),
        box(
            (front - 0.04, front - 0.02), (-half, half), (0.55 * top, 0.88 * top), 0.008
        ),
    )
    assembly.add(
        paint((0.55, 0.58, 0.6)),
        box(
            (front - 0.06, front),
            (-half * 1.3, half * 1.3),
            (0.12 * top, 0.42 * top),
            0.01,
        ),
    )
    assembly.add(paint(DARK), cylinder(0.012, (0, 0.24 * top), 8).moved(x=front - 0.05))
    return assembly


def sanitizer_stand(order: Order) -> Assembly:
    """Build a hand sanitizer dispenser on a pole with a round foot and a drip tray."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    steel = metal(STEEL)
    assembly.add(steel, lathed([(radius, 0), (radius, 0.015), (0.04, 0.03)], 18))
    assembly.add(steel, cylinder(0.022, (0.02, order.height * 0.75), 10))
    assembly.add(
        steel,
        lathed([(0.3, 0), (1.0, 0.03), (0.95, 0.03), (0.2, 0.012), (0, 0.01)], 14)
        .scaled(0.09, 0.09, 1)
        .moved(0.08, 0, order.height * 0.55),
    )
    head = Order(order.category, 0.15, 0.13, order.height * 0.28, order.colour_words)
    assembly.include(hand_sanitizer(head), x=0.05, z=order.height * 0.72)
    pixels = sign_board(0.22, 0.12, order.text or "", (0.15, 0.5, 0.75))
    assembly.add(
        picture(pixels),
        plate((-0.03, -0.015), (-0.11, 0.11), (order.height * 0.9, order.height)),
    )
    return assembly
