"""People, statues, robots and sculptures."""

import math
from dataclasses import dataclass

from memorymaze.geometry.points import FloatArray
from memorymaze.pictures.looks.assembly import Assembly, Order, built, plinth
from memorymaze.pictures.looks.materials import (
    STONE,
    Material,
    Rgb,
    glow,
    metal,
    paint,
    shade,
)
from memorymaze.pictures.looks.shapes import (
    around,
    ball,
    box,
    ellipsoid,
)
from memorymaze.pictures.looks.tubes import Point3, ellipse_ring, limb, lofted

SKINS: tuple[Rgb, ...] = (
    (0.92, 0.74, 0.62),
    (0.78, 0.57, 0.42),
    (0.5, 0.33, 0.22),
    (0.86, 0.66, 0.5),
)
SHIRTS: tuple[Rgb, ...] = (
    (0.2, 0.35, 0.6),
    (0.7, 0.2, 0.2),
    (0.85, 0.85, 0.82),
    (0.25, 0.45, 0.3),
    (0.85, 0.65, 0.2),
    (0.35, 0.3, 0.45),
)
TROUSERS: tuple[Rgb, ...] = ((0.15, 0.18, 0.28), (0.2, 0.2, 0.2), (0.5, 0.42, 0.32))
HAIRS: tuple[Rgb, ...] = (
    (0.1, 0.07, 0.05),
    (0.35, 0.2, 0.1),
    (0.6, 0.45, 0.25),
    (0.5, 0.5, 0.5),
)


@dataclass(frozen=True, slots=True)
class Clothes:
    """What each part of a body is made of."""

    skin: Material
    shirt: Material
    trousers: Material
    shoes: Material
    hair: Material

    @classmethod
    def all_of(cls, material: Material) -> "Clothes":
        """Return a body of one material, as statues are."""
        return cls(material, material, material, material, material)


def walker(
    made: Assembly,
    height: float,
    clothes: Clothes,
    *,
    stride: float = 0.0,
    raised_arm: bool = False,
) -> None:
    """Build a person who faces +x.

    The stride is the angle of the left thigh forward of upright, radians; the other
    limbs swing to match. A raised arm is the right one and points up and ahead.
    """
    s = height
    hip, knee_length, shin = 0.515 * s, 0.235 * s, 0.225 * s
    for side in (-1, 1):
        swing = side * stride
        bend = 0.15 * abs(stride) + (0.9 * stride if swing < 0 else 0.0)
        y = side * 0.052 * s
        knee = (knee_length * math.sin(swing), y, hip - knee_length * math.cos(swing))
        back = swing - abs(bend)
        ankle = (knee[0] + shin * math.sin(back), y, knee[2] - shin * math.cos(back))
        made.limb(
            clothes.trousers,
            [(0, y, hip), knee, ankle],
            [0.056 * s, 0.042 * s, 0.03 * s],
            8,
        )
        foot = limb(
            [
                (ankle[0] - 0.01 * s, y, ankle[2] - 0.025 * s),
                (ankle[0] + 0.085 * s, y * 1.2, ankle[2] - 0.032 * s),
            ],
            [0.026 * s, 0.022 * s],
            7,
        )
        made.add(clothes.shoes, foot)
        shoulder: Point3 = (0.0, side * 0.115 * s, 0.8 * s)
        reach = -swing * 0.8 + 0.06
        if raised_arm and side < 0:
            elbow: Point3 = (0.09 * s, side * 0.16 * s, 0.86 * s)
            hand: Point3 = (0.19 * s, side * 0.15 * s, 1.0 * s)
        else:
            elbow = (
                0.16 * s * math.sin(reach) - 0.01 * s,
                side * 0.145 * s,
                0.8 * s - 0.16 * s * math.cos(reach),
            )
            forward = reach + 0.25 + 0.3 * abs(stride)
            hand = (
                elbow[0] + 0.15 * s * math.sin(forward),
                side * 0.14 * s,
                elbow[2] - 0.15 * s * math.cos(forward),
            )
        made.limb(
            clothes.shirt, [shoulder, elbow, hand], [0.036 * s, 0.03 * s, 0.022 * s], 7
        )
        made.ball(clothes.skin, 0.028 * s, 8, 6, at=hand)
    torso = [
        ellipse_ring((0, 0, 0.47 * s), 0.05 * s, 0.085 * s),
        ellipse_ring((0, 0, 0.53 * s), 0.066 * s, 0.098 * s),
        ellipse_ring((0, 0, 0.62 * s), 0.058 * s, 0.086 * s),
        ellipse_ring((0.005 * s, 0, 0.72 * s), 0.068 * s, 0.105 * s),
        ellipse_ring((0, 0, 0.79 * s), 0.06 * s, 0.118 * s),
        ellipse_ring((0, 0, 0.83 * s), 0.035 * s, 0.075 * s),
    ]
    made.add(clothes.trousers, lofted(torso[:2], round_ends=True))
    made.add(
        clothes.shirt,
        lofted([torso[1].copy() * (1.02, 1.02, 1.0), *torso[2:]], round_ends=True),
    )
    made.cylinder(clothes.skin, 0.03 * s, (0.81 * s, 0.88 * s), 9)
    head = ellipsoid(
        (0.008 * s, 0, 0.925 * s), (0.056 * s, 0.047 * s, 0.066 * s), 12, 9
    )
    made.add(clothes.skin, head, ball(0.012 * s, 6, 4).moved(0.064 * s, 0, 0.918 * s))
    hair = ellipsoid(
        (-0.008 * s, 0, 0.936 * s), (0.058 * s, 0.053 * s, 0.064 * s), 12, 8
    )
    made.add(clothes.hair, hair)


