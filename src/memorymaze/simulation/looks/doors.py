"""Doors of every style: leaves, frames, handles and the plate with their label.

A door's model stands like a landmark's: the origin in the middle of the doorway on the
floor, +x out of the wall towards who walks by. Its leaves are as thick as the physics
says, 2 cm before the wall's face; frame, handle and plate stand out a little more.
"""

import math
from collections.abc import Callable

import numpy as np

from memorymaze.errors import SettingsError
from memorymaze.simulation.furnishing import DOOR_HEIGHT, DOOR_PROUD
from memorymaze.simulation.looks.boards import pictogram_board, sign_board
from memorymaze.simulation.looks.colours import Rgb, colours_of, shade
from memorymaze.simulation.looks.object_model import Material, MeshPart, ObjectModel
from memorymaze.simulation.looks.paints import glass, glow, metal, paint, picture, wood
from memorymaze.simulation.looks.pictograms import Pictogram
from memorymaze.simulation.looks.primitives import box, plate
from memorymaze.simulation.looks.shape import Floats, Shape, joined
from memorymaze.sites.records import Door

__all__ = ["DOOR_STYLES", "is_seen_through", "model_for_door"]

STEEL: Rgb = (0.70, 0.71, 0.73)
DARK: Rgb = (0.16, 0.17, 0.18)
DOUBLE_FROM = 1.35
"""Doorways this wide, metres, have two leaves."""
FRONT = DOOR_PROUD
CASING = 0.07
"""Width of the frame beside and above the doorway, metres."""
CASING_FRONT = 0.034
AJAR_DEG = 100.0
"""How far an open leaf is swung into the room."""

Parts = dict[Material, list[Shape]]


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
        _label(parts, door, length)
    return _model(parts)


def _leaves(length: float) -> list[tuple[float, float, float]]:
    """Return from, to and the hinge's side (-1, 1) of each leaf, along y."""
    half = length / 2 - 0.005
    if length < DOUBLE_FROM:
        return [(-half, half, -1.0)]
    return [(-half, -0.003, -1.0), (0.003, half, 1.0)]


def _casing(parts: Parts, length: float, material: Material) -> None:
    half = length / 2
    for side in (-1, 1):
        _add(
            parts,
            material,
            box(
                (-0.05, CASING_FRONT),
                _sorted(side * half, side * (half + CASING)),
                (0.0, DOOR_HEIGHT + CASING),
            ),
        )
    _add(
        parts,
        material,
        box(
            (-0.05, CASING_FRONT),
            (-half, half),
            (DOOR_HEIGHT - 0.005, DOOR_HEIGHT + CASING),
        ),
    )


def _handle(parts: Parts, y: float, towards: float) -> None:
    """A lever at 1.05 m that points to its hinge."""
    steel = metal(STEEL)
    _add(
        parts,
        steel,
        box((FRONT, FRONT + 0.008), (y - 0.02, y + 0.02), (0.93, 1.13)),
        box((FRONT, FRONT + 0.05), (y - 0.01, y + 0.01), (1.04, 1.06)),
        box(
            (FRONT + 0.035, FRONT + 0.055),
            _sorted(y, y + towards * 0.12),
            (1.035, 1.06),
            0.008,
        ),
    )


def _swinging(
    parts: Parts,
    door: Door,
    length: float,
    leaf: Callable[[float, float, float], Parts],
) -> None:
    """Add leaves, swung into the room where the door is open."""
    for low, high, hinge in _leaves(length):
        made = leaf(low, high, hinge)
        at = low if hinge < 0 else high
        for material, shapes in made.items():
            for shape in shapes:
                if door.state == "open":
                    swung = shape.moved(-FRONT, -at).turned("z", -hinge * AJAR_DEG)
                    shape = swung.moved(-0.06, at - hinge * 0.03)
                _add(parts, material, shape)
    if door.state == "open":
        _threshold_pane(parts, length)


def _threshold_pane(parts: Parts, length: float) -> None:
    """What tells the doorway from what is behind it, hardly to be seen."""
    pane = glass((0.8, 0.9, 0.95), 0.03)
    half = length / 2
    _add(parts, pane, _pane(0.0, (-half, half), (0.0, DOOR_HEIGHT)))


