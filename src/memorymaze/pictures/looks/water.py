"""Tanks and what dives."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, mixed, shade
from memorymaze.pictures.looks.paints import glass, metal, paint, picture
from memorymaze.pictures.looks.primitives import (
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.pictures.looks.tubes import limb, tube

DARK: Rgb = (0.13, 0.14, 0.16)
STEEL: Rgb = (0.66, 0.68, 0.7)
SEA: Rgb = (0.1, 0.4, 0.62)


def wave_tank(order: Order) -> Assembly:
    """Build a long glass tank on legs with a wave in it and a paddle with a handle."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    deck, top = order.height * 0.42, order.height - 0.1
    frame = metal(shade(STEEL, 0.7))
    for x in (back, front - 0.04):
        for y in (left, right - 0.04):
            assembly.add(frame, box((x, x + 0.04), (y, y + 0.04), (0, top)))
        for z in (deck - 0.06, top - 0.03):
            assembly.add(frame, box((x, x + 0.04), (left, right), (z, z + 0.05)))
    for y in (left, right - 0.04):
        assembly.add(frame, box((back, front), (y, y + 0.04), (top - 0.03, top + 0.02)))
    assembly.add(frame, box((back, front), (left, right), (deck - 0.05, deck)))
    level = deck + 0.5 * (top - deck)
    long_way = order.length - 0.1
    outline = [(left + 0.05, deck), (right - 0.05, deck)]
    steps = 24
    for step in range(steps + 1):
        share = step / steps
        swing = math.sin(2.5 * math.tau * share) * math.exp(-2.0 * share)
        outline.append((
            right - 0.05 - long_way * share,
            level + 0.3 * (top - deck) * swing,
        ))
    water = mixed(order.colour(SEA), (0.55, 0.8, 0.95), 0.5)
    assembly.add(paint(water, 0.7), extruded(outline, (back + 0.05, front - 0.05), "x"))
    assembly.add(
        glass(alpha=0.22),
        box((front - 0.03, front - 0.02), (left + 0.04, right - 0.04), (deck, top)),
    )
    paddle = right - 0.25
    assembly.add(
        paint((0.9, 0.75, 0.1)),
        box(
            (back + 0.06, front - 0.06),
            (paddle - 0.02, paddle + 0.02),
            (deck + 0.05, top + 0.04),
        ),
        tube([(0, paddle, top), (0, paddle - 0.3, order.height - 0.02)], 0.025, 6),
    )
    if order.text:
        wide, tall = order.length * 0.6, 0.2
        pixels = sign_board(wide, tall, order.text, (0.1, 0.25, 0.45))
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.02, front),
                (-wide / 2, wide / 2),
                (deck - 0.04 - tall, deck - 0.04),
            ),
        )
    return assembly


def submersible(order: Order) -> Assembly:
    """Build a deep-sea vessel from its side: a hull, a bubble, a screw, arms, words."""
    assembly = Assembly()
    low = 0.14 * order.height
    half = order.length / 2
    deep = order.depth / 2
    tall = order.height - low
    r = 0.4 * tall
    middle = low + r
    hull = paint(order.colour((0.96, 0.79, 0.13)), 0.4)
    profile = [
        (0, -0.72 * half),
        (r * 0.5, -0.7 * half),
        (r * 0.85, -0.58 * half),
        (r, -0.4 * half),
        (r, 0.35 * half),
        (r * 0.8, 0.62 * half),
        (r * 0.4, 0.84 * half),
        (r * 0.15, 0.9 * half),
    ]
    body = lathed(profile, 18).turned("x", -90).scaled(deep * 0.86 / r, 1, 1)
    assembly.add(hull, body.moved(z=middle))
    tower = box(
        (-deep * 0.4, deep * 0.4),
        (-0.25 * half, 0.25 * half),
        (middle + 0.7 * r, order.height),
        0.08,
    )
    assembly.add(paint((0.9, 0.25, 0.15), 0.3), tower)
    nose = -0.6 * half
    assembly.add(
        paint((0.1, 0.25, 0.4), 0.95), ball(r * 0.55, 12, 9).moved(0, nose, middle)
    )
    for side in (-1, 1):
        port = cylinder(r * 0.24, (0, 0.05), 9).turned("y", 90 * side)
        pane = cylinder(r * 0.18, (0, 0.06), 8).turned("y", 90 * side)
        for y in (-0.36, -0.12):
            x = side * deep * 0.82
            assembly.add(metal(STEEL), port.moved(x, y * half, middle + 0.2 * r))
            assembly.add(
                paint((0.1, 0.2, 0.35), 0.9), pane.moved(x, y * half, middle + 0.2 * r)
            )
        assembly.add(
            paint(shade(order.colour((0.96, 0.79, 0.13)), 0.8)),
            box(
                (side * deep * 0.55 - 0.12, side * deep * 0.55 + 0.12),
                (-0.5 * half, 0.5 * half),
                (0, 0.1),
            ),
        )
        for y in (-0.35, 0.35):
            assembly.add(
                metal(DARK),
                tube(
                    [
                        (side * deep * 0.55, y * half, 0.08),
                        (side * deep * 0.4, y * half, low + 0.3 * r),
                    ],
                    0.05,
                    6,
                ),
            )
        arm = [
            (side * deep * 0.5, -0.5 * half, middle - 0.6 * r),
            (side * deep * 0.6, -0.82 * half, middle - 0.7 * r),
            (side * deep * 0.3, -half * 0.98, middle - 0.5 * r),
        ]
        assembly.add(metal(STEEL), limb(arm, 0.05, 5))
        assembly.add(
            metal((0.9, 0.9, 0.8)),
            ball(0.1, 7, 5).moved(side * deep * 0.45, -0.66 * half, middle + 0.6 * r),
        )
        fin = box(
            (side * deep * 0.5 - 0.3, side * deep * 0.5 + 0.3),
            (0.55 * half, 0.8 * half),
            (middle - 0.03, middle + 0.03),
            0.02,
        )
        assembly.add(hull, fin)
    assembly.add(
        hull,
        box(
            (-0.04, 0.04),
            (0.5 * half, 0.85 * half),
            (middle - r * 0.8, middle + r * 1.1),
            0.03,
        ),
    )
    hub = 0.93 * half
    assembly.add(metal((0.72, 0.55, 0.28)), ball(0.1, 7, 5).moved(0, hub, middle))
    for blade in range(3):
        shape = box((-0.07, 0.07), (-0.02, 0.02), (0.05, 0.55 * r), 0.02).turned(
            "y", 120.0 * blade
        )
        assembly.add(metal((0.72, 0.55, 0.28)), shape.moved(0, hub, middle))
    guard = lathed(
        [(r * 0.62, -0.1), (r * 0.66, -0.1), (r * 0.66, 0.1), (r * 0.62, 0.1)], 20
    ).turned("x", 90)
    assembly.add(paint(DARK, 0.3), guard.moved(0, half - 0.1, middle))
    if order.text:
        wide, high = 0.62 * half, 0.5 * r
        pixels = sign_board(wide, high, order.text, (0.12, 0.12, 0.2))
        assembly.add(
            picture(pixels),
            plate(
                (0, deep * 0.93),
                (0.02 * half, 0.02 * half + wide),
                (middle - 0.35 * r, middle - 0.35 * r + high),
            ),
        )
    return assembly
