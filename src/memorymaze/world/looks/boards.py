"""Pictures of signs: words, arrows and pictograms on a ground."""

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Literal

import numpy as np
from PIL import Image, ImageDraw

from memorymaze.basics.signposts import Arrow, Signpost, signposts
from memorymaze.world.looks.lettering import Field, write
from memorymaze.world.looks.materials import (
    PURE_WHITE,
    SAFETY_GREEN,
    Pixels,
    Rgb,
    ink_on,
    mixed,
    rgb255,
)

PIXELS_PER_METRE = 300
SMALLEST_PICTURE, LARGEST_PICTURE = 128, 512
"""Pixels of the longer side."""
Pictogram = Literal[
    "woman", "man", "wheelchair", "running", "cross", "heart", "stroller", "flame"
]
PICTOGRAMS: dict[str, tuple[Pictogram, ...]] = {
    "wheelchair": ("wheelchair",),
    "accessible": ("wheelchair",),
    "women": ("woman",),
    "ladies": ("woman",),
    "men": ("man",),
    "gentlemen": ("man",),
    "restroom": ("woman", "man"),
    "first aid": ("cross",),
    "first aid room": ("cross",),
    "stroller": ("stroller",),
    "baby care": ("stroller",),
    "nursing": ("woman", "stroller"),
    "nursing room": ("woman", "stroller"),
}
"""Words that stand under pictograms."""
FINER = 4
"""Pictograms are drawn larger by this factor, then reduced, for smooth edges."""
_Point = tuple[float, float]
Pen = Callable[[ImageDraw.ImageDraw, float], None]
"""Draws in white into a square of so many pixels."""
QUARTER_TURNS: dict[Arrow, int] = {"ahead": 0, "left": 1, "back": 2, "right": 3}
ARROW: list[_Point] = [
    (0.5, 0.04), (0.94, 0.48), (0.78, 0.64), (0.62, 0.48), (0.62, 0.96),
    (0.38, 0.96), (0.38, 0.48), (0.22, 0.64), (0.06, 0.48)
]  # fmt: skip


def blank(width: float, height: float, ground: Rgb) -> Image.Image:
    """Return an empty picture for a surface of this size in metres."""
    longer = max(width, height)
    pixels = min(max(PIXELS_PER_METRE * longer, SMALLEST_PICTURE), LARGEST_PICTURE)
    scale = pixels / longer
    size = (max(8, round(width * scale)), max(8, round(height * scale)))
    return Image.new("RGB", size, rgb255(ground))


def graded(size: tuple[int, int], top: Rgb, bottom: Rgb) -> Image.Image:
    """Return a picture whose colour goes evenly over into another one downwards."""
    w, h = size
    rows = np.linspace(0, 1, h)[:, None, None]
    column = 255 * (np.array(top) * (1 - rows) + np.array(bottom) * rows)
    return Image.fromarray(column.astype(np.uint8)).resize((w, h))


def whole(image: Image.Image) -> Field:
    """Return the field that is all of a picture."""
    return Field(0, 0, image.width, image.height)


def pixels_of(image: Image.Image) -> Pixels:
    """Return an array that a material can show; read-only."""
    pixels = np.array(image, dtype=np.uint8)
    pixels.flags.writeable = False
    return pixels


