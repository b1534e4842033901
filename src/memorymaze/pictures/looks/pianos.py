"""Pianos."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import metal, paint
from memorymaze.pictures.looks.primitives import box, extruded, tapered
from memorymaze.pictures.looks.tubes import tube

DARK: Rgb = (0.1, 0.1, 0.11)
IVORY: Rgb = (0.96, 0.95, 0.91)


def piano(order: Order) -> Assembly:
    """Build an upright piano with its keys, a music desk and pedals."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    body = paint(order.colour(DARK), 0.7)
    h = order.height
    keys = 0.6 * h
    rear = back + 0.5 * order.depth
    assembly.add(
        body,
        box((back, rear), order.y, (0.06, h - 0.03), 0.01),
        box((back, rear + 0.02), order.y, (h - 0.03, h), 0.01),
    )
    assembly.add(body, box((rear, front), order.y, (keys - 0.12, keys - 0.03)))
    for y in ((left, left + 0.06), (right - 0.06, right)):
        assembly.add(
            body,
            box((rear, front), y, (keys - 0.03, keys + 0.05), 0.01),
            box((front - 0.1, front - 0.02), y, (0, keys - 0.12)),
        )
        assembly.add(body, box((back, front), y, (0, 0.06)))
    _keyboard(assembly, (rear, front - 0.04), (left + 0.06, right - 0.06), keys - 0.03)
    assembly.add(
        body,
        box((rear, rear + 0.03), (left * 0.5, right * 0.5), (keys + 0.1, keys + 0.14)),
    )
    assembly.add(
        paint(IVORY),
        box(
            (rear + 0.002, rear + 0.012),
            (left * 0.3, right * 0.3),
            (keys + 0.14, keys + 0.38),
        ),
    )
    for y in (-0.12, 0.0, 0.12):
        assembly.add(
            metal((0.8, 0.65, 0.3)),
            box((rear, rear + 0.12), (y - 0.025, y + 0.025), (0.05, 0.07)),
        )
    return assembly


def grand_piano(order: Order) -> Assembly:
    """Build a grand piano with its lid up, its keys to the front."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    body = paint(order.colour(DARK), 0.8)
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
    assembly.add(body, extruded(curve, (low, rim - 0.05), "z"))
    shelf = 0.28 * order.depth
    strings = [(x, y) for x, y in curve if x < shelf]
    inner = [(x * 0.94, y * 0.94) for x, y in [(shelf, right), *strings, (shelf, left)]]
    assembly.add(
        metal((0.78, 0.6, 0.25)), extruded(inner, (rim - 0.05, rim - 0.03), "z")
    )
    assembly.add(
        body, box((shelf - 0.02, shelf + 0.06), order.y, (rim - 0.05, rim + 0.02))
    )
    for y in ((left, left + 0.08), (right - 0.08, right)):
        assembly.add(body, box((shelf, front), y, (rim - 0.05, rim)))
    _keyboard(
        assembly, (shelf + 0.06, front - 0.02), (left + 0.08, right - 0.08), rim - 0.05
    )
    lid = extruded(
        [(x, y) for x, y in [(shelf, right), *strings, (shelf, left)]], (0.0, 0.02), "z"
    )
    lid = lid.moved(y=-left).turned("x", 38).moved(y=left, z=rim)
    high = lid.vertices[:, 2].max()
    lid = lid.moved(z=-rim).scaled(1, 1, (h - rim) / (high - rim)).moved(z=rim)
    assembly.add(body, lid)
    assembly.add(
        body,
        tube(
            [
                (0.05, right * 0.8, rim - 0.04),
                (0.05, right * 0.35, rim + 0.5 * (h - rim)),
            ],
            0.012,
            5,
        ),
    )
    for x, y in (
        (front * 0.75, left * 0.82),
        (front * 0.75, right * 0.82),
        (back * 0.7, left * 0.45),
    ):
        assembly.add(
            body,
            tapered(
                (x - 0.035, x + 0.035),
                (y - 0.035, y + 0.035),
                (0, low),
                (x - 0.06, x + 0.06),
                (y - 0.06, y + 0.06),
            ),
        )
    assembly.add(body, box((front * 0.45, front * 0.55), (-0.09, 0.09), (0.1, low)))
    for y in (-0.06, 0.0, 0.06):
        assembly.add(
            metal((0.8, 0.65, 0.3)),
            box((front * 0.5, front * 0.72), (y - 0.018, y + 0.018), (0.06, 0.08)),
        )
    return assembly


def _keyboard(
    assembly: Assembly, x: tuple[float, float], y: tuple[float, float], z: float
) -> None:
    assembly.add(paint(IVORY, 0.4), box(x, y, (z, z + 0.02)))
    black = paint(DARK, 0.4)
    count = 28
    step = (y[1] - y[0]) / count
    for key in range(1, count):
        middle = y[0] + key * step
        if key % 7 not in {0, 3}:
            assembly.add(
                black,
                box(
                    (x[0], x[0] + 0.6 * (x[1] - x[0])),
                    (middle - 0.25 * step, middle + 0.25 * step),
                    (z + 0.02, z + 0.032),
                ),
            )
