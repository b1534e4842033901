"""Things for emergencies and technical boxes on walls."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import pictogram_board, sign_board
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import glow, metal, paint, picture
from memorymaze.pictures.looks.primitives import (
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    plate,
)
from memorymaze.pictures.looks.tubes import tube

RED: Rgb = (0.78, 0.08, 0.08)
STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.1, 0.1, 0.11)
WHITE: Rgb = (0.95, 0.95, 0.94)


def fire_extinguisher(order: Order) -> Assembly:
    """Build a red cylinder with a valve, a hose and a label."""
    assembly = Assembly()
    radius = min(order.length, order.depth) * 0.38
    top = order.height
    shoulder = 0.74 * top
    profile = [
        (radius * 0.9, 0.02 * top),
        (radius, 0.05 * top),
        (radius, shoulder - 0.6 * radius),
    ]
    profile += [
        (radius * 0.86, shoulder - 0.25 * radius),
        (radius * 0.5, shoulder),
        (radius * 0.3, shoulder + 0.1 * radius),
        (radius * 0.3, 0.84 * top),
    ]
    assembly.add(paint(order.colour(RED), 0.5), lathed(profile, 18))
    assembly.add(paint(DARK), cylinder(radius * 0.95, (0, 0.03 * top), 18))
    label = lathed([(radius * 1.012, 0.3 * top), (radius * 1.012, 0.52 * top)], 18)
    assembly.add(paint(WHITE), label)
    stripe = lathed([(radius * 1.02, 0.42 * top), (radius * 1.02, 0.46 * top)], 18)
    assembly.add(paint((0.1, 0.2, 0.5)), stripe)
    head = 0.84 * top
    assembly.add(
        paint(DARK, 0.4),
        box(
            (-radius * 0.3, radius * 0.35),
            (-radius * 0.3, radius * 0.3),
            (head - 0.02 * top, head + 0.06 * top),
        ),
        box(
            (-radius * 0.2, radius * 1.1),
            (-radius * 0.16, radius * 0.16),
            (0.95 * top, top),
        ),
        box(
            (-radius * 0.2, radius * 0.9),
            (-radius * 0.16, radius * 0.16),
            (0.88 * top, 0.91 * top),
        ),
        box(
            (-radius * 0.3, -radius * 0.05),
            (-radius * 0.16, radius * 0.16),
            (0.88 * top, top),
        ),
        tube(
            [
                (0, radius * 0.2, head + 0.01),
                (0.0, radius * 0.9, head + 0.02),
                (0.0, radius * 1.22, head - 0.1 * top),
                (radius * 0.2, radius * 1.22, 0.35 * top),
            ],
            radius * 0.12,
            6,
        ),
        tube(
            [
                (radius * 0.2, radius * 1.22, 0.36 * top),
                (radius * 0.25, radius * 1.2, 0.2 * top),
            ],
            [radius * 0.12, radius * 0.2],
            8,
        ),
    )
    gauge = cylinder(radius * 0.18, (0, 0.02), 10).turned("y", 90)
    assembly.add(
        paint((0.2, 0.65, 0.3)), gauge.moved(radius * 0.3, 0, head + 0.02 * top)
    )
    assembly.add(
        metal(STEEL),
        box(
            (-order.depth / 2, -radius * 0.8),
            (-radius * 0.25, radius * 0.25),
            (0.35 * top, 0.6 * top),
        ),
    )
    return assembly


def fire_hydrant_box(order: Order) -> Assembly:
    """Build a red hose cabinet with a lamp, its words and a handle."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(RED)
    face = front - 0.03
    top = order.height
    assembly.add(
        paint(shade(colour, 0.8), 0.2), box((back, face - 0.02), order.y, (0, top))
    )
    seam = 0.72 * top
    assembly.add(
        paint(colour, 0.4),
        box(
            (face - 0.03, face),
            (order.y[0] + 0.02, order.y[1] - 0.02),
            (0.02, seam),
            0.01,
        ),
    )
    assembly.add(
        paint(colour, 0.4),
        box(
            (face - 0.03, face),
            (order.y[0] + 0.02, order.y[1] - 0.02),
            (seam + 0.02, top - 0.02),
            0.01,
        ),
    )
    wide = order.length * 0.4
    pixels = sign_board(2 * wide, 0.3 * top, order.text or "FIRE HOSE", colour)
    assembly.add(
        picture(pixels),
        plate((face - 0.01, face + 0.004), (-wide, wide), (0.32 * top, 0.62 * top)),
    )
    lamp = ball(0.06, 12, 8).moved(face - 0.01, -order.length * 0.25, (seam + top) / 2)
    assembly.add(glow((1.0, 0.25, 0.2), 0.7), lamp)
    bell = (
        cylinder(0.08, (0, 0.03), 14)
        .turned("y", 90)
        .moved(face - 0.02, order.length * 0.22, (seam + top) / 2)
    )
    assembly.add(metal(STEEL), bell)
    assembly.add(
        metal(STEEL),
        box(
            (face - 0.01, front),
            (order.y[1] - 0.1, order.y[1] - 0.06),
            (0.2 * top, 0.3 * top),
            0.008,
        ),
    )
    return assembly


