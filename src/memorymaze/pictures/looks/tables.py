"""Tables and desks."""

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.colours import Rgb, is_wooden
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, paint
from memorymaze.pictures.looks.primitives import box, cylinder, lathed
from memorymaze.pictures.looks.tubes import tube

WHITE: Rgb = (0.9, 0.9, 0.88)
OAK: Rgb = (0.7, 0.52, 0.33)
STEEL: Rgb = (0.66, 0.68, 0.7)
DARK: Rgb = (0.2, 0.2, 0.22)


def table(order: Order) -> Assembly:
    """Build a table on four legs."""
    top = order.body(OAK)
    legs = top if is_wooden(order.colour_words) else metal(STEEL)
    return _on_four_legs(order, top, legs, 0.035)


def coffee_table(order: Order) -> Assembly:
    """Build a low table with a shelf under its top."""
    assembly = table(order)
    inset = 0.06
    assembly.add(
        order.body(OAK),
        box(
            (order.x[0] + inset, order.x[1] - inset),
            (order.y[0] + inset, order.y[1] - inset),
            (0.12, 0.14),
        ),
    )
    return assembly


def desk(order: Order) -> Assembly:
    """Build a desk with drawers on one side."""
    assembly = table(order)
    right = order.y[1]
    assembly.add(
        order.shaded(OAK, 0.85),
        box(
            (order.x[0] + 0.05, order.x[1] - 0.03),
            (right - 0.45, right - 0.05),
            (0.05, order.height - 0.04),
        ),
    )
    for row in range(3):
        z = 0.1 + row * (order.height - 0.16) / 3
        assembly.add(
            metal(STEEL),
            box(
                (order.x[1] - 0.03, order.x[1] - 0.01),
                (right - 0.32, right - 0.18),
                (z + 0.1, z + 0.12),
            ),
        )
    return assembly


def round_table(order: Order) -> Assembly:
    """Build a round table on one foot."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    assembly.add(
        order.body(WHITE),
        lathed(
            [
                (radius - 0.01, order.height - 0.03),
                (radius, order.height - 0.02),
                (radius, order.height),
            ],
            28,
        ),
    )
    assembly.add(
        metal(DARK),
        lathed(
            [
                (radius * 0.6, 0),
                (radius * 0.6, 0.015),
                (0.06, 0.05),
                (0.035, 0.12),
                (0.035, order.height - 0.03),
            ],
            16,
        ),
    )
    return assembly


def high_table(order: Order) -> Assembly:
    """Build a bar table on two feet, with a footrest."""
    assembly = Assembly()
    assembly.add(
        order.body(WHITE),
        box(order.x, order.y, (order.height - 0.04, order.height), 0.01),
    )
    for side in (-1, 1):
        y = side * order.length * 0.33
        assembly.add(
            metal(DARK),
            cylinder(0.035, (0.02, order.height - 0.04), 12).moved(y=y),
            box(
                (order.x[0] * 0.85, order.x[1] * 0.85), (y - 0.12, y + 0.12), (0, 0.02)
            ),
        )
    reach = order.length * 0.33
    assembly.add(metal(DARK), tube([(0, -reach, 0.3), (0, reach, 0.3)], 0.015, 8))
    return assembly


def parasol_table(order: Order) -> Assembly:
    """Build a small round table under a parasol."""
    assembly = Assembly()
    radius = min(order.length, order.depth) / 2
    table_order = Order(order.category, 1.3 * radius, 1.3 * radius, 0.74, "white")
    assembly.include(round_table(table_order))
    assembly.add(metal(STEEL), cylinder(0.022, (0.7, order.height - 0.02), 8))
    low = order.height * 0.8
    assembly.add(
        paint(order.colour((0.2, 0.5, 0.3)), 0.0),
        lathed(
            [
                (0.03, low + 0.03),
                (radius, low - 0.02),
                (radius, low),
                (radius * 0.5, (low + order.height) / 2 + 0.05),
                (0, order.height),
            ],
            8,
        ),
    )
    return assembly


def _on_four_legs(
    order: Order, top: Material, legs: Material, thick: float
) -> Assembly:
    assembly = Assembly()
    assembly.add(
        top, box(order.x, order.y, (order.height - thick, order.height), 0.008)
    )
    inset = 0.04
    assembly.add(
        legs,
        box(
            (order.x[0] + inset, order.x[1] - inset),
            (order.y[0] + inset, order.y[1] - inset),
            (order.height - thick - 0.06, order.height - thick),
        ),
    )
    legs_into(assembly, order, legs, order.height - thick, 0.05, 0.03)
    return assembly


def legs_into(
    assembly: Assembly,
    order: Order,
    legs: Material,
    top: float,
    width: float,
    inset: float,
) -> None:
    """Add four square legs of a width, set in from the ends, in metres."""
    for x in (order.x[0] + inset, order.x[1] - inset - width):
        for y in (order.y[0] + 0.03, order.y[1] - 0.03 - width):
            assembly.add(legs, box((x, x + width), (y, y + width), (0, top)))
