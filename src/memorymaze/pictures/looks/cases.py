"""Boxes that show or swallow things: glass cases, donation and return boxes."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, ink_on, shade
from memorymaze.pictures.looks.paints import glass, metal, paint, picture, wood
from memorymaze.pictures.looks.primitives import Span, box, lathed, plate

STEEL: Rgb = (0.66, 0.68, 0.7)
DARK: Rgb = (0.14, 0.14, 0.15)
SPINES: tuple[Rgb, ...] = (
    (0.55, 0.13, 0.13), (0.13, 0.28, 0.5), (0.15, 0.4, 0.25), (0.78, 0.68, 0.45),
    (0.25, 0.2, 0.35), (0.85, 0.83, 0.78),
)  # fmt: skip


def display_case(order: Order) -> Assembly:
    """Build a glass case on a plinth: exhibits on shelves, words across the plinth."""
    assembly = Assembly()
    back, front = order.x
    left, right = order.y
    plinth = max(0.34, 0.3 * order.height) if order.height < 1.5 else 0.42
    frame = metal((0.3, 0.3, 0.32))
    assembly.add(
        wood((0.45, 0.32, 0.2)), box((back, front - 0.012), order.y, (0, plinth))
    )
    roof = order.height - 0.05
    assembly.add(wood((0.45, 0.32, 0.2)), box(order.x, order.y, (roof, order.height)))
    assembly.add(
        paint((0.86, 0.84, 0.8)),
        box((back, back + 0.02), (left + 0.02, right - 0.02), (plinth, roof)),
    )
    for x in (back, front - 0.022):
        for y in (left, right - 0.022):
            assembly.add(frame, box((x, x + 0.022), (y, y + 0.022), (plinth, roof)))
    _exhibits(assembly, order, (plinth, roof))
    assembly.add(
        glass(),
        box(
            (front - 0.012, front - 0.004),
            (left + 0.022, right - 0.022),
            (plinth, roof),
        ),
    )
    if order.text:
        tall = plinth * 0.8
        pixels = sign_board(order.length * 0.94, tall, order.text, (0.12, 0.12, 0.14))
        wide = order.length * 0.94
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.03, front),
                (-wide / 2, wide / 2),
                (plinth * 0.1, plinth * 0.9),
            ),
        )
    return assembly


def drop_box(order: Order) -> Assembly:
    """Build a box with a slot and words: book returns, donations, internal mail."""
    assembly = Assembly()
    back, front = order.x
    see_through = (order.colour_words or "") in {"clear", "glass"}
    base = order.height * (0.55 if see_through else 0.04)
    colour = (0.85, 0.85, 0.83) if see_through else order.colour((0.2, 0.35, 0.6))
    top = order.height
    if see_through:
        assembly.add(paint(colour), box((back, front - 0.01), order.y, (0, base)))
        assembly.add(
            glass(alpha=0.35),
            box(
                (back + 0.02, front - 0.02),
                (order.y[0] + 0.02, order.y[1] - 0.02),
                (base, top - 0.05),
            ),
        )
        assembly.add(paint(colour), box(order.x, order.y, (top - 0.05, top)))
        heap = paint((0.45, 0.6, 0.42))
        assembly.add(heap, lathed([(0.2, 0), (0.14, 0.08), (0, 0.13)], 9).moved(z=base))
        assembly.add(
            paint(DARK), box((-0.02, 0.02), (-0.1, 0.1), (top - 0.01, top + 0.004))
        )
    else:
        assembly.add(
            paint(DARK),
            box(
                (back + 0.04, front - 0.06),
                (order.y[0] + 0.04, order.y[1] - 0.04),
                (0, base),
            ),
        )
        assembly.add(
            paint(colour, 0.3), box((back, front - 0.03), order.y, (base, top), 0.04)
        )
        slot = top - 0.18 * order.height
        half = order.length * 0.36
        assembly.add(
            metal(STEEL),
            box(
                (front - 0.05, front),
                (-half - 0.03, half + 0.03),
                (slot - 0.08, slot + 0.08),
                0.02,
            ),
        )
        assembly.add(
            paint(DARK),
            box(
                (front - 0.02, front + 0.004),
                (-half, half),
                (slot - 0.035, slot + 0.035),
            ),
        )
    if order.text:
        middle = order.height * (0.3 if see_through else 0.42)
        tall = 0.36 * order.height
        wide = order.length * 0.86
        pixels = sign_board(
            wide,
            tall,
            order.text,
            shade(colour, 0.6) if ink_on(colour)[0] > 0.5 else (0.97, 0.97, 0.95),
        )
        assembly.add(
            picture(pixels),
            plate(
                (front - 0.04, front - 0.006),
                (-wide / 2, wide / 2),
                (middle - tall / 2, middle + tall / 2),
            ),
        )
    return assembly


def _exhibits(assembly: Assembly, order: Order, room: Span) -> None:
    """Put things on the shelves of a case: trophies, stones, instruments."""
    words = f"{order.category} {order.text or ''}".lower()
    back, front = order.x
    shelves = 2 if room[1] - room[0] > 0.9 else 1
    rise = (room[1] - room[0]) / shelves
    count = max(2, int(order.length / 0.34))
    rng = order.rng()
    prize = any(word in words for word in ("trophy", "award", "champion", "prize"))
    stone = any(
        word in words for word in ("mineral", "rock", "meteor", "ammon", "shell")
    )
    for shelf in range(shelves):
        floor = room[0] + shelf * rise
        if shelf:
            assembly.add(
                glass(alpha=0.45),
                box(
                    (back + 0.02, front - 0.03),
                    (order.y[0] + 0.03, order.y[1] - 0.03),
                    (floor - 0.012, floor),
                ),
            )
        for place in range(count):
            y = order.y[0] + order.length * (place + 0.5) / count
            tall = min(0.8 * rise, 0.3) * float(rng.uniform(0.75, 1.0))
            wide = min(0.09, order.depth * 0.2)
            if prize:
                gold = metal((0.85, 0.66, 0.2) if place % 3 else (0.78, 0.79, 0.82))
                shape = lathed(
                    [
                        (wide * 0.7, 0),
                        (wide * 0.7, tall * 0.15),
                        (wide * 0.15, tall * 0.25),
                        (wide * 0.2, tall * 0.45),
                        (wide, tall * 0.75),
                        (wide * 0.9, tall),
                    ],
                    10,
                )
                assembly.add(gold, shape.moved(0.0, y, floor))
            elif stone:
                tone = SPINES[int(rng.integers(len(SPINES)))]
                lump = lathed(
                    [
                        (wide * 0.9, 0),
                        (wide * 1.3, tall * 0.25),
                        (wide * 0.7, tall * 0.5),
                        (0, tall * 0.6),
                    ],
                    6,
                )
                assembly.add(
                    paint(shade(tone, 1.15), 0.3),
                    lump.turned("z", 40.0 * place).moved(0.0, y, floor),
                )
            else:
                stand = metal((0.3, 0.3, 0.33))
                assembly.add(
                    stand,
                    lathed(
                        [(wide, 0), (wide, 0.02), (0.015, 0.03), (0.015, tall * 0.6)], 8
                    ).moved(0.0, y, floor),
                )
                tone = metal((0.78, 0.62, 0.28) if place % 2 else (0.7, 0.72, 0.75))
                tubelike = lathed(
                    [(0.03, -0.5 * tall), (0.045, 0.0), (0.035, 0.4 * tall)], 8
                )
                assembly.add(
                    tone, tubelike.turned("y", 50).moved(0.0, y, floor + tall * 0.65)
                )
