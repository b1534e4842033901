"""Shelves, lockers, cabinets, racks and ladders."""

from memorymaze.pictures.looks.assembly import Assembly, Order, header
from memorymaze.pictures.looks.materials import (
    BEECH,
    CHARCOAL,
    IRON,
    PRINTS,
    SOOT,
    SPINES,
    STEEL,
    metal,
    paint,
    shade,
)
from memorymaze.pictures.looks.shapes import around, box, lathed, span_between
from memorymaze.pictures.looks.tubes import tube


def bookshelf(made: Assembly, order: Order) -> None:
    """Build an open case with shelves full of books."""
    front = order.x[1]
    body = order.body(BEECH)
    made.box(body, order.x.start(0.015), order.y, order.z)
    for y in (order.y[0], order.y[1] - 0.03):
        made.box(body, order.x, (y, y + 0.03), order.z)
    rows = max(1, round(order.height / 0.38))
    rise = (order.height - 0.06) / rows
    rng = order.rng()
    for row in range(rows + 1):
        z = 0.03 + row * rise if row else 0.03
        made.box(
            body,
            order.x.inset(0, 0.005),
            order.y.inset(0.03),
            (z, min(z + 0.03, order.height)),
        )
        if row == rows:
            break
        y = order.y[0] + 0.05
        end = order.y[1] - 0.05
        while y < end - 0.08:
            width = float(rng.uniform(0.07, 0.16))
            if y + width > end:
                break
            if rng.random() < 0.88:
                tall = min(rise - 0.06, float(rng.uniform(0.19, 0.29)))
                spine = SPINES[int(rng.integers(len(SPINES)))]
                deep = float(rng.uniform(0.02, 0.06))
                made.box(
                    paint(spine, 0.05),
                    order.x.inset(0.03, deep),
                    (y, y + width - 0.008),
                    (z + 0.03, z + 0.03 + tall),
                )
            y += width
    header(made, order, order.z.end(0.2, 0.04), front - 0.02)


def wall_shelf(made: Assembly, order: Order) -> None:
    """Build a small shelf on the wall with a few books and a vase."""
    back, front = order.x
    body = order.body(BEECH)
    thick = 0.03
    made.box(body, order.x, order.y, (0.1, 0.1 + thick))
    for side in (-1, 1):
        y = side * order.length * 0.35
        made.add(
            metal(CHARCOAL),
            box(order.x.start(0.02), around(y, 0.015), (0, 0.1)),
            box((back, front * 0.6), around(y, 0.015), (0.085, 0.1)),
        )
    y = order.y[0] + 0.08
    for place, spine in enumerate(SPINES):
        tall = (order.height - 0.1 - thick) * (1.0 if place == 1 else 0.86)
        made.box(
            paint(spine),
            order.x.inset(0.02, 0.03),
            (y, y + 0.05),
            (0.1 + thick, 0.1 + thick + tall),
        )
        y += 0.055
    made.lathed(
        paint((0.25, 0.45, 0.5), 0.5),
        [(0.03, 0), (0.06, 0.08), (0.03, 0.15), (0.035, 0.18)],
        12,
        at=(0, order.y[1] - 0.2, 0.1 + thick),
    )


def paper_shelf(made: Assembly, order: Order) -> None:
    """Build open pigeonholes with reams of paper."""
    body = order.body((0.72, 0.54, 0.35))
    made.box(body, order.x.start(0.015), order.y, order.z)
    columns, rows = max(2, round(order.length / 0.4)), max(2, round(order.height / 0.3))
    for column in range(columns + 1):
        y = order.y[0] + (order.length - 0.025) * column / columns
        made.box(body, order.x, (y, y + 0.025), order.z)
    for row in range(rows + 1):
        z = (order.height - 0.025) * row / rows
        made.box(body, order.x.inset(0, 0.003), order.y, (z, z + 0.025))
    rng = order.rng()
    wide, rise = order.length / columns, order.height / rows
    for column in range(columns):
        for row in range(rows):
            y = order.y[0] + column * wide + 0.05
            z = 0.025 + row * rise * 0.99
            tall = rise * float(rng.uniform(0.2, 0.65))
            tone = (0.96, 0.96, 0.94) if rng.random() < 0.7 else PRINTS[row % 5]
            made.box(
                paint(tone),
                order.x.inset(0.03, 0.02),
                (y, y + wide - 0.085),
                (z, z + tall),
            )


