"""Animals, and the bones of those that died out."""

from memorymaze.pictures.looks.assembly import Assembly, Order, built, plinth
from memorymaze.pictures.looks.materials import PITCH, Rgb, metal, paint, shade
from memorymaze.pictures.looks.shapes import around, ellipsoid
from memorymaze.pictures.looks.tubes import limb

BONE: Rgb = (0.88, 0.82, 0.68)


def animal(made: Assembly, order: Order) -> None:
    """Build a four-legged animal on a low base, its side to the front where it is long."""
    base = 0.2 * order.height if order.text else 0.06
    plinth(made, order, base, (0.75, 0.82, 0.86))
    long_way = max(order.length, order.depth)
    figure = built(_four_legs, long_way * 0.94, order.height - base, order)
    if order.length > order.depth:
        figure.turn(90)
    made.include(figure, z=base)


def _four_legs(figure: Assembly, long_way: float, tall: float, order: Order) -> None:
    """Build an animal that looks along +x."""
    colour = order.colour((0.6, 0.45, 0.3))
    fur = paint(colour, 0.02)
    s = long_way
    body, wide = 0.62 * tall, min(0.24 * tall, 0.2 * s)
    barrel = [
        (-0.36 * s, 0, body),
        (-0.1 * s, 0, body + 0.03 * tall),
        (0.18 * s, 0, body + 0.02 * tall),
    ]
    figure.limb(fur, barrel, [wide * 0.95, wide * 1.08, wide * 0.85], 12)
    figure.limb(
        fur,
        [(0.16 * s, 0, body + 0.08 * tall), (0.33 * s, 0, body + 0.2 * tall)],
        [wide * 0.68, wide * 0.5],
        10,
    )
    figure.ball(fur, wide * 0.62, 12, 9, at=(0.36 * s, 0, body + 0.22 * tall))
    figure.limb(
        fur,
        [(0.38 * s, 0, body + 0.2 * tall), (0.46 * s, 0, body + 0.16 * tall)],
        [wide * 0.38, wide * 0.24],
        8,
    )
    figure.ball(
        paint(PITCH),
        wide * 0.13,
        8,
        6,
        at=(0.46 * s + wide * 0.24, 0, body + 0.18 * tall),
    )
    for side in (-1, 1):
        figure.ball(
            fur,
            wide * 0.2,
            8,
            6,
            at=(0.33 * s, side * wide * 0.5, body + 0.22 * tall + wide * 0.52),
        )
        figure.ball(
            paint(PITCH),
            wide * 0.07,
            6,
            4,
            at=(
                0.36 * s + wide * 0.5,
                side * wide * 0.26,
                body + 0.22 * tall + wide * 0.24,
            ),
        )
        for x, lean in ((-0.32 * s, -0.02), (0.2 * s, 0.05)):
            y = side * wide * 0.6
            step = lean * s * side
            figure.limb(
                fur,
                [
                    (x, y, body - 0.02 * tall),
                    (x + step, y, 0.3 * tall),
                    (x + step * 0.6, y, 0.06 * tall),
                ],
                [wide * 0.52, wide * 0.38, wide * 0.32],
                9,
            )
            figure.add(
                fur,
                ellipsoid(
                    (x + step * 0.6 + 0.02 * s, y, 0.05 * tall),
                    (wide * 0.46, wide * 0.36, 0.05 * tall),
                    9,
                    6,
                ),
            )
    figure.ball(
        paint(shade(colour, 0.97), 0.02),
        wide * 0.2,
        8,
        6,
        at=(-0.36 * s - wide * 0.9, 0, body + 0.06 * tall),
    )