def person(made: Assembly, order: Order) -> None:
    """Build a clothed person, standing or in the middle of a step."""
    v = order.variant
    clothes = Clothes(
        paint(SKINS[v % 4], 0.05),
        paint(order.colour(SHIRTS[v % 6]), 0.02),
        paint(TROUSERS[v % 3], 0.02),
        paint((0.1, 0.09, 0.09)),
        paint(HAIRS[(v // 2) % 4], 0.05),
    )
    stride = 0.5 if "walk" in order.category or order.depth > 0.5 else 0.0
    walker(made, order.height, clothes, stride=stride)


def space_suit(made: Assembly, order: Order) -> None:
    """Build an astronaut's suit: a helmet with a gold visor, thick limbs, a backpack."""
    base = 0.24
    plinth(made, order, base, (0.3, 0.32, 0.36))
    s = order.height - base
    cloth = paint(order.colour((0.92, 0.92, 0.9)), 0.1)
    dark, red = paint((0.35, 0.36, 0.4)), paint((0.75, 0.15, 0.12))
    for side in (-1, 1):
        y = side * 0.1 * s
        made.limb(
            cloth,
            [(0, y, 0.46 * s), (0.02 * s, y * 1.2, 0.25 * s), (0.0, y * 1.2, 0.09 * s)],
            [0.095 * s, 0.085 * s, 0.075 * s],
            10,
        )
        made.limb(
            dark,
            [(-0.02 * s, y * 1.2, 0.045 * s), (0.09 * s, y * 1.3, 0.04 * s)],
            0.045 * s,
            8,
        )
        made.limb(
            cloth,
            [
                (0, side * 0.19 * s, 0.74 * s),
                (0.02 * s, side * 0.27 * s, 0.57 * s),
                (0.09 * s, side * 0.27 * s, 0.43 * s),
            ],
            [0.075 * s, 0.068 * s, 0.055 * s],
            9,
        )
        made.cylinder(
            red, 0.066 * s, (0, 0.03 * s), 10, at=(0.055 * s, side * 0.27 * s, 0.46 * s)
        )
        made.ball(dark, 0.05 * s, 8, 6, at=(0.11 * s, side * 0.27 * s, 0.39 * s))
    made.add(
        cloth,
        lofted(
            [
                ellipse_ring((0, 0, 0.42 * s), 0.11 * s, 0.16 * s),
                ellipse_ring((0, 0, 0.5 * s), 0.13 * s, 0.18 * s),
                ellipse_ring((0, 0, 0.68 * s), 0.14 * s, 0.2 * s),
                ellipse_ring((0, 0, 0.8 * s), 0.1 * s, 0.14 * s),
            ],
            round_ends=True,
        ),
    )
    made.box(
        paint((0.8, 0.8, 0.78)),
        (-0.26 * s, -0.1 * s),
        around(0, 0.17 * s),
        (0.46 * s, 0.84 * s),
        0.03,
    )
    made.box(dark, (0.1 * s, 0.16 * s), around(0, 0.09 * s), (0.58 * s, 0.7 * s), 0.01)
    made.box(red, (0.15 * s, 0.165 * s), (-0.06 * s, -0.02 * s), (0.62 * s, 0.66 * s))
    helmet = ball(0.135 * s, 13, 9).moved(0, 0, 0.87 * s)
    visor = ellipsoid((0.06 * s, 0, 0.875 * s), (0.09 * s, 0.105 * s, 0.09 * s), 11, 8)
    made.add(cloth, helmet)
    made.add(metal((0.82, 0.6, 0.18)), visor)


def statue(made: Assembly, order: Order) -> None:
    """Build a person of bronze or stone on a plinth, an arm raised to the sky."""
    foot = 0.28 * order.height
    plinth(made, order, foot)
    material = paint(order.colour((0.45, 0.36, 0.25)), 0.35)
    figure = built(
        walker,
        (order.height - foot) * 0.97,
        Clothes.all_of(material),
        stride=0.18,
        raised_arm=order.variant % 2 == 0,
    )
    tall = order.height - foot
    robe = lofted([
        ellipse_ring((0, 0, 0.12 * tall), 0.13 * tall, 0.14 * tall),
        ellipse_ring((0, 0, 0.35 * tall), 0.1 * tall, 0.115 * tall),
        ellipse_ring((0, 0, 0.55 * tall), 0.072 * tall, 0.1 * tall),
    ])
    figure.add(material, robe)
    made.include(figure, z=foot)


def bust(made: Assembly, order: Order) -> None:
    """Build a head and shoulders on a tall pedestal with its words."""
    foot = 0.64 * order.height
    narrow = Order(
        order.category, order.length * 0.8, order.depth * 0.8, foot, None, order.text
    )
    plinth(made, narrow, foot)
    made.add(
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
            ellipse_ring((0, 0, 0.0), 0.12 * tall, 0.16 * tall, 14),
            ellipse_ring((0, 0, 0.12 * tall), 0.15 * tall, 0.24 * tall, 14),
            ellipse_ring((0, 0, 0.3 * tall), 0.2 * tall, 0.4 * tall, 14),
            ellipse_ring((0, 0, 0.42 * tall), 0.14 * tall, 0.3 * tall, 14),
            ellipse_ring((0, 0, 0.48 * tall), 0.09 * tall, 0.1 * tall, 14),
            ellipse_ring((0.01, 0, 0.58 * tall), 0.085 * tall, 0.085 * tall, 14),
        ],
        round_ends=True,
    )
    head = ellipsoid(
        (0.03 * tall, 0, 0.76 * tall), (0.17 * tall, 0.14 * tall, 0.2 * tall), 16, 12
    )
    nose = limb(
        [(0.19 * tall, 0, 0.79 * tall), (0.215 * tall, 0, 0.72 * tall)], 0.022 * tall, 6
    )
    hair = ellipsoid(
        (-0.015 * tall, 0, 0.82 * tall),
        (0.175 * tall, 0.155 * tall, 0.18 * tall),
        14,
        10,
    )
    beard = ellipsoid(
        (0.12 * tall, 0, 0.6 * tall), (0.08 * tall, 0.09 * tall, 0.1 * tall), 10, 8
    )
    shift = foot + 0.04
    made.add(
        material, *(shape.moved(z=shift) for shape in (body, head, nose, hair, beard))
    )


def robot(made: Assembly, order: Order) -> None:
    """Build a humanoid robot with joints and lit eyes on a stage."""
    base = 0.18 * order.height
    plinth(made, order, base, (0.22, 0.25, 0.3))
    s = order.height - base
    shell = paint(order.colour((0.93, 0.93, 0.94)), 0.4)
    joint = paint((0.2, 0.21, 0.24), 0.3)
    for side in (-1, 1):
        y = side * 0.085 * s
        made.add(
            shell,
            limb([(0, y, 0.4 * s), (0.02 * s, y, 0.3 * s)], [0.06 * s, 0.055 * s], 8),
            limb([(0.02 * s, y, 0.2 * s), (0, y, 0.08 * s)], [0.052 * s, 0.045 * s], 8),
        )
        made.add(
            joint,
            ball(0.05 * s, 6, 5).moved(0.02 * s, y, 0.245 * s),
            ball(0.055 * s, 6, 5).moved(0, y, 0.46 * s),
        )
        made.box(
            shell, (-0.07 * s, 0.12 * s), around(y, 0.055 * s), (0, 0.06 * s), 0.02
        )
        out = side * 0.21 * s
        lift = 0.12 * s if side < 0 else 0.0
        hand = (0.2 * s, out, 0.5 * s + 3.2 * lift)
        elbow = (0.05 * s, out * 1.15, 0.55 * s)
        made.add(
            joint,
            ball(0.058 * s, 6, 5).moved(0, side * 0.17 * s, 0.74 * s),
            ball(0.042 * s, 6, 5).moved(*elbow),
            ball(0.04 * s, 6, 5).moved(*hand),
        )
        made.add(
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
    made.add(
        shell,
        lofted(
            [
                ellipse_ring((0, 0, 0.46 * s), 0.07 * s, 0.1 * s),
                ellipse_ring((0, 0, 0.54 * s), 0.09 * s, 0.11 * s),
                ellipse_ring((0.01 * s, 0, 0.7 * s), 0.12 * s, 0.16 * s),
                ellipse_ring((0, 0, 0.78 * s), 0.07 * s, 0.11 * s),
            ],
            round_ends=True,
        ),
    )
    made.cylinder(
        glow((0.2, 0.7, 0.95), 0.8),
        0.03 * s,
        (0, 0.02 * s),
        12,
        along="x",
        at=(0.115 * s, 0, 0.69 * s),
    )
    made.cylinder(joint, 0.035 * s, (0.76 * s, 0.84 * s), 9)
    made.add(
        shell, ellipsoid((0, 0, 0.905 * s), (0.1 * s, 0.105 * s, 0.095 * s), 11, 8)
    )
    made.add(
        paint((0.06, 0.07, 0.09), 0.8),
        ellipsoid((0.055 * s, 0, 0.91 * s), (0.06 * s, 0.08 * s, 0.055 * s), 9, 7),
    )
    for side in (-1, 1):
        made.ball(
            glow((0.3, 0.85, 1.0), 0.9),
            0.016 * s,
            6,
            5,
            at=(0.105 * s, side * 0.034 * s, 0.915 * s),
        )


def sculpture(made: Assembly, order: Order) -> None:
    """Build an abstract work on a low base: a rising spiral or folded sheets."""
    base = 0.1 * order.height
    plinth(made, order, base, shade(STONE, 0.6))
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
            made.limb(
                material, path, [0.055 - 0.03 * step / 30 for step in range(31)], 8
            )
        made.ball(
            material,
            0.16 * reach + 0.04,
            12,
            9,
            at=(0, 0, order.height - 0.16 * reach - 0.04),
        )
        return
    for fold in range(5):
        low, high = base + tall * fold / 5.4, base + tall * min(1.0, (fold + 1.5) / 5.4)
        wide = reach * (1.1 - 0.16 * fold)
        sheet = lofted([
            _rectangle(wide, 0.05, low),
            _rectangle(0.05, wide * 0.9, (low + high) / 2),
            _rectangle(wide * 0.8, 0.04, high),
        ])
        made.add(material, sheet.turned("z", 37.0 * fold))


def _rectangle(half_x: float, half_y: float, z: float) -> FloatArray:
    return ellipse_ring((0, 0, z), half_x, half_y, 8)