def lockers(made: Assembly, order: Order) -> None:
    """Build a row of tall metal lockers with vents and handles."""
    _door_grid(made, order, max(2, round(order.length / 0.4)), 1, vents=True)


def coin_lockers(made: Assembly, order: Order) -> None:
    """Build small lockers in rows under a strip with words, each with a lock."""
    _door_grid(made, order, max(2, round(order.length / 0.42)), 4, vents=False)


def mailboxes(made: Assembly, order: Order) -> None:
    """Build pigeonholes with slots under a strip with words."""
    _door_grid(made, order, max(2, round(order.length / 0.3)), 5, vents=False)


def cabinet(made: Assembly, order: Order) -> None:
    """Build a cupboard with two doors."""
    _door_grid(made, order, 1 if order.length < 0.7 else 2, 1, vents=False)


def filing_cabinet(made: Assembly, order: Order) -> None:
    """Build columns of drawers with handles and label holders."""
    colour = order.colour(IRON)
    made.box(paint(shade(colour, 0.75)), order.x.inset(0, 0.03), order.y, order.z)
    columns = max(1, round(order.length / 0.5))
    rows = max(2, round(order.height / 0.33))
    step, rise = order.length / columns, (order.height - 0.04) / rows
    for column in range(columns):
        for row in range(rows):
            y = order.y[0] + column * step
            z = 0.03 + row * rise
            made.box(
                paint(colour, 0.3),
                order.x.end(0.05, 0.018),
                (y + 0.01, y + step - 0.01),
                (z + 0.008, z + rise - 0.008),
                0.006,
            )
            middle, hand = y + step / 2, z + rise * 0.62
            made.box(
                metal(CHARCOAL),
                order.x.end(0.02),
                around(middle, 0.07),
                (hand, hand + 0.025),
            )
            made.box(
                paint((0.95, 0.95, 0.9)),
                order.x.end(0.02, 0.014),
                around(middle, 0.05),
                (hand - 0.09, hand - 0.05),
            )


def _door_grid(
    made: Assembly, order: Order, columns: int, rows: int, *, vents: bool
) -> None:
    front = order.x[1]
    colour = order.colour(IRON)
    dark, face = paint(shade(colour, 0.5)), order.body(IRON, 0.3)
    strip = 0.17 * order.height if order.text else 0.03
    made.box(dark, order.x.inset(0, 0.025), order.y, order.z)
    step = order.length / columns
    rise = (order.height - 0.08 - strip) / rows
    for column in range(columns):
        for row in range(rows):
            y, z = order.y[0] + column * step, 0.08 + row * rise
            made.box(
                face,
                order.x.end(0.04, 0.012),
                (y + 0.008, y + step - 0.008),
                (z + 0.008, z + rise - 0.008),
            )
            hinge = y + step - 0.07
            middle = z + rise * 0.5
            reach = 0.06 if rows == 1 else 0.022
            made.box(
                metal((0.82, 0.82, 0.84)),
                order.x.end(0.014),
                (hinge - 0.01, hinge + 0.02),
                around(middle, reach),
            )
            if vents:
                for vent in range(3):
                    up = z + rise - 0.12 - 0.045 * vent
                    made.box(
                        dark,
                        order.x.end(0.02, 0.009),
                        (y + step * 0.28, y + step * 0.72),
                        (up, up + 0.016),
                    )
            elif rows == 4:
                label = paint((0.95, 0.95, 0.93))
                made.box(
                    label,
                    order.x.end(0.02, 0.009),
                    (y + 0.05, y + 0.13),
                    (z + rise - 0.11, z + rise - 0.05),
                )
            elif rows == 5:
                made.box(
                    dark,
                    order.x.end(0.02, 0.009),
                    (y + step * 0.15, y + step * 0.7),
                    (z + rise * 0.68, z + rise * 0.8),
                )
    header(
        made, order, (order.height - strip + 0.01, order.height - 0.015), front - 0.016
    )


