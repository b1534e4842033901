"""Things of a building or a hall: pillars, escalators, clocks, pianos, lamps."""

import math

from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import sign_board
from memorymaze.simulation.looks.colours import Rgb, ink_on, shade
from memorymaze.simulation.looks.paints import glass, glow, metal, paint, picture, wood
from memorymaze.simulation.looks.primitives import (
    box,
    cylinder,
    extruded,
    lathed,
    plate,
    tapered,
)
from memorymaze.simulation.looks.tubes import tube

__all__ = [
    "clock",
    "escalator",
    "floor_lamp",
    "grand_piano",
    "grandfather_clock",
    "piano",
    "pillar",
]

STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.1, 0.1, 0.11)
IVORY: Rgb = (0.96, 0.95, 0.91)


def pillar(order: Order) -> Assembly:
    """Build a round column with a foot and a head."""
    assembly = Assembly()
    r, top = 0.5, order.height
    lip = 0.12 * min(order.length, order.depth) / r
    profile = [
        (r, 0),
        (r, lip),
        (r * 0.92, lip * 1.3),
        (r * 0.92, top - lip * 1.3),
        (r, top - lip),
        (r, top),
    ]
    assembly.add(
        order.body((0.9, 0.9, 0.89), 0.1),
        lathed(profile, 28).scaled(order.depth, order.length, 1),
    )
    return assembly


