"""Counters to be served at, glass cases, and boxes that swallow things."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.materials import (
    CHARCOAL,
    IRON,
    LIMESTONE,
    OAK,
    SLATE,
    SPINES,
    glass,
    ink_on,
    is_wooden,
    metal,
    paint,
    shade,
    wood,
)
from memorymaze.pictures.looks.shapes import AxisSpan, around, lathed


def counter(made: Assembly, order: Order) -> None:
    """Build a counter to be served at, with its words across the front."""
    top = order.height
    body = order.body(LIMESTONE)
    made.box(body, order.x.inset(0, 0.08), order.y.inset(0.03), (0.1, top - 0.05))
    made.box(paint(SLATE), order.x.inset(0.04, 0.13), order.y.inset(0.06), (0, 0.1))
    slab = (
        wood(OAK)
        if not is_wooden(order.colour_words)
        else paint((0.92, 0.92, 0.9), 0.4)
    )
    made.box(slab, order.x, order.y, order.z.end(0.05), 0.012)
    if order.text:
        tall = min(0.55 * top, 0.3 * order.length, 0.5)
        wide = min(order.length * 0.9, tall * max(2.0, 0.75 * len(order.text)))
        middle = 0.52 * top
        ground = (
            shade(order.colour(LIMESTONE), 0.35)
            if not is_wooden(order.colour_words)
            else SLATE
        )
        made.words(
            order.text,
            ground,
            order.x.end(0.1, 0.065),
            around(0, wide / 2),
            around(middle, tall / 2),
        )


def kitchen_counter(made: Assembly, order: Order) -> None:
    """Build kitchen base cabinets with doors, handles and a worktop."""
    top = order.height
    colour = order.colour(LIMESTONE)
    made.box(
        paint(shade(colour, 0.85)), order.x.inset(0, 0.04), order.y, (0.1, top - 0.04)
    )
    made.box(paint(SLATE), order.x.inset(0, 0.1), order.y, (0, 0.1))
    made.box(paint((0.45, 0.43, 0.42), 0.4), order.x, order.y, order.z.end(0.04), 0.01)
    doors = max(2, round(order.length / 0.5))
    step = order.length / doors
    for place in range(doors):
        y = (order.y[0] + place * step + 0.008, order.y[0] + (place + 1) * step - 0.008)
        made.box(
            paint(colour, 0.3), order.x.end(0.05, 0.02), y, (0.12, top - 0.22), 0.006
        )
        made.box(
            paint(colour, 0.3),
            order.x.end(0.05, 0.02),
            y,
            order.z.end(0.2, 0.06),
            0.006,
        )
        middle = sum(y) / 2
        for z in (top - 0.3, top - 0.14):
            made.box(
                metal(IRON),
                order.x.end(0.02, 0.002),
                around(middle, 0.06),
                (z, z + 0.015),
            )


def display_case(made: Assembly, order: Order) -> None:
    """Build a glass case on a plinth: exhibits on shelves, words across the plinth."""
    back, front = order.x
    left, right = order.y
    plinth = max(0.34, 0.3 * order.height) if order.height < 1.5 else 0.42
    frame = metal((0.3, 0.3, 0.32))
    made.box(wood((0.45, 0.32, 0.2)), order.x.inset(0, 0.012), order.y, (0, plinth))
    roof = order.height - 0.05
    made.box(wood((0.45, 0.32, 0.2)), order.x, order.y, (roof, order.height))
    made.box(
        paint((0.86, 0.84, 0.8)),
        order.x.start(0.02),
        order.y.inset(0.02),
        (plinth, roof),
    )
    for x in (back, front - 0.022):
        for y in (left, right - 0.022):
            made.box(frame, (x, x + 0.022), (y, y + 0.022), (plinth, roof))
    _exhibits(made, order, (plinth, roof))
    made.box(glass(), order.x.end(0.012, 0.004), order.y.inset(0.022), (plinth, roof))
    made.words(
        order.text,
        (0.12, 0.12, 0.14),
        order.x.end(0.03),
        around(0, order.length * 0.47),
        (plinth * 0.1, plinth * 0.9),
    )


def drop_box(made: Assembly, order: Order) -> None:
    """Build a box with a slot and words: book returns, donations, internal mail."""
    see_through = (order.colour_words or "") in {"clear", "glass"}
    base = order.height * (0.55 if see_through else 0.04)
    colour = (0.85, 0.85, 0.83) if see_through else order.colour((0.2, 0.35, 0.6))
    top = order.height
    if see_through:
        made.box(paint(colour), order.x.inset(0, 0.01), order.y, (0, base))
        made.box(
            glass(alpha=0.35),
            order.x.inset(0.02),
            order.y.inset(0.02),
            (base, top - 0.05),
        )
        made.box(paint(colour), order.x, order.y, order.z.end(0.05))
        heap = paint((0.45, 0.6, 0.42))
        made.lathed(heap, [(0.2, 0), (0.14, 0.08), (0, 0.13)], 9, at=(0, 0, base))
        made.box(paint(CHARCOAL), (-0.02, 0.02), (-0.1, 0.1), order.z.end(0.01, -0.004))
    else:
        made.box(
            paint(CHARCOAL), order.x.inset(0.04, 0.06), order.y.inset(0.04), (0, base)
        )
        made.box(paint(colour, 0.3), order.x.inset(0, 0.03), order.y, (base, top), 0.04)
        slot = top - 0.18 * order.height
        half = order.length * 0.36
        made.box(
            metal(IRON),
            order.x.end(0.05),
            (-half - 0.03, half + 0.03),
            around(slot, 0.08),
            0.02,
        )
        made.box(
            paint(CHARCOAL),
            order.x.end(0.02, -0.004),
            (-half, half),
            around(slot, 0.035),
        )
    made.words(
        order.text,
        shade(colour, 0.6) if ink_on(colour)[0] > 0.5 else (0.97, 0.97, 0.95),
        order.x.end(0.04, 0.006),
        around(0, order.length * 0.43),
        around(order.height * (0.3 if see_through else 0.42), 0.18 * order.height),
    )


def _exhibits(made: Assembly, order: Order, room: AxisSpan) -> None:
    """Put things on the shelves of a case: trophies, stones, instruments."""
    words = f"{order.category} {order.text or ''}".lower()
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
            made.box(
                glass(alpha=0.45),
                order.x.inset(0.02, 0.03),
                order.y.inset(0.03),
                (floor - 0.012, floor),
            )
        for place in range(count):
            y = order.y[0] + order.length * (place + 0.5) / count
            tall = min(0.8 * rise, 0.3) * float(rng.uniform(0.75, 1.0))
            wide = min(0.09, order.depth * 0.2)
            if prize:
                gold = metal((0.85, 0.66, 0.2) if place % 3 else (0.78, 0.79, 0.82))
                shape = lathed(
                    [
                        (0.7, 0),
                        (0.7, 0.15),
                        (0.15, 0.25),
                        (0.2, 0.45),
                        (1, 0.75),
                        (0.9, 1),
                    ],
                    10,
                    radius=wide,
                    height=tall,
                )
                made.add(gold, shape.moved(0.0, y, floor))
            elif stone:
                tone = SPINES[int(rng.integers(len(SPINES)))]
                lump = lathed(
                    [(0.9, 0), (1.3, 0.25), (0.7, 0.5), (0, 0.6)],
                    6,
                    radius=wide,
                    height=tall,
                )
                made.add(
                    paint(shade(tone, 1.15), 0.3),
                    lump.turned("z", 40.0 * place).moved(0.0, y, floor),
                )
            else:
                stand = metal((0.3, 0.3, 0.33))
                made.lathed(
                    stand,
                    [(wide, 0), (wide, 0.02), (0.015, 0.03), (0.015, tall * 0.6)],
                    8,
                    at=(0.0, y, floor),
                )
                tone = metal((0.78, 0.62, 0.28) if place % 2 else (0.7, 0.72, 0.75))
                tubelike = lathed(
                    [(0.03, -0.5 * tall), (0.045, 0.0), (0.035, 0.4 * tall)], 8
                )
                made.add(
                    tone, tubelike.turned("y", 50).moved(0.0, y, floor + tall * 0.65)
                )
