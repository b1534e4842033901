"""Exhibits of science museums."""

import math

import numpy as np

from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import sign_board
from memorymaze.simulation.looks.colours import Rgb, shade
from memorymaze.simulation.looks.figures import plinth
from memorymaze.simulation.looks.paints import glass, glow, metal, paint, picture, wood
from memorymaze.simulation.looks.primitives import (
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.simulation.looks.shape import smoothed
from memorymaze.simulation.looks.tubes import Point3, limb, tube

__all__ = [
    "anemometer",
    "city_model",
    "cloud_chamber",
    "core_sample",
    "detector_tube",
    "dna_model",
    "drill_head",
    "listening_horn",
    "rock",
    "robot_arm",
    "seismograph",
    "sundial",
]

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
    turns, steps = 1.8, 36
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


def rock(order: Order) -> Assembly:
    """Build a pitted lump of rock or iron on a pedestal with its words."""
    assembly = Assembly()
    base = 0.55 * order.height
    assembly.include(plinth(order, base, (0.55, 0.53, 0.5)))
    rng = order.rng()
    tall = order.height - base
    colour = order.colour((0.25, 0.23, 0.22))
    lump = ball(1.0, 18, 12)
    points = lump.vertices
    bumps = sum(
        0.09
        * math.e ** (-0.4 * k)
        * np.sin(points @ rng.normal(0, 2.2 + k, 3) + rng.uniform(0, 6))
        for k in range(4)
    )
    rough = smoothed(lump.vertices * (1 + bumps)[:, None], lump.faces)
    assembly.add(
        paint(shade(colour, 1.12), 0.5),
        rough.scaled(order.depth * 0.42, order.length * 0.43, tall * 0.5).moved(
            z=base + tall * 0.46
        ),
    )
    return assembly


def seismograph(order: Order) -> Assembly:
    """Build a drum with paper and a pen on an arm, on a wooden stand."""
    assembly = Assembly()
    base = 0.6 * order.height
    stand = wood(order.colour((0.45, 0.29, 0.17)))
    back, front = order.x
    assembly.add(
        stand,
        box((back, front - 0.02), order.y, (0, base)),
        box(order.x, order.y, (base - 0.04, base)),
    )
    if order.text:
        wide, tall = order.length * 0.8, base * 0.32
        assembly.add(
            picture(sign_board(wide, tall, order.text, (0.12, 0.1, 0.08))),
            plate(
                (front - 0.04, front - 0.006),
                (-wide / 2, wide / 2),
                (base * 0.5, base * 0.5 + tall),
            ),
        )
    r = min(0.16, 0.3 * (order.height - base))
    z = base + r + 0.08
    brass = metal((0.78, 0.62, 0.28))
    drum = cylinder(r, (-order.length * 0.3, order.length * 0.3), 20).turned("x", 90)
    assembly.add(paint((0.95, 0.94, 0.88)), drum.moved(0.02, 0, z))
    for side in (-1, 1):
        y = side * order.length * 0.33
        assembly.add(
            brass,
            cylinder(r * 1.08, (-0.012, 0.012), 20)
            .turned("x", 90)
            .moved(0.02, y * 0.92, z),
            box((-0.03, 0.07), (y - 0.012, y + 0.012), (base, z + 0.03)),
        )
    line: list[Point3] = []
    for step in range(41):
        y = order.length * 0.27 * (step / 20 - 1)
        shake = 0.3 * math.sin(step * 2.3) * math.exp(-(((step - 22) / 7) ** 2))
        a = 0.6 + shake
        line.append((
            0.02 + (r + 0.004) * math.cos(a),
            y,
            z + (r + 0.004) * math.sin(a),
        ))
    assembly.add(paint((0.75, 0.1, 0.1)), tube(line, 0.006, 4))
    assembly.add(
        brass,
        tube(
            [
                (back * 0.6, 0, base),
                (back * 0.6, 0, order.height - 0.02),
                (0.02, 0.0, order.height - 0.03),
                (0.02 + r * 0.7, 0, z + r * 0.8),
            ],
            0.012,
            6,
        ),
    )
    assembly.add(brass, ball(0.05, 10, 8).moved(back * 0.6, 0, order.height - 0.05))
    return assembly


def cloud_chamber(order: Order) -> Assembly:
    """Build a black box with a glass top over a lit chamber with tracks."""
    assembly = Assembly()
    back, front = order.x
    base = order.height * 0.78
    assembly.add(
        paint(order.colour(DARK), 0.2), box((back, front - 0.012), order.y, (0, base))
    )
    inset = 0.06
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
            tone = shade(order.colour((0.9, 0.9, 0.88)), float(rng.uniform(0.85, 1.0)))
            a, b = (
                deep * float(rng.uniform(0.26, 0.38)),
                wide * float(rng.uniform(0.26, 0.38)),
            )
            assembly.add(
                paint(tone), box((x - a, x + a), (y - b, y + b), (z, z + tall))
            )
    return assembly


def core_sample(order: Order) -> Assembly:
    """Build cylinders of layered rock standing in a row on a base."""
    assembly = Assembly()
    base = 0.45 * order.height
    assembly.include(plinth(order, base, GREY))
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
            assembly.add(
                paint(tones[(layer + place) % 5], 0.05),
                cylinder(r, (z, z + step), 12).moved(y=y),
            )
            z += step
            layer += 1
    return assembly


def drill_head(order: Order) -> Assembly:
    """Build a three-cone drill bit, points up, on a pedestal."""
    assembly = Assembly()
    base = 0.4 * order.height
    assembly.include(plinth(order, base, (0.55, 0.53, 0.5)))
    tall = order.height - base
    r = min(order.length, order.depth) * 0.4
    steel = metal(order.colour((0.5, 0.51, 0.53)))
    assembly.add(
        steel,
        lathed(
            [
                (r * 0.7, base),
                (r * 0.75, base + 0.12 * tall),
                (r * 0.55, base + 0.2 * tall),
                (r * 0.9, base + 0.45 * tall),
                (r * 0.7, base + 0.6 * tall),
            ],
            18,
        ),
    )
    for place in range(3):
        a = 360 * place / 3
        cone = lathed(
            [
                (r * 0.5, 0),
                (r * 0.55, 0.06 * tall),
                (r * 0.4, 0.2 * tall),
                (r * 0.12, 0.32 * tall),
                (0, 0.34 * tall),
            ],
            12,
        )
        shape = (
            cone.turned("y", -28).moved(r * 0.5, 0, base + 0.58 * tall).turned("z", a)
        )
        assembly.add(metal((0.62, 0.6, 0.56)), shape)
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
                assembly.add(metal((0.3, 0.3, 0.32)), spike)
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


def anemometer(order: Order) -> Assembly:
    """Build a weather mast: turning cups, a wind vane, a white louvred box."""
    assembly = Assembly()
    mast = metal(order.colour(STEEL))
    top = order.height
    reach = min(order.length, order.depth) / 2
    assembly.add(
        mast,
        lathed(
            [
                (reach * 0.7, 0),
                (reach * 0.7, 0.03),
                (0.05, 0.06),
                (0.03, 0.2),
                (0.022, top - 0.12),
            ],
            10,
        ),
    )
    hub = top - 0.12
    for place in range(3):
        a = 120.0 * place
        arm = tube([(0, 0, hub), (reach * 0.72, 0, hub)], 0.012, 5)
        cup = (
            lathed(
                [(0.0, 0.0), (0.055, 0.03), (0.08, 0.08), (0.068, 0.08), (0.0, 0.02)],
                12,
            )
            .turned("x", 90)
            .moved(reach * 0.78, 0.05, hub)
        )
        assembly.add(mast, arm.turned("z", a))
        assembly.add(paint(DARK, 0.3), cup.turned("z", a))
    assembly.add(
        mast, tube([(0, -reach, hub - 0.2), (0, reach * 0.8, hub - 0.2)], 0.012, 6)
    )
    assembly.add(
        paint((0.75, 0.15, 0.12)),
        box((-0.008, 0.008), (reach * 0.5, reach), (hub - 0.28, hub - 0.12)),
    )
    assembly.add(
        paint((0.75, 0.15, 0.12)),
        lathed([(0.035, 0), (0, 0.1)], 8)
        .turned("x", 90)
        .moved(0, -reach * 0.85, hub - 0.2),
    )
    assembly.add(
        mast,
        lathed(
            [(0.0, top - 0.12), (0.04, top - 0.11), (0.03, top - 0.03), (0, top)], 10
        ),
    )
    for slat in range(7):
        z = 1.0 + 0.05 * slat
        assembly.add(
            paint((0.93, 0.93, 0.92)),
            lathed([(0.12, z), (0.14, z), (0.1, z + 0.035)], 12).moved(0.0, 0, 0),
        )
    return assembly


def sundial(order: Order) -> Assembly:
    """Build a stone column with a dial, hour marks and a slanted pointer."""
    assembly = Assembly()
    r = min(order.length, order.depth) / 2
    stone = paint(order.colour((0.6, 0.59, 0.56)), 0.05)
    dial = order.height * 0.76
    column = [
        (r * 0.75, 0),
        (r * 0.75, 0.07),
        (r * 0.5, 0.12),
        (r * 0.38, 0.3),
        (r * 0.36, dial - 0.2),
        (r * 0.5, dial - 0.1),
        (r, dial - 0.07),
        (r, dial),
    ]
    assembly.add(stone, lathed(column, 24))
    bronze = metal((0.5, 0.4, 0.25))
    assembly.add(bronze, cylinder(r * 0.84, (dial, dial + 0.012), 28))
    for hour in range(12):
        mark = box((r * 0.58, r * 0.78), (-0.012, 0.012), (dial + 0.01, dial + 0.018))
        assembly.add(paint(DARK), mark.turned("z", 30.0 * hour))
    pointer = extruded(
        [(-r * 0.5, dial + 0.01), (r * 0.5, dial + 0.01), (-r * 0.5, order.height)],
        (-0.012, 0.012),
        "y",
    )
    assembly.add(bronze, pointer)
    return assembly


def listening_horn(order: Order) -> Assembly:
    """Build a flared brass horn from the wall with a plate of words below."""
    assembly = Assembly()
    back, front = order.x
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
    assembly.add(brass, lathed(horn, 28).turned("y", 90).moved(back, 0, z))
    assembly.add(
        paint(DARK), cylinder(0.24 * r, (0, 0.03), 16).turned("y", 90).moved(back, 0, z)
    )
    if order.text:
        wide = order.length * 0.94
        pixels = sign_board(wide, label * 0.9, order.text, (0.12, 0.12, 0.14))
        assembly.add(
            picture(pixels),
            plate((back, back + 0.03), (-wide / 2, wide / 2), (0, label * 0.9)),
        )
    return assembly
