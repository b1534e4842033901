"""Clocks."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb, ink_on, shade
from memorymaze.pictures.looks.paints import glass, metal, paint, wood
from memorymaze.pictures.looks.primitives import box, cylinder, extruded, lathed
from memorymaze.pictures.looks.tubes import tube


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
