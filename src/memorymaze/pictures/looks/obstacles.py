"""Things left in the way, and the placeholder for what nobody has modelled."""

from itertools import pairwise

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import metal, paint, picture
from memorymaze.pictures.looks.primitives import box, lathed, plate

CARDBOARD: Rgb = (0.72, 0.55, 0.36)
STEEL: Rgb = (0.7, 0.71, 0.73)
DARK: Rgb = (0.12, 0.12, 0.14)


def cardboard_boxes(order: Order) -> Assembly:
    """Build a pile of taped cardboard boxes."""
    assembly = Assembly()
    back, front = order.x
    split = order.height * (0.58 if order.height > 0.5 else 1.0)
    _carton(assembly, order.colour(CARDBOARD), order.x, order.y, (0.0, split))
    if split < order.height:
        shift = 0.1 * order.length * (1 if order.variant % 2 else -1)
        y = (
            order.y[0] + 0.15 * order.length + shift,
            order.y[1] - 0.2 * order.length + shift,
        )
        x = (back + 0.06 * order.depth, front - 0.14 * order.depth)
        _carton(
            assembly, shade(order.colour(CARDBOARD), 1.1), x, y, (split, order.height)
        )
    if order.text:
        wide = order.length * 0.6
        pixels = sign_board(wide, split * 0.35, order.text, (0.95, 0.93, 0.88))
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.02, front + 0.003),
                (-wide / 2, wide / 2),
                (split * 0.2, split * 0.55),
            ),
        )
    return assembly


def queue_barrier(order: Order) -> Assembly:
    """Build posts with round feet and a belt between them."""
    assembly = Assembly()
    r = min(0.17, order.depth / 2)
    posts = max(2, round(order.length / 1.6) + 1)
    reach = order.length - 2 * r
    for place in range(posts):
        y = -reach / 2 + reach * place / (posts - 1)
        post = lathed(
            [
                (r, 0),
                (r, 0.02),
                (0.05, 0.05),
                (0.03, 0.07),
                (0.03, order.height - 0.08),
                (0.04, order.height - 0.08),
                (0.04, order.height),
            ],
            16,
        )
        assembly.add(metal(STEEL), post.moved(y=y))
    belt = order.height - 0.06
    assembly.add(
        paint(order.colour((0.7, 0.1, 0.12))),
        box((-0.006, 0.006), (-reach / 2, reach / 2), (belt - 0.025, belt + 0.025)),
    )
    if order.text:
        wide = min(0.5, reach * 0.5)
        pixels = sign_board(wide, 0.24, order.text, (0.95, 0.95, 0.93))
        assembly.add(
            picture(pixels),
            plate(
                (-0.01, 0.012),
                (-wide / 2, wide / 2),
                (belt - 0.32, belt - 0.05),
                both_sides=True,
            ),
        )
    return assembly


def traffic_cone(order: Order) -> Assembly:
    """Build a cone with white bands on a square foot."""
    assembly = Assembly()
    r = min(order.length, order.depth) * 0.4
    h = order.height
    orange = paint(order.colour((0.95, 0.4, 0.05)), 0.1)
    assembly.add(orange, box(order.x, order.y, (0, 0.04), 0.01))
    marks = (0.04, 0.3 * h, 0.48 * h, 0.62 * h, 0.76 * h, h)
    for place, (low, high) in enumerate(pairwise(marks)):
        a, b = (r * (1 - 0.88 * each / h) for each in (low, high))
        tone = orange if place % 2 == 0 else paint((0.96, 0.96, 0.95))
        assembly.add(tone, lathed([(a, low), (b, high)], 18))
    return assembly


def placeholder(order: Order) -> Assembly:
    """Build a striped box with the name of its kind on all that can be seen of it."""
    assembly = Assembly()
    back, front = order.x
    body = paint(order.colour((0.62, 0.64, 0.67)))
    rim = min(0.06, *(0.12 * side for side in (order.length, order.height)))
    step = min(0.012, 0.2 * order.depth)
    assembly.add(body, box((back + step, front - step), order.y, order.z))
    stripe = paint((0.95, 0.75, 0.1))
    words = sign_board(
        order.length - 2 * rim,
        order.height - 2 * rim,
        f"{order.category}?",
        (0.96, 0.96, 0.94),
    )
    for x in (
        (front - 2 * step, front - 0.5 * step),
        (back + 0.5 * step, back + 2 * step),
    ):
        assembly.add(stripe, box(x, order.y, order.z))
    sheet = picture(words)
    y = (order.y[0] + rim, order.y[1] - rim)
    front_sheet = plate((front - 2 * step, front), y, (rim, order.height - rim))
    assembly.add(sheet, front_sheet, front_sheet.turned("z", 180))
    return assembly


def _carton(
    assembly: Assembly,
    colour: Rgb,
    x: tuple[float, float],
    y: tuple[float, float],
    z: tuple[float, float],
) -> None:
    assembly.add(paint(colour, 0.0), box(x, y, z, 0.008))
    middle = (y[0] + y[1]) / 2
    tape = paint(shade(colour, 1.25), 0.3)
    assembly.add(
        tape,
        box(
            (x[0] - 0.002, x[1] + 0.002),
            (middle - 0.03, middle + 0.03),
            (z[1] - 0.12 * (z[1] - z[0]), z[1] + 0.001),
        ),
    )
    assembly.add(
        paint(shade(colour, 0.6), 0.0),
        box(
            (x[1] - 0.01, x[1] + 0.003),
            (y[0] + 0.06 * (y[1] - y[0]), y[0] + 0.2 * (y[1] - y[0])),
            (z[0] + 0.1 * (z[1] - z[0]), z[0] + 0.3 * (z[1] - z[0])),
        ),
    )
