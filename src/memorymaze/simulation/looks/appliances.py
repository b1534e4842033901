"""Kitchen and water: fridges, microwaves, coolers, fountains, sinks, sanitizers."""

from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import sign_board
from memorymaze.simulation.looks.colours import Rgb, ink_on, shade
from memorymaze.simulation.looks.paints import glass, glow, metal, paint, picture
from memorymaze.simulation.looks.primitives import box, cylinder, lathed, plate
from memorymaze.simulation.looks.tubes import tube

__all__ = [
    "drinking_fountain",
    "eyewash_station",
    "hand_sanitizer",
    "microwave",
    "refrigerator",
    "sanitizer_stand",
    "sink",
    "water_cooler",
]

WHITE: Rgb = (0.93, 0.93, 0.93)
STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.1, 0.1, 0.11)
WATER: Rgb = (0.35, 0.62, 0.85)


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


def drinking_fountain(order: Order) -> Assembly:
    """Build a drinking fountain: a basin with a bubbler and a push bar."""
    assembly = Assembly()
    back, front = order.x
    steel = metal(order.colour(STEEL))
    low = order.height * (0.62 if order.mount == "floor" else 0.5)
    rim = order.height * 0.9
    half = order.length / 2
    assembly.add(
        steel, box((back, back + 0.06), (-half, half), (low * 0.5, order.height), 0.01)
    )
    pillar = 0.3 * order.length
    foot = 0.0
    assembly.add(
        paint(shade(order.colour(STEEL), 0.7), 0.4),
        box(
            (back, back + 0.6 * order.depth),
            (-pillar, pillar),
            (foot, low + 0.05),
            0.02,
        ),
    )
    basin = lathed(
        [
            (0.55, low),
            (0.9, low + 0.35 * (rim - low)),
            (1.0, rim),
            (0.9, rim),
            (0.45, rim - 0.08),
            (0.0, rim - 0.1),
        ],
        20,
    ).scaled(order.depth / 2, half, 1.0)
    assembly.add(steel, basin)
    assembly.add(paint(DARK), cylinder(0.03, (rim - 0.1, rim - 0.09), 10))
    assembly.add(
        metal((0.85, 0.86, 0.88)),
        tube(
            [
                (back * 0.5, half * 0.5, rim - 0.06),
                (back * 0.5, half * 0.5, rim + 0.04),
                (back * 0.2, half * 0.3, rim + 0.06),
            ],
            0.014,
            6,
        ),
    )
    assembly.add(
        glass(WATER, 0.6),
        tube(
            [
                (back * 0.2, half * 0.3, rim + 0.06),
                (0.0, half * 0.1, rim + 0.07),
                (front * 0.2, -half * 0.1, rim - 0.08),
            ],
            0.008,
            5,
        ),
    )
    assembly.add(
        paint((0.15, 0.35, 0.7)),
        box(
            (front - 0.03, front),
            (-half * 0.4, half * 0.4),
            (rim - 0.1, rim - 0.04),
            0.01,
        ),
    )
    return assembly


def sink(order: Order) -> Assembly:
    """Build a basin with a bent tap."""
    assembly = Assembly()
    back, front = order.x
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
    tap = metal((0.86, 0.87, 0.9))
    high = order.height - 0.012
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
            0.013,
            8,
        ),
    )
    for side in (-1, 1):
        assembly.add(
            tap, cylinder(0.022, (rim, rim + 0.04), 8).moved(back + 0.05, side * 0.09)
        )
    return assembly


def eyewash_station(order: Order) -> Assembly:
    """Build an emergency eyewash: a sign over a bowl with two jets and a lever."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour((0.1, 0.5, 0.3))
    tall = 0.42 * order.height
    pixels = sign_board(order.length, tall, order.text or "EYE WASH", (0.0, 0.48, 0.24))
    assembly.add(
        picture(pixels),
        plate((back, back + 0.02), order.y, (order.height - tall, order.height)),
    )
    rim = order.height * 0.42
    bowl = lathed(
        [
            (0.2, rim - 0.16),
            (0.8, rim - 0.06),
            (1.0, rim),
            (0.9, rim),
            (0.3, rim - 0.1),
            (0, rim - 0.11),
        ],
        18,
    ).scaled(order.depth * 0.45, order.length * 0.48, 1.0)
    assembly.add(paint((0.9, 0.85, 0.2), 0.4), bowl.moved(x=order.depth * 0.05))
    assembly.add(
        paint(colour),
        tube([(back + 0.03, 0, 0), (back + 0.03, 0, rim + 0.08)], 0.025, 8),
    )
    for side in (-1, 1):
        y = side * 0.07
        assembly.add(
            paint(colour),
            tube(
                [
                    (back + 0.03, y, rim),
                    (0.02, y, rim + 0.0),
                    (0.03, y * 0.9, rim + 0.06),
                ],
                0.014,
                6,
            ),
        )
        assembly.add(
            glass(WATER, 0.6),
            tube([(0.03, y * 0.9, rim + 0.06), (0.02, y * 0.5, rim + 0.13)], 0.01, 5),
        )
    assembly.add(
        metal(STEEL),
        box(
            (front - 0.12, front),
            (order.y[1] - 0.06, order.y[1] - 0.02),
            (rim - 0.03, rim + 0.03),
            0.01,
        ),
    )
    return assembly


def hand_sanitizer(order: Order) -> Assembly:
    """Build a soap dispenser for the wall: a white body, a window, a lever."""
    assembly = Assembly()
    back, front = order.x
    top = order.height
    assembly.add(
        paint(order.colour(WHITE), 0.3),
        box((back, front - 0.025), order.y, (0.22 * top, top), 0.02),
    )
    half = order.length * 0.22
    assembly.add(
        paint((0.35, 0.65, 0.85), 0.6),
        box(
            (front - 0.04, front - 0.02), (-half, half), (0.55 * top, 0.88 * top), 0.008
        ),
    )
    assembly.add(
        paint((0.55, 0.58, 0.6)),
        box(
            (front - 0.06, front),
            (-half * 1.3, half * 1.3),
            (0.12 * top, 0.42 * top),
            0.01,
        ),
    )
    assembly.add(paint(DARK), cylinder(0.012, (0, 0.24 * top), 8).moved(x=front - 0.05))
    return assembly


def sanitizer_stand(order: Order) -> Assembly:
    """Build a hand sanitizer dispenser on a pole with a round foot and a drip tray."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    steel = metal(STEEL)
    assembly.add(steel, lathed([(radius, 0), (radius, 0.015), (0.04, 0.03)], 18))
    assembly.add(steel, cylinder(0.022, (0.02, order.height * 0.75), 10))
    assembly.add(
        steel,
        lathed([(0.3, 0), (1.0, 0.03), (0.95, 0.03), (0.2, 0.012), (0, 0.01)], 14)
        .scaled(0.09, 0.09, 1)
        .moved(0.08, 0, order.height * 0.55),
    )
    head = Order(order.category, 0.15, 0.13, order.height * 0.28, order.colour_words)
    assembly.include(hand_sanitizer(head), x=0.05, z=order.height * 0.72)
    pixels = sign_board(0.22, 0.12, order.text or "", (0.15, 0.5, 0.75))
    assembly.add(
        picture(pixels),
        plate((-0.03, -0.015), (-0.11, 0.11), (order.height * 0.9, order.height)),
    )
    return assembly