def escalator(order: Order) -> Assembly:
    """Build the end of an escalator: handrails on glass, steps, a comb, its words."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    steel = metal(order.colour(STEEL))
    rubber = paint(DARK, 0.2)
    wall = min(0.2, 0.16 * order.length)
    deep = order.depth > 1.2
    nose = min(0.35, 0.25 * order.depth)
    for y in ((left, left + wall), (right - wall, right)):
        middle = sum(y) / 2
        skirt = order.height * 0.3
        assembly.add(steel, box((back, front - nose * 0.5), y, (0, skirt), 0.015))
        assembly.add(
            glass((0.7, 0.85, 0.88), 0.35),
            box(
                (back, front - nose),
                (middle - 0.012, middle + 0.012),
                (skirt, order.height - 0.06),
            ),
        )
        r = (order.height - 0.04 - skirt) / 2
        rail = [
            (back + 0.05, middle, order.height - 0.045),
            (front - nose, middle, order.height - 0.045),
        ]
        for step in range(1, 8):
            a = math.pi / 2 - math.pi * step / 8
            rail.append((
                front - nose + (nose - 0.05) * math.cos(a),
                middle,
                skirt + r + (r - 0.01) * math.sin(a),
            ))
        assembly.add(rubber, tube(rail, 0.042, 8))
    inner = (left + wall, right - wall)
    assembly.add(steel, box((front - nose * 1.6, front), inner, (0, 0.012)))
    run = order.depth - nose * 1.6
    count = max(2, round(run / 0.3))
    slope = 0.3 if deep and "up" not in (order.text or "").lower() else 0.0
    for step in range(count):
        x = (
            back + run * (count - 1 - step) / count,
            back + run * (count - step) / count - 0.008,
        )
        z = 0.01 + slope * 0.0 * step
        assembly.add(paint((0.3, 0.31, 0.33), 0.3), box(x, inner, (z, z + 0.02)))
        assembly.add(
            paint((0.95, 0.8, 0.1)),
            box((x[1] - 0.03, x[1]), inner, (z + 0.015, z + 0.026)),
        )
        for groove in range(9):
            y = inner[0] + (inner[1] - inner[0]) * (groove + 0.5) / 9
            assembly.add(
                paint((0.5, 0.51, 0.53), 0.3),
                box((x[0], x[1] - 0.03), (y - 0.012, y + 0.012), (z + 0.01, z + 0.024)),
            )
    if order.text:
        wide = order.length * 0.62
        tall = 0.26
        pixels = sign_board(wide, tall, order.text, (0.0, 0.35, 0.55))
        x = back if deep else back
        assembly.add(
            picture(pixels, 0.2),
            plate(
                (x, x + 0.05),
                (-wide / 2, wide / 2),
                (order.height - tall, order.height),
            ),
        )
        for side in (-1, 1):
            assembly.add(
                steel,
                box(
                    (x, x + 0.03),
                    (side * wide * 0.4 - 0.015, side * wide * 0.4 + 0.015),
                    (0, order.height - tall),
                ),
            )
    return assembly


def clock(order: Order) -> Assembly:
    """Build a round wall clock with marks and hands at ten past ten."""
    assembly = Assembly()
    back, front = order.x
    r = min(order.length, order.height) / 2
    z = order.height / 2
    rim = order.colour((0.93, 0.93, 0.92))
    face: Rgb = (0.97, 0.97, 0.96)
    case = shade(rim, 0.35) if ink_on(rim)[0] < 0.5 else rim
    body = lathed(
        [
            (r, 0),
            (r, order.depth),
            (r * 0.9, order.depth),
            (r * 0.88, order.depth * 0.7),
            (0, order.depth * 0.7),
        ],
        32,
    )
    assembly.add(paint(case, 0.4), body.turned("y", 90).moved(back, 0, z))
    dial = front - order.depth * 0.2
    assembly.add(
        paint(face),
        cylinder(r * 0.89, (0, order.depth * 0.12), 32)
        .turned("y", 90)
        .moved(dial - order.depth * 0.12, 0, z),
    )
    ink = paint((0.08, 0.08, 0.1))
    for hour in range(12):
        long_way = 0.2 if hour % 3 == 0 else 0.11
        mark = box(
            (dial - 0.004, dial + 0.002),
            (-0.025 * r, 0.025 * r),
            ((0.84 - long_way) * r, 0.84 * r),
        )
        assembly.add(ink, mark.turned("x", 30.0 * hour).moved(z=z))
    for degrees, reach, wide in ((-60.0, 0.7, 0.03), (55.0, 0.5, 0.045)):
        hand = box((dial, dial + 0.005), (-wide * r, wide * r), (-0.1 * r, reach * r))
        assembly.add(ink, hand.turned("x", degrees).moved(z=z))
    assembly.add(
        ink, cylinder(0.06 * r, (0, 0.008), 10).turned("y", 90).moved(dial, 0, z)
    )
    return assembly


def grandfather_clock(order: Order) -> Assembly:
    """Build a tall wooden clock with a dial, a pendulum behind glass, and a hood."""
    assembly = Assembly()
    back, front = order.x
    body = wood(order.colour((0.38, 0.25, 0.16)))
    h = order.height
    narrow = order.length * 0.36
    assembly.add(
        body,
        box((back, front), order.y, (0, 0.06 * h)),
        box(
            (back, front - 0.02),
            (-order.length * 0.46, order.length * 0.46),
            (0.06 * h, 0.24 * h),
        ),
    )
    assembly.add(body, box((back, back + 0.04), (-narrow, narrow), (0.24 * h, 0.7 * h)))
    for side in (-1, 1):
        y = sorted((side * narrow, side * (narrow - 0.07)))
        assembly.add(body, box((back, front - 0.05), (y[0], y[1]), (0.24 * h, 0.7 * h)))
    assembly.add(
        body,
        box(
            (back, front - 0.02),
            (-order.length * 0.46, order.length * 0.46),
            (0.7 * h, 0.93 * h),
        ),
    )
    hood = [
        (-order.length / 2, 0.93 * h),
        (order.length / 2, 0.93 * h),
        (order.length * 0.42, 0.95 * h),
        (0.06, h),
        (-0.06, h),
        (-order.length * 0.42, 0.95 * h),
    ]
    assembly.add(body, extruded(hood, (back, front), "x"))
    dial = Order("clock", order.length * 0.74, 0.03, order.length * 0.74, "gold")
    assembly.include(clock(dial), x=front - 0.012, z=0.815 * h - order.length * 0.37)
    brass = metal((0.83, 0.66, 0.25))
    assembly.add(
        brass,
        tube([(0, 0, 0.68 * h), (0, 0, 0.38 * h)], 0.008, 5),
        cylinder(0.075, (-0.01, 0.012), 18).turned("y", 90).moved(0, 0, 0.36 * h),
    )
    assembly.add(
        glass(alpha=0.2),
        box(
            (front - 0.07, front - 0.06),
            (-narrow + 0.07, narrow - 0.07),
            (0.24 * h, 0.7 * h),
        ),
    )
    return assembly


def piano(order: Order) -> Assembly:
    """Build an upright piano with its keys, a music desk and pedals."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    body = paint(order.colour(DARK), 0.7)
    h = order.height
    keys = 0.6 * h
    rear = back + 0.5 * order.depth
    assembly.add(
        body,
        box((back, rear), order.y, (0.06, h - 0.03), 0.01),
        box((back, rear + 0.02), order.y, (h - 0.03, h), 0.01),
    )
    assembly.add(body, box((rear, front), order.y, (keys - 0.12, keys - 0.03)))
    for y in ((left, left + 0.06), (right - 0.06, right)):
        assembly.add(
            body,
            box((rear, front), y, (keys - 0.03, keys + 0.05), 0.01),
            box((front - 0.1, front - 0.02), y, (0, keys - 0.12)),
        )
        assembly.add(body, box((back, front), y, (0, 0.06)))
    _keyboard(assembly, (rear, front - 0.04), (left + 0.06, right - 0.06), keys - 0.03)
    assembly.add(
        body,
        box((rear, rear + 0.03), (left * 0.5, right * 0.5), (keys + 0.1, keys + 0.14)),
    )
    assembly.add(
        paint(IVORY),
        box(
            (rear + 0.002, rear + 0.012),
            (left * 0.3, right * 0.3),
            (keys + 0.14, keys + 0.38),
        ),
    )
    for y in (-0.12, 0.0, 0.12):
        assembly.add(
            metal((0.8, 0.65, 0.3)),
            box((rear, rear + 0.12), (y - 0.025, y + 0.025), (0.05, 0.07)),
        )
    return assembly


