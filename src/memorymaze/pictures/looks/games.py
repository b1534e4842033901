"""Tables to play at."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import metal, paint, wood
from memorymaze.pictures.looks.primitives import box, lathed
from memorymaze.pictures.looks.tables import legs_into, table
from memorymaze.pictures.looks.tubes import tube

STEEL: Rgb = (0.66, 0.68, 0.7)
DARK: Rgb = (0.2, 0.2, 0.22)


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
    legs_into(assembly, order, body, low - 0.03, 0.09, back - order.x[0])
    return assembly
