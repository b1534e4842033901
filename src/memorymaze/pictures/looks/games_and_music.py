"""Games tables and pianos."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.materials import (
    BLACK,
    IRON,
    SLATE,
    Rgb,
    metal,
    paint,
    wood,
)
from memorymaze.pictures.looks.seats_and_tables import legs_into, table
from memorymaze.pictures.looks.shapes import around, box, extruded, tapered

IVORY: Rgb = (0.96, 0.95, 0.91)


def chessboard_table(made: Assembly, order: Order) -> None:
    """Build a square table with a chessboard and its pieces."""
    table(made, order)
    half = 0.36 * min(order.length, order.depth)
    step = half / 4
    light, dark = paint((0.92, 0.86, 0.72)), paint((0.22, 0.13, 0.08))
    top = order.height
    for row in range(8):
        for column in range(8):
            x, y = -half + row * step, -half + column * step
            made.box(
                light if (row + column) % 2 else dark,
                (x, x + step),
                (y, y + step),
                order.z.end(0.02, -0.003),
            )
    for row, colour in ((0, dark), (7, light)):
        for column in range(8):
            x, y = -half + (row + 0.5) * step, -half + (column + 0.5) * step
            made.lathed(
                colour,
                [
                    (step * 0.35, top),
                    (step * 0.12, top + 0.04),
                    (step * 0.2, top + 0.06),
                    (0, top + 0.08),
                ],
                6,
                at=(x, y, 0),
            )


def foosball_table(made: Assembly, order: Order) -> None:
    """Build a table football game: a green pitch in a box with rods and handles."""
    back, front = order.x.inset(0.1)
    low, high = order.height * 0.6, order.height
    body = wood((0.5, 0.33, 0.2))
    for y in (order.y[0], order.y[1] - 0.04):
        made.box(body, (back, front), (y, y + 0.04), (low, high - 0.03))
    for x in (back, front - 0.04):
        made.box(body, (x, x + 0.04), order.y, (low, high - 0.03))
    made.box(body, (back, front), order.y, (low - 0.05, low))
    made.box(
        paint(order.colour((0.15, 0.55, 0.25))),
        (back + 0.04, front - 0.04),
        order.y.inset(0.04),
        (low, low + 0.1),
    )
    for place in range(6):
        y = order.y[0] + order.length * (place + 0.75) / 6.5
        z = high - 0.1
        made.tube(metal(IRON), [(order.x[0], y, z), (order.x[1], y, z)], 0.01, 6)
        end = order.x[place % 2]
        inward = end * 0.8
        made.tube(paint(SLATE), [(end, y, z), (inward, y, z)], 0.022, 6)
        shirt = paint((0.8, 0.15, 0.15) if place % 2 else (0.15, 0.3, 0.75))
        for player in range(3):
            x = back + (front - back) * (player + 1) / 4
            made.box(shirt, around(x, 0.02), around(y, 0.025), (z - 0.09, z + 0.1))
    legs_into(made, order, body, low - 0.03, 0.09, back - order.x[0])


def piano(made: Assembly, order: Order) -> None:
    """Build an upright piano with its keys, a music desk and pedals."""
    back, front = order.x
    left, right = order.y
    body = paint(order.colour(BLACK), 0.7)
    h = order.height
    keys = 0.6 * h
    rear = back + 0.5 * order.depth
    made.add(
        body,
        box((back, rear), order.y, (0.06, h - 0.03), 0.01),
        box((back, rear + 0.02), order.y, order.z.end(0.03), 0.01),
    )
    made.box(body, (rear, front), order.y, (keys - 0.12, keys - 0.03))
    for y in (order.y.start(0.06), order.y.end(0.06)):
        made.add(
            body,
            box((rear, front), y, (keys - 0.03, keys + 0.05), 0.01),
            box(order.x.end(0.1, 0.02), y, (0, keys - 0.12)),
        )
        made.box(body, order.x, y, (0, 0.06))
    _keyboard(made, (rear, front - 0.04), order.y.inset(0.06), keys - 0.03)
    made.box(
        body, (rear, rear + 0.03), (left * 0.5, right * 0.5), (keys + 0.1, keys + 0.14)
    )
    made.box(
        paint(IVORY),
        (rear + 0.002, rear + 0.012),
        (left * 0.3, right * 0.3),
        (keys + 0.14, keys + 0.38),
    )
    for y in (-0.12, 0.0, 0.12):
        made.box(
            metal((0.8, 0.65, 0.3)), (rear, rear + 0.12), around(y, 0.025), (0.05, 0.07)
        )


def grand_piano(made: Assembly, order: Order) -> None:
    """Build a grand piano with its lid up, its keys to the front."""
    back, front = order.x
    left, right = order.y
    body = paint(order.colour(BLACK), 0.8)
    h = order.height
    low, rim = 0.56 * h, 0.72 * h
    curve = [
        (front, left),
        (front, right),
        (0.1 * order.depth, right),
        (-0.1 * order.depth, right * 0.82),
        (-0.25 * order.depth, right * 0.45),
        (-0.42 * order.depth, right * 0.1),
        (back, left * 0.3),
        (back + 0.02, left * 0.7),
        (-0.4 * order.depth, left),
    ]
    made.add(body, extruded(curve, (low, rim - 0.05), "z"))
    shelf = 0.28 * order.depth
    strings = [(x, y) for x, y in curve if x < shelf]
    inner = [(x * 0.94, y * 0.94) for x, y in [(shelf, right), *strings, (shelf, left)]]
    made.add(metal((0.78, 0.6, 0.25)), extruded(inner, (rim - 0.05, rim - 0.03), "z"))
    made.box(body, (shelf - 0.02, shelf + 0.06), order.y, (rim - 0.05, rim + 0.02))
    for y in (order.y.start(0.08), order.y.end(0.08)):
        made.box(body, (shelf, front), y, (rim - 0.05, rim))
    _keyboard(made, (shelf + 0.06, front - 0.02), order.y.inset(0.08), rim - 0.05)
    lid = extruded(
        [(x, y) for x, y in [(shelf, right), *strings, (shelf, left)]], (0.0, 0.02), "z"
    )
    lid = lid.moved(y=-left).turned("x", 38).moved(y=left, z=rim)
    high = lid.vertices[:, 2].max()
    lid = lid.moved(z=-rim).scaled(1, 1, (h - rim) / (high - rim)).moved(z=rim)
    made.add(body, lid)
    made.tube(
        body,
        [(0.05, right * 0.8, rim - 0.04), (0.05, right * 0.35, rim + 0.5 * (h - rim))],
        0.012,
        5,
    )
    for x, y in (
        (front * 0.75, left * 0.82),
        (front * 0.75, right * 0.82),
        (back * 0.7, left * 0.45),
    ):
        made.add(
            body,
            tapered(
                around(x, 0.035),
                around(y, 0.035),
                (0, low),
                around(x, 0.06),
                around(y, 0.06),
            ),
        )
    made.box(body, (front * 0.45, front * 0.55), (-0.09, 0.09), (0.1, low))
    for y in (-0.06, 0.0, 0.06):
        made.box(
            metal((0.8, 0.65, 0.3)),
            (front * 0.5, front * 0.72),
            around(y, 0.018),
            (0.06, 0.08),
        )


def _keyboard(
    made: Assembly, x: tuple[float, float], y: tuple[float, float], z: float
) -> None:
    made.box(paint(IVORY, 0.4), x, y, (z, z + 0.02))
    black = paint(BLACK, 0.4)
    count = 28
    step = (y[1] - y[0]) / count
    for key in range(1, count):
        middle = y[0] + key * step
        if key % 7 not in {0, 3}:
            made.box(
                black,
                (x[0], x[0] + 0.6 * (x[1] - x[0])),
                around(middle, 0.25 * step),
                (z + 0.02, z + 0.032),
            )