def aed_box(order: Order) -> Assembly:
    """Build a defibrillator cabinet: a heart with a bolt, the device behind a window."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(RED)
    top = order.height
    assembly.add(
        paint(colour, 0.3), box((back, front - 0.01), order.y, (0, top), 0.015)
    )
    red = colour if min(colour) < 0.7 else (0.0, 0.48, 0.24)
    pixels = pictogram_board(
        order.length * 0.92, top * 0.92, order.text or "AED", ("heart",), red
    )
    edge = 0.04 * top
    assembly.add(
        picture(pixels),
        plate(
            (front - 0.03, front),
            (order.y[0] + edge, order.y[1] - edge),
            (edge, top - edge),
        ),
    )
    return assembly


def switch_board(order: Order) -> Assembly:
    """Build an electric cabinet: two doors, a warning triangle, locks, vents."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour((0.6, 0.61, 0.63))
    assembly.add(
        paint(shade(colour, 0.7)), box((back, front - 0.025), order.y, order.z)
    )
    for side in (-1, 1):
        y = sorted((side * 0.006, side * (order.length / 2 - 0.012)))
        assembly.add(
            paint(colour, 0.2),
            box(
                (front - 0.04, front - 0.012),
                (y[0], y[1]),
                (0.012, order.height - 0.012),
                0.004,
            ),
        )
        lock = side * 0.06
        assembly.add(
            paint(DARK),
            box(
                (front - 0.02, front),
                (lock - 0.015, lock + 0.015),
                (order.height * 0.45, order.height * 0.55),
            ),
        )
        for row in range(4):
            z = 0.12 + 0.05 * row
            middle = sum(y) / 2
            assembly.add(
                paint(shade(colour, 0.4)),
                box(
                    (front - 0.02, front - 0.009),
                    (middle - 0.12, middle + 0.12),
                    (z, z + 0.02),
                ),
            )
    size = min(0.24, order.length * 0.24)
    middle, z = -order.length * 0.25, order.height * 0.66
    from_edge = [(-size / 2, 0.0), (size / 2, 0.0), (0.0, size * 0.86)]
    triangle = extruded(from_edge, (front - 0.02, front - 0.008), "x").moved(
        0, middle, z
    )
    assembly.add(paint((0.98, 0.82, 0.05)), triangle)
    bolt = [
        (0.02, 0.62),
        (-0.18, 0.3),
        (0.0, 0.3),
        (-0.04, 0.08),
        (0.18, 0.42),
        (0.02, 0.42),
    ]
    flash = extruded(
        [(a * size, b * size) for a, b in bolt], (front - 0.02, front - 0.004), "x"
    )
    assembly.add(paint(DARK), flash.moved(0, middle, z))
    return assembly


def call_button_panel(order: Order) -> Assembly:
    """Build a lift's call panel: a display and two lit round buttons with arrows."""
    assembly = Assembly()
    back, front = order.x
    face = front - 0.012
    assembly.add(metal(order.colour(STEEL)), box((back, face), order.y, order.z, 0.008))
    pixels = sign_board(order.length * 0.6, order.height * 0.2, order.text or "", DARK)
    wide = order.length * 0.3
    assembly.add(
        picture(pixels),
        plate(
            (face - 0.005, face + 0.003),
            (-wide, wide),
            (order.height * 0.72, order.height * 0.92),
        ),
    )
    size = order.length * 0.2
    for z, up in ((order.height * 0.5, 1), (order.height * 0.24, -1)):
        assembly.add(
            glow((0.98, 0.85, 0.4), 0.5),
            cylinder(order.length * 0.22, (0, 0.012), 16)
            .turned("y", 90)
            .moved(face - 0.003, 0, z),
        )
        arrow = [
            (-size / 2, -up * size * 0.35),
            (size / 2, -up * size * 0.35),
            (0.0, up * size * 0.55),
        ]
        assembly.add(paint(DARK), extruded(arrow, (face, front), "x").moved(0, 0, z))
    return assembly
