"""Things to sit on."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb, is_wooden, shade
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, paint, wood
from memorymaze.pictures.looks.primitives import box, cylinder
from memorymaze.pictures.looks.tubes import limb, tube

CHROME: Rgb = (0.72, 0.73, 0.75)
BLUE: Rgb = (0.2, 0.33, 0.55)
OAK: Rgb = (0.66, 0.46, 0.28)


def bench(order: Order) -> Assembly:
    """Build a bench: slats of wood, or an upholstered seat, on two steel frames."""
    assembly = Assembly()
    back, front = order.x
    seat = min(order.height, 0.46)
    wooden = is_wooden(order.colour_words) or order.colour_words is None
    top = wood(order.colour(OAK)) if wooden else paint(order.colour(OAK))
    if wooden:
        step = order.depth / 4
        for slat in range(4):
            x = back + slat * step
            assembly.add(
                top, box((x, x + step - 0.02), order.y, (seat - 0.05, seat), 0.008)
            )
        assembly.shapes[top][-1] = box(
            (front - step, front), order.y, (seat - 0.05, seat), 0.008
        )
    else:
        assembly.add(top, box(order.x, order.y, (seat - 0.12, seat), 0.035))
    if order.height > 0.6:
        for z in (0.6, 0.8):
            assembly.add(
                top,
                box(
                    (back, back + 0.03),
                    order.y,
                    (z * order.height, (z + 0.2) * order.height - 0.01),
                    0.008,
                ),
            )
    legs = metal((0.2, 0.2, 0.22))
    low = seat - (0.06 if wooden else 0.13)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.18)
        for x in (back + 0.06, front - 0.06):
            assembly.add(
                legs,
                box((x - 0.025, x + 0.025), (y - 0.025, y + 0.025), (0, low + 0.02)),
            )
        assembly.add(
            legs,
            box(
                (back + 0.03, front - 0.03),
                (y - 0.025, y + 0.025),
                (low - 0.03, low + 0.02),
            ),
        )
        if order.height > 0.6:
            assembly.add(
                legs,
                box(
                    (back, back + 0.03),
                    (y - 0.02, y + 0.02),
                    (seat, order.height - 0.05),
                ),
            )
    return assembly


def sofa(order: Order) -> Assembly:
    """Build a sofa with two or three cushions."""
    return _upholstered(order, max(1, min(4, round(order.length / 0.75))))


def armchair(order: Order) -> Assembly:
    """Build a sofa for one."""
    return _upholstered(order, 1)


def chair(order: Order) -> Assembly:
    """Build a chair with a shell on four steel legs."""
    assembly = Assembly()
    _chair_into(assembly, order, order.body(BLUE), 0.0)
    return assembly


def stool(order: Order) -> Assembly:
    """Build a round stool."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    assembly.add(
        order.body(BLUE), cylinder(radius, (order.height - 0.07, order.height), 18)
    )
    for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        a, b = 0.45 * radius, 0.68 * radius
        assembly.add(
            metal(CHROME),
            tube([(x * b, y * b, 0), (x * a, y * a, order.height - 0.06)], 0.016, 6),
        )
    return assembly


def stacked_chairs(order: Order) -> Assembly:
    """Build a pile of equal chairs, each a little higher."""
    assembly = Assembly()
    single = Order(
        "chair", order.length, order.depth * 0.85, min(0.82, order.height * 0.7)
    )
    count = 4
    rise = (order.height - single.height) / (count - 1)
    forward = (order.depth - single.depth) / (count - 1)
    for place in range(count):
        one = Assembly()
        _chair_into(one, single, order.body((0.85, 0.42, 0.12)), 0.0)
        assembly.include(one, x=place * forward, z=place * rise)
    return assembly


def _chair_into(assembly: Assembly, order: Order, body: Material, z: float) -> None:
    back, front = order.x
    left, right = order.y
    seat = z + min(0.47, 0.56 * order.height)
    top = z + order.height
    assembly.add(
        body,
        box(
            (back + 0.05, front),
            (left + 0.02, right - 0.02),
            (seat - 0.04, seat),
            0.015,
        ),
    )
    rest = box(
        (back, back + 0.035), (left + 0.03, right - 0.03), (seat + 0.1, top), 0.015
    )
    rest.vertices[:, 0] += 0.09 * (1 - (rest.vertices[:, 2] - seat) / (top - seat))
    assembly.add(body, rest)
    legs = metal(CHROME)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.025)
        assembly.add(
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


def _upholstered(order: Order, places: int) -> Assembly:
    assembly = Assembly()
    colour = order.colour((0.42, 0.44, 0.47))
    cloth, cushion = paint(colour, 0.02), paint(shade(colour, 1.12), 0.02)
    back, front = order.x
    arm = min(0.17, 0.16 * order.length + 0.04)
    seat = min(0.45, 0.55 * order.height)
    assembly.add(
        cloth,
        box(
            (back, front - 0.03),
            (order.y[0] + arm / 2, order.y[1] - arm / 2),
            (0.1, seat - 0.13),
            0.03,
        ),
        box(
            (back, back + 0.2),
            (order.y[0] + 0.03, order.y[1] - 0.03),
            (0.1, order.height - 0.04),
            0.06,
        ),
    )
    for side in (-1, 1):
        outer = side * order.length / 2
        y = sorted((outer, outer - side * arm))
        assembly.add(
            cloth,
            box(
                (back, front),
                (y[0], y[1]),
                (0.1, min(seat + 0.18, order.height)),
                0.055,
            ),
        )
    inner = order.length - 2 * arm
    step = inner / places
    for place in range(places):
        y = (-inner / 2 + place * step + 0.006, -inner / 2 + (place + 1) * step - 0.006)
        assembly.add(
            cushion,
            box((back + 0.17, front), y, (seat - 0.15, seat), 0.05),
            box((back + 0.13, back + 0.32), y, (seat - 0.02, order.height), 0.07),
        )
    for x in (back + 0.08, front - 0.08):
        for side in (-1, 1):
            y = side * (order.length / 2 - 0.09)
            assembly.add(
                paint((0.15, 0.12, 0.1)), limb([(x, y, 0.025), (x, y, 0.12)], 0.025, 6)
            )
    return assembly