def grand_piano(order: Order) -> Assembly:
    """Build a grand piano with its lid up, its keys to the front."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    body = paint(order.colour(DARK), 0.8)
    h = order.height
    low, rim = 0.56 * h, 0.72 * h
    curve = [
        (front, left),
        (front, right),
        (0.1 * order.depth, right),
        (-0.1 * order.depth, right * 0.82),
        (-0.25 * order.depth, right * 0.45),
        (-0.42 * order.depth, right * 0.1),
        (back, left * 0.3),
        (back + 0.02, left * 0.7),
        (-0.4 * order.depth, left),
    ]
    assembly.add(body, extruded(curve, (low, rim - 0.05), "z"))
    shelf = 0.28 * order.depth
    strings = [(x, y) for x, y in curve if x < shelf]
    inner = [(x * 0.94, y * 0.94) for x, y in [(shelf, right), *strings, (shelf, left)]]
    assembly.add(
        metal((0.78, 0.6, 0.25)), extruded(inner, (rim - 0.05, rim - 0.03), "z")
    )
    assembly.add(
        body, box((shelf - 0.02, shelf + 0.06), order.y, (rim - 0.05, rim + 0.02))
    )
    for y in ((left, left + 0.08), (right - 0.08, right)):
        assembly.add(body, box((shelf, front), y, (rim - 0.05, rim)))
    _keyboard(
        assembly, (shelf + 0.06, front - 0.02), (left + 0.08, right - 0.08), rim - 0.05
    )
    lid = extruded(
        [(x, y) for x, y in [(shelf, right), *strings, (shelf, left)]], (0.0, 0.02), "z"
    )
    lid = lid.moved(y=-left).turned("x", 38).moved(y=left, z=rim)
    high = lid.vertices[:, 2].max()
    lid = lid.moved(z=-rim).scaled(1, 1, (h - rim) / (high - rim)).moved(z=rim)
    assembly.add(body, lid)
    assembly.add(
        body,
        tube(
            [
                (0.05, right * 0.8, rim - 0.04),
                (0.05, right * 0.35, rim + 0.5 * (h - rim)),
            ],
            0.012,
            5,
        ),
    )
    for x, y in (
        (front * 0.75, left * 0.82),
        (front * 0.75, right * 0.82),
        (back * 0.7, left * 0.45),
    ):
        assembly.add(
            body,
            tapered(
                (x - 0.035, x + 0.035),
                (y - 0.035, y + 0.035),
                (0, low),
                (x - 0.06, x + 0.06),
                (y - 0.06, y + 0.06),
            ),
        )
    assembly.add(body, box((front * 0.45, front * 0.55), (-0.09, 0.09), (0.1, low)))
    for y in (-0.06, 0.0, 0.06):
        assembly.add(
            metal((0.8, 0.65, 0.3)),
            box((front * 0.5, front * 0.72), (y - 0.018, y + 0.018), (0.06, 0.08)),
        )
    return assembly


def floor_lamp(order: Order) -> Assembly:
    """Build a lamp with a cloth shade on a tall foot."""
    assembly = Assembly()
    r = min(order.length, order.depth) / 2
    h = order.height
    stand = metal(order.colour(DARK))
    assembly.add(
        stand,
        lathed(
            [
                (r * 0.75, 0),
                (r * 0.72, 0.02),
                (0.03, 0.05),
                (0.014, 0.08),
                (0.014, 0.86 * h),
            ],
            18,
        ),
    )
    cloth = [(r, 0.8 * h), (r * 0.7, h), (r * 0.66, h), (r * 0.95, 0.81 * h)]
    assembly.add(glow((0.97, 0.9, 0.72), 0.6), lathed(cloth, 22))
    return assembly


def _keyboard(
    assembly: Assembly, x: tuple[float, float], y: tuple[float, float], z: float
) -> None:
    assembly.add(paint(IVORY, 0.4), box(x, y, (z, z + 0.02)))
    black = paint(DARK, 0.4)
    count = 28
    step = (y[1] - y[0]) / count
    for key in range(1, count):
        middle = y[0] + key * step
        if key % 7 not in {0, 3}:
            assembly.add(
                black,
                box(
                    (x[0], x[0] + 0.6 * (x[1] - x[0])),
                    (middle - 0.25 * step, middle + 0.25 * step),
                    (z + 0.02, z + 0.032),
                ),
            )