def dinosaur_skull(made: Assembly, order: Order) -> None:
    """Build a dinosaur's skull with teeth on a pedestal with its words."""
    base = 0.42 * order.height
    plinth(made, order, base, (0.35, 0.28, 0.22))
    bone, dark = paint(order.colour(BONE), 0.1), paint(PITCH)
    rise = order.height - base
    s = order.length * 0.98
    z = base + 0.12 * rise
    head = Assembly()
    stand = metal((0.25, 0.25, 0.27))
    head.tube(
        stand, [(-0.12 * s, 0, base - 0.02), (-0.12 * s, 0, z + 0.35 * rise)], 0.02, 6
    )
    deep = order.depth * 0.3
    head.add(
        bone,
        limb(
            [
                (-0.3 * s, 0, z + 0.55 * rise),
                (-0.05 * s, 0, z + 0.56 * rise),
                (0.2 * s, 0, z + 0.45 * rise),
                (0.42 * s, 0, z + 0.36 * rise),
            ],
            [0.26 * rise, 0.25 * rise, 0.18 * rise, 0.11 * rise],
            10,
        ).scaled(1, deep / (0.26 * rise), 1),
    )
    head.add(
        bone,
        limb(
            [
                (-0.32 * s, 0, z + 0.2 * rise),
                (0.05 * s, 0, z + 0.1 * rise),
                (0.4 * s, 0, z + 0.12 * rise),
            ],
            [0.1 * rise, 0.09 * rise, 0.065 * rise],
            9,
        ).scaled(1, deep / (0.16 * rise), 1),
    )
    for side in (-1, 1):
        y = side * deep * 0.86
        head.add(
            dark,
            ellipsoid(
                (-0.12 * s, y, z + 0.63 * rise), (0.07 * s, 0.05, 0.1 * rise), 10, 8
            ),
        )
        head.add(
            dark,
            ellipsoid(
                (0.12 * s, y * 0.8, z + 0.54 * rise),
                (0.05 * s, 0.04, 0.06 * rise),
                8,
                6,
            ),
        )
        head.add(
            dark,
            ellipsoid(
                (0.38 * s, y * 0.45, z + 0.42 * rise),
                (0.03 * s, 0.03, 0.035 * rise),
                8,
                6,
            ),
        )
        head.tube(
            bone,
            [
                (-0.34 * s, y * 0.7, z + 0.6 * rise),
                (-0.32 * s, y * 0.9, z + 0.2 * rise),
            ],
            0.06 * rise,
            7,
        )
        for tooth in range(9):
            x = (0.0 + 0.05 * tooth) * s
            at = y * (0.75 - 0.045 * tooth)
            top = z + (0.36 - 0.012 * tooth) * rise
            head.tube(
                paint((0.97, 0.95, 0.88)),
                [(x, at, top), (x, at, top - 0.13 * rise)],
                [0.016, 0.003],
                5,
            )
    head.turn(90)
    made.include(head)


def whale_skeleton(made: Assembly, order: Order) -> None:
    """Build a whale's bones along a wall: a long skull, ribs, a backbone, flippers."""
    bone = paint(order.colour(BONE), 0.1)
    half, tall = order.length / 2, order.height
    deep = order.depth * 0.94
    strip = 0.16 * tall if order.text else 0.0
    made.box(paint((0.1, 0.2, 0.34)), order.x.start(0.02), order.y, (strip, tall))
    made.words(order.text, (0.1, 0.2, 0.34), order.x.start(0.02), order.y, (0, strip))
    spine = 0.66 * tall
    path = [
        (0.0, -half * 0.5, spine),
        (0.0, 0.0, spine + 0.06 * tall),
        (0.0, half * 0.5, spine),
        (0.0, half * 0.97, spine - 0.1 * tall),
    ]
    made.tube(bone, path, [0.06 * tall, 0.055 * tall, 0.04 * tall, 0.015 * tall], 8)
    for place in range(20):
        y = -half * 0.48 + half * 1.4 * place / 20
        size = 0.085 * tall * (1 - 0.55 * place / 20)
        made.box(
            bone,
            around(0, 0.3 * size),
            around(y, 0.012 * tall),
            (spine, spine + 0.08 * tall + size),
        )
    for place in range(9):
        y = -half * 0.42 + half * 0.07 * place * 1.2
        drop = tall * (0.5 - 0.012 * (place - 3) ** 2)
        for side in (-1, 1):
            rib = [
                (0, y, spine + 0.04 * tall),
                (side * deep * 0.46, y + 0.04, spine - 0.35 * drop),
                (side * deep * 0.4, y + 0.09, spine - 0.8 * drop),
                (side * deep * 0.15, y + 0.12, spine - drop),
            ]
            made.tube(
                bone, rib, [0.022 * tall, 0.02 * tall, 0.017 * tall, 0.008 * tall], 5
            )
    start = -half * 0.5
    made.add(
        bone,
        limb(
            [(0, start + 0.02, spine), (0, start - half * 0.1, spine - 0.02 * tall)],
            [0.13 * tall, 0.15 * tall],
            9,
        ).scaled(deep / tall * 2.6, 1, 1),
    )
    made.tube(
        bone,
        [
            (0, start - half * 0.08, spine + 0.02 * tall),
            (0, -half * 0.8, spine + 0.02 * tall),
            (0, -half, spine - 0.14 * tall),
        ],
        [0.11 * tall, 0.06 * tall, 0.012 * tall],
        7,
    )
    for side in (-1, 1):
        jaw = [
            (side * deep * 0.3, start - 0.02, spine - 0.14 * tall),
            (side * deep * 0.42, -half * 0.75, spine - 0.3 * tall),
            (side * deep * 0.1, -half * 0.99, spine - 0.2 * tall),
        ]
        made.tube(bone, jaw, [0.035 * tall, 0.032 * tall, 0.014 * tall], 6)
        arm = [
            (side * deep * 0.34, -half * 0.38, spine - 0.24 * tall),
            (side * deep * 0.44, -half * 0.3, spine - 0.46 * tall),
            (side * deep * 0.4, -half * 0.18, 0.2 * tall),
        ]
        made.tube(bone, arm, [0.035 * tall, 0.028 * tall, 0.01 * tall], 6)
    wire = metal((0.5, 0.5, 0.52))
    for y in (-half * 0.4, half * 0.4):
        made.tube(wire, [(0, y, spine), (0, y, tall)], 0.008, 4)


