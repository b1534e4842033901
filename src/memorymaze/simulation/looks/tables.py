"""Tables, counters and desks."""

from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import sign_board
from memorymaze.simulation.looks.colours import Rgb, is_wooden, shade
from memorymaze.simulation.looks.object_model import Material
from memorymaze.simulation.looks.paints import metal, paint, picture, wood
from memorymaze.simulation.looks.primitives import box, cylinder, lathed, plate
from memorymaze.simulation.looks.tubes import tube

__all__ = [
    "chess_table",
    "coffee_table",
    "counter",
    "desk",
    "foosball_table",
    "high_table",
    "kitchen_counter",
    "parasol_table",
    "round_table",
    "table",
]

WHITE: Rgb = (0.9, 0.9, 0.88)
OAK: Rgb = (0.7, 0.52, 0.33)
STEEL: Rgb = (0.66, 0.68, 0.7)
DARK: Rgb = (0.2, 0.2, 0.22)


def table(order: Order) -> Assembly:
    """Build a table on four legs."""
    top = order.body(OAK)
    legs = top if is_wooden(order.colour_words) else metal(STEEL)
    return _on_four_legs(order, top, legs, 0.035)


def coffee_table(order: Order) -> Assembly:
    """Build a low table with a shelf under its top."""
    assembly = table(order)
    inset = 0.06
    assembly.add(
        order.body(OAK),
        box(
            (order.x[0] + inset, order.x[1] - inset),
            (order.y[0] + inset, order.y[1] - inset),
            (0.12, 0.14),
        ),
    )
    return assembly


def desk(order: Order) -> Assembly:
    """Build a desk with drawers on one side."""
    assembly = table(order)
    right = order.y[1]
    assembly.add(
        order.shaded(OAK, 0.85),
        box(
            (order.x[0] + 0.05, order.x[1] - 0.03),
            (right - 0.45, right - 0.05),
            (0.05, order.height - 0.04),
        ),
    )
    for row in range(3):
        z = 0.1 + row * (order.height - 0.16) / 3
        assembly.add(
            metal(STEEL),
            box(
                (order.x[1] - 0.03, order.x[1] - 0.01),
                (right - 0.32, right - 0.18),
                (z + 0.1, z + 0.12),
            ),
        )
    return assembly


def round_table(order: Order) -> Assembly:
    """Build a round table on one foot."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    assembly.add(
        order.body(WHITE),
        lathed(
            [
                (radius - 0.01, order.height - 0.03),
                (radius, order.height - 0.02),
                (radius, order.height),
            ],
            28,
        ),
    )
    assembly.add(
        metal(DARK),
        lathed(
            [
                (radius * 0.6, 0),
                (radius * 0.6, 0.015),
                (0.06, 0.05),
                (0.035, 0.12),
                (0.035, order.height - 0.03),
            ],
            16,
        ),
    )
    return assembly


def high_table(order: Order) -> Assembly:
    """Build a bar table on two feet, with a footrest."""
    assembly = Assembly()
    assembly.add(
        order.body(WHITE),
        box(order.x, order.y, (order.height - 0.04, order.height), 0.01),
    )
    for side in (-1, 1):
        y = side * order.length * 0.33
        assembly.add(
            metal(DARK),
            cylinder(0.035, (0.02, order.height - 0.04), 12).moved(y=y),
            box(
                (order.x[0] * 0.85, order.x[1] * 0.85), (y - 0.12, y + 0.12), (0, 0.02)
            ),
        )
    reach = order.length * 0.33
    assembly.add(metal(DARK), tube([(0, -reach, 0.3), (0, reach, 0.3)], 0.015, 8))
    return assembly


def parasol_table(order: Order) -> Assembly:
    """Build a small round table under a parasol."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    table_order = Order(order.category, 1.3 * radius, 1.3 * radius, 0.74, "white")
    assembly.include(round_table(table_order))
    assembly.add(metal(STEEL), cylinder(0.022, (0.7, order.height - 0.02), 8))
    low = order.height * 0.8
    assembly.add(
        paint(order.colour((0.2, 0.5, 0.3)), 0.0),
        lathed(
            [
                (0.03, low + 0.03),
                (radius, low - 0.02),
                (radius, low),
                (radius * 0.5, (low + order.height) / 2 + 0.05),
                (0, order.height),
            ],
            8,
        ),
    )
    return assembly


def chess_table(order: Order) -> Assembly:
    """Build a square table with a chessboard and its pieces."""
    assembly = table(order)
    half = 0.36 * min(order.length, order.depth)
    step = half / 4
    light, dark = paint((0.92, 0.86, 0.72)), paint((0.22, 0.13, 0.08))
    top = order.height
    for row in range(8):
        for column in range(8):
            x, y = -half + row * step, -half + column * step
            assembly.add(
                light if (row + column) % 2 else dark,
                box((x, x + step), (y, y + step), (top - 0.02, top + 0.003)),
            )
    for row, colour in ((0, dark), (7, light)):
        for column in range(8):
            x, y = -half + (row + 0.5) * step, -half + (column + 0.5) * step
            assembly.add(
                colour,
                lathed(
                    [
                        (step * 0.35, top),
                        (step * 0.12, top + 0.04),
                        (step * 0.2, top + 0.06),
                        (0, top + 0.08),
                    ],
                    6,
                ).moved(x, y),
            )
    return assembly


