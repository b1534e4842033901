"""Plates with a door's label, on its leaf or over the doorway."""

from memorymaze.pictures.looks.boards import pictogram_board, sign_board
from memorymaze.pictures.looks.door_parts import (
    CASING,
    CASING_FRONT,
    DOUBLE_FROM,
    FRONT,
    Parts,
    add,
)
from memorymaze.pictures.looks.paints import picture
from memorymaze.pictures.looks.pictograms import Pictogram
from memorymaze.pictures.looks.primitives import plate
from memorymaze.simulation.solids import DOOR_HEIGHT
from memorymaze.sites.records import Door

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


def add_label(parts: Parts, door: Door, length: float) -> None:
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
    add(
        parts,
        picture(board, 0.15),
        plate(
            (-0.002 if above else FRONT - 0.01, front + 0.006),
            (middle - width / 2, middle + width / 2),
            (bottom, bottom + height),
        ),
    )
