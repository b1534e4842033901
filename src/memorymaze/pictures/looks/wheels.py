"""Things that people push: wheelchairs, strollers, trolleys."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, paint, picture
from memorymaze.pictures.looks.primitives import box, cylinder, lathed, plate
from memorymaze.pictures.looks.shape import Shape
from memorymaze.pictures.looks.tubes import Point3, limb, tube

STEEL: Rgb = (0.72, 0.73, 0.75)
DARK: Rgb = (0.09, 0.09, 0.1)


def stroller_rack(order: Order) -> Assembly:
    """Build folded and open push-chairs side by side under a sign."""
    assembly = Assembly()
    count = max(2, round(order.length / 0.5))
    cloths = ((0.85, 0.7, 0.15), (0.2, 0.35, 0.6), (0.65, 0.15, 0.2))
    for place in range(count):
        y = order.y[0] + order.length * (place + 0.5) / count
        one = _stroller(
            order.depth,
            min(0.42, order.length / count - 0.04),
            order.height * 0.96,
            cloths[place % 3],
        )
        assembly.include(one, y=y)
    rail = metal(order.colour(STEEL))
    assembly.add(
        rail,
        tube(
            [
                (order.x[0] + 0.02, order.y[0], 0.3),
                (order.x[0] + 0.02, order.y[1], 0.3),
            ],
            0.018,
            6,
        ),
    )
    if order.text:
        half, tall = order.length * 0.36, 0.24
        pixels = sign_board(
            2 * half, tall, order.text, shade(order.colour(STEEL), 0.35)
        )
        back = order.x[0]
        assembly.add(
            picture(pixels),
            plate(
                (back, back + 0.03), (-half, half), (order.height - tall, order.height)
            ),
        )
        for side in (-1, 1):
            assembly.add(
                rail,
                box(
                    (back, back + 0.02),
                    (side * half * 0.8 - 0.01, side * half * 0.8 + 0.01),
                    (0, order.height - tall),
                ),
            )
    return assembly


def trolley(order: Order) -> Assembly:
    """Build a cart of two shelves on castors with a handle."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    steel = metal(order.colour(STEEL))
    deck = order.height * 0.82
    for x in (back + 0.03, front - 0.03):
        for y in (left + 0.03, right - 0.03):
            assembly.add(steel, tube([(x, y, 0.1), (x, y, deck)], 0.014, 6))
            wheel = (
                cylinder(0.05, (-0.015, 0.015), 10).turned("x", 90).moved(x, y, 0.05)
            )
            assembly.add(paint(DARK), wheel)
    for z in (0.14, deck * 0.55, deck):
        assembly.add(steel, box(order.x, (left, right - 0.02), (z - 0.025, z), 0.006))
    assembly.add(
        steel,
        tube(
            [
                (back + 0.03, right - 0.03, deck),
                (back + 0.03, right - 0.012, order.height - 0.012),
                (front - 0.03, right - 0.012, order.height - 0.012),
                (front - 0.03, right - 0.03, deck),
            ],
            0.012,
            6,
        ),
    )
    load = ((0.85, 0.85, 0.8), (0.55, 0.4, 0.25), (0.3, 0.45, 0.6))
    for place, tone in enumerate(load):
        y = left + order.length * (0.22 + 0.26 * place)
        z = deck * 0.55
        assembly.add(
            paint(tone),
            box(
                (back + 0.08, front - 0.08),
                (y - 0.08, y + 0.08),
                (z, z + 0.12 + 0.03 * place),
            ),
        )
    if order.text:
        pixels = sign_board(order.length * 0.8, 0.14, order.text, (0.93, 0.93, 0.92))
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.01, front),
                (left * 0.8, right * 0.8),
                (deck - 0.18, deck - 0.04),
            ),
        )
    return assembly


