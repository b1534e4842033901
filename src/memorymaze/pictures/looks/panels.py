"""Things that hang flat on a wall: posters, panels, maps, boards, pictures."""

from memorymaze.pictures.looks import artwork, maps
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, paint, picture, wood
from memorymaze.pictures.looks.primitives import box, plate, tapered
from memorymaze.pictures.looks.signs import sheet

WHITE: Rgb = (0.93, 0.93, 0.92)
STEEL: Rgb = (0.68, 0.70, 0.72)
DARK: Rgb = (0.16, 0.17, 0.19)
OAK: Rgb = (0.66, 0.48, 0.30)


def poster(order: Order) -> Assembly:
    """Build a poster: words over a picture."""
    pixels = artwork.poster(
        order.length, order.height, order.text or "", order.colour(WHITE), order.variant
    )
    return sheet(order, picture(pixels))


def information_panel(order: Order) -> Assembly:
    """Build an exhibition panel with a headline, small print and a picture."""
    ground = order.colour((0.15, 0.24, 0.42))
    pixels = artwork.headlined(
        order.length, order.height, order.text or "", ground, order.variant
    )
    return sheet(order, picture(pixels))


def exhibit_panel(order: Order) -> Assembly:
    """Build a panel: flat on a wall, or a slanted desk to read on a stand."""
    if order.depth < 0.2:
        return information_panel(order)
    ground = order.colour((0.15, 0.24, 0.42))
    pixels = artwork.headlined(
        order.length, order.depth * 1.4, order.text or "", ground, order.variant
    )
    assembly = Assembly()
    back, front = order.x
    low, high = order.height * 0.68, order.height
    tilted = plate(order.x, order.y, (high - 0.04, high), roof=True)
    fall = (high - low - 0.04) * (tilted.vertices[:, 0] - back) / order.depth
    tilted.vertices[:, 2] -= fall
    assembly.add(picture(pixels), tilted)
    for side in (-1, 1):
        y = side * order.length * 0.36
        assembly.add(
            metal(STEEL),
            tapered(
                (-0.1, 0.06), (y - 0.03, y + 0.03), (0, (low + high) / 2 - 0.03),
                (back * 0.3, 0.03), (y - 0.03, y + 0.03),
            ),
        )  # fmt: skip
        assembly.add(metal(STEEL), box((back, front), (y - 0.05, y + 0.05), (0, 0.02)))
    return assembly


def notice_board(order: Order) -> Assembly:
    """Build a cork board with papers in a wooden frame."""
    pixels = artwork.cork_board(
        order.length - 0.08,
        order.height - 0.08,
        order.text or "",
        order.colour((0.74, 0.56, 0.36)),
        order.variant,
    )
    return framed(order, picture(pixels), wood(OAK), 0.04)


def whiteboard(order: Order) -> Assembly:
    """Build a whiteboard on the wall, or on a stand with castors where it is deep."""
    low = order.height * 0.42 if order.mount == "floor" else 0.0
    pixels = artwork.marker_board(
        order.length - 0.06, order.height - low - 0.06, order.text or "", order.variant
    )
    if order.mount != "floor":
        return framed(order, picture(pixels), metal(STEEL), 0.03)
    board = Order(
        order.category, order.length, 0.05, order.height - low, order.colour_words
    )
    assembly = Assembly()
    assembly.include(framed(board, picture(pixels), metal(STEEL), 0.03), z=low)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.05)
        assembly.add(
            metal(STEEL),
            box((-0.02, 0.02), (y - 0.02, y + 0.02), (0.06, low)),
            box(order.x, (y - 0.02, y + 0.02), (0.05, 0.09)),
        )
        for x in (order.x[0] + 0.04, order.x[1] - 0.04):
            assembly.add(
                paint(DARK),
                box((x - 0.04, x + 0.04), (y - 0.015, y + 0.015), (0, 0.06)),
            )
    return assembly


def menu_board(order: Order) -> Assembly:
    """Build a board with a line of words for each thing on offer."""
    text = "\n".join((order.text or order.category).split(" / "))
    pixels = sign_board(order.length, order.height, text, order.colour(DARK))
    return framed(order, picture(pixels), wood(OAK), 0.03)


def floor_map(order: Order) -> Assembly:
    """Build a floor plan to find one's way by."""
    pixels = maps.floor_map(
        order.length, order.height, order.text or "", order.colour(WHITE), order.variant
    )
    return framed(order, picture(pixels), metal(STEEL), 0.02)


def world_map(order: Order) -> Assembly:
    """Build a map of the world."""
    sea = order.colour((0.14, 0.36, 0.66))
    if min(sea) > 0.8:
        sea = (0.14, 0.36, 0.66)
    land = order.second_colour((0.28, 0.52, 0.24))
    pixels = maps.world_map(order.length, order.height, order.text or "", sea, land)
    return framed(order, picture(pixels), metal(STEEL), 0.02)


def framed(order: Order, material: Material, frame: Material, width: float) -> Assembly:
    """Build a sheet in a frame of four bars of this width in metres."""
    assembly = Assembly()
    back, front = order.x
    step = min(0.012, 0.3 * order.depth)
    left, right = order.y
    assembly.add(
        material,
        plate(
            (back, front - step),
            (left + width * 0.9, right - width * 0.9),
            (width * 0.9, order.height - width * 0.9),
        ),
    )
    for z in (0.0, order.height - width):
        assembly.add(frame, box(order.x, order.y, (z, z + width)))
    for y in (left, right - width):
        assembly.add(frame, box(order.x, (y, y + width), (width, order.height - width)))
    return assembly