def dinosaur_skeleton(made: Assembly, order: Order) -> None:
    """Build the standing bones of a two-legged dinosaur on a base."""
    base = 0.1 * order.height
    plinth(made, order, base, (0.35, 0.28, 0.22))
    bone = paint(order.colour(BONE), 0.1)
    long_way = max(order.length, order.depth) * 0.48
    h = order.height - base
    figure = Assembly()
    path = [
        (-long_way, 0, 0.5 * h),
        (-0.4 * long_way, 0, 0.52 * h),
        (0.1 * long_way, 0, 0.6 * h),
        (0.45 * long_way, 0, 0.78 * h),
        (0.6 * long_way, 0, 0.92 * h),
    ]
    figure.tube(bone, path, [0.006 * h, 0.025 * h, 0.045 * h, 0.03 * h, 0.025 * h], 7)
    figure.add(
        bone,
        limb(
            [(0.6 * long_way, 0, 0.93 * h), (0.95 * long_way, 0, 0.88 * h)],
            [0.07 * h, 0.04 * h],
            8,
        ),
        limb(
            [(0.62 * long_way, 0, 0.85 * h), (0.93 * long_way, 0, 0.8 * h)], 0.02 * h, 6
        ),
    )
    for place in range(7):
        x = (-0.1 + 0.08 * place) * long_way
        z = (0.56 + 0.018 * place) * h
        for side in (-1, 1):
            figure.tube(
                bone,
                [
                    (x, 0, z),
                    (x, side * 0.13 * h, z - 0.12 * h),
                    (x + 0.03 * h, side * 0.05 * h, z - 0.25 * h),
                ],
                [0.014 * h, 0.012 * h, 0.006 * h],
                5,
            )
    for side in (-1, 1):
        y = side * 0.09 * h
        figure.tube(
            bone,
            [
                (-0.1 * long_way, y, 0.54 * h),
                (0.08 * long_way, y, 0.3 * h),
                (-0.08 * long_way, y, 0.12 * h),
                (0.0, y, 0.0),
            ],
            [0.035 * h, 0.03 * h, 0.022 * h, 0.02 * h],
            6,
        )
        figure.tube(
            bone,
            [(-0.04 * long_way, y, 0.012 * h), (0.16 * long_way, y, 0.012 * h)],
            0.012 * h,
            5,
        )
        figure.tube(
            bone,
            [
                (0.4 * long_way, y * 0.8, 0.62 * h),
                (0.5 * long_way, y, 0.52 * h),
                (0.58 * long_way, y, 0.54 * h),
            ],
            0.012 * h,
            5,
        )
    if order.length > order.depth:
        figure.turn(90)
    made.include(figure, z=base)
