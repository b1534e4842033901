"""Things that hang flat on a wall, or stand as a sheet: signs, posters, maps, boards."""

from memorymaze.simulation.looks import artwork, maps
from memorymaze.simulation.looks.assembly import Assembly, Order
from memorymaze.simulation.looks.boards import exit_board, pictogram_board, sign_board
from memorymaze.simulation.looks.colours import Rgb
from memorymaze.simulation.looks.object_model import Material
from memorymaze.simulation.looks.paints import metal, paint, picture, wood
from memorymaze.simulation.looks.pictograms import Pictogram
from memorymaze.simulation.looks.primitives import box, extruded, plate, tapered
from memorymaze.simulation.looks.signposts import signposts

__all__ = [
    "a_frame",
    "banner",
    "exhibit_panel",
    "exit_sign",
    "flag",
    "floor_map",
    "framed_photos",
    "hanging_sign",
    "information_panel",
    "menu_board",
    "mirror",
    "mural",
    "notice_board",
    "painting",
    "poster",
    "restroom_sign",
    "room_number_sign",
    "sign",
    "whiteboard",
    "world_map",
]

WHITE: Rgb = (0.93, 0.93, 0.92)
STEEL: Rgb = (0.68, 0.70, 0.72)
DARK: Rgb = (0.16, 0.17, 0.19)
OAK: Rgb = (0.66, 0.48, 0.30)
PEOPLE_SIGNS: tuple[tuple[str, tuple[Pictogram, ...]], ...] = (
    ("wheelchair", ("wheelchair",)),
    ("accessible", ("wheelchair",)),
    ("women", ("woman",)),
    ("ladies", ("woman",)),
    ("men", ("man",)),
    ("gentlemen", ("man",)),
    ("first aid", ("cross",)),
    ("stroller", ("stroller",)),
    ("nursing", ("woman", "stroller")),
)


def sign(order: Order) -> Assembly:
    """Build a board with words, which fill it, and a pictogram where one says more."""
    text = (order.text or order.category).strip()
    ground = order.colour(WHITE)
    pictograms = _pictograms(text)
    square = 0.6 < order.length / order.height < 1.6
    if pictograms and square:
        pixels = pictogram_board(order.length, order.height, text, pictograms, ground)
    else:
        pixels = sign_board(order.length, order.height, text, ground)
    return _sheet(order, picture(pixels))


def room_number_sign(order: Order) -> Assembly:
    """Build a small framed plate with a number."""
    pixels = sign_board(
        order.length, order.height, order.text or "", order.colour(WHITE), framed=True
    )
    return _sheet(order, picture(pixels))


def restroom_sign(order: Order) -> Assembly:
    """Build a restroom sign with the pictograms that its words name."""
    text = order.text or ""
    pictograms = _pictograms(text) or ("woman", "man")
    ground = order.colour((0.13, 0.36, 0.75))
    pixels = pictogram_board(order.length, order.height, text, pictograms, ground)
    return _sheet(order, picture(pixels))


def exit_sign(order: Order) -> Assembly:
    """Build a lit emergency exit sign, readable from both sides where it hangs."""
    pixels = exit_board(order.length, order.height, order.text or "EXIT")
    assembly = Assembly()
    hangs = order.mount == "ceiling"
    assembly.add(
        picture(pixels, 0.75), plate(order.x, order.y, order.z, both_sides=hangs)
    )
    return assembly


def hanging_sign(order: Order) -> Assembly:
    """Build a board on two rods; its back is blank where its words point somewhere."""
    text = order.text or order.category
    pixels = sign_board(
        order.length, order.height * 0.88, text, order.colour((0.08, 0.13, 0.34))
    )
    assembly = Assembly()
    points = any(post.arrow for post in signposts(text))
    assembly.add(
        picture(pixels),
        plate(order.x, order.y, (0, order.height * 0.88), both_sides=not points),
    )
    for side in (-1, 1):
        y = side * order.length * 0.36
        assembly.add(
            metal(STEEL),
            box(
                (-0.012, 0.012),
                (y - 0.012, y + 0.012),
                (order.height * 0.88, order.height),
            ),
        )
    return assembly


def poster(order: Order) -> Assembly:
    """Build a poster: words over a picture."""
    pixels = artwork.poster(
        order.length, order.height, order.text or "", order.colour(WHITE), order.variant
    )
    return _sheet(order, picture(pixels))


