"""Animals."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.captions import plinth
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import paint
from memorymaze.pictures.looks.primitives import ball
from memorymaze.pictures.looks.tubes import limb

DARK: Rgb = (0.07, 0.06, 0.06)


def animal(order: Order) -> Assembly:
    """Build a four-legged animal on a low base, its side to the front where it is long."""
    assembly = Assembly()
    base = 0.2 * order.height if order.text else 0.06
    assembly.include(plinth(order, base, (0.75, 0.82, 0.86)))
    long_way = max(order.length, order.depth)
    figure = _four_legs(long_way * 0.94, order.height - base, order)
    if order.length > order.depth:
        figure = figure.turned(90)
    assembly.include(figure, z=base)
    return assembly


def _four_legs(long_way: float, tall: float, order: Order) -> Assembly:
    """Build an animal that looks along +x."""
    figure = Assembly()
    colour = order.colour((0.6, 0.45, 0.3))
    fur = paint(colour, 0.02)
    s = long_way
    body, wide = 0.62 * tall, min(0.24 * tall, 0.2 * s)
    barrel = [
        (-0.36 * s, 0, body),
        (-0.1 * s, 0, body + 0.03 * tall),
        (0.18 * s, 0, body + 0.02 * tall),
    ]
    figure.add(fur, limb(barrel, [wide * 0.95, wide * 1.08, wide * 0.85], 12))
    figure.add(
        fur,
        limb(
            [(0.16 * s, 0, body + 0.08 * tall), (0.33 * s, 0, body + 0.2 * tall)],
            [wide * 0.68, wide * 0.5],
            10,
        ),
    )
    figure.add(fur, ball(wide * 0.62, 12, 9).moved(0.36 * s, 0, body + 0.22 * tall))
    figure.add(
        fur,
        limb(
            [(0.38 * s, 0, body + 0.2 * tall), (0.46 * s, 0, body + 0.16 * tall)],
            [wide * 0.38, wide * 0.24],
            8,
        ),
    )
    figure.add(
        paint(DARK),
        ball(wide * 0.13, 8, 6).moved(0.46 * s + wide * 0.24, 0, body + 0.18 * tall),
    )
    for side in (-1, 1):
        figure.add(
            fur,
            ball(wide * 0.2, 8, 6).moved(
                0.33 * s, side * wide * 0.5, body + 0.22 * tall + wide * 0.52
            ),
        )
        figure.add(
            paint(DARK),
            ball(wide * 0.07, 6, 4).moved(
                0.36 * s + wide * 0.5,
                side * wide * 0.26,
                body + 0.22 * tall + wide * 0.24,
            ),
        )
        for x, lean in ((-0.32 * s, -0.02), (0.2 * s, 0.05)):
            y = side * wide * 0.6
            step = lean * s * side
            figure.add(
                fur,
                limb(
                    [
                        (x, y, body - 0.02 * tall),
                        (x + step, y, 0.3 * tall),
                        (x + step * 0.6, y, 0.06 * tall),
                    ],
                    [wide * 0.52, wide * 0.38, wide * 0.32],
                    9,
                ),
            )
            figure.add(
                fur,
                ball(1, 9, 6)
                .scaled(wide * 0.46, wide * 0.36, 0.05 * tall)
                .moved(x + step * 0.6 + 0.02 * s, y, 0.05 * tall),
            )
    figure.add(
        paint(shade(colour, 0.97), 0.02),
        ball(wide * 0.2, 8, 6).moved(-0.36 * s - wide * 0.9, 0, body + 0.06 * tall),
    )
    return figure
