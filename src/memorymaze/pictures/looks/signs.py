"""Signs: words and pictograms that name places and ways."""

from memorymaze.perception.signposts import signposts
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import (
    Pictogram,
    blank_board,
    exit_board,
    pictogram_board,
    sign_board,
)
from memorymaze.pictures.looks.materials import (
    ALUMINIUM,
    CHALK,
    ELM,
    GRAPHITE,
    Material,
    metal,
    picture,
    wood,
)
from memorymaze.pictures.looks.shapes import around, plate

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


def sign(made: Assembly, order: Order) -> None:
    """Build a board with words, which fill it, and a pictogram where one says more."""
    text = (order.text or order.category).strip()
    ground = order.colour(CHALK)
    pictograms = _pictograms(text)
    square = 0.6 < order.length / order.height < 1.6
    if pictograms and square:
        pixels = pictogram_board(order.length, order.height, text, pictograms, ground)
    else:
        pixels = sign_board(order.length, order.height, text, ground)
    sheet(made, order, picture(pixels))


def room_number_sign(made: Assembly, order: Order) -> None:
    """Build a small framed plate with a number."""
    pixels = sign_board(
        order.length, order.height, order.text or "", order.colour(CHALK), framed=True
    )
    sheet(made, order, picture(pixels))


def restroom_sign(made: Assembly, order: Order) -> None:
    """Build a restroom sign with the pictograms that its words name."""
    text = order.text or ""
    pictograms = _pictograms(text) or ("woman", "man")
    ground = order.colour((0.13, 0.36, 0.75))
    pixels = pictogram_board(order.length, order.height, text, pictograms, ground)
    sheet(made, order, picture(pixels))


def exit_sign(made: Assembly, order: Order) -> None:
    """Build a lit emergency exit sign, readable from both sides where it hangs."""
    pixels = exit_board(order.length, order.height, order.text or "EXIT")
    hangs = order.mount == "ceiling"
    made.plate(picture(pixels, 0.75), order.x, order.y, order.z, both_sides=hangs)


def hanging_sign(made: Assembly, order: Order) -> None:
    """Build a board on two rods; no words are on its back where they point somewhere."""
    text, ground = order.text or order.category, order.colour((0.08, 0.13, 0.34))
    z = (0.0, order.height * 0.88)
    if any(post.arrow for post in signposts(text)):
        half = (0.0, order.depth / 2)
        made.words(text, ground, half, order.y, z)
        back = picture(blank_board(order.length, z[1], ground))
        made.add(back, plate(half, order.y, z).turned("z", 180))
    else:
        made.words(text, ground, order.x, order.y, z, both_sides=True)
    for side in (-1, 1):
        y = side * order.length * 0.36
        made.box(
            metal(ALUMINIUM),
            (-0.012, 0.012),
            around(y, 0.012),
            (order.height * 0.88, order.height),
        )


def banner(made: Assembly, order: Order) -> None:
    """Build a cloth hanging from a bar, its words one below the other."""
    ground = order.colour((0.13, 0.36, 0.75))
    pixels = sign_board(
        order.length, order.height, order.text or "", ground, framed=True
    )
    made.plate(
        picture(pixels),
        (-0.006, 0.006),
        order.y.inset(0.03),
        (0.02, order.height - 0.02),
    )
    bar = order.depth / 2
    for z in (0.0, order.height - 0.04):
        made.box(metal(ALUMINIUM), (-bar, bar), order.y, (z, z + 0.04), bar / 2)


def a_frame(made: Assembly, order: Order) -> None:
    """Build a folding board on the floor, with words on both sides."""
    text = order.text or order.category
    pixels = sign_board(
        order.length, order.height * 0.9, text, order.colour(GRAPHITE), framed=True
    )
    front = plate((0, 0.03), order.y, (0.05, order.height))
    lean = order.depth / 2 - 0.03
    front.vertices[:, 0] += lean * (1 - front.vertices[:, 2] / order.height)
    back = front.turned("z", 180)
    made.add(picture(pixels), front, back)
    for side in (-1, 1):
        y = side * (order.length / 2 - 0.03)
        for x in (-order.depth / 2 + 0.03, order.depth / 2 - 0.03):
            made.box(wood(ELM), around(x, 0.03), around(y, 0.03), (0, 0.06))


def sheet(made: Assembly, order: Order, material: Material) -> None:
    """Build a plate whose front is all of one picture."""
    made.plate(material, order.x, order.y, order.z)


def _pictograms(text: str) -> tuple[Pictogram, ...]:
    words = text.lower()
    for word, pictograms in PEOPLE_SIGNS:
        if words.startswith(word):
            return pictograms
    return ()