def information_panel(order: Order) -> Assembly:
    """Build an exhibition panel with a headline, small print and a picture."""
    ground = order.colour((0.15, 0.24, 0.42))
    pixels = artwork.headlined(
        order.length, order.height, order.text or "", ground, order.variant
    )
    return _sheet(order, picture(pixels))


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
    return _framed(order, picture(pixels), wood(OAK), 0.04)


def whiteboard(order: Order) -> Assembly:
    """Build a whiteboard on the wall, or on a stand with castors where it is deep."""
    low = order.height * 0.42 if order.mount == "floor" else 0.0
    pixels = artwork.marker_board(
        order.length - 0.06, order.height - low - 0.06, order.text or "", order.variant
    )
    if order.mount != "floor":
        return _framed(order, picture(pixels), metal(STEEL), 0.03)
    board = Order(
        order.category, order.length, 0.05, order.height - low, order.colour_words
    )
    assembly = Assembly()
    assembly.include(_framed(board, picture(pixels), metal(STEEL), 0.03), z=low)
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
    return _framed(order, picture(pixels), wood(OAK), 0.03)


def floor_map(order: Order) -> Assembly:
    """Build a floor plan to find one's way by."""
    pixels = maps.floor_map(
        order.length, order.height, order.text or "", order.colour(WHITE), order.variant
    )
    return _framed(order, picture(pixels), metal(STEEL), 0.02)


def world_map(order: Order) -> Assembly:
    """Build a map of the world."""
    sea = order.colour((0.14, 0.36, 0.66))
    if min(sea) > 0.8:
        sea = (0.14, 0.36, 0.66)
    land = order.second_colour((0.28, 0.52, 0.24))
    pixels = maps.world_map(order.length, order.height, order.text or "", sea, land)
    return _framed(order, picture(pixels), metal(STEEL), 0.02)


def painting(order: Order) -> Assembly:
    """Build a landscape in a frame."""
    pixels = artwork.painting(
        order.length, order.height, order.colour((0.3, 0.45, 0.6)), order.variant
    )
    return _framed(order, picture(pixels), paint((0.55, 0.42, 0.18), 0.5), 0.05)


def mural(order: Order) -> Assembly:
    """Build a picture straight on the wall, with its words under it."""
    colour = order.colour((0.3, 0.45, 0.6))
    pixels = artwork.poster(
        order.length, order.height, order.text or "", colour, 4 * order.variant
    )
    return _sheet(order, picture(pixels))


def framed_photos(order: Order) -> Assembly:
    """Build rows of portraits."""
    tone = order.colour((0.2, 0.2, 0.2))
    pixels = artwork.framed_photos(order.length, order.height, tone)
    return _sheet(order, picture(pixels))


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


def banner(order: Order) -> Assembly:
    """Build a cloth hanging from a bar, its words one below the other."""
    ground = order.colour((0.13, 0.36, 0.75))
    pixels = sign_board(
        order.length, order.height, order.text or "", ground, framed=True
    )
    assembly = Assembly()
    assembly.add(
        picture(pixels),
        plate(
            (-0.006, 0.006),
            (order.y[0] + 0.03, order.y[1] - 0.03),
            (0.02, order.height - 0.02),
        ),
    )
    bar = order.depth / 2
    for z in (0.0, order.height - 0.04):
        assembly.add(metal(STEEL), box((-bar, bar), order.y, (z, z + 0.04), bar / 2))
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


def a_frame(order: Order) -> Assembly:
    """Build a folding board on the floor, with words on both sides."""
    text = order.text or order.category
    pixels = sign_board(
        order.length, order.height * 0.9, text, order.colour(DARK), framed=True
    )
    assembly = Assembly()
    front = plate((0, 0.03), order.y, (0.05, order.height))
    lean = order.depth / 2 - 0.03
    front.vertices[:, 0] += lean * (1 - front.vertices[:, 2] / order.height)
    back = front.turned("z", 180)
    assembly.add(picture(pixels), front, back)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.03)
        for x in (-order.depth / 2 + 0.03, order.depth / 2 - 0.03):
            assembly.add(
                wood(OAK),
                box((x - 0.03, x + 0.03), (y - 0.03, y + 0.03), (0, 0.06)),
            )
    return assembly


def _sheet(order: Order, material: Material) -> Assembly:
    assembly = Assembly()
    assembly.add(material, plate(order.x, order.y, order.z))
    return assembly


def _framed(
    order: Order, material: Material, frame: Material, width: float
) -> Assembly:
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


def _pictograms(text: str) -> tuple[Pictogram, ...]:
    words = text.lower()
    for word, pictograms in PEOPLE_SIGNS:
        if words.startswith(word):
            return pictograms
    return ()
