"""Pictures on walls: paintings, murals, photos, mirrors, flags."""

from memorymaze.pictures.looks import artwork
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import metal, paint, picture, wood
from memorymaze.pictures.looks.panels import framed
from memorymaze.pictures.looks.primitives import box, extruded, plate
from memorymaze.pictures.looks.signs import sheet

WHITE: Rgb = (0.93, 0.93, 0.92)
STEEL: Rgb = (0.68, 0.70, 0.72)
OAK: Rgb = (0.66, 0.48, 0.30)


def painting(order: Order) -> Assembly:
    """Build a landscape in a frame."""
    pixels = artwork.painting(
        order.length, order.height, order.colour((0.3, 0.45, 0.6)), order.variant
    )
    return framed(order, picture(pixels), paint((0.55, 0.42, 0.18), 0.5), 0.05)


def mural(order: Order) -> Assembly:
    """Build a picture straight on the wall, with its words under it."""
    colour = order.colour((0.3, 0.45, 0.6))
    pixels = artwork.poster(
        order.length, order.height, order.text or "", colour, 4 * order.variant
    )
    return sheet(order, picture(pixels))


def framed_photos(order: Order) -> Assembly:
    """Build rows of portraits."""
    tone = order.colour((0.2, 0.2, 0.2))
    pixels = artwork.framed_photos(order.length, order.height, tone)
    return sheet(order, picture(pixels))


def mirror(order: Order) -> Assembly:
    """Build a mirror: a pale shiny pane in a frame."""
    assembly = Assembly()
    frame = min(0.04, 0.1 * order.length)
    back, front = order.x
    assembly.add(
        metal(order.colour(STEEL)), box((back, front - 0.01), order.y, order.z)
    )
    low, high = order.y
    inner = (low + frame, high - frame)
    assembly.add(
        paint((0.83, 0.90, 0.93), 1.0),
        extruded(
            [(inner[0], frame), (inner[1], frame), (inner[1], order.height - frame),
             (inner[0], order.height - frame)],
            (back, front),
            "x",
        ),
    )  # fmt: skip
    stripe = order.length * 0.16
    assembly.add(
        paint((0.95, 0.98, 1.0), 1.0),
        extruded(
            [(-stripe, order.height * 0.3), (0, order.height * 0.3),
             (stripe, order.height * 0.7), (0, order.height * 0.7)],
            (back, front + 0.002),
            "x",
        ),
    )  # fmt: skip
    return assembly


def flag(order: Order) -> Assembly:
    """Build a flag hanging from a pole on the wall."""
    pixels = artwork.flag(
        order.length,
        order.height,
        order.colour((0.13, 0.36, 0.75)),
        order.second_colour(WHITE),
    )
    assembly = Assembly()
    assembly.add(
        picture(pixels), plate((-0.008, 0.008), order.y, (0, order.height - 0.03))
    )
    half = order.depth / 2
    assembly.add(
        wood(OAK),
        box((-half, half), order.y, (order.height - 0.05, order.height), 0.02),
    )
    return assembly
