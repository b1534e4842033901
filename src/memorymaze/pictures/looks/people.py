"""Human forms that move: people, space suits."""

import math
from dataclasses import dataclass

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.captions import plinth
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, paint
from memorymaze.pictures.looks.primitives import ball, box, cylinder
from memorymaze.pictures.looks.tubes import Point3, limb, lofted, ring

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
    height: float, clothes: Clothes, *, stride: float = 0.0, raised_arm: bool = False
) -> Assembly:
    """Build a person who faces +x.

    Args:
        height: Metres.
        clothes: Materials.
        stride: Angle of the left thigh forward of upright, radians; the other limbs
            swing to match. 0 stands.
        raised_arm: The right arm points up and ahead.
    """
    assembly = Assembly()
    s = height
    hip, knee_length, shin = 0.515 * s, 0.235 * s, 0.225 * s
    for side in (-1, 1):
        swing = side * stride
        bend = 0.15 * abs(stride) + (0.9 * stride if swing < 0 else 0.0)
        y = side * 0.052 * s
        knee = (knee_length * math.sin(swing), y, hip - knee_length * math.cos(swing))
        back = swing - abs(bend)
        ankle = (knee[0] + shin * math.sin(back), y, knee[2] - shin * math.cos(back))
        assembly.add(
            clothes.trousers,
            limb([(0, y, hip), knee, ankle], [0.056 * s, 0.042 * s, 0.03 * s], 8),
        )
        foot = limb(
            [
                (ankle[0] - 0.01 * s, y, ankle[2] - 0.025 * s),
                (ankle[0] + 0.085 * s, y * 1.2, ankle[2] - 0.032 * s),
            ],
            [0.026 * s, 0.022 * s],
            7,
        )
        assembly.add(clothes.shoes, foot)
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
        assembly.add(
            clothes.shirt,
            limb([shoulder, elbow, hand], [0.036 * s, 0.03 * s, 0.022 * s], 7),
        )
        assembly.add(clothes.skin, ball(0.028 * s, 8, 6).moved(*hand))
    torso = [
        ring((0, 0, 0.47 * s), 0.05 * s, 0.085 * s),
        ring((0, 0, 0.53 * s), 0.066 * s, 0.098 * s),
        ring((0, 0, 0.62 * s), 0.058 * s, 0.086 * s),
        ring((0.005 * s, 0, 0.72 * s), 0.068 * s, 0.105 * s),
        ring((0, 0, 0.79 * s), 0.06 * s, 0.118 * s),
        ring((0, 0, 0.83 * s), 0.035 * s, 0.075 * s),
    ]
    assembly.add(clothes.trousers, lofted(torso[:2], round_ends=True))
    assembly.add(
        clothes.shirt,
        lofted([torso[1].copy() * (1.02, 1.02, 1.0), *torso[2:]], round_ends=True),
    )
    assembly.add(clothes.skin, cylinder(0.03 * s, (0.81 * s, 0.88 * s), 9))
    head = (
        ball(1.0, 12, 9)
        .scaled(0.056 * s, 0.047 * s, 0.066 * s)
        .moved(0.008 * s, 0, 0.925 * s)
    )
    assembly.add(
        clothes.skin, head, ball(0.012 * s, 6, 4).moved(0.064 * s, 0, 0.918 * s)
    )
    hair = (
        ball(1.0, 12, 8)
        .scaled(0.058 * s, 0.053 * s, 0.064 * s)
        .moved(-0.008 * s, 0, 0.936 * s)
    )
    assembly.add(clothes.hair, hair)
    return assembly


def person(order: Order) -> Assembly:
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
    return walker(order.height, clothes, stride=stride)


def space_suit(order: Order) -> Assembly:
    """Build an astronaut's suit: a helmet with a gold visor, thick limbs, a backpack."""
    assembly = Assembly()
    base = 0.24
    assembly.include(plinth(order, base, (0.3, 0.32, 0.36)))
    s = order.height - base
    cloth = paint(order.colour((0.92, 0.92, 0.9)), 0.1)
    dark, red = paint((0.35, 0.36, 0.4)), paint((0.75, 0.15, 0.12))
    for side in (-1, 1):
        y = side * 0.1 * s
        assembly.add(
            cloth,
            limb(
                [
                    (0, y, 0.46 * s),
                    (0.02 * s, y * 1.2, 0.25 * s),
                    (0.0, y * 1.2, 0.09 * s),
                ],
                [0.095 * s, 0.085 * s, 0.075 * s],
                10,
            ),
        )
        assembly.add(
            dark,
            limb(
                [(-0.02 * s, y * 1.2, 0.045 * s), (0.09 * s, y * 1.3, 0.04 * s)],
                0.045 * s,
                8,
            ),
        )
        assembly.add(
            cloth,
            limb(
                [
                    (0, side * 0.19 * s, 0.74 * s),
                    (0.02 * s, side * 0.27 * s, 0.57 * s),
                    (0.09 * s, side * 0.27 * s, 0.43 * s),
                ],
                [0.075 * s, 0.068 * s, 0.055 * s],
                9,
            ),
        )
        assembly.add(
            red,
            cylinder(0.066 * s, (0, 0.03 * s), 10).moved(
                0.055 * s, side * 0.27 * s, 0.46 * s
            ),
        )
        assembly.add(
            dark, ball(0.05 * s, 8, 6).moved(0.11 * s, side * 0.27 * s, 0.39 * s)
        )
    assembly.add(
        cloth,
        lofted(
            [
                ring((0, 0, 0.42 * s), 0.11 * s, 0.16 * s),
                ring((0, 0, 0.5 * s), 0.13 * s, 0.18 * s),
                ring((0, 0, 0.68 * s), 0.14 * s, 0.2 * s),
                ring((0, 0, 0.8 * s), 0.1 * s, 0.14 * s),
            ],
            round_ends=True,
        ),
    )
    assembly.add(
        paint((0.8, 0.8, 0.78)),
        box((-0.26 * s, -0.1 * s), (-0.17 * s, 0.17 * s), (0.46 * s, 0.84 * s), 0.03),
    )
    assembly.add(
        dark, box((0.1 * s, 0.16 * s), (-0.09 * s, 0.09 * s), (0.58 * s, 0.7 * s), 0.01)
    )
    assembly.add(
        red, box((0.15 * s, 0.165 * s), (-0.06 * s, -0.02 * s), (0.62 * s, 0.66 * s))
    )
    helmet = ball(0.135 * s, 13, 9).moved(0, 0, 0.87 * s)
    visor = (
        ball(1.0, 11, 8)
        .scaled(0.09 * s, 0.105 * s, 0.09 * s)
        .moved(0.06 * s, 0, 0.875 * s)
    )
    assembly.add(cloth, helmet)
    assembly.add(metal((0.82, 0.6, 0.18)), visor)
    return assembly
