"""Doors of every style: leaves, frames, handles and the plate with their label.

A door's model stands like a landmark's: the origin in the middle of the doorway on the
floor, +x out of the wall towards who walks by. Its leaves are as thick as the physics
says, 2 cm before the wall's face; frame, handle and plate stand out a little more.
"""

import math
from collections.abc import Callable

import numpy as np

from memorymaze.world.looks.assembly import Assembly, ObjectModel, built
from memorymaze.world.looks.boards import PICTOGRAMS, pictogram_board, sign_board
from memorymaze.world.looks.materials import (
    LEAD,
    STEEL,
    Material,
    Rgb,
    colours_of,
    glass,
    glow,
    metal,
    paint,
    picture,
    shade,
    wood,
)
from memorymaze.world.looks.shapes import (
    Shape,
    around,
    box,
    joined,
    pane,
    span_between,
)
from memorymaze.world.sites.records import Door
from memorymaze.world.sites.solids import DOOR_HEIGHT, DOOR_PROUD

DOUBLE_FROM = 1.35
"""Doorways this wide, metres, have two leaves."""
FRONT = DOOR_PROUD
CASING = 0.07
"""Width of the frame beside and above the doorway, metres."""
CASING_FRONT = 0.034
AJAR_DEG = 100.0
"""How far an open leaf is swung into the room."""


def is_seen_through(door: Door) -> bool:
    """Whether one sees what is behind the door: it is glazed or open."""
    return door.state == "open" or door.style in {"glass", "automatic_glass"}


def model_for_door(door: Door) -> ObjectModel:
    """Return what a door looks like."""
    length = float(door.line.length)
    made = Assembly()
    DOOR_STYLES[door.style](made, door, length)
    if door.label:
        add_label(made, door, length)
    return made.unstretched()


