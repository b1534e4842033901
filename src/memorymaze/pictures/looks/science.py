"""Exhibits of science museums that stand on a base."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.captions import plinth
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import glass, glow, metal, paint, picture
from memorymaze.pictures.looks.primitives import box, cylinder, lathed, plate
from memorymaze.pictures.looks.tubes import Point3, limb, tube

STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.13, 0.13, 0.15)
GREY: Rgb = (0.32, 0.34, 0.37)


def dna_model(order: Order) -> Assembly:
    """Build a double helix with coloured rungs on a base."""
    assembly = Assembly()
    base = 0.2 * order.height
    assembly.include(plinth(order, base, GREY))
    r = min(order.length, order.depth) * 0.42
    tall = order.height - base
    strands = (order.colour((0.78, 0.15, 0.15)), (0.15, 0.35, 0.75))
    turns, steps = 1.8, 28
    for strand, tone in enumerate(strands):
        path: list[Point3] = []
        for step in range(steps + 1):
            a = math.tau * turns * step / steps + math.pi * strand
            path.append((
                r * math.cos(a),
                r * math.sin(a),
                base + 0.02 + (tall - 0.06) * step / steps,
            ))
        assembly.add(paint(tone, 0.4), tube(path, 0.032, 6))
    rungs: tuple[Rgb, ...] = (
        (0.95, 0.8, 0.2),
        (0.3, 0.65, 0.35),
        (0.9, 0.5, 0.2),
        (0.6, 0.4, 0.7),
    )
    for step in range(1, 18):
        a = math.tau * turns * step / 18
        z = base + 0.02 + (tall - 0.06) * step / 18
        end: Point3 = (r * math.cos(a), r * math.sin(a), z)
        for side in (-1, 1):
            tone = rungs[(step + side) % 4]
            assembly.add(
                paint(tone, 0.3),
                tube([(0, 0, z), (side * end[0], side * end[1], z)], 0.018, 5),
            )
    return assembly


def robot_arm(order: Order) -> Assembly:
    """Build an industrial arm of three joints with a gripper."""
    assembly = Assembly()
    base = 0.14 * order.height
    assembly.include(plinth(order, base, GREY))
    h = order.height - base
    paint_ = paint(order.colour((0.93, 0.49, 0.11)), 0.3)
    dark = paint(DARK, 0.3)
    across = order.length * 0.46
    shoulder = (0.0, -across * 0.3, base + 0.3 * h)
    elbow = (0.0, -across * 0.55, base + 0.86 * h)
    wrist = (0.0, across * 0.66, base + 0.8 * h)
    r = 0.085 * h
    assembly.add(
        dark, cylinder(r * 2.1, (base, base + 0.06 * h), 16).moved(y=shoulder[1])
    )
    assembly.add(
        paint_,
        cylinder(r * 1.6, (base + 0.06 * h, base + 0.3 * h), 16, r * 1.2).moved(
            y=shoulder[1]
        ),
    )
    assembly.add(
        paint_,
        limb([shoulder, elbow], [r * 1.05, r * 0.85], 10),
        limb([elbow, wrist], [r * 0.85, r * 0.55], 10),
    )
    for joint, size in ((shoulder, 1.35), (elbow, 1.15), (wrist, 0.8)):
        disc = cylinder(r * size, (-r * 1.25, r * 1.25), 14).turned("y", 90)
        assembly.add(dark, disc.moved(*joint))
    hand = wrist[2] - 0.2 * h
    assembly.add(dark, tube([wrist, (0.0, wrist[1], hand)], r * 0.5, 8))
    for side in (-1, 1):
        y = wrist[1] + side * r * 0.6
        assembly.add(
            metal(STEEL),
            tube(
                [
                    (0, wrist[1], hand),
                    (0, y, hand - 0.03 * h),
                    (0, y, hand - 0.14 * h),
                    (0, wrist[1] + side * r * 0.25, hand - 0.19 * h),
                ],
                r * 0.17,
                5,
            ),
        )
    return assembly


def cloud_chamber(order: Order) -> Assembly:
    """Build a black box with a glass top over a lit chamber with tracks."""
    assembly = Assembly()
    back, front = order.x
    base = order.height * 0.78
    assembly.add(
        paint(order.colour(DARK), 0.2), box((back, front - 0.012), order.y, (0, base))
    )
    inset = min(0.06, 0.2 * order.depth, 0.2 * order.length)
    x, y = (back + inset, front - inset), (order.y[0] + inset, order.y[1] - inset)
    assembly.add(glow((0.25, 0.45, 0.6), 0.4), box(x, y, (base, base + 0.02)))
    rng = order.rng()
    for _ in range(12):
        a, b = rng.uniform(*x), rng.uniform(*y)
        c, d = a + rng.uniform(-0.12, 0.12), b + rng.uniform(-0.14, 0.14)
        c, d = min(max(c, x[0]), x[1]), min(max(d, y[0]), y[1])
        assembly.add(
            glow((0.95, 0.98, 1.0), 0.9),
            tube([(a, b, base + 0.025), (c, d, base + 0.03)], 0.005, 4),
        )
    assembly.add(
        glass(alpha=0.25),
        box(
            (back + 0.02, front - 0.02),
            (order.y[0] + 0.02, order.y[1] - 0.02),
            (base, order.height - 0.03),
        ),
    )
    for side in (0, 1):
        edge = (back, back + 0.03) if side else (front - 0.03, front)
        assembly.add(
            metal(STEEL), box(edge, order.y, (order.height - 0.03, order.height))
        )
        rim = sorted((order.y[side], order.y[side] + (0.03 if side == 0 else -0.03)))
        assembly.add(
            metal(STEEL),
            box(
                (back + 0.03, front - 0.03),
                (rim[0], rim[1]),
                (order.height - 0.03, order.height),
            ),
        )
    if order.text:
        wide, tall = order.length * 0.84, base * 0.3
        assembly.add(
            picture(sign_board(wide, tall, order.text, (0.93, 0.93, 0.92))),
            plate(
                (front - 0.04, front),
                (-wide / 2, wide / 2),
                (base * 0.55, base * 0.55 + tall),
            ),
        )
    return assembly


def city_model(order: Order) -> Assembly:
    """Build a table-top city of white blocks and towers with streets and parks."""
    assembly = Assembly()
    table_top = order.height * 0.62
    narrow = Order(
        order.category, order.length, order.depth, table_top, None, order.text
    )
    assembly.include(plinth(narrow, table_top, (0.3, 0.32, 0.36)))
    back, front = order.x
    assembly.add(
        paint((0.45, 0.48, 0.5)),
        box(
            (back + 0.02, front - 0.02),
            (order.y[0] + 0.02, order.y[1] - 0.02),
            (table_top, table_top + 0.015),
        ),
    )
    rng = order.rng()
    columns, rows = max(4, int(order.length / 0.17)), max(3, int(order.depth / 0.17))
    room = order.height - table_top - 0.015
    wide, deep = (order.length - 0.1) / columns, (order.depth - 0.1) / rows
    for column in range(columns):
        for row in range(rows):
            y = order.y[0] + 0.05 + (column + 0.5) * wide
            x = back + 0.05 + (row + 0.5) * deep
            near = 1 - math.hypot(column / columns - 0.5, row / rows - 0.5)
            z = table_top + 0.015
            if rng.random() < 0.12:
                assembly.add(
                    paint((0.25, 0.5, 0.25)),
                    box(
                        (x - deep * 0.4, x + deep * 0.4),
                        (y - wide * 0.4, y + wide * 0.4),
                        (z, z + 0.02),
                    ),
                )
                continue
            tall = room * min(1.0, 0.15 + near**3 * float(rng.uniform(0.3, 1.1)))
            if column == columns // 2 and row == rows // 2:
                tall = room
            tone = shade(
                order.colour((0.9, 0.9, 0.88)),
                (0.6, 0.75, 0.9, 1.0)[int(rng.integers(4))],
            )
            a, b = (
                deep * float(rng.uniform(0.26, 0.38)),
                wide * float(rng.uniform(0.26, 0.38)),
            )
            assembly.add(
                paint(tone), box((x - a, x + a), (y - b, y + b), (z, z + tall))
            )
    return assembly


def detector_tube(order: Order) -> Assembly:
    """Build a light detector: a golden glass bulb looking up from a black base."""
    assembly = Assembly()
    base = 0.35 * order.height
    assembly.include(plinth(order, base, GREY))
    r = min(order.length, order.depth) * 0.44
    tall = order.height - base
    assembly.add(
        paint(DARK, 0.3),
        lathed(
            [
                (r * 0.3, base),
                (r * 0.3, base + 0.2 * tall),
                (r * 0.45, base + 0.3 * tall),
            ],
            16,
        ),
    )
    bulb = [
        (r * 0.4, base + 0.26 * tall),
        (r * 0.75, base + 0.4 * tall),
        (r * 0.98, base + 0.55 * tall),
        (r, base + 0.66 * tall),
        (r * 0.9, base + 0.82 * tall),
        (r * 0.6, base + 0.94 * tall),
        (0, order.height),
    ]
    assembly.add(metal(order.colour((0.83, 0.65, 0.22))), lathed(bulb, 24))
    band = [
        (r * 1.0, base + 0.58 * tall),
        (r * 1.03, base + 0.58 * tall),
        (r * 1.03, base + 0.64 * tall),
        (r * 1.0, base + 0.64 * tall),
    ]
    assembly.add(metal(STEEL), lathed(band, 24))
    return assembly
