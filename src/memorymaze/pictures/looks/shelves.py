"""Open shelves with books and papers."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.captions import header
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.paints import metal, paint
from memorymaze.pictures.looks.primitives import box, lathed

DARK: Rgb = (0.14, 0.14, 0.15)
OAK: Rgb = (0.72, 0.54, 0.35)
SPINES: tuple[Rgb, ...] = (
    (0.55, 0.13, 0.13), (0.13, 0.28, 0.5), (0.15, 0.4, 0.25), (0.78, 0.68, 0.45),
    (0.25, 0.2, 0.35), (0.85, 0.83, 0.78),
)  # fmt: skip
PRINTS: tuple[Rgb, ...] = (
    (0.8, 0.25, 0.2), (0.2, 0.45, 0.75), (0.95, 0.8, 0.3), (0.3, 0.6, 0.4),
    (0.6, 0.35, 0.65), (0.9, 0.9, 0.86),
)  # fmt: skip


def bookshelf(order: Order) -> Assembly:
    """Build an open case with shelves full of books."""
    assembly = Assembly()
    back, front = order.x
    body = order.body(OAK)
    assembly.add(body, box((back, back + 0.015), order.y, order.z))
    for y in (order.y[0], order.y[1] - 0.03):
        assembly.add(body, box((back, front), (y, y + 0.03), order.z))
    rows = max(1, round(order.height / 0.38))
    rise = (order.height - 0.06) / rows
    rng = order.rng()
    for row in range(rows + 1):
        z = 0.03 + row * rise if row else 0.03
        assembly.add(
            body,
            box(
                (back, front - 0.005),
                (order.y[0] + 0.03, order.y[1] - 0.03),
                (z, min(z + 0.03, order.height)),
            ),
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
                assembly.add(
                    paint(spine, 0.05),
                    box(
                        (back + 0.03, front - deep),
                        (y, y + width - 0.008),
                        (z + 0.03, z + 0.03 + tall),
                    ),
                )
            y += width
    header(assembly, order, (order.height - 0.2, order.height - 0.04), front - 0.02)
    return assembly


def wall_shelf(order: Order) -> Assembly:
    """Build a small shelf on the wall with a few books and a vase."""
    assembly = Assembly()
    back, front = order.x
    body = order.body(OAK)
    thick = 0.03
    assembly.add(body, box((back, front), order.y, (0.1, 0.1 + thick)))
    for side in (-1, 1):
        y = side * order.length * 0.35
        assembly.add(
            metal(DARK),
            box((back, back + 0.02), (y - 0.015, y + 0.015), (0, 0.1)),
            box((back, front * 0.6), (y - 0.015, y + 0.015), (0.085, 0.1)),
        )
    y = order.y[0] + 0.08
    for place, spine in enumerate(SPINES):
        tall = (order.height - 0.1 - thick) * (1.0 if place == 1 else 0.86)
        assembly.add(
            paint(spine),
            box(
                (back + 0.02, front - 0.03),
                (y, y + 0.05),
                (0.1 + thick, 0.1 + thick + tall),
            ),
        )
        y += 0.055
    assembly.add(
        paint((0.25, 0.45, 0.5), 0.5),
        lathed([(0.03, 0), (0.06, 0.08), (0.03, 0.15), (0.035, 0.18)], 12).moved(
            y=order.y[1] - 0.2, z=0.1 + thick
        ),
    )
    return assembly


def paper_shelf(order: Order) -> Assembly:
    """Build open pigeonholes with reams of paper."""
    assembly = Assembly()
    back, front = order.x
    body = order.body((0.72, 0.54, 0.35))
    assembly.add(body, box((back, back + 0.015), order.y, order.z))
    columns, rows = max(2, round(order.length / 0.4)), max(2, round(order.height / 0.3))
    for column in range(columns + 1):
        y = order.y[0] + (order.length - 0.025) * column / columns
        assembly.add(body, box((back, front), (y, y + 0.025), order.z))
    for row in range(rows + 1):
        z = (order.height - 0.025) * row / rows
        assembly.add(body, box((back, front - 0.003), order.y, (z, z + 0.025)))
    rng = order.rng()
    wide, rise = order.length / columns, order.height / rows
    for column in range(columns):
        for row in range(rows):
            y = order.y[0] + column * wide + 0.05
            z = 0.025 + row * rise * 0.99
            tall = rise * float(rng.uniform(0.2, 0.65))
            tone = (0.96, 0.96, 0.94) if rng.random() < 0.7 else PRINTS[row % 5]
            assembly.add(
                paint(tone),
                box((back + 0.03, front - 0.02), (y, y + wide - 0.085), (z, z + tall)),
            )
    return assembly
