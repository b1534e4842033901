"""Flat things that show something: posters, boards, maps, pictures and screens."""

from memorymaze.pictures.looks import artwork
from memorymaze.pictures.looks.assembly import Assembly, Order, built
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.materials import (
    ALUMINIUM,
    CHALK,
    EBONY,
    ELM,
    GRAPHITE,
    PALE_GREY,
    Material,
    metal,
    paint,
    picture,
    wood,
)
from memorymaze.pictures.looks.shapes import (
    around,
    box,
    extruded,
    plate,
    tapered,
)
from memorymaze.pictures.looks.signs import sheet

GLOW = 0.55


def poster(made: Assembly, order: Order) -> None:
    """Build a poster: words over a picture."""
    pixels = artwork.poster_picture(
        order.length, order.height, order.text or "", order.colour(CHALK), order.variant
    )
    sheet(made, order, picture(pixels))


def information_panel(made: Assembly, order: Order) -> None:
    """Build an exhibition panel with a headline, small print and a picture."""
    ground = order.colour((0.15, 0.24, 0.42))
    pixels = artwork.headlined(
        order.length, order.height, order.text or "", ground, order.variant
    )
    sheet(made, order, picture(pixels))


def exhibit_panel(made: Assembly, order: Order) -> None:
    """Build a panel: flat on a wall, or a slanted desk to read on a stand."""
    if order.depth < 0.2:
        information_panel(made, order)
        return
    ground = order.colour((0.15, 0.24, 0.42))
    pixels = artwork.headlined(
        order.length, order.depth * 1.4, order.text or "", ground, order.variant
    )
    back = order.x[0]
    low, high = order.height * 0.68, order.height
    tilted = plate(order.x, order.y, (high - 0.04, high), roof=True)
    fall = (high - low - 0.04) * (tilted.vertices[:, 0] - back) / order.depth
    tilted.vertices[:, 2] -= fall
    made.add(picture(pixels), tilted)
    for side in (-1, 1):
        y = side * order.length * 0.36
        made.add(
            metal(ALUMINIUM),
            tapered(
                (-0.1, 0.06), around(y, 0.03), (0, (low + high) / 2 - 0.03),
                (back * 0.3, 0.03), around(y, 0.03)
            )
        )  # fmt: skip
        made.box(metal(ALUMINIUM), order.x, around(y, 0.05), (0, 0.02))


def notice_board(made: Assembly, order: Order) -> None:
    """Build a cork board with papers in a wooden frame."""
    pixels = artwork.cork_board(
        order.length - 0.08,
        order.height - 0.08,
        order.text or "",
        order.colour((0.74, 0.56, 0.36)),
        order.variant,
    )
    framed(made, order, picture(pixels), wood(ELM), 0.04)


def whiteboard(made: Assembly, order: Order) -> None:
    """Build a whiteboard on the wall, or on a stand with castors where it is deep."""
    low = order.height * 0.42 if order.mount == "floor" else 0.0
    pixels = artwork.marker_board(
        order.length - 0.06, order.height - low - 0.06, order.text or "", order.variant
    )
    if order.mount != "floor":
        framed(made, order, picture(pixels), metal(ALUMINIUM), 0.03)
        return
    board = Order(
        order.category, order.length, 0.05, order.height - low, order.colour_words
    )
    made.include(built(framed, board, picture(pixels), metal(ALUMINIUM), 0.03), z=low)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.05)
        made.add(
            metal(ALUMINIUM),
            box((-0.02, 0.02), around(y, 0.02), (0.06, low)),
            box(order.x, around(y, 0.02), (0.05, 0.09)),
        )
        for x in (order.x[0] + 0.04, order.x[1] - 0.04):
            made.box(paint(GRAPHITE), around(x, 0.04), around(y, 0.015), (0, 0.06))


def menu_board(made: Assembly, order: Order) -> None:
    """Build a board with a line of words for each thing on offer."""
    text = "\n".join((order.text or order.category).split(" / "))
    pixels = sign_board(order.length, order.height, text, order.colour(GRAPHITE))
    framed(made, order, picture(pixels), wood(ELM), 0.03)


