"""Human and abstract forms on plinths: statues, busts, robots, sculptures."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.captions import plinth
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import glow, metal, paint
from memorymaze.pictures.looks.people import Clothes, walker
from memorymaze.pictures.looks.primitives import ball, box, cylinder
from memorymaze.pictures.looks.shape import Floats
from memorymaze.pictures.looks.tubes import limb, lofted, ring

STONE: Rgb = (0.6, 0.59, 0.56)


def statue(order: Order) -> Assembly:
    """Build a person of bronze or stone on a plinth, an arm raised to the sky."""
    foot = 0.28 * order.height
    assembly = plinth(order, foot)
    material = paint(order.colour((0.45, 0.36, 0.25)), 0.35)
    figure = walker(
        (order.height - foot) * 0.97,
        Clothes.all_of(material),
        stride=0.18,
        raised_arm=order.variant % 2 == 0,
    )
    tall = order.height - foot
    robe = lofted(
        [
            ring((0, 0, 0.12 * tall), 0.13 * tall, 0.14 * tall),
            ring((0, 0, 0.35 * tall), 0.1 * tall, 0.115 * tall),
            ring((0, 0, 0.55 * tall), 0.072 * tall, 0.1 * tall),
        ],
    )
    figure.add(material, robe)
    assembly.include(figure, z=foot)
    return assembly


def bust(order: Order) -> Assembly:
    """Build a head and shoulders on a tall pedestal with its words."""
    foot = 0.64 * order.height
    narrow = Order(
        order.category, order.length * 0.8, order.depth * 0.8, foot, None, order.text
    )
    assembly = plinth(narrow, foot)
    assembly.add(
        paint(STONE, 0.05),
        box(order.x, order.y, (0, 0.04)),
        box(
            (order.x[0] * 0.9, order.x[1] * 0.9),
            (order.y[0] * 0.9, order.y[1] * 0.9),
            (foot, foot + 0.04),
        ),
    )
    material = paint(order.colour((0.48, 0.34, 0.2)), 0.5)
    tall = order.height - foot - 0.04
    body = lofted(
        [
            ring((0, 0, 0.0), 0.12 * tall, 0.16 * tall, 14),
            ring((0, 0, 0.12 * tall), 0.15 * tall, 0.24 * tall, 14),
            ring((0, 0, 0.3 * tall), 0.2 * tall, 0.4 * tall, 14),
            ring((0, 0, 0.42 * tall), 0.14 * tall, 0.3 * tall, 14),
            ring((0, 0, 0.48 * tall), 0.09 * tall, 0.1 * tall, 14),
            ring((0.01, 0, 0.58 * tall), 0.085 * tall, 0.085 * tall, 14),
        ],
        round_ends=True,
    )
    head = (
        ball(1.0, 16, 12)
        .scaled(0.17 * tall, 0.14 * tall, 0.2 * tall)
        .moved(0.03 * tall, 0, 0.76 * tall)
    )
    nose = limb(
        [(0.19 * tall, 0, 0.79 * tall), (0.215 * tall, 0, 0.72 * tall)], 0.022 * tall, 6
    )
    hair = (
        ball(1.0, 14, 10)
        .scaled(0.175 * tall, 0.155 * tall, 0.18 * tall)
        .moved(-0.015 * tall, 0, 0.82 * tall)
    )
    beard = (
        ball(1.0, 10, 8)
        .scaled(0.08 * tall, 0.09 * tall, 0.1 * tall)
        .moved(0.12 * tall, 0, 0.6 * tall)
    )
    shift = foot + 0.04
    assembly.add(
        material, *(shape.moved(z=shift) for shape in (body, head, nose, hair, beard))
    )
    return assembly


def robot(order: Order) -> Assembly:
    """Build a humanoid robot with joints and lit eyes on a stage."""
    assembly = Assembly()
    base = 0.18 * order.height
    assembly.include(plinth(order, base, (0.22, 0.25, 0.3)))
    s = order.height - base
    shell = paint(order.colour((0.93, 0.93, 0.94)), 0.4)
    joint = paint((0.2, 0.21, 0.24), 0.3)
    for side in (-1, 1):
        y = side * 0.085 * s
        assembly.add(
            shell,
            limb([(0, y, 0.4 * s), (0.02 * s, y, 0.3 * s)], [0.06 * s, 0.055 * s], 8),
            limb([(0.02 * s, y, 0.2 * s), (0, y, 0.08 * s)], [0.052 * s, 0.045 * s], 8),
        )
        assembly.add(
            joint,
            ball(0.05 * s, 6, 5).moved(0.02 * s, y, 0.245 * s),
            ball(0.055 * s, 6, 5).moved(0, y, 0.46 * s),
        )
        assembly.add(
            shell,
            box(
                (-0.07 * s, 0.12 * s),
                (y - 0.055 * s, y + 0.055 * s),
                (0, 0.06 * s),
                0.02,
            ),
        )
        out = side * 0.21 * s
        lift = 0.12 * s if side < 0 else 0.0
        hand = (0.2 * s, out, 0.5 * s + 3.2 * lift)
        elbow = (0.05 * s, out * 1.15, 0.55 * s)
        assembly.add(
            joint,
            ball(0.058 * s, 6, 5).moved(0, side * 0.17 * s, 0.74 * s),
            ball(0.042 * s, 6, 5).moved(*elbow),
            ball(0.04 * s, 6, 5).moved(*hand),
        )
        assembly.add(
            shell,
            limb(
                [(0.01 * s, out, 0.71 * s), (0.04 * s, out * 1.1, 0.6 * s)],
                0.045 * s,
                8,
            ),
            limb(
                [
                    (0.08 * s, out * 1.13, 0.54 * s + 0.3 * lift),
                    (0.17 * s, out * 1.02, 0.51 * s + 2.7 * lift),
                ],
                0.036 * s,
                8,
            ),
        )
    assembly.add(
        shell,
        lofted(
            [
                ring((0, 0, 0.46 * s), 0.07 * s, 0.1 * s),
                ring((0, 0, 0.54 * s), 0.09 * s, 0.11 * s),
                ring((0.01 * s, 0, 0.7 * s), 0.12 * s, 0.16 * s),
                ring((0, 0, 0.78 * s), 0.07 * s, 0.11 * s),
            ],
            round_ends=True,
        ),
    )
    assembly.add(
        glow((0.2, 0.7, 0.95), 0.8),
        cylinder(0.03 * s, (0, 0.02 * s), 12)
        .turned("y", 90)
        .moved(0.115 * s, 0, 0.69 * s),
    )
    assembly.add(joint, cylinder(0.035 * s, (0.76 * s, 0.84 * s), 9))
    assembly.add(
        shell,
        ball(1.0, 11, 8).scaled(0.1 * s, 0.105 * s, 0.095 * s).moved(0, 0, 0.905 * s),
    )
    assembly.add(
        paint((0.06, 0.07, 0.09), 0.8),
        ball(1.0, 9, 7)
        .scaled(0.06 * s, 0.08 * s, 0.055 * s)
        .moved(0.055 * s, 0, 0.91 * s),
    )
    for side in (-1, 1):
        assembly.add(
            glow((0.3, 0.85, 1.0), 0.9),
            ball(0.016 * s, 6, 5).moved(0.105 * s, side * 0.034 * s, 0.915 * s),
        )
    return assembly


def sculpture(order: Order) -> Assembly:
    """Build an abstract work on a low base: a rising spiral or folded sheets."""
    assembly = Assembly()
    base = 0.1 * order.height
    assembly.include(plinth(order, base, shade(STONE, 0.6)))
    tall = order.height - base
    reach = min(order.length, order.depth) * 0.4
    material = metal(order.colour((0.75, 0.76, 0.78)))
    words = f"{order.category} {order.name or ''}".lower()
    if "spiral" in words or (order.variant % 2 == 0 and "fold" not in words):
        for start in (0.0, math.pi):
            path = [
                (
                    reach * (1 - 0.75 * t) * math.cos(start + 9 * t),
                    reach * (1 - 0.75 * t) * math.sin(start + 9 * t),
                    base + 0.04 + (tall - 0.08) * t,
                )
                for t in (step / 30 for step in range(31))
            ]
            assembly.add(
                material,
                limb(path, [0.055 - 0.03 * step / 30 for step in range(31)], 8),
            )
        assembly.add(
            material,
            ball(0.16 * reach + 0.04, 12, 9).moved(
                0, 0, order.height - 0.16 * reach - 0.04
            ),
        )
        return assembly
    for fold in range(5):
        low, high = base + tall * fold / 5.4, base + tall * min(1.0, (fold + 1.5) / 5.4)
        wide = reach * (1.1 - 0.16 * fold)
        sheet = lofted([
            _rectangle(wide, 0.05, low),
            _rectangle(0.05, wide * 0.9, (low + high) / 2),
            _rectangle(wide * 0.8, 0.04, high),
        ])
        assembly.add(material, sheet.turned("z", 37.0 * fold))
    return assembly


def _rectangle(half_x: float, half_y: float, z: float) -> Floats:
    return ring((0, 0, z), half_x, half_y, 8)
