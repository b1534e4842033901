"""Things of a hall: pillars, escalators, lamps."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import glass, glow, metal, paint, picture
from memorymaze.pictures.looks.primitives import box, lathed, plate
from memorymaze.pictures.looks.tubes import tube

STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.1, 0.1, 0.11)


def pillar(order: Order) -> Assembly:
    """Build a round column with a foot and a head."""
    assembly = Assembly()
    r, top = 0.5, order.height
    lip = 0.12 * min(order.length, order.depth) / r
    profile = [
        (r, 0),
        (r, lip),
        (r * 0.92, lip * 1.3),
        (r * 0.92, top - lip * 1.3),
        (r, top - lip),
        (r, top),
    ]
    assembly.add(
        order.body((0.9, 0.9, 0.89), 0.1),
        lathed(profile, 28).scaled(order.depth, order.length, 1),
    )
    return assembly


def escalator(order: Order) -> Assembly:
    """Build the end of an escalator: handrails on glass, steps, a comb, its words."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    steel = metal(order.colour(STEEL))
    wall = min(0.2, 0.16 * order.length)
    nose = min(0.35, 0.25 * order.depth)
    skirt, grip = order.height * 0.3, order.height - 0.045
    for y in ((left, left + wall), (right - wall, right)):
        middle = sum(y) / 2
        assembly.add(steel, box((back, front - nose * 0.5), y, (0, skirt), 0.015))
        pane = (middle - 0.012, middle + 0.012)
        assembly.add(
            glass((0.7, 0.85, 0.88), 0.35),
            box((back, front - nose), pane, (skirt, order.height - 0.06)),
        )
        r = (order.height - 0.04 - skirt) / 2
        rail = [(back + 0.05, middle, grip), (front - nose, middle, grip)]
        for step in range(1, 8):
            a = math.pi / 2 - math.pi * step / 8
            x = front - nose + (nose - 0.05) * math.cos(a)
            rail.append((x, middle, skirt + r + (r - 0.01) * math.sin(a)))
        assembly.add(paint(DARK, 0.2), tube(rail, 0.042, 8))
    inner = (left + wall, right - wall)
    assembly.add(steel, box((front - nose * 1.6, front), inner, (0, 0.012)))
    run = order.depth - nose * 1.6
    count = max(2, round(run / 0.36))
    ribs = 6
    for step in range(count):
        low, high = back + run * step / count, back + run * (step + 1) / count - 0.008
        assembly.add(
            paint((0.3, 0.31, 0.33), 0.3), box((low, high), inner, (0.01, 0.03))
        )
        assembly.add(
            paint((0.95, 0.8, 0.1)), box((high - 0.03, high), inner, (0.025, 0.036))
        )
        for rib in range(ribs):
            y = inner[0] + (inner[1] - inner[0]) * (rib + 0.5) / ribs
            assembly.add(
                paint((0.5, 0.51, 0.53), 0.3),
                box((low, high - 0.03), (y - 0.02, y + 0.02), (0.02, 0.034)),
            )
    if order.text:
        wide, tall = order.length * 0.62, 0.26
        pixels = sign_board(wide, tall, order.text, (0.0, 0.35, 0.55))
        assembly.add(
            picture(pixels, 0.2),
            plate(
                (back, back + 0.05),
                (-wide / 2, wide / 2),
                (order.height - tall, order.height),
            ),
        )
        for side in (-1, 1):
            y = side * wide * 0.4
            post = box(
                (back, back + 0.03), (y - 0.015, y + 0.015), (0, order.height - tall)
            )
            assembly.add(steel, post)
    return assembly


def floor_lamp(order: Order) -> Assembly:
    """Build a lamp with a cloth shade on a tall foot."""
    assembly = Assembly()
    r = min(order.length, order.depth) / 2
    h = order.height
    stand = metal(order.colour(DARK))
    assembly.add(
        stand,
        lathed(
            [
                (r * 0.75, 0),
                (r * 0.72, 0.02),
                (0.03, 0.05),
                (0.014, 0.08),
                (0.014, 0.86 * h),
            ],
            18,
        ),
    )
    cloth = [(r, 0.8 * h), (r * 0.7, h), (r * 0.66, h), (r * 0.95, 0.81 * h)]
    assembly.add(glow((0.97, 0.9, 0.72), 0.6), lathed(cloth, 22))
    return assembly
