"""Things with a display: televisions, signage, kiosks, terminals, video walls."""

from memorymaze.pictures.looks import artwork
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import paint, picture
from memorymaze.pictures.looks.primitives import box, plate, tapered

BLACK: Rgb = (0.07, 0.07, 0.08)
WHITE: Rgb = (0.9, 0.9, 0.9)
GLOW = 0.55


def screen(order: Order) -> Assembly:
    """Build a flat screen that shows a picture with its words."""
    return _screen(order, tiles=1)


def video_wall(order: Order) -> Assembly:
    """Build a screen of three by three tiles."""
    return _screen(order, tiles=3)


def touch_screen(order: Order) -> Assembly:
    """Build a slanted display on a pedestal."""
    assembly = Assembly()
    body = order.body(WHITE)
    back, front = order.x
    low, high = order.height * 0.66, order.height
    foot = order.length * 0.3
    assembly.add(
        body,
        box(order.x, (-order.length * 0.38, order.length * 0.38), (0, 0.03)),
        tapered(
            (back * 0.5, front * 0.5), (-foot, foot), (0.03, (low + high) / 2 - 0.05),
            (back * 0.4, front * 0.3), (-foot * 0.8, foot * 0.8),
        ),
    )  # fmt: skip
    pixels = artwork.film(
        order.length, order.depth * 1.3, order.text or "", order.variant
    )
    for material, depth, top in (
        (paint(BLACK), order.x, high - 0.015),
        (picture(pixels, GLOW), (back + 0.025, front - 0.025), high),
    ):
        inset = 0.0 if depth == order.x else 0.03
        y = (order.y[0] + inset, order.y[1] - inset)
        slab = plate(depth, y, (top - 0.06 + inset, top), roof=True)
        slab.vertices[:, 2] -= (
            (high - low - 0.06) * (slab.vertices[:, 0] - back) / order.depth
        )
        assembly.add(material, slab)
    return assembly


def kiosk(order: Order) -> Assembly:
    """Build an upright pillar with a screen and its words over it."""
    assembly = Assembly()
    back, front = order.x
    body = order.body((0.2, 0.35, 0.6))
    assembly.add(
        body,
        box(order.x, order.y, (0, 0.05), 0.01),
        box(
            (back + 0.05, front - 0.03),
            (order.y[0] + 0.04, order.y[1] - 0.04),
            (0.05, order.height),
            0.03,
        ),
    )
    y = (order.y[0] + 0.09, order.y[1] - 0.09)
    top = order.height - 0.06
    head = top - 0.3 * order.height
    assembly.add(
        picture(
            artwork.film(
                order.length, order.height * 0.3, order.text or "", order.variant
            ),
            GLOW,
        ),
        plate((front - 0.06, front - 0.02), y, (head, top)),
    )
    shelf = head - 0.08
    assembly.add(
        paint(BLACK), box((front - 0.08, front), y, (shelf - 0.04, shelf), 0.01)
    )
    return assembly


def computer_terminal(order: Order) -> Assembly:
    """Build a stand with a monitor, a keyboard and its words on the front."""
    assembly = Assembly()
    back, front = order.x
    desk = order.height * 0.66
    body = order.body(WHITE)
    assembly.add(
        body,
        box(order.x, order.y, (desk - 0.04, desk), 0.01),
        box(
            (back + 0.04, front - 0.12),
            (order.y[0] + 0.04, order.y[1] - 0.04),
            (0, desk - 0.04),
        ),
    )
    words = sign_board(order.length * 0.9, 0.2, order.text or "", (0.13, 0.36, 0.75))
    assembly.add(
        picture(words),
        plate(
            (front - 0.13, front - 0.11),
            (order.y[0] + 0.06, order.y[1] - 0.06),
            (desk - 0.3, desk - 0.1),
        ),
    )
    middle = (back + front) / 2 - 0.05
    half = order.length * 0.4
    low = desk + 0.1
    assembly.add(
        paint(BLACK),
        box((middle - 0.08, middle + 0.08), (-0.1, 0.1), (desk, desk + 0.015)),
        box((middle - 0.02, middle + 0.01), (-0.03, 0.03), (desk + 0.01, low + 0.05)),
        box((middle - 0.02, middle + 0.025), (-half, half), (low, order.height), 0.01),
        box(
            (front - 0.18, front - 0.05), (-half * 0.8, half * 0.8), (desk, desk + 0.02)
        ),
    )
    display = artwork.film(half * 2, order.height - low, "", order.variant)
    assembly.add(
        picture(display, GLOW),
        plate(
            (middle, middle + 0.03),
            (-half + 0.02, half - 0.02),
            (low + 0.02, order.height - 0.02),
        ),
    )
    return assembly


def _screen(order: Order, tiles: int) -> Assembly:
    assembly = Assembly()
    back, front = order.x
    rim = min(0.03, 0.04 * min(order.length, order.height))
    assembly.add(
        paint(order.colour(BLACK), 0.4),
        box((back, front - 0.008), order.y, order.z, min(0.012, order.depth / 5)),
    )
    pixels = artwork.film(
        order.length, order.height, order.text or "", order.variant, tiles=tiles
    )
    assembly.add(
        picture(pixels, GLOW),
        plate(
            (front - 0.03, front),
            (order.y[0] + rim, order.y[1] - rim),
            (rim, order.height - rim),
        ),
    )
    return assembly
