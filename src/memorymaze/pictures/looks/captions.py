"""What tells visitors about a thing: plinths and strips with words."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, is_wooden, shade
from memorymaze.pictures.looks.paints import paint, picture
from memorymaze.pictures.looks.primitives import Span, box, plate

DARK: Rgb = (0.13, 0.13, 0.15)
STONE: Rgb = (0.6, 0.59, 0.56)


def plinth(order: Order, height: float, colour: Rgb = STONE) -> Assembly:
    """Build a stone base over the order's footprint, its words on the front."""
    assembly = Assembly()
    stone = paint(colour, 0.05)
    back, front = order.x
    lip = min(0.03, 0.1 * height)
    assembly.add(stone, box(order.x, order.y, (0, lip)))
    assembly.add(
        stone,
        box(
            (back + 0.03, front - 0.03),
            (order.y[0] + 0.03, order.y[1] - 0.03),
            (lip, height),
        ),
    )
    if order.text:
        wide = order.length * 0.84
        tall = min(0.75 * (height - lip), 0.42 * wide)
        tall = max(tall, min(0.1, height - lip))
        pixels = sign_board(wide, tall, order.text, (0.1, 0.1, 0.12))
        middle = lip + (height - lip) / 2
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.05, front - 0.015),
                (-wide / 2, wide / 2),
                (middle - tall / 2, middle + tall / 2),
            ),
        )
    return assembly


def header(assembly: Assembly, order: Order, z: Span, front: float) -> None:
    """Add a strip with the order's words, if it has any, to the front of a thing."""
    if not order.text:
        return
    colour = order.colour((0.3, 0.3, 0.32))
    ground = shade(colour, 0.45) if not is_wooden(order.colour_words) else DARK
    pixels = sign_board(order.length * 0.96, z[1] - z[0], order.text, ground)
    half = order.length * 0.48
    assembly.add(
        picture(pixels), plate((front - 0.02, front + 0.012), (-half, half), z)
    )
