"""Things to sit on, and tables and desks."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.materials import (
    BLUE,
    CHESTNUT,
    CHROME,
    IRON,
    LIMESTONE,
    OAK,
    SLATE,
    Material,
    is_wooden,
    metal,
    paint,
    shade,
    wood,
)
from memorymaze.pictures.looks.shapes import around, box, cylinder, span_between
from memorymaze.pictures.looks.tubes import tube


def bench(made: Assembly, order: Order) -> None:
    """Build a bench: slats of wood, or an upholstered seat, on two steel frames."""
    back, front = order.x
    seat = min(order.height, 0.46)
    wooden = is_wooden(order.colour_words) or order.colour_words is None
    top = wood(order.colour(CHESTNUT)) if wooden else paint(order.colour(CHESTNUT))
    if wooden:
        step = order.depth / 4
        for slat in range(4):
            x = back + slat * step
            made.box(top, (x, x + step - 0.02), order.y, (seat - 0.05, seat), 0.008)
        made.shapes[top][-1] = box(
            order.x.end(step), order.y, (seat - 0.05, seat), 0.008
        )
    else:
        made.box(top, order.x, order.y, (seat - 0.12, seat), 0.035)
    if order.height > 0.6:
        for z in (0.6, 0.8):
            made.box(
                top,
                order.x.start(0.03),
                order.y,
                (z * order.height, (z + 0.2) * order.height - 0.01),
                0.008,
            )
    legs = metal((0.2, 0.2, 0.22))
    low = seat - (0.06 if wooden else 0.13)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.18)
        for x in (back + 0.06, front - 0.06):
            made.box(legs, around(x, 0.025), around(y, 0.025), (0, low + 0.02))
        made.box(legs, order.x.inset(0.03), around(y, 0.025), (low - 0.03, low + 0.02))
        if order.height > 0.6:
            made.box(
                legs, order.x.start(0.03), around(y, 0.02), (seat, order.height - 0.05)
            )


def sofa(made: Assembly, order: Order) -> None:
    """Build a sofa with two or three cushions."""
    _upholstered(made, order, max(1, min(4, round(order.length / 0.75))))


def armchair(made: Assembly, order: Order) -> None:
    """Build a sofa for one."""
    _upholstered(made, order, 1)


def chair(made: Assembly, order: Order) -> None:
    """Build a chair with a shell on four steel legs."""
    _chair_into(made, order, order.body(BLUE), 0.0)


def stool(made: Assembly, order: Order) -> None:
    """Build a round stool."""
    radius = min(order.length, order.depth) / 2
    made.cylinder(order.body(BLUE), radius, order.z.end(0.07), 18)
    for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        a, b = 0.45 * radius, 0.68 * radius
        made.tube(
            metal(CHROME),
            [(x * b, y * b, 0), (x * a, y * a, order.height - 0.06)],
            0.016,
            6,
        )


def stacked_chairs(made: Assembly, order: Order) -> None:
    """Build a pile of equal chairs, each a little higher."""
    single = Order(
        "chair", order.length, order.depth * 0.85, min(0.82, order.height * 0.7)
    )
    count = 4
    rise = (order.height - single.height) / (count - 1)
    forward = (order.depth - single.depth) / (count - 1)
    for place in range(count):
        one = Assembly()
        _chair_into(one, single, order.body((0.85, 0.42, 0.12)), 0.0)
        made.include(one, x=place * forward, z=place * rise)


def _chair_into(made: Assembly, order: Order, body: Material, z: float) -> None:
    back, front = order.x
    seat = z + min(0.47, 0.56 * order.height)
    top = z + order.height
    made.box(
        body, order.x.inset(0.05, 0), order.y.inset(0.02), (seat - 0.04, seat), 0.015
    )
    rest = box(order.x.start(0.035), order.y.inset(0.03), (seat + 0.1, top), 0.015)
    rest.vertices[:, 0] += 0.09 * (1 - (rest.vertices[:, 2] - seat) / (top - seat))
    made.add(body, rest)
    legs = metal(CHROME)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.025)
        made.add(
            legs,
            tube([(front - 0.03, y, z), (front - 0.06, y, seat - 0.02)], 0.013, 6),
            tube(
                [
                    (back + 0.02, y, z),
                    (back + 0.1, y, seat - 0.02),
                    (back + 0.03, y, top - 0.1),
                ],
                0.013,
                6,
            ),
        )


def _upholstered(made: Assembly, order: Order, places: int) -> None:
    colour = order.colour((0.42, 0.44, 0.47))
    cloth, cushion = paint(colour, 0.02), paint(shade(colour, 1.12), 0.02)
    back, front = order.x
    arm = min(0.17, 0.16 * order.length + 0.04)
    seat = min(0.45, 0.55 * order.height)
    made.add(
        cloth,
        box(order.x.inset(0, 0.03), order.y.inset(arm / 2), (0.1, seat - 0.13), 0.03),
        box(order.x.start(0.2), order.y.inset(0.03), (0.1, order.height - 0.04), 0.06),
    )
    for side in (-1, 1):
        outer = side * order.length / 2
        y = span_between(outer, outer - side * arm)
        made.box(cloth, order.x, y, (0.1, min(seat + 0.18, order.height)), 0.055)
    inner = order.length - 2 * arm
    step = inner / places
    for place in range(places):
        y = (-inner / 2 + place * step + 0.006, -inner / 2 + (place + 1) * step - 0.006)
        made.add(
            cushion,
            box(order.x.inset(0.17, 0), y, (seat - 0.15, seat), 0.05),
            box(order.x.start(0.13, 0.32), y, (seat - 0.02, order.height), 0.07),
        )
    for x in (back + 0.08, front - 0.08):
        for side in (-1, 1):
            y = side * (order.length / 2 - 0.09)
            made.limb(paint((0.15, 0.12, 0.1)), [(x, y, 0.025), (x, y, 0.12)], 0.025, 6)


def table(made: Assembly, order: Order) -> None:
    """Build a table on four legs."""
    top = order.body(OAK)
    legs = top if is_wooden(order.colour_words) else metal(IRON)
    _on_four_legs(made, order, top, legs, 0.035)


def coffee_table(made: Assembly, order: Order) -> None:
    """Build a low table with a shelf under its top."""
    table(made, order)
    inset = 0.06
    made.box(order.body(OAK), order.x.inset(inset), order.y.inset(inset), (0.12, 0.14))


def desk(made: Assembly, order: Order) -> None:
    """Build a desk with drawers on one side."""
    table(made, order)
    made.box(
        order.shaded(OAK, 0.85),
        order.x.inset(0.05, 0.03),
        order.y.end(0.45, 0.05),
        (0.05, order.height - 0.04),
    )
    for row in range(3):
        z = 0.1 + row * (order.height - 0.16) / 3
        made.box(
            metal(IRON),
            order.x.end(0.03, 0.01),
            order.y.end(0.32, 0.18),
            (z + 0.1, z + 0.12),
        )


def round_table(made: Assembly, order: Order) -> None:
    """Build a round table on one foot."""
    radius = min(order.length, order.depth) / 2
    made.lathed(
        order.body(LIMESTONE),
        [
            (radius - 0.01, order.height - 0.03),
            (radius, order.height - 0.02),
            (radius, order.height),
        ],
        28,
    )
    made.lathed(
        metal(SLATE),
        [
            (radius * 0.6, 0),
            (radius * 0.6, 0.015),
            (0.06, 0.05),
            (0.035, 0.12),
            (0.035, order.height - 0.03),
        ],
        16,
    )


def high_table(made: Assembly, order: Order) -> None:
    """Build a bar table on two feet, with a footrest."""
    made.box(order.body(LIMESTONE), order.x, order.y, order.z.end(0.04), 0.01)
    for side in (-1, 1):
        y = side * order.length * 0.33
        made.add(
            metal(SLATE),
            cylinder(0.035, (0.02, order.height - 0.04), 12).moved(y=y),
            box((order.x[0] * 0.85, order.x[1] * 0.85), around(y, 0.12), (0, 0.02)),
        )
    reach = order.length * 0.33
    made.tube(metal(SLATE), [(0, -reach, 0.3), (0, reach, 0.3)], 0.015, 8)


def parasol_table(made: Assembly, order: Order) -> None:
    """Build a small round table under a parasol."""
    radius = min(order.length, order.depth) / 2
    table_order = Order(order.category, 1.3 * radius, 1.3 * radius, 0.74, "white")
    round_table(made, table_order)
    made.cylinder(metal(IRON), 0.022, (0.7, order.height - 0.02), 8)
    low = order.height * 0.8
    made.lathed(
        paint(order.colour((0.2, 0.5, 0.3)), 0.0),
        [
            (0.03, low + 0.03),
            (radius, low - 0.02),
            (radius, low),
            (radius * 0.5, (low + order.height) / 2 + 0.05),
            (0, order.height),
        ],
        8,
    )


def _on_four_legs(
    made: Assembly, order: Order, top: Material, legs: Material, thick: float
) -> None:
    made.box(top, order.x, order.y, order.z.end(thick), 0.008)
    inset = 0.04
    made.box(
        legs,
        order.x.inset(inset),
        order.y.inset(inset),
        (order.height - thick - 0.06, order.height - thick),
    )
    legs_into(made, order, legs, order.height - thick, 0.05, 0.03)


def legs_into(
    made: Assembly, order: Order, legs: Material, top: float, width: float, inset: float
) -> None:
    """Add four square legs of a width, set in from the ends, in metres."""
    for x in (order.x[0] + inset, order.x[1] - inset - width):
        for y in (order.y[0] + 0.03, order.y[1] - 0.03 - width):
            made.box(legs, (x, x + width), (y, y + width), (0, top))
