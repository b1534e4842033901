"""Doors of every style: leaves, frames, handles and the plate with their label.

A door's model stands like a landmark's: the origin in the middle of the doorway on the
floor, +x out of the wall towards who walks by. Its leaves are as thick as the physics
says, 2 cm before the wall's face; frame, handle and plate stand out a little more.
"""

import math
from collections.abc import Callable

import numpy as np

from memorymaze.errors import SettingsError
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb, colours_of, shade
from memorymaze.pictures.looks.door_labels import add_label
from memorymaze.pictures.looks.door_parts import (
    CASING,
    DARK,
    FRONT,
    STEEL,
    Parts,
    add,
    casing,
    door_colour,
    door_model,
    frame_line,
    handle,
    pane,
    swinging,
    threshold_pane,
    upright_grain,
)
from memorymaze.pictures.looks.object_model import ObjectModel
from memorymaze.pictures.looks.paints import glass, glow, metal, paint, picture, wood
from memorymaze.pictures.looks.primitives import box, plate
from memorymaze.sites.records import Door


def is_seen_through(door: Door) -> bool:
    """Whether one sees what is behind the door: it is glazed or open."""
    return door.state == "open" or door.style in {"glass", "automatic_glass"}


def model_for_door(door: Door) -> ObjectModel:
    """Return what a door looks like.

    Raises:
        SettingsError: Its style is none that the plan format knows.
    """
    if door.style not in DOOR_STYLES:
        raise SettingsError(
            f"door {door.id}: expected a style of {', '.join(DOOR_STYLES)}, got "
            f"{door.style!r}"
        )
    length = float(door.line.length)
    parts: Parts = {}
    DOOR_STYLES[door.style](parts, door, length)
    if door.label:
        add_label(parts, door, length)
    return door_model(parts)


