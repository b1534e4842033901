"""Exhibits of science museums: matter, machines, rocks and the earth."""

import math

import numpy as np

from memorymaze.pictures.looks.assembly import Assembly, Order, plinth
from memorymaze.pictures.looks.materials import (
    ANTHRACITE,
    DARK_GREY,
    STEEL,
    Rgb,
    glass,
    glow,
    metal,
    paint,
    shade,
    wood,
)
from memorymaze.pictures.looks.shapes import (
    around,
    ball,
    box,
    cylinder,
    lathed,
    smoothed_shape,
    span_between,
)
from memorymaze.pictures.looks.tubes import Point3, limb


def dna_model(made: Assembly, order: Order) -> None:
    """Build a double helix with coloured rungs on a base."""
    base = 0.2 * order.height
    plinth(made, order, base, DARK_GREY)
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
        made.tube(paint(tone, 0.4), path, 0.032, 6)
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
            made.tube(
                paint(tone, 0.3),
                [(0, 0, z), (side * end[0], side * end[1], z)],
                0.018,
                5,
            )


def robot_arm(made: Assembly, order: Order) -> None:
    """Build an industrial arm of three joints with a gripper."""
    base = 0.14 * order.height
    plinth(made, order, base, DARK_GREY)
    h = order.height - base
    paint_ = paint(order.colour((0.93, 0.49, 0.11)), 0.3)
    dark = paint(ANTHRACITE, 0.3)
    across = order.length * 0.46
    shoulder = (0.0, -across * 0.3, base + 0.3 * h)
    elbow = (0.0, -across * 0.55, base + 0.86 * h)
    wrist = (0.0, across * 0.66, base + 0.8 * h)
    r = 0.085 * h
    made.cylinder(dark, r * 2.1, (base, base + 0.06 * h), 16, at=(0, shoulder[1], 0))
    made.cylinder(
        paint_,
        r * 1.6,
        (base + 0.06 * h, base + 0.3 * h),
        16,
        r * 1.2,
        at=(0, shoulder[1], 0),
    )
    made.add(
        paint_,
        limb([shoulder, elbow], [r * 1.05, r * 0.85], 10),
        limb([elbow, wrist], [r * 0.85, r * 0.55], 10),
    )
    for joint, size in ((shoulder, 1.35), (elbow, 1.15), (wrist, 0.8)):
        disc = cylinder(r * size, around(0, r * 1.25), 14, along="x")
        made.add(dark, disc.moved(*joint))
    hand = wrist[2] - 0.2 * h
    made.tube(dark, [wrist, (0.0, wrist[1], hand)], r * 0.5, 8)
    for side in (-1, 1):
        y = wrist[1] + side * r * 0.6
        made.tube(
            metal(STEEL),
            [
                (0, wrist[1], hand),
                (0, y, hand - 0.03 * h),
                (0, y, hand - 0.14 * h),
                (0, wrist[1] + side * r * 0.25, hand - 0.19 * h),
            ],
            r * 0.17,
            5,
        )


def cloud_chamber(made: Assembly, order: Order) -> None:
    """Build a black box with a glass top over a lit chamber with tracks."""
    base = order.height * 0.78
    made.box(
        paint(order.colour(ANTHRACITE), 0.2),
        order.x.inset(0, 0.012),
        order.y,
        (0, base),
    )
    inset = min(0.06, 0.2 * order.depth, 0.2 * order.length)
    x, y = order.x.inset(inset), order.y.inset(inset)
    made.box(glow((0.25, 0.45, 0.6), 0.4), x, y, (base, base + 0.02))
    rng = order.rng()
    for _ in range(12):
        a, b = rng.uniform(*x), rng.uniform(*y)
        c, d = a + rng.uniform(-0.12, 0.12), b + rng.uniform(-0.14, 0.14)
        c, d = min(max(c, x[0]), x[1]), min(max(d, y[0]), y[1])
        made.tube(
            glow((0.95, 0.98, 1.0), 0.9),
            [(a, b, base + 0.025), (c, d, base + 0.03)],
            0.005,
            4,
        )
    made.box(
        glass(alpha=0.25),
        order.x.inset(0.02),
        order.y.inset(0.02),
        (base, order.height - 0.03),
    )
    for side in (0, 1):
        edge = order.x.start(0.03) if side else order.x.end(0.03)
        made.box(metal(STEEL), edge, order.y, order.z.end(0.03))
        rim = span_between(
            order.y[side], order.y[side] + (0.03 if side == 0 else -0.03)
        )
        made.box(metal(STEEL), order.x.inset(0.03), rim, order.z.end(0.03))
    made.words(
        order.text,
        (0.93, 0.93, 0.92),
        order.x.end(0.04),
        around(0, order.length * 0.42),
        (base * 0.55, base * 0.55 + base * 0.3),
    )


