"""Cabinets in rows: lockers, drawers, mailboxes."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.captions import header
from memorymaze.pictures.looks.colours import Rgb, shade
from memorymaze.pictures.looks.paints import metal, paint
from memorymaze.pictures.looks.primitives import box

STEEL: Rgb = (0.66, 0.68, 0.7)
DARK: Rgb = (0.14, 0.14, 0.15)


def lockers(order: Order) -> Assembly:
    """Build a row of tall metal lockers with vents and handles."""
    return _door_grid(order, max(2, round(order.length / 0.4)), 1, vents=True)


def coin_lockers(order: Order) -> Assembly:
    """Build small lockers in rows under a strip with words, each with a lock."""
    return _door_grid(order, max(2, round(order.length / 0.42)), 4, vents=False)


def mailboxes(order: Order) -> Assembly:
    """Build pigeonholes with slots under a strip with words."""
    return _door_grid(order, max(2, round(order.length / 0.3)), 5, vents=False)


def cabinet(order: Order) -> Assembly:
    """Build a cupboard with two doors."""
    return _door_grid(order, 1 if order.length < 0.7 else 2, 1, vents=False)


def filing_cabinet(order: Order) -> Assembly:
    """Build columns of drawers with handles and label holders."""
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(STEEL)
    assembly.add(
        paint(shade(colour, 0.75)), box((back, front - 0.03), order.y, order.z)
    )
    columns = max(1, round(order.length / 0.5))
    rows = max(2, round(order.height / 0.33))
    step, rise = order.length / columns, (order.height - 0.04) / rows
    for column in range(columns):
        for row in range(rows):
            y = order.y[0] + column * step
            z = 0.03 + row * rise
            assembly.add(
                paint(colour, 0.3),
                box(
                    (front - 0.05, front - 0.018),
                    (y + 0.01, y + step - 0.01),
                    (z + 0.008, z + rise - 0.008),
                    0.006,
                ),
            )
            middle, hand = y + step / 2, z + rise * 0.62
            assembly.add(
                metal(DARK),
                box(
                    (front - 0.02, front),
                    (middle - 0.07, middle + 0.07),
                    (hand, hand + 0.025),
                ),
            )
            assembly.add(
                paint((0.95, 0.95, 0.9)),
                box(
                    (front - 0.02, front - 0.014),
                    (middle - 0.05, middle + 0.05),
                    (hand - 0.09, hand - 0.05),
                ),
            )
    return assembly


def _door_grid(order: Order, columns: int, rows: int, *, vents: bool) -> Assembly:
    assembly = Assembly()
    back, front = order.x
    colour = order.colour(STEEL)
    dark, face = paint(shade(colour, 0.5)), order.body(STEEL, 0.3)
    strip = 0.17 * order.height if order.text else 0.03
    assembly.add(dark, box((back, front - 0.025), order.y, order.z))
    step = order.length / columns
    rise = (order.height - 0.08 - strip) / rows
    for column in range(columns):
        for row in range(rows):
            y, z = order.y[0] + column * step, 0.08 + row * rise
            assembly.add(
                face,
                box(
                    (front - 0.04, front - 0.012),
                    (y + 0.008, y + step - 0.008),
                    (z + 0.008, z + rise - 0.008),
                ),
            )
            hinge = y + step - 0.07
            middle = z + rise * 0.5
            reach = 0.06 if rows == 1 else 0.022
            assembly.add(
                metal((0.82, 0.82, 0.84)),
                box(
                    (front - 0.014, front),
                    (hinge - 0.01, hinge + 0.02),
                    (middle - reach, middle + reach),
                ),
            )
            if vents:
                for vent in range(3):
                    up = z + rise - 0.12 - 0.045 * vent
                    assembly.add(
                        dark,
                        box(
                            (front - 0.02, front - 0.009),
                            (y + step * 0.28, y + step * 0.72),
                            (up, up + 0.016),
                        ),
                    )
            elif rows == 4:
                label = paint((0.95, 0.95, 0.93))
                assembly.add(
                    label,
                    box(
                        (front - 0.02, front - 0.009),
                        (y + 0.05, y + 0.13),
                        (z + rise - 0.11, z + rise - 0.05),
                    ),
                )
            elif rows == 5:
                assembly.add(
                    dark,
                    box(
                        (front - 0.02, front - 0.009),
                        (y + step * 0.15, y + step * 0.7),
                        (z + rise * 0.68, z + rise * 0.8),
                    ),
                )
    header(
        assembly,
        order,
        (order.height - strip + 0.01, order.height - 0.015),
        front - 0.016,
    )
    return assembly