def _wood_door(parts: Parts, door: Door, length: float) -> None:
    colour = door_colour(door, (0.50, 0.33, 0.20))
    natural = any(
        word in (door.color or "")
        for word in ("brown", "oak", "walnut", "wood", "beech", "pine")
    )
    board = wood(shade(colour, 1.08)) if natural else paint(colour, 0.15)
    groove = paint(shade(colour, 0.55))
    casing(parts, length, paint(shade(colour, 0.62), 0.1))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        made: Parts = {}
        add(made, board, upright_grain((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        for z in (0.95,):
            add(
                made,
                groove,
                frame_line(FRONT + 0.001, (low + 0.12, high - 0.12), (0.15, z - 0.1)),
                frame_line(FRONT + 0.001, (low + 0.12, high - 0.12), (z + 0.25, 1.95)),
            )
        y = high - 0.07 if hinge < 0 else low + 0.07
        handle(made, y, hinge)
        return made

    swinging(parts, door, length, leaf)


def _steel_door(parts: Parts, door: Door, length: float) -> None:
    colour = door_colour(door, (0.55, 0.56, 0.58))
    coat, dark = paint(colour, 0.3), paint(shade(colour, 0.6))
    casing(parts, length, paint(shade(colour, 0.75), 0.2))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        made: Parts = {}
        add(made, coat, box((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        for slot in range(6):
            z = 0.22 + 0.05 * slot
            add(
                made,
                dark,
                box((FRONT, FRONT + 0.004), (low + 0.18, high - 0.18), (z, z + 0.022)),
            )
        y = high - 0.07 if hinge < 0 else low + 0.07
        handle(made, y, hinge)
        return made

    swinging(parts, door, length, leaf)


def _fire_door(parts: Parts, door: Door, length: float) -> None:
    colour = door_colour(door, (0.75, 0.12, 0.12))
    coat, dark = paint(colour, 0.3), paint(DARK)
    casing(parts, length, paint(shade(colour, 0.7), 0.2))
    notice = sign_board(0.34, 0.12, "FIRE DOOR\nKEEP SHUT", (0.10, 0.25, 0.62))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        made: Parts = {}
        add(made, coat, box((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        edge = high - 0.26 if hinge < 0 else low + 0.26
        add(
            made,
            dark,
            box((FRONT, FRONT + 0.003), (edge - 0.09, edge + 0.09), (1.35, 1.95)),
        )
        add(
            made,
            paint((0.42, 0.50, 0.54), 0.6),
            box((FRONT, FRONT + 0.005), (edge - 0.07, edge + 0.07), (1.37, 1.93)),
        )
        add(
            made,
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
        add(
            made,
            picture(notice),
            plate((FRONT, FRONT + 0.004), (middle - 0.17, middle + 0.17), (1.13, 1.25)),
        )
        return made

    swinging(parts, door, length, leaf)


def _glazed_leaf(door: Door, low: float, high: float, *, handle: float | None) -> Parts:
    tint, alpha = _glazing(door)
    made: Parts = {}
    frame = metal((0.62, 0.64, 0.66))
    rail = 0.055
    add(
        made,
        frame,
        box((-FRONT, FRONT), (low, low + rail), (0.006, 2.095)),
        box((-FRONT, FRONT), (high - rail, high), (0.006, 2.095)),
        box((-FRONT, FRONT), (low + rail, high - rail), (0.006, 0.13)),
        box((-FRONT, FRONT), (low + rail, high - rail), (2.04, 2.095)),
    )
    inner = (low + rail, high - rail)
    add(made, glass(tint, alpha), pane(FRONT - 0.005, inner, (0.13, 2.04)))
    dots = paint((0.93, 0.95, 0.96))
    for z in (0.95, 1.45):
        count = max(2, int((inner[1] - inner[0]) / 0.1))
        for y in np.linspace(inner[0] + 0.05, inner[1] - 0.05, count):
            add(made, dots, pane(FRONT, (y - 0.016, y + 0.016), (z, z + 0.032)))
    if handle is not None:
        add(
            made,
            frame,
            box(
                (FRONT + 0.03, FRONT + 0.055),
                (handle - 0.0125, handle + 0.0125),
                (0.8, 1.3),
                0.01,
            ),
            box(
                (FRONT - 0.01, FRONT + 0.04),
                (handle - 0.01, handle + 0.01),
                (0.86, 0.88),
            ),
            box(
                (FRONT - 0.01, FRONT + 0.04),
                (handle - 0.01, handle + 0.01),
                (1.22, 1.24),
            ),
        )
    return made


def _glass_door(parts: Parts, door: Door, length: float) -> None:
    casing(parts, length, metal((0.58, 0.60, 0.62)))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        y = high - 0.11 if hinge < 0 else low + 0.11
        return _glazed_leaf(door, low, high, handle=y)

    swinging(parts, door, length, leaf)


def _automatic_door(parts: Parts, door: Door, length: float) -> None:
    casing(parts, length, metal((0.50, 0.52, 0.54)))
    half = length / 2
    add(
        parts,
        metal((0.42, 0.44, 0.46)),
        box((FRONT - 0.01, FRONT + 0.075), (-half, half), (2.10, 2.22), 0.01),
    )
    add(
        parts,
        paint((0.06, 0.06, 0.07), 0.6),
        box((FRONT + 0.07, FRONT + 0.085), (-0.1, 0.1), (2.13, 2.19)),
    )
    # Open leaves are drawn back, so that only their edges are left in the doorway.
    slide = (length / 2 - 0.14) if door.state == "open" else 0.0
    for low, high, hinge in (
        (-half + 0.005, -0.003, -1.0),
        (0.003, half - 0.005, 1.0),
    ):
        for material, shapes in _glazed_leaf(door, low, high, handle=None).items():
            for shape in shapes:
                back = -0.045 if door.state == "open" else 0.0
                add(parts, material, shape.moved(back, hinge * slide))
    if door.state == "open":
        threshold_pane(parts, length)
        return
    notice = sign_board(0.3, 0.12, "AUTOMATIC DOOR", (0.05, 0.35, 0.62))
    y = length / 4
    add(
        parts,
        picture(notice),
        plate((FRONT - 0.004, FRONT + 0.002), (y - 0.15, y + 0.15), (1.2, 1.32)),
    )


def _elevator(parts: Parts, door: Door, length: float) -> None:
    colour = door_colour(door, STEEL)
    brushed = picture(_brushed(colour))
    half = length / 2
    casing(parts, length, metal(shade(colour, 0.72)))
    middle = 0.004
    for low, high in ((-half, -middle), (middle, half)):
        add(parts, brushed, upright_grain((-FRONT, FRONT), (low, high), (0.006, 2.095)))
    add(
        parts,
        paint((0.05, 0.05, 0.05)),
        box((-FRONT, FRONT - 0.012), (-middle, middle), (0.0, 2.1)),
    )
    y = half + CASING + 0.10
    add(
        parts,
        metal(shade(colour, 0.9)),
        box((0.0, 0.016), (y - 0.05, y + 0.05), (0.95, 1.28)),
    )
    add(
        parts,
        glow((1.0, 0.72, 0.25)),
        box((0.016, 0.022), (y - 0.02, y + 0.02), (1.16, 1.20)),
        box((0.016, 0.022), (y - 0.02, y + 0.02), (1.03, 1.07)),
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


DOOR_STYLES: dict[str, Callable[[Parts, Door, float], None]] = {
    "wood": _wood_door,
    "glass": _glass_door,
    "steel": _steel_door,
    "automatic_glass": _automatic_door,
    "elevator": _elevator,
    "fire": _fire_door,
}
"""How each style of the plan format is built."""
