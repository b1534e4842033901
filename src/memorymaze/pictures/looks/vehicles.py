"""Things that carry people or luggage: bicycles, cars, suitcases."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import glow, metal, paint, picture
from memorymaze.pictures.looks.primitives import box, cylinder, extruded, plate
from memorymaze.pictures.looks.tubes import Point3, limb, tube
from memorymaze.pictures.looks.wheels import spoked_wheel

STEEL: Rgb = (0.72, 0.73, 0.75)
DARK: Rgb = (0.09, 0.09, 0.1)


def exercise_bike(order: Order) -> Assembly:
    """Build a stationary bicycle, its side to the front, with a lamp and its words."""
    assembly = Assembly()
    half, h = order.length / 2, order.height
    frame = paint(order.colour((0.79, 0.13, 0.13)), 0.4)
    dark = paint(DARK)
    for y in (-half * 0.72, half * 0.72):
        assembly.add(dark, box(order.x, (y - 0.05, y + 0.05), (0, 0.07), 0.02))
    assembly.add(
        frame, tube([(0, -half * 0.72, 0.07), (0, half * 0.72, 0.07)], 0.035, 8)
    )
    wheel = (0.0, half * 0.45, 0.36)
    disc = cylinder(0.26, (-0.04, 0.04), 24).turned("y", 90)
    assembly.add(metal(STEEL), disc.moved(*wheel))
    assembly.add(frame, cylinder(0.19, (-0.05, 0.05), 20).turned("y", 90).moved(*wheel))
    crank = (0.0, -0.02, 0.34)
    assembly.add(dark, cylinder(0.11, (-0.06, 0.06), 16).turned("y", 90).moved(*crank))
    assembly.add(
        frame,
        tube([crank, (0, half * 0.55, h * 0.72), (0, half * 0.5, h - 0.12)], 0.035, 8),
        tube([crank, (0, -half * 0.52, h * 0.66)], 0.035, 8),
        tube([crank, (0, 0, 0.08)], 0.04, 8),
    )
    saddle = [(-0.1, -0.02), (0.1, -0.02), (0.05, 0.24), (-0.05, 0.24)]
    assembly.add(
        dark,
        extruded([(x, y - half * 0.62) for x, y in saddle], (h * 0.67, h * 0.73), "z"),
    )
    bar: list[Point3] = [
        (-0.22, half * 0.32, h - 0.04),
        (-0.2, half * 0.5, h - 0.1),
        (0.2, half * 0.5, h - 0.1),
        (0.22, half * 0.32, h - 0.04),
    ]
    assembly.add(dark, tube(bar, 0.022, 7))
    for side in (-1, 1):
        pedal = (side * 0.16, -0.02, 0.34 + side * 0.16)
        assembly.add(
            metal(STEEL),
            tube(
                [(side * 0.07, crank[1], crank[2]), (side * 0.09, crank[1], pedal[2])],
                0.014,
                6,
            ),
        )
        assembly.add(
            dark,
            box(
                (pedal[0] - 0.06, pedal[0] + 0.06),
                (pedal[1] - 0.05, pedal[1] + 0.05),
                (pedal[2] - 0.015, pedal[2] + 0.015),
            ),
        )
    assembly.add(
        glow((1.0, 0.92, 0.6), 0.9),
        limb([(0, half * 0.8, h - 0.22), (0, half * 0.8, h - 0.1)], [0.04, 0.08], 10),
    )
    assembly.add(
        metal(STEEL),
        tube([(0, half * 0.8, 0.07), (0, half * 0.8, h - 0.24)], 0.018, 6),
        box((-0.02, 0.02), (-half, half), (0, 0.02)),
    )
    if order.text:
        pixels = sign_board(order.length * 0.7, 0.2, order.text, (0.96, 0.96, 0.94))
        wide = order.length * 0.35
        front = order.x[1]
        assembly.add(
            picture(pixels), plate((front - 0.03, front), (-wide, wide), (0.08, 0.28))
        )
    return assembly


def bicycle(order: Order) -> Assembly:
    """Build a bicycle along its longer side."""
    assembly = Assembly()
    long_way = max(order.length, order.depth)
    h = order.height
    r = min(0.34, 0.33 * h, 0.2 * long_way)
    frame = paint(order.colour((0.13, 0.36, 0.75)), 0.5)
    rear, fore = -long_way / 2 + r, long_way / 2 - r
    for x in (rear, fore):
        spoked_wheel(assembly, (x, 0.0, r), r, paint(DARK), metal(STEEL))
    crank, seat, head = (
        (rear * 0.15, 0.0, r * 0.9),
        (rear * 0.42, 0.0, 0.78 * h),
        (fore * 0.62, 0.0, 0.8 * h),
    )
    for a, b in (
        (crank, seat),
        (crank, head),
        (seat, head),
        (crank, (rear, 0.0, r)),
        (seat, (rear, 0.0, r)),
        (head, (fore, 0.0, r)),
    ):
        assembly.add(frame, tube([a, b], 0.018, 6))
    top = (fore * 0.56, 0.0, h - 0.03)
    assembly.add(
        metal(STEEL),
        tube([head, top], 0.015, 6),
        tube(
            [
                (top[0] - 0.1, -0.25, h - 0.02),
                (top[0], 0.0, h - 0.03),
                (top[0] - 0.1, 0.25, h - 0.02),
            ],
            0.014,
            6,
        ),
    )
    assembly.add(
        paint(DARK),
        box(
            (seat[0] - 0.14, seat[0] + 0.12),
            (-0.08, 0.08),
            (seat[2], seat[2] + 0.06),
            0.025,
        ),
    )
    assembly.add(
        paint(DARK), cylinder(0.09, (-0.02, 0.02), 14).turned("x", 90).moved(*crank)
    )
    return assembly.turned(90) if order.length > order.depth else assembly


def car(order: Order) -> Assembly:
    """Build a small car along its longer side."""
    assembly = Assembly()
    long_way, across = max(order.length, order.depth), min(order.length, order.depth)
    half, h = long_way / 2, order.height
    body = paint(order.colour((0.2, 0.4, 0.7)), 0.6)
    r = 0.22 * h
    low, belt = 0.18 * h, 0.58 * h
    lower = [
        (-half, low),
        (half, low),
        (half, belt * 0.82),
        (half * 0.5, belt),
        (-half * 0.95, belt),
        (-half, belt * 0.9),
    ]
    upper = [
        (half * 0.45, belt - 0.01),
        (half * 0.12, h),
        (-half * 0.55, h),
        (-half * 0.85, belt - 0.01),
    ]
    y = across / 2
    assembly.add(body, extruded(lower, (-y, y), "y"))
    assembly.add(
        paint((0.12, 0.16, 0.2), 0.9), extruded(upper, (-y * 0.86, y * 0.86), "y")
    )
    assembly.add(
        body,
        box((-half * 0.52, half * 0.1), (-y * 0.84, y * 0.84), (h - 0.03, h + 0.01)),
    )
    for x in (-half * 0.6, half * 0.6):
        for side in (-1, 1):
            tyre = (
                cylinder(r, (-0.09, 0.09), 18)
                .turned("x", 90)
                .moved(x, side * (y - 0.08), r)
            )
            hub = (
                cylinder(r * 0.55, (-0.1, 0.1), 14)
                .turned("x", 90)
                .moved(x, side * (y - 0.08), r)
            )
            assembly.add(paint(DARK), tyre)
            assembly.add(metal(STEEL), hub)
    for side in (-1, 1):
        assembly.add(
            glow((1.0, 0.97, 0.85), 0.6),
            box(
                (half - 0.04, half + 0.01),
                (side * y * 0.7 - 0.14, side * y * 0.7 + 0.14),
                (belt * 0.58, belt * 0.75),
            ),
        )
        assembly.add(
            paint((0.7, 0.08, 0.08), 0.5),
            box(
                (-half - 0.01, -half + 0.04),
                (side * y * 0.7 - 0.14, side * y * 0.7 + 0.14),
                (belt * 0.6, belt * 0.8),
            ),
        )
    return assembly.turned(90) if order.length > order.depth else assembly


def suitcase(order: Order) -> Assembly:
    """Build a suitcase on wheels with its handle out."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour((0.25, 0.28, 0.35))
    top = order.height * 0.72
    assembly.add(paint(colour, 0.3), box((back, front), order.y, (0.05, top), 0.04))
    for place in range(5):
        y = order.y[0] + order.length * (place + 0.5) / 5
        assembly.add(
            paint(shade(colour, 0.75), 0.3),
            box(
                (front - 0.02, front + 0.006), (y - 0.012, y + 0.012), (0.1, top - 0.05)
            ),
        )
    reach = order.length * 0.25
    grip: list[Point3] = [
        (back + 0.04, -reach, top),
        (back + 0.04, -reach, order.height - 0.01),
        (back + 0.04, reach, order.height - 0.01),
        (back + 0.04, reach, top),
    ]
    assembly.add(metal(STEEL), tube(grip, 0.012, 6))
    for x in (back + 0.05, front - 0.05):
        for y in (order.y[0] + 0.05, order.y[1] - 0.05):
            assembly.add(
                paint(DARK),
                cylinder(0.03, (-0.012, 0.012), 8).turned("x", 90).moved(x, y, 0.03),
            )
    return assembly
