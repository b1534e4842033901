"""Machines of offices and kitchens on their own cabinets."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb, ink_on, shade
from memorymaze.pictures.looks.paints import glass, glow, metal, paint
from memorymaze.pictures.looks.primitives import box, cylinder, lathed, tapered

WHITE: Rgb = (0.9, 0.9, 0.9)
STEEL: Rgb = (0.68, 0.7, 0.72)
DARK: Rgb = (0.1, 0.1, 0.11)


def coffee_machine(order: Order) -> Assembly:
    """Build a coffee machine on its cabinet: a display, spouts, a cup, a drip tray."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    split = order.height * 0.52 if order.height > 1.0 else 0.0
    colour = order.colour((0.15, 0.15, 0.16))
    if split:
        assembly.add(
            paint((0.5, 0.42, 0.35)),
            box((back, front - 0.02), order.y, (0, split - 0.03)),
        )
        assembly.add(
            paint((0.2, 0.2, 0.2), 0.3), box(order.x, order.y, (split - 0.03, split))
        )
        assembly.add(
            metal(STEEL),
            box(
                (front - 0.02, front - 0.005),
                (right - 0.12, right - 0.1),
                (split * 0.5, split * 0.75),
            ),
        )
    top = order.height
    body = paint(colour, 0.5)
    tall = top - split
    y = (left + 0.04, right - 0.04)
    assembly.add(
        body,
        box((back + 0.02, back + 0.55 * order.depth), y, (split, top), 0.02),
        box((back + 0.1, front - 0.06), y, (split + 0.58 * tall, top - 0.01), 0.03),
        box((back + 0.1, front - 0.03), y, (split, split + 0.1 * tall), 0.01),
    )
    trim = ink_ground(colour)
    nose = front - 0.06
    assembly.add(
        glow((0.35, 0.65, 0.85), 0.5),
        box(
            (nose - 0.02, nose + 0.008),
            (-0.09, 0.09),
            (top - 0.26 * tall, top - 0.1 * tall),
        ),
    )
    assembly.add(
        metal(STEEL),
        cylinder(0.014, (0, 0.07), 8).moved(nose - 0.07, -0.03, split + 0.52 * tall),
        cylinder(0.014, (0, 0.07), 8).moved(nose - 0.07, 0.03, split + 0.52 * tall),
        box(
            (nose - 0.14, nose + 0.02),
            (left + 0.08, right - 0.08),
            (split + 0.1 * tall, split + 0.12 * tall),
        ),
    )
    assembly.add(
        paint(WHITE, 0.4),
        lathed([(0.03, 0), (0.042, 0.09), (0.038, 0.09), (0.027, 0.01)], 12).moved(
            nose - 0.07, 0.0, split + 0.12 * tall
        ),
    )
    assembly.add(
        paint(trim),
        box(
            (nose - 0.02, nose + 0.006),
            (-0.16, 0.16),
            (top - 0.36 * tall, top - 0.33 * tall),
        ),
    )
    hopper = glass((0.35, 0.22, 0.12), 0.8)
    assembly.add(
        hopper,
        tapered(
            (back + 0.06, back + 0.26),
            (-0.1, 0.1),
            (top - 0.005, top + 0.14),
            (back + 0.03, back + 0.3),
            (-0.13, 0.13),
        ),
    )
    return assembly