def floor_map(made: Assembly, order: Order) -> None:
    """Build a floor plan to find one's way by."""
    pixels = artwork.floor_map_picture(
        order.length, order.height, order.text or "", order.colour(CHALK), order.variant
    )
    framed(made, order, picture(pixels), metal(ALUMINIUM), 0.02)


def world_map(made: Assembly, order: Order) -> None:
    """Build a map of the world."""
    sea = order.colour((0.14, 0.36, 0.66))
    if min(sea) > 0.8:
        sea = (0.14, 0.36, 0.66)
    land = order.second_colour((0.28, 0.52, 0.24))
    pixels = artwork.world_map_picture(
        order.length, order.height, order.text or "", sea, land
    )
    framed(made, order, picture(pixels), metal(ALUMINIUM), 0.02)


def framed(
    made: Assembly, order: Order, material: Material, frame: Material, width: float
) -> None:
    """Build a sheet in a frame of four bars of this width in metres."""
    step = min(0.012, 0.3 * order.depth)
    left, right = order.y
    made.plate(
        material,
        order.x.inset(0, step),
        order.y.inset(width * 0.9),
        (width * 0.9, order.height - width * 0.9),
    )
    for z in (0.0, order.height - width):
        made.box(frame, order.x, order.y, (z, z + width))
    for y in (left, right - width):
        made.box(frame, order.x, (y, y + width), (width, order.height - width))


def painting(made: Assembly, order: Order) -> None:
    """Build a landscape in a frame."""
    pixels = artwork.painting_picture(
        order.length, order.height, order.colour((0.3, 0.45, 0.6)), order.variant
    )
    framed(made, order, picture(pixels), paint((0.55, 0.42, 0.18), 0.5), 0.05)


def mural(made: Assembly, order: Order) -> None:
    """Build a picture straight on the wall, with its words under it."""
    colour = order.colour((0.3, 0.45, 0.6))
    pixels = artwork.poster_picture(
        order.length, order.height, order.text or "", colour, order.variant
    )
    sheet(made, order, picture(pixels))


def framed_photos(made: Assembly, order: Order) -> None:
    """Build rows of portraits."""
    tone = order.colour((0.2, 0.2, 0.2))
    pixels = artwork.photo_picture(order.length, order.height, tone)
    sheet(made, order, picture(pixels))


def mirror(made: Assembly, order: Order) -> None:
    """Build a mirror: a pale shiny pane in a frame."""
    frame = min(0.04, 0.1 * order.length)
    back, front = order.x
    made.box(metal(order.colour(ALUMINIUM)), order.x.inset(0, 0.01), order.y, order.z)
    inner = order.y.inset(frame)
    made.add(
        paint((0.83, 0.90, 0.93), 1.0),
        extruded(
            [(inner[0], frame), (inner[1], frame), (inner[1], order.height - frame),
             (inner[0], order.height - frame)],
            order.x,
            "x"
        )
    )  # fmt: skip
    stripe = order.length * 0.16
    made.add(
        paint((0.95, 0.98, 1.0), 1.0),
        extruded(
            [(-stripe, order.height * 0.3), (0, order.height * 0.3),
             (stripe, order.height * 0.7), (0, order.height * 0.7)],
            (back, front + 0.002),
            "x"
        )
    )  # fmt: skip


def flag(made: Assembly, order: Order) -> None:
    """Build a flag hanging from a pole on the wall."""
    pixels = artwork.flag_picture(
        order.length,
        order.height,
        order.colour((0.13, 0.36, 0.75)),
        order.second_colour(CHALK),
    )
    made.plate(picture(pixels), (-0.008, 0.008), order.y, (0, order.height - 0.03))
    half = order.depth / 2
    made.box(wood(ELM), (-half, half), order.y, order.z.end(0.05), 0.02)


def digital_sign(made: Assembly, order: Order) -> None:
    """Build a flat screen that shows a picture with its words."""
    _screen(made, order, tiles=1)


def video_wall(made: Assembly, order: Order) -> None:
    """Build a screen of three by three tiles."""
    _screen(made, order, tiles=3)


