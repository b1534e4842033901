"""Machines of kitchens and offices."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.materials import (
    ALUMINIUM,
    BLACK,
    PALE_GREY,
    STEEL,
    WHITE,
    Rgb,
    glass,
    glow,
    ink_on,
    metal,
    paint,
    shade,
)
from memorymaze.pictures.looks.shapes import (
    around,
    box,
    cylinder,
    lathed,
    span_within,
    tapered,
)


def refrigerator(made: Assembly, order: Order) -> None:
    """Build a fridge: a small freezer door over a tall one, with long handles."""
    back, front = order.x
    colour = order.colour(WHITE)
    face = front - 0.04
    made.box(
        paint(shade(colour, 0.75), 0.2),
        (back, face - 0.05),
        order.y,
        (0.03, order.height),
    )
    split = order.height * 0.68
    for low, high in ((0.05, split - 0.006), (split + 0.006, order.height)):
        made.box(paint(colour, 0.5), (face - 0.055, face), order.y, (low, high), 0.018)
    made.box(paint(BLACK), (back + 0.04, face - 0.08), order.y, (0, 0.03))
    y = order.y[0] + 0.08
    for low, high in ((split - 0.55, split - 0.06), (split + 0.06, split + 0.35)):
        made.tube(
            metal(shade(STEEL, 0.6)),
            [
                (face, y, low),
                (front - 0.012, y, low),
                (front - 0.012, y, high),
                (face, y, high),
            ],
            0.012,
            6,
        )
    notes = ((0.98, 0.9, 0.4), (0.6, 0.85, 0.95), (0.95, 0.6, 0.6))
    for place, tone in enumerate(notes):
        z = split - 0.2 - 0.13 * place
        made.box(
            paint(tone),
            (face - 0.01, face + 0.004),
            (0.02 + 0.06 * place, 0.12 + 0.06 * place),
            (z, z + 0.1),
        )


def microwave(made: Assembly, order: Order) -> None:
    """Build a microwave oven: a dark window, keys and a lit clock."""
    back, front = order.x
    colour = order.colour(WHITE)
    face = front - 0.03
    made.box(paint(colour, 0.3), (back, face), order.y, (0.015, order.height), 0.012)
    for side in (-1, 1):
        y = side * order.length * 0.4
        made.box(paint(BLACK), (back + 0.03, face - 0.03), around(y, 0.02), (0, 0.02))
    keys = order.y[1] - 0.24 * order.length
    low, high = 0.1 * order.height, 0.93 * order.height
    trim = (0.06, 0.06, 0.07) if ink_on(colour)[0] < 0.5 else (0.3, 0.31, 0.33)
    made.box(
        paint(trim, 0.7),
        (face - 0.01, face + 0.006),
        (order.y[0] + 0.03, keys - 0.03),
        (low, high),
    )
    made.box(
        metal(STEEL), (face, front), (keys - 0.025, keys - 0.008), (low, high), 0.006
    )
    made.box(
        glow((0.15, 0.85, 0.5), 0.6),
        (face - 0.01, face + 0.006),
        (keys + 0.015, order.y[1] - 0.025),
        (high - 0.05, high),
    )
    for row in range(4):
        for column in range(3):
            y, z = keys + 0.016 + 0.028 * column, low + row * (high - low - 0.07) / 4
            made.box(
                paint((0.6, 0.62, 0.64)),
                (face - 0.01, face + 0.005),
                (y, y + 0.021),
                (z, z + 0.03),
            )


def water_cooler(made: Assembly, order: Order) -> None:
    """Build a water dispenser with a blue bottle on top and two taps."""
    colour = order.colour(WHITE)
    body = 0.72 * order.height
    made.box(paint(colour, 0.2), order.x.inset(0, 0.03), order.y, (0, body), 0.025)
    low, high = body * 0.6, body * 0.9
    half = order.length * 0.36
    made.box(
        paint(shade(colour, 0.6)), order.x.end(0.06, 0.024), (-half, half), (low, high)
    )
    for y, tone in ((-0.06, (0.8, 0.15, 0.15)), (0.06, (0.15, 0.35, 0.8))):
        made.box(
            paint(tone),
            order.x.end(0.04),
            around(y, 0.022),
            (high - 0.09, high - 0.04),
            0.008,
        )
    made.box(metal(STEEL), order.x.end(0.05), (-half, half), (low - 0.015, low + 0.01))
    radius = min(order.length, order.depth) * 0.4
    tall = order.height - body
    made.lathed(
        glass((0.45, 0.7, 0.9), 0.75),
        [
            (radius * 0.4, body - 0.01),
            (radius * 0.45, body + 0.1 * tall),
            (radius, body + 0.28 * tall),
            (radius * 0.96, body + 0.5 * tall),
            (radius, body + 0.55 * tall),
            (radius, body + 0.92 * tall),
            (radius * 0.8, order.height),
        ],
        18,
    )


def sink(made: Assembly, order: Order) -> None:
    """Build a basin with a bent tap."""
    back = order.x[0]
    colour = order.colour(STEEL)
    rim = order.height * 0.6
    basin = lathed(
        [
            (0.6, 0.0),
            (0.92, rim * 0.5),
            (1.0, rim),
            (0.88, rim),
            (0.6, rim * 0.4),
            (0.0, rim * 0.35),
        ],
        24,
    ).scaled(order.depth / 2, order.length / 2, 1.0)
    made.add(metal(colour), basin)
    made.box(metal(colour), order.x.start(0.09), order.y, (rim * 0.55, rim), 0.01)
    made.cylinder(paint(BLACK), 0.025, (rim * 0.35, rim * 0.4), 10)
    tap = metal((0.36, 0.38, 0.42))
    high = order.height - 0.02
    made.tube(
        tap,
        [
            (back + 0.05, 0, rim - 0.02),
            (back + 0.05, 0, high - 0.03),
            (back + 0.08, 0, high),
            (back + 0.17, 0, high),
            (back + 0.19, 0, high - 0.05),
        ],
        0.02,
        8,
    )
    for side, water in ((-1, (0.15, 0.3, 0.75)), (1, (0.8, 0.12, 0.12))):
        made.cylinder(
            paint(water), 0.03, (rim, rim + 0.05), 8, at=(back + 0.06, side * 0.12, 0)
        )


def coffee_machine(made: Assembly, order: Order) -> None:
    """Build a coffee machine on its cabinet: a display, spouts, a cup, a drip tray."""
    front = order.x[1]
    split = order.height * 0.52 if order.height > 1.0 else 0.0
    colour = order.colour((0.15, 0.15, 0.16))
    if split:
        made.box(
            paint((0.5, 0.42, 0.35)), order.x.inset(0, 0.02), order.y, (0, split - 0.03)
        )
        made.box(paint((0.2, 0.2, 0.2), 0.3), order.x, order.y, (split - 0.03, split))
        made.box(
            metal(ALUMINIUM),
            order.x.end(0.02, 0.005),
            order.y.end(0.12, 0.1),
            (split * 0.5, split * 0.75),
        )
    top = order.height
    body = paint(colour, 0.5)
    tall = top - split
    y = order.y.inset(0.04)
    made.add(
        body,
        box(order.x.start(0.02, 0.55 * order.depth), y, (split, top), 0.02),
        box(order.x.inset(0.1, 0.06), y, (split + 0.58 * tall, top - 0.01), 0.03),
        box(order.x.inset(0.1, 0.03), y, (split, split + 0.1 * tall), 0.01),
    )
    trim = ink_ground(colour)
    nose = front - 0.06
    made.box(
        glow((0.35, 0.65, 0.85), 0.5),
        (nose - 0.02, nose + 0.008),
        (-0.09, 0.09),
        order.z.end(0.26 * tall, 0.1 * tall),
    )
    made.add(
        metal(ALUMINIUM),
        cylinder(0.014, (0, 0.07), 8).moved(nose - 0.07, -0.03, split + 0.52 * tall),
        cylinder(0.014, (0, 0.07), 8).moved(nose - 0.07, 0.03, split + 0.52 * tall),
        box(
            (nose - 0.14, nose + 0.02),
            order.y.inset(0.08),
            (split + 0.1 * tall, split + 0.12 * tall),
        ),
    )
    made.lathed(
        paint(PALE_GREY, 0.4),
        [(0.03, 0), (0.042, 0.09), (0.038, 0.09), (0.027, 0.01)],
        12,
        at=(nose - 0.07, 0.0, split + 0.12 * tall),
    )
    made.box(
        paint(trim),
        (nose - 0.02, nose + 0.006),
        (-0.16, 0.16),
        order.z.end(0.36 * tall, 0.33 * tall),
    )
    hopper = glass((0.35, 0.22, 0.12), 0.8)
    made.add(
        hopper,
        tapered(
            order.x.start(0.06, 0.26),
            (-0.1, 0.1),
            order.z.end(0.005, -0.14),
            order.x.start(0.03, 0.3),
            (-0.13, 0.13),
        ),
    )


def photocopier(made: Assembly, order: Order) -> None:
    """Build an office copier: paper drawers, an output bay, a lid and a panel."""
    left, right = order.y
    colour = order.colour(PALE_GREY)
    body, dark = paint(colour, 0.2), paint((0.25, 0.27, 0.3))
    inner = order.y.inset(0.16 * order.length)
    waist, lid = order.height * 0.62, order.height * 0.86
    made.box(body, order.x.inset(0, 0.06), inner, (0.05, waist), 0.02)
    made.box(dark, order.x.inset(0.05, 0.1), span_within(inner, 0.03), (0, 0.05))
    for row in range(3):
        z = 0.07 + row * (waist - 0.1) / 3
        made.box(
            paint(shade(colour, 0.92), 0.2),
            order.x.end(0.09, 0.045),
            span_within(inner, 0.02),
            (z + 0.01, z + (waist - 0.1) / 3 - 0.01),
            0.006,
        )
        made.box(dark, order.x.end(0.06, 0.04), (-0.1, 0.1), (z + 0.1, z + 0.12))
    made.box(body, order.x.start(0.3 * order.depth), inner, (waist, lid))
    made.box(body, order.x.inset(0, 0.08), (inner[0], inner[0] + 0.1), (waist, lid))
    made.box(
        paint((0.97, 0.97, 0.96)),
        order.x.inset(0.2, 0.14),
        (inner[0] + 0.16, inner[1] - 0.05),
        (waist, waist + 0.02),
    )
    made.box(body, order.x.inset(0, 0.06), inner, (lid - 0.06, lid), 0.015)
    made.box(
        dark,
        order.x.inset(0.02, 0.12),
        span_within(inner, 0.02),
        (lid, order.height),
        0.03,
    )
    panel = tapered(
        order.x.end(0.16),
        (inner[1] - 0.34, inner[1]),
        (lid - 0.05, lid - 0.02),
        order.x.end(0.16),
        (inner[1] - 0.34, inner[1]),
    )
    made.add(dark, panel)
    made.box(
        glow((0.3, 0.6, 0.85), 0.5),
        order.x.end(0.13, 0.04),
        (inner[1] - 0.3, inner[1] - 0.14),
        (lid - 0.03, lid - 0.012),
    )
    made.box(
        paint((0.2, 0.7, 0.3)),
        order.x.end(0.1, 0.05),
        (inner[1] - 0.1, inner[1] - 0.04),
        (lid - 0.03, lid - 0.01),
    )
    tray = paint(shade(colour, 0.85))
    made.box(
        tray,
        order.x.inset(0.12, 0.16),
        (left, inner[0] + 0.02),
        (waist * 0.8, waist * 0.8 + 0.03),
    )
    made.box(
        tray,
        order.x.inset(0.12, 0.16),
        (inner[1] - 0.02, right),
        (waist * 0.6, waist * 0.6 + 0.03),
    )


def printer(made: Assembly, order: Order) -> None:
    """Build a printer, on a cabinet where it stands on the floor."""
    low = order.height * 0.55 if order.height > 0.8 else 0.0
    if low:
        made.box(paint((0.6, 0.5, 0.4)), order.x.inset(0.02, 0.04), order.y, (0, low))
        made.box(
            metal(ALUMINIUM),
            order.x.end(0.05, 0.03),
            (-0.06, 0.06),
            (low * 0.7, low * 0.75),
        )
    colour = order.colour((0.55, 0.56, 0.58))
    tall = order.height - low
    y = order.y.inset(0.03)
    made.box(
        paint(colour, 0.2), order.x.inset(0, 0.06), y, (low, low + 0.85 * tall), 0.03
    )
    made.box(
        paint(BLACK),
        order.x.end(0.12, 0.055),
        span_within(y, 0.06),
        (low + 0.45 * tall, low + 0.62 * tall),
    )
    made.box(
        paint((0.97, 0.97, 0.95)),
        order.x.end(0.2),
        span_within(y, 0.1),
        (low + 0.46 * tall, low + 0.48 * tall),
    )
    made.box(
        paint(shade(colour, 0.7)),
        order.x.end(0.08, 0.05),
        span_within(y, 0.03),
        (low + 0.06 * tall, low + 0.32 * tall),
        0.01,
    )
    feeder = box(
        order.x.start(0.02, 0.05), span_within(y, 0.1), (low + 0.8 * tall, order.height)
    )
    made.add(paint((0.97, 0.97, 0.95)), feeder)
    made.box(
        glow((0.3, 0.6, 0.85), 0.5),
        order.x.end(0.1, 0.056),
        (y[1] - 0.16, y[1] - 0.04),
        (low + 0.68 * tall, low + 0.78 * tall),
    )


def ink_ground(colour: Rgb) -> Rgb:
    """Return white on dark machines and a dark tone on light ones."""
    return (0.96, 0.96, 0.94) if ink_on(colour)[0] > 0.5 else shade(colour, 0.35)