def _stroller(depth: float, width: float, height: float, cloth: Rgb) -> Assembly:
    """Build one push-chair that faces +x."""
    assembly = Assembly()
    back, front = -depth / 2, depth / 2
    frame = metal((0.3, 0.3, 0.33))
    wheel = 0.09 * min(1.0, height)
    for side in (-1, 1):
        y = side * width / 2 * 0.88
        assembly.add(
            frame,
            tube(
                [
                    (front - wheel, y, wheel),
                    (back * 0.2, y, height * 0.5),
                    (back + 0.04, y, height),
                ],
                0.014,
                4,
            ),
            tube(
                [(back + wheel, y, wheel), (front * 0.25, y, height * 0.42)], 0.012, 6
            ),
        )
        for x in (back + wheel, front - wheel):
            assembly.add(
                paint(DARK),
                cylinder(wheel, (-0.02, 0.02), 8).turned("x", 90).moved(x, y, wheel),
            )
    half = width * 0.42
    assembly.add(
        frame,
        tube([(back + 0.04, -half, height), (back + 0.04, half, height)], 0.016, 6),
    )
    assembly.add(
        paint(cloth, 0.02),
        box(
            (back * 0.35, front * 0.45),
            (-half, half),
            (height * 0.4, height * 0.46),
            0.02,
        ),
        limb(
            [(back * 0.3, 0, height * 0.46), (back * 0.55, 0, height * 0.72)],
            half * 0.55,
            6,
        ).scaled(1, 1.7, 1),
        lathed(
            [(half, 0), (half * 0.98, half * 0.3), (half * 0.6, half * 0.8), (0, half)],
            8,
        )
        .scaled(1.1, 1.0, 0.9)
        .moved(back * 0.3, 0, height * 0.66),
    )
    return assembly


def wheelchair(order: Order) -> Assembly:
    """Build a folding wheelchair with spoked wheels, handles and footrests."""
    assembly = Assembly()
    back, front = order.x
    h = order.height
    r = min(0.31, 0.34 * h)
    half = order.length / 2
    seat = 0.54 * h
    frame, rubber = metal(STEEL), paint(DARK)
    cloth = paint(order.colour((0.13, 0.36, 0.75)), 0.05)
    axle = back + r + 0.06
    inner = half - 0.08
    assembly.add(
        cloth,
        box((axle - 0.16, axle + 0.3), (-inner, inner), (seat - 0.05, seat), 0.02),
    )
    rest = box(
        (axle - 0.2, axle - 0.16), (-inner, inner), (seat + 0.04, h - 0.06), 0.015
    )
    assembly.add(cloth, rest)
    for side in (-1, 1):
        y = side * (half - 0.035)
        spoked_wheel(assembly, (axle, y, r), r, rubber, frame)
        p = side * inner
        assembly.add(
            frame,
            tube(
                [
                    (axle + 0.32, p, 0.1),
                    (axle + 0.28, p, seat - 0.02),
                    (axle - 0.16, p, seat - 0.02),
                    (axle - 0.18, p, h - 0.02),
                    (back + 0.02, p, h - 0.02),
                ],
                0.014,
                6,
            ),
            tube(
                [
                    (axle + 0.28, p, seat),
                    (axle + 0.22, p, seat + 0.2),
                    (axle - 0.16, p, seat + 0.2),
                ],
                0.013,
                6,
            ),
            tube([(axle + 0.3, p, 0.24), (front - 0.1, p * 0.8, 0.1)], 0.013, 6),
        )
        assembly.add(
            paint(DARK),
            tube([(back + 0.1, p, h - 0.02), (back, p, h - 0.02)], 0.019, 6),
        )
        assembly.add(
            cloth,
            box(
                (axle - 0.14, axle + 0.2),
                (p - 0.025, p + 0.025),
                (seat + 0.19, seat + 0.23),
                0.01,
            ),
        )
        assembly.add(
            rubber,
            cylinder(0.08, (-0.015, 0.015), 14)
            .turned("x", 90)
            .moved(axle + 0.33, p, 0.08),
        )
        assembly.add(
            paint(DARK),
            box(
                (front - 0.18, front),
                (min(0, side * 0.03) + p * 0.5 - 0.06, p * 0.5 + 0.07),
                (0.07, 0.1),
                0.01,
            ),
        )
    if order.text:
        pixels = sign_board(0.4, 0.16, order.text, (0.96, 0.96, 0.94))
        assembly.add(
            picture(pixels),
            plate((axle - 0.16, axle - 0.14), (-0.2, 0.2), (seat + 0.16, seat + 0.32)),
        )
    return assembly


def spoked_wheel(
    assembly: Assembly, hub: Point3, radius: float, tyre: Material, spokes: Material
) -> None:
    """Add a spoked wheel that rolls along x."""
    points: list[Point3] = []
    for step in range(22):
        a = math.tau * step / 22
        points.append((
            (radius - 0.018) * math.cos(a),
            0.0,
            (radius - 0.018) * math.sin(a),
        ))
    ring: Shape = tube(points, 0.018, 6, closed=True)
    assembly.add(tyre, ring.moved(*hub))
    assembly.add(spokes, cylinder(0.03, (-0.03, 0.03), 8).turned("x", 90).moved(*hub))
    for spoke in range(5):
        a = math.pi * spoke / 5
        x, z = (radius - 0.02) * math.cos(a), (radius - 0.02) * math.sin(a)
        assembly.add(spokes, tube([(-x, 0, -z), (x, 0, z)], 0.005, 4).moved(*hub))