def _wood_door(made: Assembly, door: Door, length: float) -> None:
    colour = door_colour(door, (0.50, 0.33, 0.20))
    natural = any(
        word in (door.color or "")
        for word in ("brown", "oak", "walnut", "wood", "beech", "pine")
    )
    board = wood(shade(colour, 1.08)) if natural else paint(colour, 0.15)
    groove = paint(shade(colour, 0.55))
    casing(made, length, paint(shade(colour, 0.62), 0.1))

    def leaf(made: Assembly, low: float, high: float, hinge: float) -> None:
        made.add(board, upright_grain((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        made.add(
            groove,
            frame_line(FRONT + 0.001, (low + 0.12, high - 0.12), (0.15, 0.85)),
            frame_line(FRONT + 0.001, (low + 0.12, high - 0.12), (1.2, 1.95)),
        )
        y = high - 0.07 if hinge < 0 else low + 0.07
        handle(made, y, hinge)

    swinging(made, door, length, leaf)


def _steel_door(made: Assembly, door: Door, length: float) -> None:
    colour = door_colour(door, (0.55, 0.56, 0.58))
    coat, dark = paint(colour, 0.3), paint(shade(colour, 0.6))
    casing(made, length, paint(shade(colour, 0.75), 0.2))

    def leaf(made: Assembly, low: float, high: float, hinge: float) -> None:
        made.box(coat, (-FRONT, FRONT), (low, high), (0.006, 2.095))
        for slot in range(6):
            z = 0.22 + 0.05 * slot
            made.box(
                dark, (FRONT, FRONT + 0.004), (low + 0.18, high - 0.18), (z, z + 0.022)
            )
        y = high - 0.07 if hinge < 0 else low + 0.07
        handle(made, y, hinge)

    swinging(made, door, length, leaf)


def _fire_door(made: Assembly, door: Door, length: float) -> None:
    colour = door_colour(door, (0.75, 0.12, 0.12))
    coat, dark = paint(colour, 0.3), paint(LEAD)
    casing(made, length, paint(shade(colour, 0.7), 0.2))
    notice = sign_board(0.34, 0.12, "FIRE DOOR\nKEEP SHUT", (0.10, 0.25, 0.62))

    def leaf(made: Assembly, low: float, high: float, hinge: float) -> None:
        made.box(coat, (-FRONT, FRONT), (low, high), (0.006, 2.095))
        edge = high - 0.26 if hinge < 0 else low + 0.26
        made.box(dark, (FRONT, FRONT + 0.003), around(edge, 0.09), (1.35, 1.95))
        made.box(
            paint((0.42, 0.50, 0.54), 0.6),
            (FRONT, FRONT + 0.005),
            around(edge, 0.07),
            (1.37, 1.93),
        )
        made.add(
            metal(STEEL),
            box(
                (FRONT + 0.03, FRONT + 0.07),
                (low + 0.06, high - 0.06),
                (0.98, 1.06),
                0.012,
            ),
            box((FRONT, FRONT + 0.06), (low + 0.06, low + 0.11), (0.96, 1.08)),
            box((FRONT, FRONT + 0.06), (high - 0.11, high - 0.06), (0.96, 1.08)),
        )
        middle = (low + high) / 2
        made.plate(
            picture(notice), (FRONT, FRONT + 0.004), around(middle, 0.17), (1.13, 1.25)
        )

    swinging(made, door, length, leaf)


def _glazed_leaf(
    made: Assembly, low: float, high: float, door: Door, handle: float | None = None
) -> None:
    tint, alpha = _glazing(door)
    frame = metal((0.62, 0.64, 0.66))
    rail = 0.055
    made.add(
        frame,
        box((-FRONT, FRONT), (low, low + rail), (0.006, 2.095)),
        box((-FRONT, FRONT), (high - rail, high), (0.006, 2.095)),
        box((-FRONT, FRONT), (low + rail, high - rail), (0.006, 0.13)),
        box((-FRONT, FRONT), (low + rail, high - rail), (2.04, 2.095)),
    )
    inner = (low + rail, high - rail)
    made.add(glass(tint, alpha), pane(FRONT - 0.005, inner, (0.13, 2.04)))
    dots = paint((0.93, 0.95, 0.96))
    for z in (0.95, 1.45):
        count = max(2, int((inner[1] - inner[0]) / 0.1))
        for y in np.linspace(inner[0] + 0.05, inner[1] - 0.05, count):
            made.add(dots, pane(FRONT, around(y, 0.016), (z, z + 0.032)))
    if handle is not None:
        made.add(
            frame,
            box(
                (FRONT + 0.03, FRONT + 0.055), around(handle, 0.0125), (0.8, 1.3), 0.01
            ),
            box((FRONT - 0.01, FRONT + 0.04), around(handle, 0.01), (0.86, 0.88)),
            box((FRONT - 0.01, FRONT + 0.04), around(handle, 0.01), (1.22, 1.24)),
        )


def _glass_door(made: Assembly, door: Door, length: float) -> None:
    casing(made, length, metal((0.58, 0.60, 0.62)))

    def leaf(made: Assembly, low: float, high: float, hinge: float) -> None:
        y = high - 0.11 if hinge < 0 else low + 0.11
        _glazed_leaf(made, low, high, door, handle=y)

    swinging(made, door, length, leaf)


def _automatic_door(made: Assembly, door: Door, length: float) -> None:
    casing(made, length, metal((0.50, 0.52, 0.54)))
    half = length / 2
    made.box(
        metal((0.42, 0.44, 0.46)),
        (FRONT - 0.01, FRONT + 0.075),
        (-half, half),
        (2.10, 2.22),
        0.01,
    )
    made.box(
        paint((0.06, 0.06, 0.07), 0.6),
        (FRONT + 0.07, FRONT + 0.085),
        (-0.1, 0.1),
        (2.13, 2.19),
    )
    # Open leaves are drawn back, so that only their edges are left in the doorway.
    slide = (length / 2 - 0.14) if door.state == "open" else 0.0
    for low, high, hinge in ((-half + 0.005, -0.003, -1.0), (0.003, half - 0.005, 1.0)):
        for material, shapes in built(_glazed_leaf, low, high, door).shapes.items():
            for shape in shapes:
                back = -0.045 if door.state == "open" else 0.0
                made.add(material, shape.moved(back, hinge * slide))
    if door.state == "open":
        threshold_pane(made, length)
        return
    notice = sign_board(0.3, 0.12, "AUTOMATIC DOOR", (0.05, 0.35, 0.62))
    y = length / 4
    made.plate(
        picture(notice), (FRONT - 0.004, FRONT + 0.002), around(y, 0.15), (1.2, 1.32)
    )


def _elevator(made: Assembly, door: Door, length: float) -> None:
    colour = door_colour(door, STEEL)
    brushed = picture(_brushed(colour))
    half = length / 2
    casing(made, length, metal(shade(colour, 0.72)))
    middle = 0.004
    for low, high in ((-half, -middle), (middle, half)):
        made.add(brushed, upright_grain((-FRONT, FRONT), (low, high), (0.006, 2.095)))
    made.box(
        paint((0.05, 0.05, 0.05)),
        (-FRONT, FRONT - 0.012),
        (-middle, middle),
        (0.0, 2.1),
    )
    y = half + CASING + 0.10
    made.box(metal(shade(colour, 0.9)), (0.0, 0.016), around(y, 0.05), (0.95, 1.28))
    made.add(
        glow((1.0, 0.72, 0.25)),
        box((0.016, 0.022), around(y, 0.02), (1.16, 1.20)),
        box((0.016, 0.022), around(y, 0.02), (1.03, 1.07)),
    )


def _brushed(colour: Rgb) -> "np.ndarray[tuple[int, ...], np.dtype[np.uint8]]":
    rng = np.random.default_rng(3)
    lines = rng.normal(0, 0.025, (1, 128, 1)) + rng.normal(0, 0.008, (64, 128, 1))
    slope = np.linspace(0.06, -0.05, 64)[:, None, None]
    sheen = 0.05 * np.sin(np.linspace(0, 2 * math.pi, 128))[None, :, None]
    pixels = np.clip(np.array(colour) * (1 + lines + slope + sheen), 0, 1)
    return (255 * pixels).astype(np.uint8)


def _glazing(door: Door) -> tuple[Rgb, float]:
    words = (door.color or "").lower()
    if "frost" in words:
        return (0.90, 0.94, 0.95), 0.8
    named = colours_of(door.color)
    if not named or "clear" in words:
        return (0.78, 0.90, 0.92), 0.16
    return named[0], 0.3


DOOR_STYLES: dict[str, Callable[[Assembly, Door, float], None]] = {
    "wood": _wood_door,
    "glass": _glass_door,
    "steel": _steel_door,
    "automatic_glass": _automatic_door,
    "elevator": _elevator,
    "fire": _fire_door,
}
"""How each style of the plan format is built."""


def swinging(
    made: Assembly,
    door: Door,
    length: float,
    leaf: Callable[[Assembly, float, float, float], None],
) -> None:
    """Add leaves, swung into the room where the door is open."""
    for low, high, hinge in door_leaves(length):
        at = low if hinge < 0 else high
        for material, shapes in built(leaf, low, high, hinge).shapes.items():
            for shape in shapes:
                if door.state == "open":
                    swung = shape.moved(-FRONT, -at).turned(-hinge * AJAR_DEG)
                    shape = swung.moved(-0.06, at - hinge * 0.03)
                made.add(material, shape)
    if door.state == "open":
        threshold_pane(made, length)


def door_leaves(length: float) -> list[tuple[float, float, float]]:
    """Return from, to and the hinge's side (-1, 1) of each leaf, along y."""
    half = length / 2 - 0.005
    if length < DOUBLE_FROM:
        return [(-half, half, -1.0)]
    return [(-half, -0.003, -1.0), (0.003, half, 1.0)]


def casing(made: Assembly, length: float, material: Material) -> None:
    """Add the frame beside and above the doorway."""
    half = length / 2
    for side in (-1, 1):
        made.box(
            material,
            (-0.05, CASING_FRONT),
            span_between(side * half, side * (half + CASING)),
            (0.0, DOOR_HEIGHT + CASING),
        )
    made.box(
        material,
        (-0.05, CASING_FRONT),
        (-half, half),
        (DOOR_HEIGHT - 0.005, DOOR_HEIGHT + CASING),
    )


def handle(made: Assembly, y: float, towards: float) -> None:
    """Add a lever at 1.05 m that points to its hinge."""
    steel = metal(STEEL)
    made.add(
        steel,
        box((FRONT, FRONT + 0.008), around(y, 0.02), (0.93, 1.13)),
        box((FRONT, FRONT + 0.05), around(y, 0.01), (1.04, 1.06)),
        box(
            (FRONT + 0.035, FRONT + 0.055),
            span_between(y, y + towards * 0.12),
            (1.035, 1.06),
            0.008,
        ),
    )


def threshold_pane(made: Assembly, length: float) -> None:
    """Add what tells the doorway from what is behind it, hardly to be seen."""
    clear = glass((0.8, 0.9, 0.95), 0.03)
    half = length / 2
    made.add(clear, pane(0.0, (-half, half), (0.0, DOOR_HEIGHT)))


def frame_line(x: float, y: tuple[float, float], z: tuple[float, float]) -> Shape:
    """Return four thin grooves round a rectangle."""
    wide = 0.008
    return joined(
        pane(x, (y[0], y[0] + wide), z),
        pane(x, (y[1] - wide, y[1]), z),
        pane(x, y, (z[0], z[0] + wide)),
        pane(x, y, (z[1] - wide, z[1])),
    )


def upright_grain(
    x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]
) -> Shape:
    """Return a box whose picture stands upright on its front and back."""
    shape = box(x, y, z)
    across = (shape.vertices[:, 1] - y[0]) / (y[1] - y[0])
    up = (shape.vertices[:, 2] - z[0]) / (z[1] - z[0])
    return Shape(
        shape.vertices, shape.faces, shape.normals, np.column_stack([up, across])
    )


def door_colour(door: Door, otherwise: Rgb) -> Rgb:
    """Return the first colour that the plan names for a door."""
    return next(iter(colours_of(door.color)), otherwise)


def add_label(made: Assembly, door: Door, length: float) -> None:
    """Put the label on the leaf, or over the doorway where no leaf can bear it."""
    text = door.label or ""
    above = door.state == "open" or door.style in {"elevator", "automatic_glass"}
    room = length - 0.24 if above or length < DOUBLE_FROM else length / 2 - 0.24
    longest = max(len(line) for line in text.split("\n"))
    height = 0.15
    width = min(max(0.26, 0.062 * longest + 0.08), max(room, 0.3))
    if width < 0.045 * longest:
        height = 0.2
    ground = (0.96, 0.96, 0.94)
    if "exit" in text.lower() or "stairs" in text.lower():
        ground = (0.05, 0.45, 0.25)
    elif any(word in text.lower() for word in ("staff", "danger", "no entry", "only")):
        ground = (0.78, 0.13, 0.12)
    elif above:
        ground = (0.12, 0.16, 0.24)
    pictograms = PICTOGRAMS.get(text.strip().lower())
    if pictograms is not None and not above:
        board = pictogram_board(0.3, 0.36, text, pictograms, (0.12, 0.28, 0.52))
        width, height = 0.3, 0.36
    else:
        board = sign_board(width, height, text, ground, framed=False)
    middle = 0.0
    if not above and length >= DOUBLE_FROM:
        middle = -length / 4
    bottom = DOOR_HEIGHT + CASING + 0.015 if above else 1.68 - height / 2
    if door.style == "automatic_glass":
        bottom = DOOR_HEIGHT + 0.135
    front = CASING_FRONT if above else FRONT
    made.plate(
        picture(board, 0.15),
        (-0.002 if above else FRONT - 0.01, front + 0.006),
        around(middle, width / 2),
        (bottom, bottom + height),
    )
