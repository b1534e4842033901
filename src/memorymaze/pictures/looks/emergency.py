"""Equipment for emergencies, and the electric panels beside it."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import pictogram_board
from memorymaze.pictures.looks.materials import (
    BLACK,
    PORCELAIN,
    SIGNAL_RED,
    STEEL,
    glow,
    metal,
    paint,
    picture,
    shade,
)
from memorymaze.pictures.looks.shapes import (
    around,
    ball,
    box,
    cylinder,
    extruded,
    lathed,
    span_between,
)
from memorymaze.pictures.looks.tubes import tube


def fire_extinguisher(made: Assembly, order: Order) -> None:
    """Build a red cylinder with a valve, a hose and a label."""
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
    made.lathed(paint(order.colour(SIGNAL_RED), 0.5), profile, 18)
    made.cylinder(paint(BLACK), radius * 0.95, (0, 0.03 * top), 18)
    label = lathed([(radius * 1.012, 0.3 * top), (radius * 1.012, 0.52 * top)], 18)
    made.add(paint(PORCELAIN), label)
    stripe = lathed([(radius * 1.02, 0.42 * top), (radius * 1.02, 0.46 * top)], 18)
    made.add(paint((0.1, 0.2, 0.5)), stripe)
    head = 0.84 * top
    made.add(
        paint(BLACK, 0.4),
        box(
            (-radius * 0.3, radius * 0.35),
            around(0, radius * 0.3),
            (head - 0.02 * top, head + 0.06 * top),
        ),
        box((-radius * 0.2, radius * 1.1), around(0, radius * 0.16), (0.95 * top, top)),
        box(
            (-radius * 0.2, radius * 0.9),
            around(0, radius * 0.16),
            (0.88 * top, 0.91 * top),
        ),
        box(
            (-radius * 0.3, -radius * 0.05), around(0, radius * 0.16), (0.88 * top, top)
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
    gauge = cylinder(radius * 0.18, (0, 0.02), 10, along="x")
    made.add(paint((0.2, 0.65, 0.3)), gauge.moved(radius * 0.3, 0, head + 0.02 * top))
    made.box(
        metal(STEEL),
        (-order.depth / 2, -radius * 0.8),
        around(0, radius * 0.25),
        (0.35 * top, 0.6 * top),
    )


def fire_hydrant_box(made: Assembly, order: Order) -> None:
    """Build a red hose cabinet with a lamp, its words and a handle."""
    back, front = order.x
    colour = order.colour(SIGNAL_RED)
    face = front - 0.03
    top = order.height
    made.box(paint(shade(colour, 0.8), 0.2), (back, face - 0.02), order.y, (0, top))
    seam = 0.72 * top
    made.box(
        paint(colour, 0.4), (face - 0.03, face), order.y.inset(0.02), (0.02, seam), 0.01
    )
    made.box(
        paint(colour, 0.4),
        (face - 0.03, face),
        order.y.inset(0.02),
        (seam + 0.02, top - 0.02),
        0.01,
    )
    wide = order.length * 0.4
    made.words(
        order.text or "FIRE HOSE",
        colour,
        (face - 0.01, face + 0.004),
        (-wide, wide),
        (0.32 * top, 0.62 * top),
    )
    lamp = ball(0.06, 12, 8).moved(face - 0.01, -order.length * 0.25, (seam + top) / 2)
    made.add(glow((1.0, 0.25, 0.2), 0.7), lamp)
    bell = cylinder(0.08, (0, 0.03), 14, along="x").moved(
        face - 0.02, order.length * 0.22, (seam + top) / 2
    )
    made.add(metal(STEEL), bell)
    made.box(
        metal(STEEL),
        (face - 0.01, front),
        order.y.end(0.1, 0.06),
        (0.2 * top, 0.3 * top),
        0.008,
    )


def aed(made: Assembly, order: Order) -> None:
    """Build a defibrillator cabinet: a heart with a bolt, the device behind a window."""
    colour = order.colour(SIGNAL_RED)
    top = order.height
    made.box(paint(colour, 0.3), order.x.inset(0, 0.01), order.y, (0, top), 0.015)
    red = colour if min(colour) < 0.7 else (0.0, 0.48, 0.24)
    pixels = pictogram_board(
        order.length * 0.92, top * 0.92, order.text or "AED", ("heart",), red
    )
    edge = 0.04 * top
    made.plate(
        picture(pixels), order.x.end(0.03), order.y.inset(edge), (edge, top - edge)
    )


def switch_board(made: Assembly, order: Order) -> None:
    """Build an electric cabinet: two doors, a warning triangle, locks, vents."""
    colour = order.colour((0.6, 0.61, 0.63))
    made.box(paint(shade(colour, 0.7)), order.x.inset(0, 0.025), order.y, order.z)
    for side in (-1, 1):
        y = span_between(side * 0.006, side * (order.length / 2 - 0.012))
        made.box(
            paint(colour, 0.2),
            order.x.end(0.04, 0.012),
            y,
            (0.012, order.height - 0.012),
            0.004,
        )
        lock = side * 0.06
        made.box(
            paint(BLACK),
            order.x.end(0.02),
            around(lock, 0.015),
            (order.height * 0.45, order.height * 0.55),
        )
        for row in range(4):
            z = 0.12 + 0.05 * row
            middle = sum(y) / 2
            made.box(
                paint(shade(colour, 0.4)),
                order.x.end(0.02, 0.009),
                around(middle, 0.12),
                (z, z + 0.02),
            )
    size = min(0.24, order.length * 0.24)
    middle, z = -order.length * 0.25, order.height * 0.66
    from_edge = [(-size / 2, 0.0), (size / 2, 0.0), (0.0, size * 0.86)]
    triangle = extruded(from_edge, order.x.end(0.02, 0.008), "x").moved(0, middle, z)
    made.add(paint((0.98, 0.82, 0.05)), triangle)
    bolt = [
        (0.02, 0.62),
        (-0.18, 0.3),
        (0.0, 0.3),
        (-0.04, 0.08),
        (0.18, 0.42),
        (0.02, 0.42),
    ]
    flash = extruded(
        [(a * size, b * size) for a, b in bolt], order.x.end(0.02, 0.004), "x"
    )
    made.add(paint(BLACK), flash.moved(0, middle, z))


def call_button_panel(made: Assembly, order: Order) -> None:
    """Build a lift's call panel: a display and two lit round buttons with arrows."""
    back, front = order.x
    face = front - 0.012
    made.box(metal(order.colour(STEEL)), (back, face), order.y, order.z, 0.008)
    wide = order.length * 0.3
    made.words(
        order.text or "",
        BLACK,
        (face - 0.005, face + 0.003),
        (-wide, wide),
        (order.height * 0.72, order.height * 0.92),
    )
    size = order.length * 0.2
    for z, up in ((order.height * 0.5, 1), (order.height * 0.24, -1)):
        made.cylinder(
            glow((0.98, 0.85, 0.4), 0.5),
            order.length * 0.22,
            (0, 0.012),
            16,
            along="x",
            at=(face - 0.003, 0, z),
        )
        arrow = [
            (-size / 2, -up * size * 0.35),
            (size / 2, -up * size * 0.35),
            (0.0, up * size * 0.55),
        ]
        made.add(paint(BLACK), extruded(arrow, (face, front), "x").moved(0, 0, z))