@cache
def sign_board(
    width: float, height: float, text: str, ground: Rgb, *, framed: bool = False
) -> Pixels:
    """Return the picture of a sign with its words, and arrows where they point.

    Its words are black or white, whatever shows on the ground's colour.
    """
    image = blank(width, height, ground)
    ink = ink_on(ground)
    field = whole(image).inset(0.07)
    if framed:
        line = max(2, min(image.size) // 40)
        ImageDraw.Draw(image).rectangle(
            [2 * line, 2 * line, image.width - 2 * line, image.height - 2 * line],
            outline=rgb255(ink),
            width=line,
        )
        field = whole(image).inset(5.5 * line / min(image.size))
    posts = signposts(text)
    for part, post in zip(_shares(field, posts), posts, strict=True):
        _draw_post(image, part, post, ink)
    if len(posts) > 1:
        _rule_between(image, _shares(field, posts), mixed(ground, ink, 0.5))
    return pixels_of(image)


@cache
def blank_board(width: float, height: float, ground: Rgb) -> Pixels:
    """Return the back of a sign: bands of colour, no words, nothing that reads like one."""
    image = blank(width, height, ground)
    draw = ImageDraw.Draw(image)
    ink = ink_on(ground)
    w, h = image.size
    for top, bottom, share in (
        (0.06, 0.14, 0.35),
        (0.32, 0.68, 0.14),
        (0.86, 0.94, 0.35),
    ):
        tone = rgb255(mixed(ground, ink, share))
        draw.rectangle([0, top * h, w, bottom * h], tone)
    return pixels_of(image)


@cache
def exit_board(width: float, height: float, text: str) -> Pixels:
    """Return an emergency exit sign with its running man and words."""
    image = blank(width, height, SAFETY_GREEN)
    field = whole(image).inset(0.08)
    if width > 1.2 * height:
        side = field.height
        man = Field(field.left, field.top, field.left + side, field.bottom)
        words = Field(man.right + 0.06 * side, field.top, field.right, field.bottom)
    else:
        middle = field.top + 0.6 * field.height
        man = Field(field.left, field.top, field.right, middle)
        words = Field(field.left, middle, field.right, field.bottom)
    draw_pictogram(image, man, "running", PURE_WHITE)
    for part, post in zip(
        _shares(words, signposts(text)), signposts(text), strict=True
    ):
        _draw_post(image, part, post, PURE_WHITE)
    return pixels_of(image)


@cache
def pictogram_board(
    width: float,
    height: float,
    text: str,
    pictograms: tuple[Pictogram, ...],
    ground: Rgb,
) -> Pixels:
    """Return a sign of pictograms side by side over its words."""
    image = blank(width, height, ground)
    ink = ink_on(ground)
    field = whole(image).inset(0.06)
    share = 0.68 if text.strip() else 1.0
    middle = field.top + share * field.height
    step = field.width / len(pictograms)
    for place, pictogram in enumerate(pictograms):
        left = field.left + place * step
        draw_pictogram(
            image, Field(left, field.top, left + step, middle), pictogram, ink
        )
    write(
        image,
        Field(field.left, middle + 0.02 * field.height, field.right, field.bottom),
        text,
        ink,
        most_lines=2,
    )
    return pixels_of(image)


def _shares(field: Field, posts: tuple[Signpost, ...]) -> list[Field]:
    """Divide a field among the parts of a sign: side by side where it is broad."""
    if field.width > 2.2 * field.height:
        weights = [max(4.0, len(post.words)) ** 0.7 + 1.5 for post in posts]
        ends = field.left + np.cumsum([0.0, *weights]) / sum(weights) * field.width
        return [
            Field(left + 2, field.top, right - 2, field.bottom)
            for left, right in pairwise(ends)
        ]
    step = field.height / len(posts)
    return [
        Field(
            field.left,
            field.top + place * step + 1,
            field.right,
            field.top + (place + 1) * step - 1,
        )
        for place in range(len(posts))
    ]


def _draw_post(image: Image.Image, field: Field, post: Signpost, ink: Rgb) -> None:
    if post.arrow is None:
        write(image, field, post.words, ink)
        return
    side = min(field.height, 0.24 * field.width)
    if post.arrow_first:
        arrow = Field(field.left, field.top, field.left + side, field.bottom)
        words = Field(arrow.right + 0.12 * side, field.top, field.right, field.bottom)
    else:
        arrow = Field(field.right - side, field.top, field.right, field.bottom)
        words = Field(field.left, field.top, arrow.left - 0.12 * side, field.bottom)
    draw_arrow(image, arrow.inset(0.04), post.arrow, ink)
    write(image, words, post.words, ink, align=0.0 if post.arrow_first else 1.0)


def _rule_between(image: Image.Image, fields: list[Field], colour: Rgb) -> None:
    draw = ImageDraw.Draw(image)
    for before, after in pairwise(fields):
        if after.left > before.left:
            x = (before.right + after.left) / 2
            draw.line([x, before.top, x, before.bottom], rgb255(colour), 2)
        else:
            y = (before.bottom + after.top) / 2
            draw.line([before.left, y, before.right, y], rgb255(colour), 2)


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
    draw: ImageDraw.ImageDraw, s: float, points: list[_Point], width: float
) -> None:
    draw.line([(x * s, y * s) for x, y in points], 255, round(width * s), "curve")
    for x, y in points:
        _disc(draw, s, x, y, width / 2)


def _area(draw: ImageDraw.ImageDraw, s: float, points: list[_Point]) -> None:
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