def _wood_door(parts: Parts, door: Door, length: float) -> None:
    colour = _colour(door, (0.50, 0.33, 0.20))
    natural = any(
        word in (door.color or "")
        for word in ("brown", "oak", "walnut", "wood", "beech", "pine")
    )
    board = wood(shade(colour, 1.08)) if natural else paint(colour, 0.15)
    groove = paint(shade(colour, 0.55))
    _casing(parts, length, paint(shade(colour, 0.62), 0.1))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        made: Parts = {}
        _add(made, board, _upright_grain((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        for z in (0.95,):
            _add(
                made,
                groove,
                _frame_line(FRONT + 0.001, (low + 0.12, high - 0.12), (0.15, z - 0.1)),
                _frame_line(FRONT + 0.001, (low + 0.12, high - 0.12), (z + 0.25, 1.95)),
            )
        y = high - 0.07 if hinge < 0 else low + 0.07
        _handle(made, y, hinge)
        return made

    _swinging(parts, door, length, leaf)


def _steel_door(parts: Parts, door: Door, length: float) -> None:
    colour = _colour(door, (0.55, 0.56, 0.58))
    coat, dark = paint(colour, 0.3), paint(shade(colour, 0.6))
    _casing(parts, length, paint(shade(colour, 0.75), 0.2))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        made: Parts = {}
        _add(made, coat, box((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        for slot in range(6):
            z = 0.22 + 0.05 * slot
            _add(
                made,
                dark,
                box((FRONT, FRONT + 0.004), (low + 0.18, high - 0.18), (z, z + 0.022)),
            )
        y = high - 0.07 if hinge < 0 else low + 0.07
        _handle(made, y, hinge)
        return made

    _swinging(parts, door, length, leaf)


def _fire_door(parts: Parts, door: Door, length: float) -> None:
    colour = _colour(door, (0.75, 0.12, 0.12))
    coat, dark = paint(colour, 0.3), paint(DARK)
    _casing(parts, length, paint(shade(colour, 0.7), 0.2))
    notice = sign_board(0.34, 0.12, "FIRE DOOR\nKEEP SHUT", (0.10, 0.25, 0.62))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        made: Parts = {}
        _add(made, coat, box((-FRONT, FRONT), (low, high), (0.006, 2.095)))
        edge = high - 0.26 if hinge < 0 else low + 0.26
        _add(
            made,
            dark,
            box((FRONT, FRONT + 0.003), (edge - 0.09, edge + 0.09), (1.35, 1.95)),
        )
        _add(
            made,
            paint((0.42, 0.50, 0.54), 0.6),
            box((FRONT, FRONT + 0.005), (edge - 0.07, edge + 0.07), (1.37, 1.93)),
        )
        _add(
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
        _add(
            made,
            picture(notice),
            plate((FRONT, FRONT + 0.004), (middle - 0.17, middle + 0.17), (1.13, 1.25)),
        )
        return made

    _swinging(parts, door, length, leaf)


def _glazed_leaf(door: Door, low: float, high: float, *, handle: float | None) -> Parts:
    tint, alpha = _glazing(door)
    made: Parts = {}
    frame = metal((0.62, 0.64, 0.66))
    rail = 0.055
    _add(
        made,
        frame,
        box((-FRONT, FRONT), (low, low + rail), (0.006, 2.095)),
        box((-FRONT, FRONT), (high - rail, high), (0.006, 2.095)),
        box((-FRONT, FRONT), (low + rail, high - rail), (0.006, 0.13)),
        box((-FRONT, FRONT), (low + rail, high - rail), (2.04, 2.095)),
    )
    inner = (low + rail, high - rail)
    _add(made, glass(tint, alpha), _pane(FRONT - 0.005, inner, (0.13, 2.04)))
    dots = paint((0.93, 0.95, 0.96))
    for z in (0.95, 1.45):
        count = max(2, int((inner[1] - inner[0]) / 0.1))
        for y in np.linspace(inner[0] + 0.05, inner[1] - 0.05, count):
            _add(made, dots, _pane(FRONT, (y - 0.016, y + 0.016), (z, z + 0.032)))
    if handle is not None:
        _add(
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
    _casing(parts, length, metal((0.58, 0.60, 0.62)))

    def leaf(low: float, high: float, hinge: float) -> Parts:
        y = high - 0.11 if hinge < 0 else low + 0.11
        return _glazed_leaf(door, low, high, handle=y)

    _swinging(parts, door, length, leaf)


def _automatic_door(parts: Parts, door: Door, length: float) -> None:
    _casing(parts, length, metal((0.50, 0.52, 0.54)))
    half = length / 2
    _add(
        parts,
        metal((0.42, 0.44, 0.46)),
        box((FRONT - 0.01, FRONT + 0.075), (-half, half), (2.10, 2.22), 0.01),
    )
    _add(
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
                _add(parts, material, shape.moved(back, hinge * slide))
    if door.state == "open":
        _threshold_pane(parts, length)
        return
    notice = sign_board(0.3, 0.12, "AUTOMATIC DOOR", (0.05, 0.35, 0.62))
    y = length / 4
    _add(
        parts,
        picture(notice),
        plate((FRONT - 0.004, FRONT + 0.002), (y - 0.15, y + 0.15), (1.2, 1.32)),
    )


def _elevator(parts: Parts, door: Door, length: float) -> None:
    colour = _colour(door, STEEL)
    brushed = picture(_brushed(colour))
    half = length / 2
    _casing(parts, length, metal(shade(colour, 0.72)))
    middle = 0.004
    for low, high in ((-half, -middle), (middle, half)):
        _add(
            parts, brushed, _upright_grain((-FRONT, FRONT), (low, high), (0.006, 2.095))
        )
    _add(
        parts,
        paint((0.05, 0.05, 0.05)),
        box((-FRONT, FRONT - 0.012), (-middle, middle), (0.0, 2.1)),
    )
    y = half + CASING + 0.10
    _add(
        parts,
        metal(shade(colour, 0.9)),
        box((0.0, 0.016), (y - 0.05, y + 0.05), (0.95, 1.28)),
    )
    _add(
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


def _label(parts: Parts, door: Door, length: float) -> None:
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
    _add(
        parts,
        picture(board, 0.15),
        plate(
            (-0.002 if above else FRONT - 0.01, front + 0.006),
            (middle - width / 2, middle + width / 2),
            (bottom, bottom + height),
        ),
    )


def _glazing(door: Door) -> tuple[Rgb, float]:
    words = (door.color or "").lower()
    if "frost" in words:
        return (0.90, 0.94, 0.95), 0.8
    named = colours_of(door.color)
    if not named or "clear" in words:
        return (0.78, 0.90, 0.92), 0.16
    return named[0], 0.3


def _colour(door: Door, otherwise: Rgb) -> Rgb:
    return next(iter(colours_of(door.color)), otherwise)


def _frame_line(x: float, y: tuple[float, float], z: tuple[float, float]) -> Shape:
    """Four thin grooves round a rectangle."""
    wide = 0.008
    return joined(
        _pane(x, (y[0], y[0] + wide), z),
        _pane(x, (y[1] - wide, y[1]), z),
        _pane(x, y, (z[0], z[0] + wide)),
        _pane(x, y, (z[1] - wide, z[1])),
    )


def _pane(x: float, y: tuple[float, float], z: tuple[float, float]) -> Shape:
    """A single rectangle that is seen from the front."""
    points = np.array([
        (x, y[0], z[0]),
        (x, y[1], z[0]),
        (x, y[1], z[1]),
        (x, y[0], z[1]),
    ])
    return Shape(
        points,
        np.array([(0, 1, 2), (0, 2, 3)]),
        np.tile((1.0, 0.0, 0.0), (4, 1)),
    )


def _upright_grain(
    x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]
) -> Shape:
    """A box whose picture stands upright on its front and back."""
    shape = box(x, y, z)
    across = (shape.vertices[:, 1] - y[0]) / (y[1] - y[0])
    up = (shape.vertices[:, 2] - z[0]) / (z[1] - z[0])
    return Shape(
        shape.vertices, shape.faces, shape.normals, np.column_stack([up, across])
    )


def _add(parts: Parts, material: Material, *shapes: Shape) -> None:
    parts.setdefault(material, []).extend(shapes)


def _sorted(a: float, b: float) -> tuple[float, float]:
    return (a, b) if a < b else (b, a)


def _model(parts: Parts) -> ObjectModel:
    made: list[MeshPart] = []
    for material, shapes in parts.items():
        if material.texture is None:
            shapes = [Shape(s.vertices, s.faces, s.normals) for s in shapes]
        whole = joined(*shapes)
        uv: Floats | None = whole.uv
        made.append(
            MeshPart(
                whole.vertices.astype(np.float32),
                whole.faces.astype(np.int32),
                whole.normals.astype(np.float32),
                None if uv is None else uv.astype(np.float32),
                material,
            )
        )
    return ObjectModel(tuple(made))


PICTOGRAMS: dict[str, tuple[Pictogram, ...]] = {
    "women": ("woman",),
    "men": ("man",),
    "restroom": ("woman", "man"),
    "accessible": ("wheelchair",),
    "first aid": ("cross",),
    "first aid room": ("cross",),
    "baby care": ("stroller",),
    "nursing room": ("stroller",),
}
"""Labels that stand under a pictogram."""

DOOR_STYLES: dict[str, Callable[[Parts, Door, float], None]] = {
    "wood": _wood_door,
    "glass": _glass_door,
    "steel": _steel_door,
    "automatic_glass": _automatic_door,
    "elevator": _elevator,
    "fire": _fire_door,
}
"""How each style of the plan format is built."""
