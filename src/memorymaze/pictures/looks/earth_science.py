"""Exhibits about the earth and its weather."""

import math

import numpy as np

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.captions import plinth
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import metal, paint, picture, wood
from memorymaze.pictures.looks.primitives import ball, box, cylinder, lathed, plate
from memorymaze.pictures.looks.shape import smoothed
from memorymaze.pictures.looks.tubes import Point3, tube

DARK: Rgb = (0.13, 0.13, 0.15)
GREY: Rgb = (0.32, 0.34, 0.37)


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
    bumps = np.zeros(len(points))
    for octave in range(4):
        waves = points @ rng.normal(0, 2.2 + octave, 3) + rng.uniform(0, 6)
        bumps += 0.09 * math.exp(-0.4 * octave) * np.sin(waves)
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
        shake = 0.22 * math.sin(step * 1.5) * math.exp(-(((step - 22) / 7) ** 2))
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
                cylinder(r, (z, z + step), 9).moved(y=y),
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


def listening_horn(order: Order) -> Assembly:
    """Build a flared brass horn from the wall with a plate of words below."""
    assembly = Assembly()
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
    assembly.add(brass, lathed(horn, 28).turned("y", 90).moved(back, 0, z))
    # Rings in its throat, as lamps alone do not show how deep it is.
    for share, at, tone in ((0.8, 0.9, 0.8), (0.5, 0.91, 0.55), (0.25, 0.92, 0.2)):
        ring = cylinder(share * r, (at * deep, (at + 0.02) * deep), 24)
        colour = shade(order.colour((0.83, 0.65, 0.22)), tone)
        assembly.add(paint(colour), ring.turned("y", 90).moved(back, 0, z))
    if order.text:
        wide = order.length * 0.94
        pixels = sign_board(wide, label * 0.9, order.text, (0.12, 0.12, 0.14))
        assembly.add(
            picture(pixels),
            plate((back, back + 0.03), (-wide / 2, wide / 2), (0, label * 0.9)),
        )
    return assembly
