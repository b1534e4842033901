"""Instruments: clocks, telescopes, sundials and weather masts."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order, built
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.materials import (
    ANTHRACITE,
    STEEL,
    WHITE,
    Rgb,
    glass,
    ink_on,
    metal,
    paint,
    picture,
    shade,
    wood,
)
from memorymaze.pictures.looks.shapes import (
    around,
    box,
    cylinder,
    extruded,
    lathed,
    span_between,
)
from memorymaze.pictures.looks.tubes import tube


def clock(made: Assembly, order: Order) -> None:
    """Build a round wall clock with marks and hands at ten past ten."""
    back, front = order.x
    r = min(order.length, order.height) / 2
    z = order.height / 2
    rim = order.colour((0.93, 0.93, 0.92))
    face: Rgb = (0.97, 0.97, 0.96)
    case = shade(rim, 0.35) if ink_on(rim)[0] < 0.5 else rim
    body = lathed(
        [(1, 0), (1, 1), (0.9, 1), (0.88, 0.7), (0, 0.7)],
        32,
        radius=r,
        height=order.depth,
    )
    made.add(paint(case, 0.4), body.turned("y", 90).moved(back, 0, z))
    dial = front - order.depth * 0.2
    made.cylinder(
        paint(face),
        r * 0.89,
        (0, order.depth * 0.12),
        32,
        along="x",
        at=(dial - order.depth * 0.12, 0, z),
    )
    ink = paint((0.08, 0.08, 0.1))
    for hour in range(12):
        long_way = 0.2 if hour % 3 == 0 else 0.11
        mark = box(
            (dial - 0.004, dial + 0.002),
            around(0, 0.025 * r),
            ((0.84 - long_way) * r, 0.84 * r),
        )
        made.add(ink, mark.turned("x", 30.0 * hour).moved(z=z))
    for degrees, reach, wide in ((-60.0, 0.7, 0.03), (55.0, 0.5, 0.045)):
        hand = box((dial, dial + 0.005), around(0, wide * r), (-0.1 * r, reach * r))
        made.add(ink, hand.turned("x", degrees).moved(z=z))
    made.cylinder(ink, 0.06 * r, (0, 0.008), 10, along="x", at=(dial, 0, z))


def grandfather_clock(made: Assembly, order: Order) -> None:
    """Build a tall wooden clock with a dial, a pendulum behind glass, and a hood."""
    front = order.x[1]
    body = wood(order.colour((0.38, 0.25, 0.16)))
    h = order.height
    narrow = order.length * 0.36
    made.add(
        body,
        box(order.x, order.y, (0, 0.06 * h)),
        box(
            order.x.inset(0, 0.02), around(0, order.length * 0.46), (0.06 * h, 0.24 * h)
        ),
    )
    made.box(body, order.x.start(0.04), (-narrow, narrow), (0.24 * h, 0.7 * h))
    for side in (-1, 1):
        y = span_between(side * narrow, side * (narrow - 0.07))
        made.box(body, order.x.inset(0, 0.05), y, (0.24 * h, 0.7 * h))
    made.box(
        body,
        order.x.inset(0, 0.02),
        around(0, order.length * 0.46),
        (0.7 * h, 0.93 * h),
    )
    hood = [
        (-order.length / 2, 0.93 * h),
        (order.length / 2, 0.93 * h),
        (order.length * 0.42, 0.95 * h),
        (0.06, h),
        (-0.06, h),
        (-order.length * 0.42, 0.95 * h),
    ]
    made.add(body, extruded(hood, order.x, "x"))
    dial = Order("clock", order.length * 0.74, 0.03, order.length * 0.74, "gold")
    made.include(built(clock, dial), x=front - 0.012, z=0.815 * h - order.length * 0.37)
    brass = metal((0.83, 0.66, 0.25))
    made.add(
        brass,
        tube([(0, 0, 0.68 * h), (0, 0, 0.38 * h)], 0.008, 5),
        cylinder(0.075, (-0.01, 0.012), 18, along="x").moved(0, 0, 0.36 * h),
    )
    made.box(
        glass(alpha=0.2),
        order.x.end(0.07, 0.06),
        (-narrow + 0.07, narrow - 0.07),
        (0.24 * h, 0.7 * h),
    )


def weather_mast(made: Assembly, order: Order) -> None:
    """Build a weather mast: turning cups, a wind vane, a white louvred box."""
    mast = metal(order.colour(STEEL))
    top = order.height
    reach = min(order.length, order.depth) / 2
    made.lathed(
        mast,
        [
            (reach * 0.7, 0),
            (reach * 0.7, 0.03),
            (0.05, 0.06),
            (0.03, 0.2),
            (0.022, top - 0.12),
        ],
        10,
    )
    hub = top - 0.12
    for place in range(3):
        a = 120.0 * place
        arm = tube([(0, 0, hub), (reach * 0.72, 0, hub)], 0.012, 5)
        cup = (
            lathed(
                [(0.0, 0.0), (0.055, 0.03), (0.08, 0.08), (0.068, 0.08), (0.0, 0.02)],
                12,
            )
            .turned("x", 90)
            .moved(reach * 0.78, 0.05, hub)
        )
        made.add(mast, arm.turned("z", a))
        made.add(paint(ANTHRACITE, 0.3), cup.turned("z", a))
    made.tube(mast, [(0, -reach, hub - 0.2), (0, reach * 0.8, hub - 0.2)], 0.012, 6)
    made.box(
        paint((0.75, 0.15, 0.12)),
        (-0.008, 0.008),
        (reach * 0.5, reach),
        (hub - 0.28, hub - 0.12),
    )
    made.add(
        paint((0.75, 0.15, 0.12)),
        lathed([(0.035, 0), (0, 0.1)], 8)
        .turned("x", 90)
        .moved(0, -reach * 0.85, hub - 0.2),
    )
    made.lathed(
        mast, [(0.0, top - 0.12), (0.04, top - 0.11), (0.03, top - 0.03), (0, top)], 10
    )
    for slat in range(7):
        z = 1.0 + 0.05 * slat
        made.lathed(
            paint((0.93, 0.93, 0.92)),
            [(0.12, z), (0.14, z), (0.1, z + 0.035)],
            12,
            at=(0.0, 0, 0),
        )


def sundial(made: Assembly, order: Order) -> None:
    """Build a stone column with a dial, hour marks and a slanted pointer."""
    r = min(order.length, order.depth) / 2
    stone = paint(order.colour((0.6, 0.59, 0.56)), 0.05)
    dial = order.height * 0.76
    column = [
        (r * 0.75, 0),
        (r * 0.75, 0.07),
        (r * 0.5, 0.12),
        (r * 0.38, 0.3),
        (r * 0.36, dial - 0.2),
        (r * 0.5, dial - 0.1),
        (r, dial - 0.07),
        (r, dial),
    ]
    made.lathed(stone, column, 24)
    bronze = metal((0.5, 0.4, 0.25))
    made.cylinder(bronze, r * 0.84, (dial, dial + 0.012), 28)
    for hour in range(12):
        mark = box((r * 0.58, r * 0.78), (-0.012, 0.012), (dial + 0.01, dial + 0.018))
        made.add(paint(ANTHRACITE), mark.turned("z", 30.0 * hour))
    pointer = extruded(
        [(-r * 0.5, dial + 0.01), (r * 0.5, dial + 0.01), (-r * 0.5, order.height)],
        (-0.012, 0.012),
        "y",
    )
    made.add(bronze, pointer)


def telescope(made: Assembly, order: Order) -> None:
    """Build a telescope on a tripod, or a coin-operated one on a pillar."""
    reach = min(order.length, order.depth) / 2
    body = paint(order.colour(WHITE), 0.5)
    dark = paint(ANTHRACITE)
    pivot = order.height * 0.72
    words = order.text
    if words:
        made.lathed(
            metal((0.5, 0.52, 0.55)),
            [(reach * 0.8, 0), (reach * 0.8, 0.03), (0.07, 0.05), (0.055, pivot - 0.1)],
            14,
        )
        box_low = pivot - 0.34
        made.box(body, (-0.1, 0.1), (-0.13, 0.13), (box_low, pivot - 0.02), 0.03)
        made.plate(
            picture(sign_board(0.24, 0.2, words, (0.12, 0.2, 0.4))),
            (0.08, 0.115),
            (-0.12, 0.12),
            (box_low + 0.04, box_low + 0.26),
        )
    else:
        for place in range(3):
            a = math.tau * place / 3 + math.pi
            made.tube(
                paint((0.45, 0.3, 0.18)),
                [
                    (reach * 0.96 * math.cos(a), reach * 0.96 * math.sin(a), 0.0),
                    (0, 0, pivot - 0.04),
                ],
                0.022,
                6,
            )
        made.cylinder(dark, 0.05, (pivot - 0.1, pivot), 10)
    length = min(2.2 * reach, 1.0)
    barrel = lathed(
        [
            (0.03, -0.55 * length),
            (0.035, -0.42 * length),
            (0.05, -0.4 * length),
            (0.055, 0.2 * length),
            (0.085, 0.22 * length),
            (0.09, 0.55 * length),
            (0.075, 0.55 * length),
            (0.07, 0.5 * length),
            (0, 0.5 * length),
        ],
        16,
    )
    made.add(body, barrel.turned("y", 62).moved(0, 0, pivot + 0.1))
    eye = lathed([(0.036, -0.56 * length), (0.036, -0.44 * length)], 12).turned("y", 62)
    lens = lathed([(0.07, 0.505 * length), (0.0, 0.52 * length)], 14).turned("y", 62)
    made.add(dark, eye.moved(0, 0, pivot + 0.1))
    made.add(paint((0.15, 0.3, 0.5), 0.9), lens.moved(0, 0, pivot + 0.1))
    made.ball(dark, 0.05, 10, 8, at=(0, 0, pivot + 0.04))
    finder = lathed([(0.014, -0.15 * length), (0.018, 0.15 * length)], 8).turned(
        "y", 62
    )
    made.add(dark, finder.moved(-0.06, 0, pivot + 0.1 + 0.11))
