"""Signs without words: arrows, people, crosses, hearts."""

from collections.abc import Callable
from typing import Literal

from PIL import Image, ImageDraw

from memorymaze.pictures.looks.colours import Rgb, rgb255
from memorymaze.simulation.senses.lettering import Field
from memorymaze.simulation.senses.signposts import Arrow

Pictogram = Literal[
    "woman", "man", "wheelchair", "running", "cross", "heart", "stroller", "flame"
]

FINER = 4
"""Pictograms are drawn larger by this factor, then reduced, for smooth edges."""
Point = tuple[float, float]
Pen = Callable[[ImageDraw.ImageDraw, float], None]
"""Draws in white into a square of so many pixels."""

QUARTER_TURNS: dict[Arrow, int] = {"ahead": 0, "left": 1, "back": 2, "right": 3}
ARROW: list[Point] = [
    (0.5, 0.04), (0.94, 0.48), (0.78, 0.64), (0.62, 0.48), (0.62, 0.96),
    (0.38, 0.96), (0.38, 0.48), (0.22, 0.64), (0.06, 0.48),
]  # fmt: skip


def draw_arrow(image: Image.Image, field: Field, arrow: Arrow, ink: Rgb) -> None:
    """Draw an arrow in the middle of a field of an RGB picture."""

    def pen(draw: ImageDraw.ImageDraw, side: float) -> None:
        points = ARROW
        for _ in range(QUARTER_TURNS[arrow]):
            points = [(y, 1 - x) for x, y in points]
        draw.polygon([(x * side, y * side) for x, y in points], 255)

    _stamp(image, field, pen, ink)


def draw_pictogram(
    image: Image.Image, field: Field, pictogram: Pictogram, ink: Rgb
) -> None:
    """Draw a pictogram in the middle of a field of an RGB picture."""
    _stamp(image, field, PENS[pictogram], ink)


def _stamp(image: Image.Image, field: Field, pen: Pen, ink: Rgb) -> None:
    side = max(4, int(min(field.width, field.height)))
    mask = Image.new("L", (side * FINER, side * FINER))
    pen(ImageDraw.Draw(mask), side * FINER)
    mask = mask.reduce(FINER)
    x = int((field.left + field.right - side) / 2)
    y = int((field.top + field.bottom - side) / 2)
    image.paste(rgb255(ink), (x, y), mask)


def _disc(draw: ImageDraw.ImageDraw, s: float, x: float, y: float, r: float) -> None:
    draw.ellipse([(x - r) * s, (y - r) * s, (x + r) * s, (y + r) * s], 255)


def _stroke(
    draw: ImageDraw.ImageDraw, s: float, points: list[Point], width: float
) -> None:
    draw.line([(x * s, y * s) for x, y in points], 255, round(width * s), "curve")
    for x, y in points:
        _disc(draw, s, x, y, width / 2)


def _area(draw: ImageDraw.ImageDraw, s: float, points: list[Point]) -> None:
    draw.polygon([(x * s, y * s) for x, y in points], 255)


def _man(draw: ImageDraw.ImageDraw, s: float) -> None:
    _disc(draw, s, 0.5, 0.13, 0.1)
    _area(draw, s, [(0.34, 0.27), (0.66, 0.27), (0.66, 0.58), (0.34, 0.58)])
    for side in (-1, 1):
        _stroke(draw, s, [(0.5 + side * 0.2, 0.31), (0.5 + side * 0.22, 0.56)], 0.085)
        _stroke(draw, s, [(0.5 + side * 0.09, 0.55), (0.5 + side * 0.09, 0.93)], 0.12)


def _woman(draw: ImageDraw.ImageDraw, s: float) -> None:
    _disc(draw, s, 0.5, 0.13, 0.1)
    _area(draw, s, [(0.4, 0.26), (0.6, 0.26), (0.78, 0.7), (0.22, 0.7)])
    for side in (-1, 1):
        _stroke(draw, s, [(0.5 + side * 0.14, 0.3), (0.5 + side * 0.3, 0.56)], 0.08)
        _stroke(draw, s, [(0.5 + side * 0.09, 0.68), (0.5 + side * 0.09, 0.93)], 0.1)


def _wheelchair(draw: ImageDraw.ImageDraw, s: float) -> None:
    _disc(draw, s, 0.4, 0.12, 0.09)
    _stroke(draw, s, [(0.41, 0.26), (0.45, 0.56), (0.7, 0.56), (0.8, 0.86)], 0.1)
    _stroke(draw, s, [(0.43, 0.38), (0.64, 0.38)], 0.07)
    box = [0.14 * s, 0.4 * s, 0.68 * s, 0.94 * s]
    draw.arc(box, 20, 235, 255, round(0.08 * s))
    _stroke(draw, s, [(0.8, 0.86), (0.88, 0.83)], 0.07)


def _running(draw: ImageDraw.ImageDraw, s: float) -> None:
    _disc(draw, s, 0.66, 0.14, 0.09)
    _stroke(draw, s, [(0.58, 0.3), (0.48, 0.54)], 0.16)
    _stroke(draw, s, [(0.58, 0.28), (0.38, 0.32), (0.28, 0.46)], 0.075)
    _stroke(draw, s, [(0.6, 0.3), (0.72, 0.46), (0.86, 0.42)], 0.075)
    _stroke(draw, s, [(0.47, 0.56), (0.64, 0.68), (0.6, 0.9)], 0.1)
    _stroke(draw, s, [(0.46, 0.55), (0.36, 0.74), (0.14, 0.78)], 0.1)


def _cross(draw: ImageDraw.ImageDraw, s: float) -> None:
    draw.rectangle([0.36 * s, 0.08 * s, 0.64 * s, 0.92 * s], 255)
    draw.rectangle([0.08 * s, 0.36 * s, 0.92 * s, 0.64 * s], 255)


def _heart(draw: ImageDraw.ImageDraw, s: float) -> None:
    _disc(draw, s, 0.3, 0.34, 0.22)
    _disc(draw, s, 0.7, 0.34, 0.22)
    _area(draw, s, [(0.1, 0.42), (0.9, 0.42), (0.5, 0.92)])
    bolt = [
        (0.55, 0.24),
        (0.36, 0.54),
        (0.49, 0.54),
        (0.43, 0.78),
        (0.66, 0.45),
        (0.53, 0.45),
    ]
    draw.polygon([(x * s, y * s) for x, y in bolt], 0)


def _stroller(draw: ImageDraw.ImageDraw, s: float) -> None:
    draw.pieslice([0.14 * s, 0.14 * s, 0.74 * s, 0.74 * s], 0, 270, 255)
    _stroke(draw, s, [(0.72, 0.44), (0.9, 0.22)], 0.07)
    _disc(draw, s, 0.28, 0.84, 0.09)
    _disc(draw, s, 0.62, 0.84, 0.09)


def _flame(draw: ImageDraw.ImageDraw, s: float) -> None:
    outline = [(0.5, 0.05), (0.7, 0.35), (0.8, 0.62), (0.7, 0.86), (0.5, 0.95)]
    outline += [(0.3, 0.86), (0.2, 0.62), (0.33, 0.42), (0.42, 0.52)]
    _area(draw, s, outline)


PENS: dict[Pictogram, Pen] = {
    "woman": _woman,
    "man": _man,
    "wheelchair": _wheelchair,
    "running": _running,
    "cross": _cross,
    "heart": _heart,
    "stroller": _stroller,
    "flame": _flame,
}