def photocopier(order: Order) -> Assembly:
    """Build an office copier: paper drawers, an output bay, a lid and a panel."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    colour = order.colour(WHITE)
    body, dark = paint(colour, 0.2), paint((0.25, 0.27, 0.3))
    inner = (left + 0.16 * order.length, right - 0.16 * order.length)
    waist, lid = order.height * 0.62, order.height * 0.86
    assembly.add(body, box((back, front - 0.06), inner, (0.05, waist), 0.02))
    assembly.add(
        dark,
        box((back + 0.05, front - 0.1), (inner[0] + 0.03, inner[1] - 0.03), (0, 0.05)),
    )
    for row in range(3):
        z = 0.07 + row * (waist - 0.1) / 3
        assembly.add(
            paint(shade(colour, 0.92), 0.2),
            box(
                (front - 0.09, front - 0.045),
                (inner[0] + 0.02, inner[1] - 0.02),
                (z + 0.01, z + (waist - 0.1) / 3 - 0.01),
                0.006,
            ),
        )
        assembly.add(
            dark, box((front - 0.06, front - 0.04), (-0.1, 0.1), (z + 0.1, z + 0.12))
        )
    assembly.add(body, box((back, back + 0.3 * order.depth), inner, (waist, lid)))
    assembly.add(
        body, box((back, front - 0.08), (inner[0], inner[0] + 0.1), (waist, lid))
    )
    assembly.add(
        paint((0.97, 0.97, 0.96)),
        box(
            (back + 0.2, front - 0.14),
            (inner[0] + 0.16, inner[1] - 0.05),
            (waist, waist + 0.02),
        ),
    )
    assembly.add(body, box((back, front - 0.06), inner, (lid - 0.06, lid), 0.015))
    assembly.add(
        dark,
        box(
            (back + 0.02, front - 0.12),
            (inner[0] + 0.02, inner[1] - 0.02),
            (lid, order.height),
            0.03,
        ),
    )
    panel = tapered(
        (front - 0.16, front),
        (inner[1] - 0.34, inner[1]),
        (lid - 0.05, lid - 0.02),
        (front - 0.16, front),
        (inner[1] - 0.34, inner[1]),
    )
    assembly.add(dark, panel)
    assembly.add(
        glow((0.3, 0.6, 0.85), 0.5),
        box(
            (front - 0.13, front - 0.04),
            (inner[1] - 0.3, inner[1] - 0.14),
            (lid - 0.03, lid - 0.012),
        ),
    )
    assembly.add(
        paint((0.2, 0.7, 0.3)),
        box(
            (front - 0.1, front - 0.05),
            (inner[1] - 0.1, inner[1] - 0.04),
            (lid - 0.03, lid - 0.01),
        ),
    )
    tray = paint(shade(colour, 0.85))
    assembly.add(
        tray,
        box(
            (back + 0.12, front - 0.16),
            (left, inner[0] + 0.02),
            (waist * 0.8, waist * 0.8 + 0.03),
        ),
    )
    assembly.add(
        tray,
        box(
            (back + 0.12, front - 0.16),
            (inner[1] - 0.02, right),
            (waist * 0.6, waist * 0.6 + 0.03),
        ),
    )
    return assembly


def printer(order: Order) -> Assembly:
    """Build a printer, on a cabinet where it stands on the floor."""
    assembly = Assembly()
    back, front = order.x
    low = order.height * 0.55 if order.height > 0.8 else 0.0
    if low:
        assembly.add(
            paint((0.6, 0.5, 0.4)), box((back + 0.02, front - 0.04), order.y, (0, low))
        )
        assembly.add(
            metal(STEEL),
            box((front - 0.05, front - 0.03), (-0.06, 0.06), (low * 0.7, low * 0.75)),
        )
    colour = order.colour((0.55, 0.56, 0.58))
    tall = order.height - low
    y = (order.y[0] + 0.03, order.y[1] - 0.03)
    assembly.add(
        paint(colour, 0.2), box((back, front - 0.06), y, (low, low + 0.85 * tall), 0.03)
    )
    assembly.add(
        paint(DARK),
        box(
            (front - 0.12, front - 0.055),
            (y[0] + 0.06, y[1] - 0.06),
            (low + 0.45 * tall, low + 0.62 * tall),
        ),
    )
    assembly.add(
        paint((0.97, 0.97, 0.95)),
        box(
            (front - 0.2, front),
            (y[0] + 0.1, y[1] - 0.1),
            (low + 0.46 * tall, low + 0.48 * tall),
        ),
    )
    assembly.add(
        paint(shade(colour, 0.7)),
        box(
            (front - 0.08, front - 0.05),
            (y[0] + 0.03, y[1] - 0.03),
            (low + 0.06 * tall, low + 0.32 * tall),
            0.01,
        ),
    )
    feeder = box(
        (back + 0.02, back + 0.05),
        (y[0] + 0.1, y[1] - 0.1),
        (low + 0.8 * tall, order.height),
    )
    assembly.add(paint((0.97, 0.97, 0.95)), feeder)
    assembly.add(
        glow((0.3, 0.6, 0.85), 0.5),
        box(
            (front - 0.1, front - 0.056),
            (y[1] - 0.16, y[1] - 0.04),
            (low + 0.68 * tall, low + 0.78 * tall),
        ),
    )
    return assembly


def ink_ground(colour: Rgb) -> Rgb:
    """Return white on dark machines and a dark tone on light ones."""
    return (0.96, 0.96, 0.94) if ink_on(colour)[0] > 0.5 else shade(colour, 0.35)
