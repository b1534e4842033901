"""Open frames that hold things: racks, stands, ladders."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.captions import header
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import metal, paint
from memorymaze.pictures.looks.primitives import ball, box, lathed
from memorymaze.pictures.looks.tubes import tube

STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.15, 0.15, 0.16)
PRINTS: tuple[Rgb, ...] = (
    (0.8, 0.25, 0.2), (0.2, 0.45, 0.75), (0.95, 0.8, 0.3), (0.3, 0.6, 0.4),
    (0.6, 0.35, 0.65), (0.9, 0.9, 0.86),
)  # fmt: skip


def brochure_rack(order: Order) -> Assembly:
    """Build a stand with rising rows of brochures, cards or newspapers."""
    assembly = Assembly()
    back, front = order.x
    body = order.body(STEEL, 0.4)
    top = order.height - (0.2 if order.text else 0.02)
    assembly.add(body, box((back, back + 0.02), order.y, (0.1, order.height)))
    for y in (order.y[0], order.y[1] - 0.025):
        assembly.add(
            body,
            box((back, front), (y, y + 0.025), (0, 0.06)),
            box((back, back + 0.05), (y, y + 0.025), (0, order.height)),
        )
    rows = max(2, round((top - 0.15) / 0.3))
    columns = max(2, round(order.length / 0.16))
    rise = (top - 0.12) / rows
    step = (order.length - 0.06) / columns
    rng = order.rng()
    for row in range(rows):
        z = 0.12 + row * rise
        x = front - (front - back) * 0.75 * row / rows
        assembly.add(
            body,
            box(
                (back + 0.02, x), (order.y[0] + 0.02, order.y[1] - 0.02), (z, z + 0.015)
            ),
            box((x - 0.015, x), (order.y[0] + 0.02, order.y[1] - 0.02), (z, z + 0.07)),
        )
        for column in range(columns):
            if rng.random() < 0.12:
                continue
            y = order.y[0] + 0.03 + column * step
            print_ = paint(PRINTS[int(rng.integers(len(PRINTS)))])
            assembly.add(
                print_,
                box(
                    (x - 0.05, x - 0.02),
                    (y + 0.008, y + step - 0.008),
                    (z + 0.015, z + min(0.24, rise * 0.86)),
                ),
            )
    header(assembly, order, (order.height - 0.19, order.height), back + 0.02)
    return assembly


def coat_rack(order: Order) -> Assembly:
    """Build a rail on two stands with coats on hangers."""
    assembly = Assembly()
    steel = metal(order.colour(STEEL))
    top = order.height - 0.02
    reach = order.length / 2 - 0.02
    back, front = order.x
    for side in (-1, 1):
        y = side * reach
        assembly.add(
            steel,
            tube([(0, y, 0.03), (0, y, top)], 0.018, 8),
            box((back, front), (y - 0.018, y + 0.018), (0, 0.03)),
        )
    assembly.add(steel, tube([(0, -reach, top), (0, reach, top)], 0.02, 8))
    coats = ((0.16, 0.2, 0.32), (0.45, 0.12, 0.14), (0.3, 0.34, 0.26), (0.6, 0.5, 0.36))
    count = max(2, int(order.length / 0.24))
    for place in range(count):
        y = -reach + 2 * reach * (place + 0.6) / count
        if place % 4 == 3:
            continue
        half, thick = order.depth * 0.42, 0.05
        low = top - 0.95
        body = lathed(
            [
                (0.8, low),
                (0.95, low + 0.3),
                (0.85, top - 0.25),
                (0.25, top - 0.1),
                (0.1, top - 0.05),
            ],
            10,
        ).scaled(half, thick, 1.0)
        assembly.add(paint(coats[place % 4], 0.02), body.moved(y=y))
        assembly.add(steel, tube([(0, y, top - 0.07), (0, y, top)], 0.006, 5))
    return assembly


def umbrella_stand(order: Order) -> Assembly:
    """Build a framed stand with umbrellas in it."""
    assembly = Assembly()
    steel = metal(order.colour(DARK))
    back, front = order.x
    left, right = order.y
    top = order.height * 0.72
    corners = [
        (x, y)
        for x in (back + 0.012, front - 0.012)
        for y in (left + 0.012, right - 0.012)
    ]
    for x, y in corners:
        assembly.add(steel, tube([(x, y, 0), (x, y, top)], 0.012, 6))
    for z in (0.25 * top, top):
        for x in (back + 0.012, front - 0.012):
            assembly.add(steel, tube([(x, left, z), (x, right, z)], 0.01, 6))
        for y in (left + 0.012, right - 0.012):
            assembly.add(steel, tube([(back, y, z), (front, y, z)], 0.01, 6))
    assembly.add(steel, box((back, front), (left, right), (0.0, 0.03)))
    cloths = ((0.1, 0.1, 0.12), (0.15, 0.3, 0.6), (0.7, 0.15, 0.2), (0.85, 0.88, 0.9))
    count = max(3, int(order.length / 0.11))
    for place in range(count):
        y = left + order.length * (place + 0.5) / count
        x = back + order.depth * (0.35 if place % 2 else 0.62)
        tip = order.height - 0.04 * (place % 3)
        tone = paint(cloths[place % 4], 0.05)
        assembly.add(
            tone,
            lathed(
                [(0.008, 0.04), (0.03, 0.3), (0.035, top), (0.01, tip - 0.16)], 7
            ).moved(x, y),
        )
        crook = [
            (x, y, tip - 0.16),
            (x, y, tip - 0.03),
            (x + 0.02, y, tip - 0.008),
            (x + 0.045, y, tip - 0.02),
            (x + 0.05, y, tip - 0.06),
        ]
        assembly.add(paint((0.4, 0.25, 0.14)), tube(crook, 0.009, 5))
    return assembly


def tray_rack(order: Order) -> Assembly:
    """Build a trolley with rows of trays on rails, its words on top."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    steel = metal(order.colour(STEEL))
    roof = order.height - (0.22 if order.text else 0.02)
    for x in (back + 0.015, front - 0.03):
        for y in (left + 0.015, right - 0.015, 0.0):
            assembly.add(
                steel, box((x - 0.015, x + 0.015), (y - 0.015, y + 0.015), (0.04, roof))
            )
            assembly.add(
                paint(DARK),
                ball(0.04, 8, 5).moved(x, min(max(y, left + 0.04), right - 0.04), 0.04),
            )
    trays = ((0.75, 0.4, 0.2), (0.35, 0.25, 0.2))
    rows = max(3, int(roof / 0.15))
    for row in range(rows):
        z = 0.12 + (roof - 0.14) * row / rows
        for side in (-1, 1):
            y = sorted((side * 0.03, side * (order.length / 2 - 0.04)))
            assembly.add(
                paint(trays[row % 2]),
                box((back + 0.02, front - 0.01), (y[0], y[1]), (z, z + 0.03)),
            )
            if (row + side) % 3 == 0:
                assembly.add(
                    paint((0.95, 0.95, 0.93), 0.4),
                    lathed(
                        [(0.05, 0), (0.09, 0.025), (0.085, 0.025), (0.045, 0.01)], 10
                    ).moved(0.0, sum(y) / 2, z + 0.03),
                )
    assembly.add(steel, box(order.x, order.y, (roof, roof + 0.02)))
    header(assembly, order, (roof + 0.01, order.height), front - 0.012)
    return assembly


def ladder(order: Order) -> Assembly:
    """Build a folding step ladder."""
    assembly = Assembly()
    back, front = order.x
    stiles = metal(order.colour((0.9, 0.75, 0.15)))
    top = order.height
    half = order.length / 2 - 0.03
    narrow = half * 0.72
    for side in (-1, 1):
        assembly.add(
            stiles,
            tube(
                [(front - 0.02, side * half, 0), (0.01, side * narrow, top)], 0.022, 6
            ),
            tube(
                [(back + 0.02, side * half, 0), (-0.01, side * narrow, top - 0.05)],
                0.018,
                6,
            ),
        )
    steps = max(4, round(top / 0.28))
    for place in range(1, steps):
        share = place / steps
        x = (front - 0.02) * (1 - share)
        wide = half + (narrow - half) * share
        z = top * share
        assembly.add(
            metal(STEEL),
            box((x - 0.05, x + 0.04), (-wide, wide), (z - 0.012, z + 0.012)),
        )
    assembly.add(
        stiles, box((-0.08, 0.08), (-narrow - 0.02, narrow + 0.02), (top - 0.03, top))
    )
    return assembly
