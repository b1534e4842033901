"""Kitchen things: fridges, microwaves, sinks, water coolers."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb, ink_on, shade
from memorymaze.pictures.looks.paints import glass, glow, metal, paint
from memorymaze.pictures.looks.primitives import box, cylinder, lathed
from memorymaze.pictures.looks.tubes import tube

WHITE: Rgb = (0.93, 0.93, 0.93)
STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.1, 0.1, 0.11)


def refrigerator(order: Order) -> Assembly:
    """Build a fridge: a small freezer door over a tall one, with long handles."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(WHITE)
    face = front - 0.04
    assembly.add(
        paint(shade(colour, 0.75), 0.2),
        box((back, face - 0.05), order.y, (0.03, order.height)),
    )
    split = order.height * 0.68
    for low, high in ((0.05, split - 0.006), (split + 0.006, order.height)):
        assembly.add(
            paint(colour, 0.5), box((face - 0.055, face), order.y, (low, high), 0.018)
        )
    assembly.add(paint(DARK), box((back + 0.04, face - 0.08), order.y, (0, 0.03)))
    y = order.y[0] + 0.08
    for low, high in ((split - 0.55, split - 0.06), (split + 0.06, split + 0.35)):
        assembly.add(
            metal(shade(STEEL, 0.6)),
            tube(
                [
                    (face, y, low),
                    (front - 0.012, y, low),
                    (front - 0.012, y, high),
                    (face, y, high),
                ],
                0.012,
                6,
            ),
        )
    notes = ((0.98, 0.9, 0.4), (0.6, 0.85, 0.95), (0.95, 0.6, 0.6))
    for place, tone in enumerate(notes):
        z = split - 0.2 - 0.13 * place
        assembly.add(
            paint(tone),
            box(
                (face - 0.01, face + 0.004),
                (0.02 + 0.06 * place, 0.12 + 0.06 * place),
                (z, z + 0.1),
            ),
        )
    return assembly


def microwave(order: Order) -> Assembly:
    """Build a microwave oven: a dark window, keys and a lit clock."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(WHITE)
    face = front - 0.03
    assembly.add(
        paint(colour, 0.3), box((back, face), order.y, (0.015, order.height), 0.012)
    )
    for side in (-1, 1):
        y = side * order.length * 0.4
        assembly.add(
            paint(DARK),
            box((back + 0.03, face - 0.03), (y - 0.02, y + 0.02), (0, 0.02)),
        )
    keys = order.y[1] - 0.24 * order.length
    low, high = 0.1 * order.height, 0.93 * order.height
    trim = (0.06, 0.06, 0.07) if ink_on(colour)[0] < 0.5 else (0.3, 0.31, 0.33)
    assembly.add(
        paint(trim, 0.7),
        box((face - 0.01, face + 0.006), (order.y[0] + 0.03, keys - 0.03), (low, high)),
    )
    assembly.add(
        metal(STEEL),
        box((face, front), (keys - 0.025, keys - 0.008), (low, high), 0.006),
    )
    assembly.add(
        glow((0.15, 0.85, 0.5), 0.6),
        box(
            (face - 0.01, face + 0.006),
            (keys + 0.015, order.y[1] - 0.025),
            (high - 0.05, high),
        ),
    )
    for row in range(4):
        for column in range(3):
            y, z = keys + 0.016 + 0.028 * column, low + row * (high - low - 0.07) / 4
            assembly.add(
                paint((0.6, 0.62, 0.64)),
                box((face - 0.01, face + 0.005), (y, y + 0.021), (z, z + 0.03)),
            )
    return assembly


def water_cooler(order: Order) -> Assembly:
    """Build a water dispenser with a blue bottle on top and two taps."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(WHITE)
    body = 0.72 * order.height
    assembly.add(
        paint(colour, 0.2), box((back, front - 0.03), order.y, (0, body), 0.025)
    )
    low, high = body * 0.6, body * 0.9
    half = order.length * 0.36
    assembly.add(
        paint(shade(colour, 0.6)),
        box((front - 0.06, front - 0.024), (-half, half), (low, high)),
    )
    for y, tone in ((-0.06, (0.8, 0.15, 0.15)), (0.06, (0.15, 0.35, 0.8))):
        assembly.add(
            paint(tone),
            box(
                (front - 0.04, front),
                (y - 0.022, y + 0.022),
                (high - 0.09, high - 0.04),
                0.008,
            ),
        )
    assembly.add(
        metal(STEEL),
        box((front - 0.05, front), (-half, half), (low - 0.015, low + 0.01)),
    )
    radius = min(order.length, order.depth) * 0.4
    tall = order.height - body
    assembly.add(
        glass((0.45, 0.7, 0.9), 0.75),
        lathed(
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
        ),
    )
    return assembly


def sink(order: Order) -> Assembly:
    """Build a basin with a bent tap."""
    assembly = Assembly()
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
    assembly.add(metal(colour), basin)
    assembly.add(
        metal(colour), box((back, back + 0.09), order.y, (rim * 0.55, rim), 0.01)
    )
    assembly.add(paint(DARK), cylinder(0.025, (rim * 0.35, rim * 0.4), 10))
    tap = metal((0.36, 0.38, 0.42))
    high = order.height - 0.02
    assembly.add(
        tap,
        tube(
            [
                (back + 0.05, 0, rim - 0.02),
                (back + 0.05, 0, high - 0.03),
                (back + 0.08, 0, high),
                (back + 0.17, 0, high),
                (back + 0.19, 0, high - 0.05),
            ],
            0.02,
            8,
        ),
    )
    for side, water in ((-1, (0.15, 0.3, 0.75)), (1, (0.8, 0.12, 0.12))):
        assembly.add(
            paint(water),
            cylinder(0.03, (rim, rim + 0.05), 8).moved(back + 0.06, side * 0.12),
        )
    return assembly
