"""Rockets, engines, station modules."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.captions import plinth
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import metal, paint, picture
from memorymaze.pictures.looks.primitives import (
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.pictures.looks.tubes import tube

WHITE: Rgb = (0.93, 0.93, 0.93)
STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.14, 0.14, 0.16)
RED: Rgb = (0.78, 0.15, 0.12)


def rocket(order: Order) -> Assembly:
    """Build a model of a launcher with boosters and fins on a base."""
    assembly = Assembly()
    base = 0.16 * order.height
    assembly.include(plinth(order, base, (0.25, 0.27, 0.32)))
    tall = order.height - base - 0.03
    r = min(0.11 * tall, min(order.length, order.depth) * 0.2)
    low = base + 0.03
    body = paint(order.colour(WHITE), 0.4)
    nose = [
        (r, low + 0.74 * tall),
        (r * 0.9, low + 0.84 * tall),
        (r * 0.55, low + 0.94 * tall),
        (0, low + tall),
    ]
    assembly.add(body, lathed([(r, low + 0.07 * tall), *nose], 18))
    for z, tone in ((0.36, DARK), (0.62, RED), (0.72, DARK)):
        assembly.add(
            paint(tone, 0.3),
            cylinder(r * 1.015, (low + z * tall, low + (z + 0.03) * tall), 18),
        )
    flame = metal((0.35, 0.33, 0.32))
    assembly.add(flame, lathed([(r * 0.75, low), (r * 0.35, low + 0.08 * tall)], 14))
    for place in range(4):
        a = math.pi / 4 + place * math.pi / 2
        x, y = 1.55 * r * math.cos(a), 1.55 * r * math.sin(a)
        booster = lathed(
            [
                (r * 0.5, low + 0.04 * tall),
                (r * 0.5, low + 0.36 * tall),
                (0, low + 0.47 * tall),
            ],
            12,
        )
        assembly.add(body, booster.moved(x, y))
        assembly.add(
            flame,
            lathed([(r * 0.42, low), (r * 0.22, low + 0.05 * tall)], 10).moved(x, y),
        )
        fin = extruded(
            [
                (0.9 * r, low + 0.05 * tall),
                (2.1 * r, low),
                (2.1 * r, low + 0.07 * tall),
                (0.9 * r, low + 0.22 * tall),
            ],
            (-0.012, 0.012),
            "y",
        )
        assembly.add(paint(RED, 0.3), fin.turned("z", 90.0 * place))
    return assembly


def rocket_engine(order: Order) -> Assembly:
    """Build a rocket engine, its bell down, in a frame with its words."""
    assembly = Assembly()
    base = 0.12 * order.height
    assembly.include(plinth(order, base, (0.25, 0.27, 0.32)))
    tall = order.height - base
    r = min(order.length, order.depth) * 0.42
    low = base + 0.04
    bell = metal(order.colour(STEEL))
    wall = [
        (r, low),
        (r * 0.88, low + 0.12 * tall),
        (r * 0.66, low + 0.28 * tall),
        (r * 0.36, low + 0.44 * tall),
        (r * 0.2, low + 0.5 * tall),
        (r * 0.32, low + 0.56 * tall),
        (r * 0.36, low + 0.66 * tall),
        (r * 0.3, low + 0.7 * tall),
    ]
    assembly.add(bell, lathed(wall, 22))
    for z, out in ((0.02, 1.0), (0.12, 0.9), (0.21, 0.78), (0.3, 0.64), (0.38, 0.5)):
        hoop = lathed(
            [
                (r * out * 0.98, low + z * tall),
                (r * out + 0.02, low + z * tall),
                (r * out + 0.02, low + (z + 0.015) * tall),
                (r * out * 0.98, low + (z + 0.015) * tall),
            ],
            15,
        )
        assembly.add(metal((0.45, 0.4, 0.36)), hoop)
    copper = metal((0.72, 0.43, 0.28))
    top = low + 0.7 * tall
    for place in range(3):
        a = math.tau * place / 3 + 0.5
        x, y = 0.5 * r * math.cos(a), 0.5 * r * math.sin(a)
        assembly.add(
            metal(shade(STEEL, 0.7)),
            cylinder(0.16 * r, (top - 0.2 * tall, top + 0.05 * tall), 10).moved(x, y),
        )
        assembly.add(
            copper,
            tube(
                [
                    (x, y, top - 0.18 * tall),
                    (x * 1.5, y * 1.5, top - 0.3 * tall),
                    (x * 1.3, y * 1.3, low + 0.3 * tall),
                ],
                0.045 * r + 0.012,
                6,
            ),
        )
        assembly.add(
            copper,
            tube(
                [(x, y, top + 0.02 * tall), (0, 0, top + 0.1 * tall)],
                0.05 * r + 0.01,
                6,
            ),
        )
    assembly.add(
        metal(STEEL),
        cylinder(r * 0.22, (top, order.height - 0.06), 14),
        box(
            (-r * 0.5, r * 0.5),
            (-r * 0.5, r * 0.5),
            (order.height - 0.06, order.height),
        ),
    )
    for x in (-1, 1):
        for y in (-1, 1):
            foot = (x * order.depth * 0.46, y * order.length * 0.46, base)
            assembly.add(
                paint((0.2, 0.3, 0.5)),
                tube(
                    [foot, (x * r * 0.45, y * r * 0.45, order.height - 0.03)], 0.03, 6
                ),
            )
    return assembly


def space_station_module(order: Order) -> Assembly:
    """Build a white cylinder on cradles: hatches, ribs, windows, its words."""
    assembly = Assembly()
    low = 0.1 * order.height
    r = (order.height - low) / 2
    middle = low + r
    half = order.length / 2
    skin = paint(order.colour(WHITE), 0.2)
    profile = [
        (r * 0.5, -half),
        (r * 0.52, -half * 0.9),
        (r * 0.92, -half * 0.8),
        (r, -half * 0.76),
        (r, half * 0.76),
        (r * 0.92, half * 0.8),
        (r * 0.52, half * 0.9),
        (r * 0.5, half),
    ]
    flat = order.depth / (2 * r)
    cylinder_ = lathed(profile, 22).turned("x", 90).scaled(flat, 1, 1).moved(z=middle)
    assembly.add(skin, cylinder_)
    rib = paint((0.72, 0.73, 0.75), 0.2)
    for place in range(3):
        y = half * (-0.74 + 0.74 * place)
        hoop = lathed(
            [(r * 0.99, -0.03), (r * 1.02, -0.03), (r * 1.02, 0.03), (r * 0.99, 0.03)],
            28,
        )
        assembly.add(rib, hoop.turned("x", 90).scaled(flat, 1, 1).moved(0, y, middle))
    for side in (-1, 1):
        hatch = lathed([(r * 0.42, 0), (r * 0.42, 0.02)], 18).turned("x", 90)
        assembly.add(
            paint((0.3, 0.32, 0.36)),
            hatch.moved(0, side * (half - 0.005) + 0.01, middle),
        )
    front = order.depth / 2
    for side in (-1, 1):
        y = side * half * 0.52
        port = (
            cylinder(r * 0.24, (0, 0.03), 20)
            .turned("y", 90)
            .moved(front * 0.955, y, middle + 0.28 * r)
        )
        assembly.add(paint((0.35, 0.37, 0.4), 0.4), port)
        pane = (
            cylinder(r * 0.19, (0, 0.035), 18)
            .turned("y", 90)
            .moved(front * 0.96, y, middle + 0.28 * r)
        )
        assembly.add(paint((0.06, 0.12, 0.3), 0.9), pane)
        rail = [
            (front * 0.92, y - 0.3, middle - 0.3 * r),
            (front * 1.01, y - 0.3, middle - 0.3 * r),
            (front * 1.01, y + 0.3, middle - 0.3 * r),
            (front * 0.92, y + 0.3, middle - 0.3 * r),
        ]
        assembly.add(paint((0.9, 0.75, 0.1)), tube(rail, 0.016, 5))
    door = 0.26 * half
    assembly.add(
        paint((0.25, 0.27, 0.3)),
        box((0, front * 0.93), (-door, door), (low * 0.9, middle + 0.5 * r), 0.05),
    )
    if order.text:
        wide, tall = order.length * 0.5, 0.3 * r
        pixels = sign_board(wide, tall, order.text, (0.1, 0.2, 0.45))
        assembly.add(
            picture(pixels),
            plate(
                (0, front * 0.9),
                (-wide / 2, wide / 2),
                (middle + 0.56 * r, middle + 0.56 * r + tall),
            ),
        )
    for y in (-half * 0.55, half * 0.55):
        cradle = [
            (-front * 0.8, 0),
            (front * 0.8, 0),
            (front * 0.8, low * 1.8),
            (front * 0.45, low * 1.2),
            (-front * 0.45, low * 1.2),
            (-front * 0.8, low * 1.8),
        ]
        assembly.add(
            paint((0.3, 0.3, 0.33)), extruded(cradle, (y - 0.06, y + 0.06), "y")
        )
    return assembly