def brochure_rack(made: Assembly, order: Order) -> None:
    """Build a stand with rising rows of brochures, cards or newspapers."""
    back, front = order.x
    body = order.body(STEEL, 0.4)
    top = order.height - (0.2 if order.text else 0.02)
    made.box(body, order.x.start(0.02), order.y, (0.1, order.height))
    for y in (order.y[0], order.y[1] - 0.025):
        made.add(
            body,
            box(order.x, (y, y + 0.025), (0, 0.06)),
            box(order.x.start(0.05), (y, y + 0.025), (0, order.height)),
        )
    rows = max(2, round((top - 0.15) / 0.3))
    columns = max(2, round(order.length / 0.16))
    rise = (top - 0.12) / rows
    step = (order.length - 0.06) / columns
    rng = order.rng()
    for row in range(rows):
        z = 0.12 + row * rise
        x = front - (front - back) * 0.75 * row / rows
        made.add(
            body,
            box((back + 0.02, x), order.y.inset(0.02), (z, z + 0.015)),
            box((x - 0.015, x), order.y.inset(0.02), (z, z + 0.07)),
        )
        for column in range(columns):
            if rng.random() < 0.12:
                continue
            y = order.y[0] + 0.03 + column * step
            print_ = paint(PRINTS[int(rng.integers(len(PRINTS)))])
            made.box(
                print_,
                (x - 0.05, x - 0.02),
                (y + 0.008, y + step - 0.008),
                (z + 0.015, z + min(0.24, rise * 0.86)),
            )
    header(made, order, order.z.end(0.19), back + 0.02)


def coat_rack(made: Assembly, order: Order) -> None:
    """Build a rail on two stands with coats on hangers."""
    steel = metal(order.colour(STEEL))
    top = order.height - 0.02
    reach = order.length / 2 - 0.02
    for side in (-1, 1):
        y = side * reach
        made.add(
            steel,
            tube([(0, y, 0.03), (0, y, top)], 0.018, 8),
            box(order.x, around(y, 0.018), (0, 0.03)),
        )
    made.tube(steel, [(0, -reach, top), (0, reach, top)], 0.02, 8)
    coats = ((0.16, 0.2, 0.32), (0.45, 0.12, 0.14), (0.3, 0.34, 0.26), (0.6, 0.5, 0.36))
    count = max(2, int(order.length / 0.24))
    for place in range(count):
        y = -reach + 2 * reach * (place + 0.6) / count
        if place % 4 == 3:
            continue
        half, thick = order.depth * 0.42, 0.05
        low = top - 0.95
        body = lathed(
            [
                (0.8, low),
                (0.95, low + 0.3),
                (0.85, top - 0.25),
                (0.25, top - 0.1),
                (0.1, top - 0.05),
            ],
            10,
        ).scaled(half, thick, 1.0)
        made.add(paint(coats[place % 4], 0.02), body.moved(y=y))
        made.tube(steel, [(0, y, top - 0.07), (0, y, top)], 0.006, 5)


