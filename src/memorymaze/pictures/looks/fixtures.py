"""What is built in or stands fixed: pillars, escalators, lamps, washing places."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order, built
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.materials import (
    BLACK,
    STEEL,
    WHITE,
    Rgb,
    glass,
    glow,
    metal,
    paint,
    picture,
    shade,
)
from memorymaze.pictures.looks.shapes import around, box, extruded, lathed

WATER: Rgb = (0.35, 0.62, 0.85)


def pillar(made: Assembly, order: Order) -> None:
    """Build a round column with a foot and a head."""
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
    made.add(
        order.body((0.9, 0.9, 0.89), 0.1),
        lathed(profile, 28).scaled(order.depth, order.length, 1),
    )


def escalator(made: Assembly, order: Order) -> None:
    """Build the end of an escalator: handrails on glass, steps, a comb, its words."""
    back, front = order.x
    steel = metal(order.colour(STEEL))
    wall = min(0.2, 0.16 * order.length)
    nose = min(0.35, 0.25 * order.depth)
    skirt, grip = order.height * 0.3, order.height - 0.045
    for y in (order.y.start(wall), order.y.end(wall)):
        middle = sum(y) / 2
        made.box(steel, order.x.inset(0, nose * 0.5), y, (0, skirt), 0.015)
        pane = around(middle, 0.012)
        made.box(
            glass((0.7, 0.85, 0.88), 0.35),
            order.x.inset(0, nose),
            pane,
            (skirt, order.height - 0.06),
        )
        r = (order.height - 0.04 - skirt) / 2
        rail = [(back + 0.05, middle, grip), (front - nose, middle, grip)]
        for step in range(1, 8):
            a = math.pi / 2 - math.pi * step / 8
            x = front - nose + (nose - 0.05) * math.cos(a)
            rail.append((x, middle, skirt + r + (r - 0.01) * math.sin(a)))
        made.tube(paint(BLACK, 0.2), rail, 0.042, 8)
    inner = order.y.inset(wall)
    made.box(steel, order.x.end(nose * 1.6), inner, (0, 0.012))
    run = order.depth - nose * 1.6
    count = max(2, round(run / 0.36))
    ribs = 6
    for step in range(count):
        low, high = back + run * step / count, back + run * (step + 1) / count - 0.008
        made.box(paint((0.3, 0.31, 0.33), 0.3), (low, high), inner, (0.01, 0.03))
        made.box(paint((0.95, 0.8, 0.1)), (high - 0.03, high), inner, (0.025, 0.036))
        for rib in range(ribs):
            y = inner[0] + (inner[1] - inner[0]) * (rib + 0.5) / ribs
            made.box(
                paint((0.5, 0.51, 0.53), 0.3),
                (low, high - 0.03),
                around(y, 0.02),
                (0.02, 0.034),
            )
    if order.text:
        wide, tall = order.length * 0.62, 0.26
        made.words(
            order.text,
            (0.0, 0.35, 0.55),
            order.x.start(0.05),
            around(0, wide / 2),
            order.z.end(tall),
            light=0.2,
        )
        for side in (-1, 1):
            y = side * wide * 0.4
            post = box(order.x.start(0.03), around(y, 0.015), (0, order.height - tall))
            made.add(steel, post)


def floor_lamp(made: Assembly, order: Order) -> None:
    """Build a lamp with a cloth shade on a tall foot."""
    r = min(order.length, order.depth) / 2
    h = order.height
    stand = metal(order.colour(BLACK))
    made.lathed(
        stand,
        [
            (r * 0.75, 0),
            (r * 0.72, 0.02),
            (0.03, 0.05),
            (0.014, 0.08),
            (0.014, 0.86 * h),
        ],
        18,
    )
    cloth = [(r, 0.8 * h), (r * 0.7, h), (r * 0.66, h), (r * 0.95, 0.81 * h)]
    made.lathed(glow((0.97, 0.9, 0.72), 0.6), cloth, 22)


def drinking_fountain(made: Assembly, order: Order) -> None:
    """Build a drinking fountain: a steel cabinet with a basin, a spout, a push bar."""
    back = order.x[0]
    left, right = order.y
    colour = order.colour(STEEL)
    steel = metal(colour)
    rim = order.height * 0.9
    tub = min(0.16, 0.2 * order.height)
    low = rim - tub
    made.box(
        paint(shade(colour, 0.62), 0.3),
        order.x.inset(0, 0.1),
        (left * 0.8, right * 0.8),
        (0.06, low),
    )
    made.box(paint(BLACK), order.x.inset(0, 0.14), (left * 0.7, right * 0.7), (0, 0.06))
    for row in range(4):
        z = 0.2 * low + 0.05 * row
        vent = box(order.x.end(0.11, 0.097), (left * 0.5, right * 0.5), (z, z + 0.018))
        made.add(paint(shade(colour, 0.35)), vent)
    made.box(steel, order.x, order.y, (low, low + 0.05), 0.02)
    for y in (order.y.start(0.03), order.y.end(0.03)):
        made.box(steel, order.x, y, (low, rim), 0.008)
    made.box(steel, order.x.end(0.03), order.y, (low, rim - 0.004), 0.01)
    made.box(steel, order.x.start(0.06), order.y, (low, order.height), 0.01)
    made.cylinder(paint((0.3, 0.31, 0.33), 0.4), 0.035, (low + 0.05, low + 0.056), 12)
    spout = [
        (back * 0.4, left * 0.55, low + 0.05),
        (back * 0.4, left * 0.55, rim + 0.01),
        (back * 0.4, left * 0.3, rim + 0.04),
    ]
    made.tube(metal((0.85, 0.86, 0.88)), spout, 0.017, 7)
    jet = [
        (back * 0.4, left * 0.3, rim + 0.04),
        (back * 0.4, left * 0.1, rim + 0.06),
        (back * 0.4, right * 0.25, low + 0.05),
    ]
    made.tube(paint(WATER, 0.8), jet, 0.011, 5)
    bar = box(
        order.x.end(0.03, -0.012), (left * 0.55, right * 0.55), (low + 0.02, low + 0.08)
    )
    made.add(paint((0.12, 0.3, 0.65)), bar)
    drop = extruded(
        [(0.0, 0.045), (0.022, 0.0), (0.012, -0.018), (-0.012, -0.018), (-0.022, 0.0)],
        order.x.start(0.065),
        "x",
    )
    made.add(paint((0.12, 0.3, 0.65)), drop.moved(z=order.height - 0.05))


def eyewash_station(made: Assembly, order: Order) -> None:
    """Build an emergency eyewash: a sign over a bowl with two jets and a lever."""
    back = order.x[0]
    colour = order.colour((0.1, 0.5, 0.3))
    tall = 0.42 * order.height
    made.words(
        order.text or "EYE WASH",
        (0.0, 0.48, 0.24),
        order.x.start(0.02),
        order.y,
        order.z.end(tall),
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
    made.add(paint((0.9, 0.85, 0.2), 0.4), bowl.moved(x=order.depth * 0.05))
    made.tube(
        paint(colour), [(back + 0.03, 0, 0), (back + 0.03, 0, rim + 0.08)], 0.025, 8
    )
    for side in (-1, 1):
        y = side * 0.07
        made.tube(
            paint(colour),
            [(back + 0.03, y, rim), (0.02, y, rim + 0.0), (0.03, y * 0.9, rim + 0.06)],
            0.014,
            6,
        )
        made.tube(
            glass(WATER, 0.6),
            [(0.03, y * 0.9, rim + 0.06), (0.02, y * 0.5, rim + 0.13)],
            0.01,
            5,
        )
    made.box(
        metal(STEEL),
        order.x.end(0.12),
        order.y.end(0.06, 0.02),
        around(rim, 0.03),
        0.01,
    )


def hand_sanitizer(made: Assembly, order: Order) -> None:
    """Build a soap dispenser for the wall: a white body, a window, a lever."""
    front = order.x[1]
    top = order.height
    made.box(
        paint(order.colour(WHITE), 0.3),
        order.x.inset(0, 0.025),
        order.y,
        (0.22 * top, top),
        0.02,
    )
    half = order.length * 0.22
    made.box(
        paint((0.35, 0.65, 0.85), 0.6),
        order.x.end(0.04, 0.02),
        (-half, half),
        (0.55 * top, 0.88 * top),
        0.008,
    )
    made.box(
        paint((0.55, 0.58, 0.6)),
        order.x.end(0.06),
        around(0, half * 1.3),
        (0.12 * top, 0.42 * top),
        0.01,
    )
    made.cylinder(paint(BLACK), 0.012, (0, 0.24 * top), 8, at=(front - 0.05, 0, 0))


def hand_sanitizer_stand(made: Assembly, order: Order) -> None:
    """Build a hand sanitizer dispenser on a pole with a round foot and a drip tray."""
    radius = min(order.length, order.depth) / 2
    steel = metal(STEEL)
    made.lathed(steel, [(radius, 0), (radius, 0.015), (0.04, 0.03)], 18)
    made.cylinder(steel, 0.022, (0.02, order.height * 0.75), 10)
    made.add(
        steel,
        lathed([(0.3, 0), (1.0, 0.03), (0.95, 0.03), (0.2, 0.012), (0, 0.01)], 14)
        .scaled(0.09, 0.09, 1)
        .moved(0.08, 0, order.height * 0.55),
    )
    head = Order(order.category, 0.15, 0.13, order.height * 0.28, order.colour_words)
    made.include(built(hand_sanitizer, head), x=0.05, z=order.height * 0.72)
    made.plate(
        picture(sign_board(0.22, 0.12, order.text or "", (0.15, 0.5, 0.75))),
        (-0.03, -0.015),
        (-0.11, 0.11),
        (order.height * 0.9, order.height),
    )