def touch_screen(made: Assembly, order: Order) -> None:
    """Build a slanted display on a pedestal."""
    body = order.body(PALE_GREY)
    back, front = order.x
    low, high = order.height * 0.66, order.height
    foot = order.length * 0.3
    made.add(
        body,
        box(order.x, around(0, order.length * 0.38), (0, 0.03)),
        tapered(
            (back * 0.5, front * 0.5), (-foot, foot), (0.03, (low + high) / 2 - 0.05),
            (back * 0.4, front * 0.3), around(0, foot * 0.8)
        )
    )  # fmt: skip
    pixels = artwork.film(
        order.length, order.depth * 1.3, order.text or "", order.variant
    )
    for material, depth, top in (
        (paint(EBONY), order.x, high - 0.015),
        (picture(pixels, GLOW), order.x.inset(0.025), high),
    ):
        inset = 0.0 if depth == order.x else 0.03
        y = order.y.inset(inset)
        slab = plate(depth, y, (top - 0.06 + inset, top), roof=True)
        slab.vertices[:, 2] -= (
            (high - low - 0.06) * (slab.vertices[:, 0] - back) / order.depth
        )
        made.add(material, slab)


def kiosk(made: Assembly, order: Order) -> None:
    """Build an upright pillar with a screen and its words over it."""
    body = order.body((0.2, 0.35, 0.6))
    made.add(
        body,
        box(order.x, order.y, (0, 0.05), 0.01),
        box(order.x.inset(0.05, 0.03), order.y.inset(0.04), (0.05, order.height), 0.03),
    )
    y = order.y.inset(0.09)
    top = order.height - 0.06
    head = top - 0.3 * order.height
    made.plate(
        picture(
            artwork.film(
                order.length, order.height * 0.3, order.text or "", order.variant
            ),
            GLOW,
        ),
        order.x.end(0.06, 0.02),
        y,
        (head, top),
    )
    shelf = head - 0.08
    made.box(paint(EBONY), order.x.end(0.08), y, (shelf - 0.04, shelf), 0.01)


def computer_terminal(made: Assembly, order: Order) -> None:
    """Build a stand with a monitor, a keyboard and its words on the front."""
    back, front = order.x
    desk = order.height * 0.66
    body = order.body(PALE_GREY)
    made.add(
        body,
        box(order.x, order.y, (desk - 0.04, desk), 0.01),
        box(order.x.inset(0.04, 0.12), order.y.inset(0.04), (0, desk - 0.04)),
    )
    words = sign_board(order.length * 0.9, 0.2, order.text or "", (0.13, 0.36, 0.75))
    made.plate(
        picture(words),
        order.x.end(0.13, 0.11),
        order.y.inset(0.06),
        (desk - 0.3, desk - 0.1),
    )
    middle = (back + front) / 2 - 0.05
    half = order.length * 0.4
    low = desk + 0.1
    made.add(
        paint(EBONY),
        box(around(middle, 0.08), (-0.1, 0.1), (desk, desk + 0.015)),
        box((middle - 0.02, middle + 0.01), (-0.03, 0.03), (desk + 0.01, low + 0.05)),
        box((middle - 0.02, middle + 0.025), (-half, half), (low, order.height), 0.01),
        box(order.x.end(0.18, 0.05), around(0, half * 0.8), (desk, desk + 0.02)),
    )
    display = artwork.film(half * 2, order.height - low, "", order.variant)
    made.plate(
        picture(display, GLOW),
        (middle, middle + 0.03),
        (-half + 0.02, half - 0.02),
        (low + 0.02, order.height - 0.02),
    )


def _screen(made: Assembly, order: Order, tiles: int) -> None:
    rim = min(0.03, 0.04 * min(order.length, order.height))
    made.box(
        paint(order.colour(EBONY), 0.4),
        order.x.inset(0, 0.008),
        order.y,
        order.z,
        min(0.012, order.depth / 5),
    )
    pixels = artwork.film(
        order.length, order.height, order.text or "", order.variant, tiles=tiles
    )
    made.plate(
        picture(pixels, GLOW),
        order.x.end(0.03),
        order.y.inset(rim),
        (rim, order.height - rim),
    )