def umbrella_stand(made: Assembly, order: Order) -> None:
    """Build a framed stand with umbrellas in it."""
    steel = metal(order.colour(SOOT))
    back, front = order.x
    left, right = order.y
    top = order.height * 0.72
    corners = [
        (x, y)
        for x in (back + 0.012, front - 0.012)
        for y in (left + 0.012, right - 0.012)
    ]
    for x, y in corners:
        made.tube(steel, [(x, y, 0), (x, y, top)], 0.012, 6)
    for z in (0.25 * top, top):
        for x in (back + 0.012, front - 0.012):
            made.tube(steel, [(x, left, z), (x, right, z)], 0.01, 6)
        for y in (left + 0.012, right - 0.012):
            made.tube(steel, [(back, y, z), (front, y, z)], 0.01, 6)
    made.box(steel, order.x, order.y, (0.0, 0.03))
    cloths = ((0.1, 0.1, 0.12), (0.15, 0.3, 0.6), (0.7, 0.15, 0.2), (0.85, 0.88, 0.9))
    count = max(3, int(order.length / 0.11))
    for place in range(count):
        y = left + order.length * (place + 0.5) / count
        x = back + order.depth * (0.35 if place % 2 else 0.62)
        tip = order.height - 0.04 * (place % 3)
        tone = paint(cloths[place % 4], 0.05)
        made.lathed(
            tone,
            [(0.008, 0.04), (0.03, 0.3), (0.035, top), (0.01, tip - 0.16)],
            7,
            at=(x, y, 0),
        )
        crook = [
            (x, y, tip - 0.16),
            (x, y, tip - 0.03),
            (x + 0.02, y, tip - 0.008),
            (x + 0.045, y, tip - 0.02),
            (x + 0.05, y, tip - 0.06),
        ]
        made.tube(paint((0.4, 0.25, 0.14)), crook, 0.009, 5)


def tray_rack(made: Assembly, order: Order) -> None:
    """Build a trolley with rows of trays on rails, its words on top."""
    back, front = order.x
    left, right = order.y
    steel = metal(order.colour(STEEL))
    roof = order.height - (0.22 if order.text else 0.02)
    for x in (back + 0.015, front - 0.03):
        for y in (left + 0.015, right - 0.015, 0.0):
            made.box(steel, around(x, 0.015), around(y, 0.015), (0.04, roof))
            made.ball(
                paint(SOOT),
                0.04,
                8,
                5,
                at=(x, min(max(y, left + 0.04), right - 0.04), 0.04),
            )
    trays = ((0.75, 0.4, 0.2), (0.35, 0.25, 0.2))
    rows = max(3, int(roof / 0.15))
    for row in range(rows):
        z = 0.12 + (roof - 0.14) * row / rows
        for side in (-1, 1):
            y = span_between(side * 0.03, side * (order.length / 2 - 0.04))
            made.box(paint(trays[row % 2]), order.x.inset(0.02, 0.01), y, (z, z + 0.03))
            if (row + side) % 3 == 0:
                made.lathed(
                    paint((0.95, 0.95, 0.93), 0.4),
                    [(0.05, 0), (0.09, 0.025), (0.085, 0.025), (0.045, 0.01)],
                    10,
                    at=(0.0, sum(y) / 2, z + 0.03),
                )
    made.box(steel, order.x, order.y, (roof, roof + 0.02))
    header(made, order, (roof + 0.01, order.height), front - 0.012)


def ladder(made: Assembly, order: Order) -> None:
    """Build a folding step ladder."""
    back, front = order.x
    stiles = metal(order.colour((0.9, 0.75, 0.15)))
    top = order.height
    half = order.length / 2 - 0.03
    narrow = half * 0.72
    for side in (-1, 1):
        made.add(
            stiles,
            tube(
                [(front - 0.02, side * half, 0), (0.01, side * narrow, top)], 0.022, 6
            ),
            tube(
                [(back + 0.02, side * half, 0), (-0.01, side * narrow, top - 0.05)],
                0.018,
                6,
            ),
        )
    steps = max(4, round(top / 0.28))
    for place in range(1, steps):
        share = place / steps
        x = (front - 0.02) * (1 - share)
        wide = half + (narrow - half) * share
        z = top * share
        made.box(metal(STEEL), (x - 0.05, x + 0.04), (-wide, wide), around(z, 0.012))
    made.box(stiles, (-0.08, 0.08), (-narrow - 0.02, narrow + 0.02), order.z.end(0.03))
