"""Instruments that stand out of doors or look there."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import metal, paint, picture
from memorymaze.pictures.looks.primitives import (
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.pictures.looks.tubes import tube

STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.13, 0.13, 0.15)
WHITE: Rgb = (0.93, 0.93, 0.93)


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


def telescope(order: Order) -> Assembly:
    """Build a telescope on a tripod, or a coin-operated one on a pillar."""
    assembly = Assembly()
    reach = min(order.length, order.depth) / 2
    body = paint(order.colour(WHITE), 0.5)
    dark = paint(DARK)
    pivot = order.height * 0.72
    words = order.text
    if words:
        assembly.add(
            metal((0.5, 0.52, 0.55)),
            lathed(
                [
                    (reach * 0.8, 0),
                    (reach * 0.8, 0.03),
                    (0.07, 0.05),
                    (0.055, pivot - 0.1),
                ],
                14,
            ),
        )
        box_low = pivot - 0.34
        assembly.add(
            body, box((-0.1, 0.1), (-0.13, 0.13), (box_low, pivot - 0.02), 0.03)
        )
        pixels = sign_board(0.24, 0.2, words, (0.12, 0.2, 0.4))
        assembly.add(
            picture(pixels),
            plate((0.08, 0.115), (-0.12, 0.12), (box_low + 0.04, box_low + 0.26)),
        )
    else:
        for place in range(3):
            a = math.tau * place / 3 + math.pi
            assembly.add(
                paint((0.45, 0.3, 0.18)),
                tube(
                    [
                        (reach * 0.96 * math.cos(a), reach * 0.96 * math.sin(a), 0.0),
                        (0, 0, pivot - 0.04),
                    ],
                    0.022,
                    6,
                ),
            )
        assembly.add(dark, cylinder(0.05, (pivot - 0.1, pivot), 10))
    length = min(2.2 * reach, 1.0)
    barrel = lathed(
        [
            (0.03, -0.55 * length),
            (0.035, -0.42 * length),
            (0.05, -0.4 * length),
            (0.055, 0.2 * length),
            (0.085, 0.22 * length),
            (0.09, 0.55 * length),
            (0.075, 0.55 * length),
            (0.07, 0.5 * length),
            (0, 0.5 * length),
        ],
        16,
    )
    assembly.add(body, barrel.turned("y", 62).moved(0, 0, pivot + 0.1))
    eye = lathed([(0.036, -0.56 * length), (0.036, -0.44 * length)], 12).turned("y", 62)
    lens = lathed([(0.07, 0.505 * length), (0.0, 0.52 * length)], 14).turned("y", 62)
    assembly.add(dark, eye.moved(0, 0, pivot + 0.1))
    assembly.add(paint((0.15, 0.3, 0.5), 0.9), lens.moved(0, 0, pivot + 0.1))
    assembly.add(dark, ball(0.05, 10, 8).moved(0, 0, pivot + 0.04))
    finder = lathed([(0.014, -0.15 * length), (0.018, 0.15 * length)], 8).turned(
        "y", 62
    )
    assembly.add(dark, finder.moved(-0.06, 0, pivot + 0.1 + 0.11))
    return assembly
