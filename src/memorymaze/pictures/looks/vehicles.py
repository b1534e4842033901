"""Things on wheels: bicycles, a car, suitcases, trolleys, chairs for riding."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order, built
from memorymaze.pictures.looks.materials import (
    CHROME,
    RUBBER,
    Material,
    Rgb,
    glow,
    metal,
    paint,
    shade,
)
from memorymaze.pictures.looks.shapes import (
    Shape,
    around,
    box,
    cylinder,
    extruded,
    lathed,
)
from memorymaze.pictures.looks.tubes import Point3, limb, tube


def exercise_bike(made: Assembly, order: Order) -> None:
    """Build a stationary bicycle, its side to the front, with a lamp and its words."""
    half, h = order.length / 2, order.height
    frame = paint(order.colour((0.79, 0.13, 0.13)), 0.4)
    dark = paint(RUBBER)
    for y in (-half * 0.72, half * 0.72):
        made.box(dark, order.x, around(y, 0.05), (0, 0.07), 0.02)
    made.tube(frame, [(0, -half * 0.72, 0.07), (0, half * 0.72, 0.07)], 0.035, 8)
    wheel = (0.0, half * 0.45, 0.36)
    disc = cylinder(0.26, (-0.04, 0.04), 24, along="x")
    made.add(metal(CHROME), disc.moved(*wheel))
    made.cylinder(frame, 0.19, (-0.05, 0.05), 20, along="x", at=wheel)
    crank = (0.0, -0.02, 0.34)
    made.cylinder(dark, 0.11, (-0.06, 0.06), 16, along="x", at=crank)
    made.add(
        frame,
        tube([crank, (0, half * 0.55, h * 0.72), (0, half * 0.5, h - 0.12)], 0.035, 8),
        tube([crank, (0, -half * 0.52, h * 0.66)], 0.035, 8),
        tube([crank, (0, 0, 0.08)], 0.04, 8),
    )
    saddle = [(-0.1, -0.02), (0.1, -0.02), (0.05, 0.24), (-0.05, 0.24)]
    made.add(
        dark,
        extruded([(x, y - half * 0.62) for x, y in saddle], (h * 0.67, h * 0.73), "z"),
    )
    bar: list[Point3] = [
        (-0.22, half * 0.32, h - 0.04),
        (-0.2, half * 0.5, h - 0.1),
        (0.2, half * 0.5, h - 0.1),
        (0.22, half * 0.32, h - 0.04),
    ]
    made.tube(dark, bar, 0.022, 7)
    for side in (-1, 1):
        pedal = (side * 0.16, -0.02, 0.34 + side * 0.16)
        made.tube(
            metal(CHROME),
            [(side * 0.07, crank[1], crank[2]), (side * 0.09, crank[1], pedal[2])],
            0.014,
            6,
        )
        made.box(
            dark,
            around(pedal[0], 0.06),
            around(pedal[1], 0.05),
            around(pedal[2], 0.015),
        )
    made.limb(
        glow((1.0, 0.92, 0.6), 0.9),
        [(0, half * 0.8, h - 0.22), (0, half * 0.8, h - 0.1)],
        [0.04, 0.08],
        10,
    )
    made.add(
        metal(CHROME),
        tube([(0, half * 0.8, 0.07), (0, half * 0.8, h - 0.24)], 0.018, 6),
        box((-0.02, 0.02), (-half, half), (0, 0.02)),
    )
    wide = order.length * 0.35
    made.words(
        order.text,
        (0.96, 0.96, 0.94),
        order.x.end(0.03),
        (-wide, wide),
        (0.08, 0.28),
    )


def bicycle(made: Assembly, order: Order) -> None:
    """Build a bicycle along its longer side."""
    long_way = max(order.length, order.depth)
    h = order.height
    r = min(0.34, 0.33 * h, 0.2 * long_way)
    frame = paint(order.colour((0.13, 0.36, 0.75)), 0.5)
    rear, fore = -long_way / 2 + r, long_way / 2 - r
    for x in (rear, fore):
        spoked_wheel(made, (x, 0.0, r), r, paint(RUBBER), metal(CHROME))
    crank, seat, head = (
        (rear * 0.15, 0.0, r * 0.9),
        (rear * 0.42, 0.0, 0.78 * h),
        (fore * 0.62, 0.0, 0.8 * h),
    )
    for a, b in (
        (crank, seat),
        (crank, head),
        (seat, head),
        (crank, (rear, 0.0, r)),
        (seat, (rear, 0.0, r)),
        (head, (fore, 0.0, r)),
    ):
        made.tube(frame, [a, b], 0.018, 6)
    top = (fore * 0.56, 0.0, h - 0.03)
    made.add(
        metal(CHROME),
        tube([head, top], 0.015, 6),
        tube(
            [
                (top[0] - 0.1, -0.25, h - 0.02),
                (top[0], 0.0, h - 0.03),
                (top[0] - 0.1, 0.25, h - 0.02),
            ],
            0.014,
            6,
        ),
    )
    made.box(
        paint(RUBBER),
        (seat[0] - 0.14, seat[0] + 0.12),
        (-0.08, 0.08),
        (seat[2], seat[2] + 0.06),
        0.025,
    )
    made.cylinder(paint(RUBBER), 0.09, (-0.02, 0.02), 14, along="y", at=crank)
    if order.length > order.depth:
        made.turn(90)


def car(made: Assembly, order: Order) -> None:
    """Build a small car along its longer side."""
    long_way, across = max(order.length, order.depth), min(order.length, order.depth)
    half, h = long_way / 2, order.height
    body = paint(order.colour((0.2, 0.4, 0.7)), 0.6)
    r = 0.22 * h
    low, belt = 0.18 * h, 0.58 * h
    lower = [
        (-half, low),
        (half, low),
        (half, belt * 0.82),
        (half * 0.5, belt),
        (-half * 0.95, belt),
        (-half, belt * 0.9),
    ]
    upper = [
        (half * 0.45, belt - 0.01),
        (half * 0.12, h),
        (-half * 0.55, h),
        (-half * 0.85, belt - 0.01),
    ]
    y = across / 2
    made.add(body, extruded(lower, (-y, y), "y"))
    made.add(paint((0.12, 0.16, 0.2), 0.9), extruded(upper, around(0, y * 0.86), "y"))
    made.box(
        body, (-half * 0.52, half * 0.1), around(0, y * 0.84), (h - 0.03, h + 0.01)
    )
    for x in (-half * 0.6, half * 0.6):
        for side in (-1, 1):
            tyre = cylinder(r, (-0.09, 0.09), 18, along="y").moved(
                x, side * (y - 0.08), r
            )
            hub = cylinder(r * 0.55, (-0.1, 0.1), 14, along="y").moved(
                x, side * (y - 0.08), r
            )
            made.add(paint(RUBBER), tyre)
            made.add(metal(CHROME), hub)
    for side in (-1, 1):
        made.box(
            glow((1.0, 0.97, 0.85), 0.6),
            (half - 0.04, half + 0.01),
            around(side * y * 0.7, 0.14),
            (belt * 0.58, belt * 0.75),
        )
        made.box(
            paint((0.7, 0.08, 0.08), 0.5),
            (-half - 0.01, -half + 0.04),
            around(side * y * 0.7, 0.14),
            (belt * 0.6, belt * 0.8),
        )
    if order.length > order.depth:
        made.turn(90)


def suitcase(made: Assembly, order: Order) -> None:
    """Build a suitcase on wheels with its handle out."""
    back, front = order.x
    colour = order.colour((0.25, 0.28, 0.35))
    top = order.height * 0.72
    made.box(paint(colour, 0.3), order.x, order.y, (0.05, top), 0.04)
    for place in range(5):
        y = order.y[0] + order.length * (place + 0.5) / 5
        made.box(
            paint(shade(colour, 0.75), 0.3),
            order.x.end(0.02, -0.006),
            around(y, 0.012),
            (0.1, top - 0.05),
        )
    reach = order.length * 0.25
    grip: list[Point3] = [
        (back + 0.04, -reach, top),
        (back + 0.04, -reach, order.height - 0.01),
        (back + 0.04, reach, order.height - 0.01),
        (back + 0.04, reach, top),
    ]
    made.tube(metal(CHROME), grip, 0.012, 6)
    for x in (back + 0.05, front - 0.05):
        for y in (order.y[0] + 0.05, order.y[1] - 0.05):
            made.cylinder(
                paint(RUBBER), 0.03, (-0.012, 0.012), 8, along="y", at=(x, y, 0.03)
            )


def stroller_rack(made: Assembly, order: Order) -> None:
    """Build folded and open push-chairs side by side under a sign."""
    count = max(2, round(order.length / 0.5))
    cloths = ((0.85, 0.7, 0.15), (0.2, 0.35, 0.6), (0.65, 0.15, 0.2))
    for place in range(count):
        y = order.y[0] + order.length * (place + 0.5) / count
        one = built(
            _stroller,
            order.depth,
            min(0.42, order.length / count - 0.04),
            order.height * 0.96,
            cloths[place % 3],
        )
        made.include(one, y=y)
    rail = metal(order.colour(CHROME))
    made.tube(
        rail,
        [(order.x[0] + 0.02, order.y[0], 0.3), (order.x[0] + 0.02, order.y[1], 0.3)],
        0.018,
        6,
    )
    if order.text:
        half, tall = order.length * 0.36, 0.24
        made.words(
            order.text,
            shade(order.colour(CHROME), 0.35),
            order.x.start(0.03),
            (-half, half),
            order.z.end(tall),
        )
        for side in (-1, 1):
            made.box(
                rail,
                order.x.start(0.02),
                around(side * half * 0.8, 0.01),
                (0, order.height - tall),
            )


def trolley(made: Assembly, order: Order) -> None:
    """Build a cart of two shelves on castors with a handle."""
    back, front = order.x
    left, right = order.y
    steel = metal(order.colour(CHROME))
    deck = order.height * 0.82
    for x in (back + 0.03, front - 0.03):
        for y in (left + 0.03, right - 0.03):
            made.tube(steel, [(x, y, 0.1), (x, y, deck)], 0.014, 6)
            wheel = cylinder(0.05, (-0.015, 0.015), 10, along="y").moved(x, y, 0.05)
            made.add(paint(RUBBER), wheel)
    for z in (0.14, deck * 0.55, deck):
        made.box(steel, order.x, order.y.inset(0, 0.02), (z - 0.025, z), 0.006)
    made.tube(
        steel,
        [
            (back + 0.03, right - 0.03, deck),
            (back + 0.03, right - 0.012, order.height - 0.012),
            (front - 0.03, right - 0.012, order.height - 0.012),
            (front - 0.03, right - 0.03, deck),
        ],
        0.012,
        6,
    )
    load = ((0.85, 0.85, 0.8), (0.55, 0.4, 0.25), (0.3, 0.45, 0.6))
    for place, tone in enumerate(load):
        y = left + order.length * (0.22 + 0.26 * place)
        z = deck * 0.55
        made.box(
            paint(tone),
            order.x.inset(0.08),
            around(y, 0.08),
            (z, z + 0.12 + 0.03 * place),
        )
    made.words(
        order.text,
        (0.93, 0.93, 0.92),
        order.x.end(0.01),
        (left * 0.8, right * 0.8),
        (deck - 0.18, deck - 0.04),
    )


def _stroller(
    made: Assembly, depth: float, width: float, height: float, cloth: Rgb
) -> None:
    """Build one push-chair that faces +x."""
    back, front = around(0, depth / 2)
    frame = metal((0.3, 0.3, 0.33))
    wheel = 0.09 * min(1.0, height)
    for side in (-1, 1):
        y = side * width / 2 * 0.88
        made.add(
            frame,
            tube(
                [
                    (front - wheel, y, wheel),
                    (back * 0.2, y, height * 0.5),
                    (back + 0.04, y, height),
                ],
                0.014,
                4,
            ),
            tube(
                [(back + wheel, y, wheel), (front * 0.25, y, height * 0.42)], 0.012, 6
            ),
        )
        for x in (back + wheel, front - wheel):
            made.cylinder(
                paint(RUBBER), wheel, (-0.02, 0.02), 8, along="y", at=(x, y, wheel)
            )
    half = width * 0.42
    made.tube(
        frame, [(back + 0.04, -half, height), (back + 0.04, half, height)], 0.016, 6
    )
    made.add(
        paint(cloth, 0.02),
        box(
            (back * 0.35, front * 0.45),
            (-half, half),
            (height * 0.4, height * 0.46),
            0.02,
        ),
        limb(
            [(back * 0.3, 0, height * 0.46), (back * 0.55, 0, height * 0.72)],
            half * 0.55,
            6,
        ).scaled(1, 1.7, 1),
        lathed([(1, 0), (0.98, 0.3), (0.6, 0.8), (0, 1)], 8, radius=half, height=half)
        .scaled(1.1, 1.0, 0.9)
        .moved(back * 0.3, 0, height * 0.66),
    )


def wheelchair(made: Assembly, order: Order) -> None:
    """Build a folding wheelchair with spoked wheels, handles and footrests."""
    back, front = order.x
    h = order.height
    r = min(0.31, 0.34 * h)
    half = order.length / 2
    seat = 0.54 * h
    frame, rubber = metal(CHROME), paint(RUBBER)
    cloth = paint(order.colour((0.13, 0.36, 0.75)), 0.05)
    axle = back + r + 0.06
    inner = half - 0.08
    made.box(
        cloth, (axle - 0.16, axle + 0.3), (-inner, inner), (seat - 0.05, seat), 0.02
    )
    rest = box(
        (axle - 0.2, axle - 0.16), (-inner, inner), (seat + 0.04, h - 0.06), 0.015
    )
    made.add(cloth, rest)
    for side in (-1, 1):
        y = side * (half - 0.035)
        spoked_wheel(made, (axle, y, r), r, rubber, frame)
        p = side * inner
        made.add(
            frame,
            tube(
                [
                    (axle + 0.32, p, 0.1),
                    (axle + 0.28, p, seat - 0.02),
                    (axle - 0.16, p, seat - 0.02),
                    (axle - 0.18, p, h - 0.02),
                    (back + 0.02, p, h - 0.02),
                ],
                0.014,
                6,
            ),
            tube(
                [
                    (axle + 0.28, p, seat),
                    (axle + 0.22, p, seat + 0.2),
                    (axle - 0.16, p, seat + 0.2),
                ],
                0.013,
                6,
            ),
            tube([(axle + 0.3, p, 0.24), (front - 0.1, p * 0.8, 0.1)], 0.013, 6),
        )
        made.tube(
            paint(RUBBER), [(back + 0.1, p, h - 0.02), (back, p, h - 0.02)], 0.019, 6
        )
        made.box(
            cloth,
            (axle - 0.14, axle + 0.2),
            around(p, 0.025),
            (seat + 0.19, seat + 0.23),
            0.01,
        )
        made.cylinder(
            rubber, 0.08, (-0.015, 0.015), 14, along="y", at=(axle + 0.33, p, 0.08)
        )
        made.box(
            paint(RUBBER),
            order.x.end(0.18),
            (min(0, side * 0.03) + p * 0.5 - 0.06, p * 0.5 + 0.07),
            (0.07, 0.1),
            0.01,
        )
    made.words(
        order.text,
        (0.96, 0.96, 0.94),
        (axle - 0.16, axle - 0.14),
        (-0.2, 0.2),
        (seat + 0.16, seat + 0.32),
    )


def spoked_wheel(
    made: Assembly, hub: Point3, radius: float, tyre: Material, spokes: Material
) -> None:
    """Add a spoked wheel that rolls along x."""
    points: list[Point3] = []
    for step in range(22):
        a = math.tau * step / 22
        points.append((
            (radius - 0.018) * math.cos(a),
            0.0,
            (radius - 0.018) * math.sin(a),
        ))
    ring: Shape = tube(points, 0.018, 6, closed=True)
    made.add(tyre, ring.moved(*hub))
    made.cylinder(spokes, 0.03, (-0.03, 0.03), 8, along="y", at=hub)
    for spoke in range(5):
        a = math.pi * spoke / 5
        x, z = (radius - 0.02) * math.cos(a), (radius - 0.02) * math.sin(a)
        made.add(spokes, tube([(-x, 0, -z), (x, 0, z)], 0.005, 4).moved(*hub))
