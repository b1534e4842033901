"""Signs: words and pictograms that name places and ways."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import exit_board, pictogram_board, sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, picture, wood
from memorymaze.pictures.looks.pictograms import Pictogram
from memorymaze.pictures.looks.primitives import box, plate
from memorymaze.simulation.senses.signposts import signposts

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
    return sheet(order, picture(pixels))


def room_number_sign(order: Order) -> Assembly:
    """Build a small framed plate with a number."""
    pixels = sign_board(
        order.length, order.height, order.text or "", order.colour(WHITE), framed=True
    )
    return sheet(order, picture(pixels))


def restroom_sign(order: Order) -> Assembly:
    """Build a restroom sign with the pictograms that its words name."""
    text = order.text or ""
    pictograms = _pictograms(text) or ("woman", "man")
    ground = order.colour((0.13, 0.36, 0.75))
    pixels = pictogram_board(order.length, order.height, text, pictograms, ground)
    return sheet(order, picture(pixels))


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


def sheet(order: Order, material: Material) -> Assembly:
    """Build a plate whose front is all of one picture."""
    assembly = Assembly()
    assembly.add(material, plate(order.x, order.y, order.z))
    return assembly


def _pictograms(text: str) -> tuple[Pictogram, ...]:
    words = text.lower()
    for word, pictograms in PEOPLE_SIGNS:
        if words.startswith(word):
            return pictograms
    return ()
