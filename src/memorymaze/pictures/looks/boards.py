"""Pictures of signs: words, arrows and pictograms on a coloured ground."""

from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from memorymaze.pictures.looks.colours import Rgb, ink_on, mixed, rgb255
from memorymaze.pictures.looks.pictograms import (
    Pictogram,
    draw_arrow,
    draw_pictogram,
)
from memorymaze.simulation.senses.lettering import Field, write
from memorymaze.simulation.senses.signposts import Signpost, signposts

Pixels = NDArray[np.uint8]

PIXELS_PER_METRE = 300
SMALLEST_PICTURE, LARGEST_PICTURE = 128, 512
"""Pixels of the longer side."""
GREEN: Rgb = (0.0, 0.48, 0.24)
WHITE: Rgb = (1.0, 1.0, 1.0)


def blank(width: float, height: float, ground: Rgb) -> Image.Image:
    """Return an empty picture for a surface of this size in metres."""
    longer = max(width, height)
    pixels = min(max(PIXELS_PER_METRE * longer, SMALLEST_PICTURE), LARGEST_PICTURE)
    scale = pixels / longer
    size = (max(8, round(width * scale)), max(8, round(height * scale)))
    return Image.new("RGB", size, rgb255(ground))


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

    Args:
        width: Metres.
        height: Metres.
        text: What is written on it.
        ground: Colour behind the words, which are black or white.
        framed: With a line round it.
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
def exit_board(width: float, height: float, text: str, ground: Rgb = GREEN) -> Pixels:
    """Return an emergency exit sign with its running man and words."""
    image = blank(width, height, ground)
    field = whole(image).inset(0.08)
    if width > 1.2 * height:
        side = field.height
        man = Field(field.left, field.top, field.left + side, field.bottom)
        words = Field(man.right + 0.06 * side, field.top, field.right, field.bottom)
    else:
        middle = field.top + 0.6 * field.height
        man = Field(field.left, field.top, field.right, middle)
        words = Field(field.left, middle, field.right, field.bottom)
    draw_pictogram(image, man, "running", WHITE)
    for part, post in zip(
        _shares(words, signposts(text)), signposts(text), strict=True
    ):
        _draw_post(image, part, post, WHITE)
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