def foosball_table(order: Order) -> Assembly:
    """Build a table football game: a green pitch in a box with rods and handles."""
    assembly = Assembly()
    back, front = order.x[0] + 0.1, order.x[1] - 0.1
    low, high = order.height * 0.6, order.height
    body = wood((0.5, 0.33, 0.2))
    for y in (order.y[0], order.y[1] - 0.04):
        assembly.add(body, box((back, front), (y, y + 0.04), (low, high - 0.03)))
    for x in (back, front - 0.04):
        assembly.add(body, box((x, x + 0.04), order.y, (low, high - 0.03)))
    assembly.add(body, box((back, front), order.y, (low - 0.05, low)))
    assembly.add(
        paint(order.colour((0.15, 0.55, 0.25))),
        box(
            (back + 0.04, front - 0.04),
            (order.y[0] + 0.04, order.y[1] - 0.04),
            (low, low + 0.1),
        ),
    )
    for place in range(6):
        y = order.y[0] + order.length * (place + 0.75) / 6.5
        z = high - 0.1
        assembly.add(
            metal(STEEL), tube([(order.x[0], y, z), (order.x[1], y, z)], 0.01, 6)
        )
        end = order.x[place % 2]
        inward = end * 0.8
        assembly.add(paint(DARK), tube([(end, y, z), (inward, y, z)], 0.022, 6))
        shirt = paint((0.8, 0.15, 0.15) if place % 2 else (0.15, 0.3, 0.75))
        for player in range(3):
            x = back + (front - back) * (player + 1) / 4
            assembly.add(
                shirt,
                box((x - 0.02, x + 0.02), (y - 0.025, y + 0.025), (z - 0.09, z + 0.1)),
            )
    _legs_into(assembly, order, body, low - 0.03, 0.09, back - order.x[0])
    return assembly


def counter(order: Order) -> Assembly:
    """Build a counter to be served at, with its words across the front."""
    assembly = Assembly()
    back, front = order.x
    top = order.height
    body = order.body(WHITE)
    assembly.add(
        body,
        box(
            (back, front - 0.08),
            (order.y[0] + 0.03, order.y[1] - 0.03),
            (0.1, top - 0.05),
        ),
    )
    assembly.add(
        paint(DARK),
        box(
            (back + 0.04, front - 0.13),
            (order.y[0] + 0.06, order.y[1] - 0.06),
            (0, 0.1),
        ),
    )
    slab = (
        wood(OAK)
        if not is_wooden(order.colour_words)
        else paint((0.92, 0.92, 0.9), 0.4)
    )
    assembly.add(slab, box(order.x, order.y, (top - 0.05, top), 0.012))
    if order.text:
        tall = min(0.55 * top, 0.3 * order.length, 0.5)
        wide = min(order.length * 0.9, tall * max(2.0, 0.75 * len(order.text)))
        middle = 0.52 * top
        ground = (
            shade(order.colour(WHITE), 0.35)
            if not is_wooden(order.colour_words)
            else DARK
        )
        pixels = sign_board(wide, tall, order.text, ground)
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.1, front - 0.065),
                (-wide / 2, wide / 2),
                (middle - tall / 2, middle + tall / 2),
            ),
        )
    return assembly


def kitchen_counter(order: Order) -> Assembly:
    """Build kitchen base cabinets with doors, handles and a worktop."""
    assembly = Assembly()
    back, front = order.x
    top = order.height
    colour = order.colour(WHITE)
    assembly.add(
        paint(shade(colour, 0.85)),
        box((back, front - 0.04), order.y, (0.1, top - 0.04)),
    )
    assembly.add(paint(DARK), box((back, front - 0.1), order.y, (0, 0.1)))
    assembly.add(
        paint((0.45, 0.43, 0.42), 0.4), box(order.x, order.y, (top - 0.04, top), 0.01)
    )
    doors = max(2, round(order.length / 0.5))
    step = order.length / doors
    for place in range(doors):
        y = (order.y[0] + place * step + 0.008, order.y[0] + (place + 1) * step - 0.008)
        assembly.add(
            paint(colour, 0.3),
            box((front - 0.05, front - 0.02), y, (0.12, top - 0.22), 0.006),
        )
        assembly.add(
            paint(colour, 0.3),
            box((front - 0.05, front - 0.02), y, (top - 0.2, top - 0.06), 0.006),
        )
        middle = sum(y) / 2
        for z in (top - 0.3, top - 0.14):
            assembly.add(
                metal(STEEL),
                box(
                    (front - 0.02, front - 0.002),
                    (middle - 0.06, middle + 0.06),
                    (z, z + 0.015),
                ),
            )
    return assembly


def _on_four_legs(
    order: Order, top: Material, legs: Material, thick: float
) -> Assembly:
    assembly = Assembly()
    assembly.add(
        top, box(order.x, order.y, (order.height - thick, order.height), 0.008)
    )
    inset = 0.04
    assembly.add(
        legs,
        box(
            (order.x[0] + inset, order.x[1] - inset),
            (order.y[0] + inset, order.y[1] - inset),
            (order.height - thick - 0.06, order.height - thick),
        ),
    )
    _legs_into(assembly, order, legs, order.height - thick, 0.05, 0.03)
    return assembly


def _legs_into(
    assembly: Assembly,
    order: Order,
    legs: Material,
    top: float,
    width: float,
    inset: float,
) -> None:
    for x in (order.x[0] + inset, order.x[1] - inset - width):
        for y in (order.y[0] + 0.03, order.y[1] - 0.03 - width):
            assembly.add(legs, box((x, x + width), (y, y + width), (0, top)))