def city_model(made: Assembly, order: Order) -> None:
    """Build a table-top city of white blocks and towers with streets and parks."""
    table_top = order.height * 0.62
    narrow = Order(
        order.category, order.length, order.depth, table_top, None, order.text
    )
    plinth(made, narrow, table_top, (0.3, 0.32, 0.36))
    back = order.x[0]
    made.box(
        paint((0.45, 0.48, 0.5)),
        order.x.inset(0.02),
        order.y.inset(0.02),
        (table_top, table_top + 0.015),
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
                made.box(
                    paint((0.25, 0.5, 0.25)),
                    around(x, deep * 0.4),
                    around(y, wide * 0.4),
                    (z, z + 0.02),
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
            made.box(paint(tone), around(x, a), around(y, b), (z, z + tall))


def detector_model(made: Assembly, order: Order) -> None:
    """Build a light detector: a golden glass bulb looking up from a black base."""
    base = 0.35 * order.height
    plinth(made, order, base, DARK_GREY)
    r = min(order.length, order.depth) * 0.44
    tall = order.height - base
    made.lathed(
        paint(ANTHRACITE, 0.3),
        [(0.3, 0), (0.3, 0.2), (0.45, 0.3)],
        16,
        radius=r,
        height=tall,
        z=base,
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
    made.lathed(metal(order.colour((0.83, 0.65, 0.22))), bulb, 24)
    band = [
        (r * 1.0, base + 0.58 * tall),
        (r * 1.03, base + 0.58 * tall),
        (r * 1.03, base + 0.64 * tall),
        (r * 1.0, base + 0.64 * tall),
    ]
    made.lathed(metal(STEEL), band, 24)


def rock(made: Assembly, order: Order) -> None:
    """Build a pitted lump of rock or iron on a pedestal with its words."""
    base = 0.55 * order.height
    plinth(made, order, base, (0.55, 0.53, 0.5))
    rng = order.rng()
    tall = order.height - base
    colour = order.colour((0.25, 0.23, 0.22))
    lump = ball(1.0, 18, 12)
    points = lump.vertices
    bumps = np.zeros(len(points))
    for octave in range(4):
        waves = points @ rng.normal(0, 2.2 + octave, 3) + rng.uniform(0, 6)
        bumps += 0.09 * math.exp(-0.4 * octave) * np.sin(waves)
    rough = smoothed_shape(lump.vertices * (1 + bumps)[:, None], lump.faces)
    made.add(
        paint(shade(colour, 1.12), 0.5),
        rough.scaled(order.depth * 0.42, order.length * 0.43, tall * 0.5).moved(
            z=base + tall * 0.46
        ),
    )


def seismograph(made: Assembly, order: Order) -> None:
    """Build a drum with paper and a pen on an arm, on a wooden stand."""
    base = 0.6 * order.height
    stand = wood(order.colour((0.45, 0.29, 0.17)))
    back = order.x[0]
    made.add(
        stand,
        box(order.x.inset(0, 0.02), order.y, (0, base)),
        box(order.x, order.y, (base - 0.04, base)),
    )
    made.words(
        order.text,
        (0.12, 0.1, 0.08),
        order.x.end(0.04, 0.006),
        around(0, order.length * 0.4),
        (base * 0.5, base * 0.5 + base * 0.32),
    )
    r = min(0.16, 0.3 * (order.height - base))
    z = base + r + 0.08
    brass = metal((0.78, 0.62, 0.28))
    drum = cylinder(r, around(0, order.length * 0.3), 20, along="y")
    made.add(paint((0.95, 0.94, 0.88)), drum.moved(0.02, 0, z))
    for side in (-1, 1):
        y = side * order.length * 0.33
        made.add(
            brass,
            cylinder(r * 1.08, (-0.012, 0.012), 20, along="y").moved(0.02, y * 0.92, z),
            box((-0.03, 0.07), around(y, 0.012), (base, z + 0.03)),
        )
    line: list[Point3] = []
    for step in range(41):
        y = order.length * 0.27 * (step / 20 - 1)
        shake = 0.22 * math.sin(step * 1.5) * math.exp(-(((step - 22) / 7) ** 2))
        a = 0.6 + shake
        line.append((
            0.02 + (r + 0.004) * math.cos(a),
            y,
            z + (r + 0.004) * math.sin(a),
        ))
    made.tube(paint((0.75, 0.1, 0.1)), line, 0.006, 4)
    made.tube(
        brass,
        [
            (back * 0.6, 0, base),
            (back * 0.6, 0, order.height - 0.02),
            (0.02, 0.0, order.height - 0.03),
            (0.02 + r * 0.7, 0, z + r * 0.8),
        ],
        0.012,
        6,
    )
    made.ball(brass, 0.05, 10, 8, at=(back * 0.6, 0, order.height - 0.05))


def core_sample(made: Assembly, order: Order) -> None:
    """Build cylinders of layered rock standing in a row on a base."""
    base = 0.45 * order.height
    plinth(made, order, base, DARK_GREY)
    rng = order.rng()
    brown = order.colour((0.45, 0.29, 0.17))
    tones = (
        brown,
        (0.62, 0.56, 0.45),
        (0.3, 0.27, 0.25),
        (0.7, 0.5, 0.35),
        (0.5, 0.5, 0.5),
    )
    count = max(3, int(order.length / 0.24))
    r = min(0.08, order.depth * 0.3)
    for place in range(count):
        y = order.y[0] + order.length * (place + 0.5) / count
        z = base
        end = order.height * (1.0 if place == 1 else float(rng.uniform(0.85, 0.98)))
        layer = 0
        while z < end - 0.01:
            step = min(float(rng.uniform(0.05, 0.16)), end - z)
            made.cylinder(
                paint(tones[(layer + place) % 5], 0.05),
                r,
                (z, z + step),
                9,
                at=(0, y, 0),
            )
            z += step
            layer += 1


def drill_head(made: Assembly, order: Order) -> None:
    """Build a three-cone drill bit, points up, on a pedestal."""
    base = 0.4 * order.height
    plinth(made, order, base, (0.55, 0.53, 0.5))
    tall = order.height - base
    r = min(order.length, order.depth) * 0.4
    steel = metal(order.colour((0.5, 0.51, 0.53)))
    made.lathed(
        steel,
        [(0.7, 0), (0.75, 0.12), (0.55, 0.2), (0.9, 0.45), (0.7, 0.6)],
        18,
        radius=r,
        height=tall,
        z=base,
    )
    for place in range(3):
        a = 360 * place / 3
        cone = lathed(
            [(0.5, 0), (0.55, 0.06), (0.4, 0.2), (0.12, 0.32), (0, 0.34)],
            12,
            radius=r,
            height=tall,
        )
        shape = (
            cone.turned("y", -28).moved(r * 0.5, 0, base + 0.58 * tall).turned("z", a)
        )
        made.add(metal((0.62, 0.6, 0.56)), shape)
        for ring_ in range(3):
            for tooth in range(7):
                b = math.tau * tooth / 7
                out = r * (0.55 - 0.14 * ring_)
                spike = (
                    lathed([(0.03, 0), (0, 0.06)], 4)
                    .turned("y", 90)
                    .moved(out, 0, (0.05 + 0.08 * ring_) * tall)
                )
                spike = (
                    spike
                    .turned("z", math.degrees(b))
                    .turned("y", -28)
                    .moved(r * 0.5, 0, base + 0.58 * tall)
                    .turned("z", a)
                )
                made.add(metal((0.3, 0.3, 0.32)), spike)


def listening_horn(made: Assembly, order: Order) -> None:
    """Build a flared brass horn from the wall with a plate of words below."""
    back = order.x[0]
    brass = metal(order.colour((0.83, 0.65, 0.22)))
    label = 0.24 * order.height if order.text else 0.0
    r = min(order.length, order.height - label) / 2
    z = order.height - r
    deep = order.depth
    horn = [
        (0.1 * r, 0),
        (0.13 * r, 0.3 * deep),
        (0.22 * r, 0.6 * deep),
        (0.45 * r, 0.84 * deep),
        (1.0 * r, deep),
        (0.97 * r, deep),
        (0.36 * r, 0.8 * deep),
        (0.1 * r, 0.5 * deep),
        (0, 0.5 * deep),
    ]
    made.add(brass, lathed(horn, 28).turned("y", 90).moved(back, 0, z))
    # Rings in its throat, as lamps alone do not show how deep it is.
    for share, at, tone in ((0.8, 0.9, 0.8), (0.5, 0.91, 0.55), (0.25, 0.92, 0.2)):
        ring = cylinder(share * r, (at * deep, (at + 0.02) * deep), 24)
        colour = shade(order.colour((0.83, 0.65, 0.22)), tone)
        made.add(paint(colour), ring.turned("y", 90).moved(back, 0, z))
    made.words(
        order.text,
        (0.12, 0.12, 0.14),
        order.x.start(0.03),
        around(0, order.length * 0.47),
        (0, label * 0.9),
    )
