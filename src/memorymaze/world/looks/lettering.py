"""Words as pictures: as large as their field allows, never cut."""

from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import matplotlib
from PIL import Image, ImageDraw, ImageFont

REFERENCE_SIZE = 100
"""Pixels of the font in which widths are measured."""
SPACE = 35.0
"""Width of a space at the reference size, pixels."""
ABOVE, BELOW = 0.77, 0.23
"""How far letters rise over their line and hang below it, shares of the size."""
DESCENDING = frozenset("gjpqy,;()[]{}|/Q@_")
LINE_STEP = 1.04
"""Distance of two lines as a share of the font's size."""
NARROWEST = 0.78
"""Narrower than this, letters become hard to read; smaller ones are better."""
SMALLEST = 6
"""Pixels of font size below which letters are mere texture."""


class Field(NamedTuple):
    """A rectangle of a picture, pixels from its top left."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def width(self) -> float:
        """Pixels."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Pixels."""
        return self.bottom - self.top

    def inset(self, share: float) -> "Field":
        """Return it without a margin, a share of its shorter side."""
        margin = share * min(self.width, self.height)
        return Field(
            self.left + margin,
            self.top + margin,
            self.right - margin,
            self.bottom - margin,
        )


@dataclass(frozen=True, slots=True)
class Lines:
    """How words are set in a field."""

    words: tuple[str, ...]
    """One text per line."""
    size: int
    """Of the font, pixels."""
    squeeze: float
    """Width of the letters as a share of their natural one."""


@cache
def fitted(text: str, width: int, height: int, *, most_lines: int = 8) -> Lines:
    """Break a text where its letters become largest in a field of so many pixels.

    Line breaks in it are kept; each of its lines becomes at most `most_lines`.
    """
    best: Lines | None = None
    fixed = [line.split() for line in text.splitlines() if line.strip()]
    longest = max((len(words) for words in fixed), default=1)
    for count in range(1, min(most_lines, longest) + 1):
        lines = tuple(line for words in fixed for line in _broken(tuple(words), count))
        widest = max(_width(line) for line in lines) / REFERENCE_SIZE
        below = BELOW if DESCENDING & set(lines[-1]) else 0.0
        tall = height / (ABOVE + below + LINE_STEP * (len(lines) - 1))
        size = min(tall, width / (NARROWEST * widest))
        squeeze = min(1.0, width / (size * widest))
        setting = Lines(lines, max(SMALLEST, int(size)), squeeze)
        if best is None or _legibility(setting) > _legibility(best):
            best = setting
    return best or Lines(("",), SMALLEST, 1.0)


def write(
    image: Image.Image,
    field: Field,
    text: str,
    ink: tuple[float, float, float],
    *,
    align: float = 0.5,
    most_lines: int = 8,
) -> Field:
    """Write a text into a field of an RGB picture, as large as it fits; return where.

    Arrows are letters too. `align` is 0 left, 0.5 in the middle, 1 right; each line of
    the text becomes at most `most_lines`.
    """
    if not text.strip():
        return Field(field.left, field.top, field.left, field.top)
    width, height = max(1, int(field.width)), max(1, int(field.height))
    setting = fitted(text, width, height, most_lines=most_lines)
    size = min(setting.size, max(SMALLEST, height))
    font = _font(size)
    step = LINE_STEP * size
    boxes = [font.getbbox(line) for line in setting.words]
    ink_width = max(right - left for left, _, right, _ in boxes)
    tall = step * (len(boxes) - 1) + boxes[-1][3] - boxes[0][1]
    squeeze = min(setting.squeeze, width / max(ink_width, 1), 1.0)
    lift = min(1.0, height / max(tall, 1))
    mask = Image.new("L", (max(1, int(ink_width) + 2), max(1, int(tall) + 3)))
    pen = ImageDraw.Draw(mask)
    for row, (line, (left, _, right, _)) in enumerate(
        zip(setting.words, boxes, strict=True)
    ):
        free = ink_width - (right - left)
        pen.text(
            (1 + align * free - left, 1 + row * step - boxes[0][1]), line, 255, font
        )
    final = (
        max(1, min(width, round(mask.width * squeeze))),
        max(1, min(height, round(mask.height * lift))),
    )
    if final != mask.size:
        mask = mask.resize(final, Image.Resampling.BOX)
    x = int(field.left + align * (width - final[0]))
    y = int(field.top + (height - final[1]) / 2)
    image.paste(tuple(round(255 * part) for part in ink), (x, y), mask)
    return Field(x, y, x + final[0], y + final[1])


def _legibility(setting: Lines) -> float:
    return setting.size * (0.35 + 0.65 * setting.squeeze)


@cache
def _broken(words: tuple[str, ...], count: int) -> tuple[str, ...]:
    """Break words into so many lines, the widest as narrow as can be."""
    count = min(count, len(words))
    reach: dict[tuple[int, int], tuple[float, tuple[int, ...]]] = {(0, 0): (0.0, (0,))}
    for lines in range(1, count + 1):
        for end in range(lines, len(words) - (count - lines) + 1):
            reach[lines, end] = min(
                (
                    max(reach[lines - 1, start][0], _width(" ".join(words[start:end]))),
                    (*reach[lines - 1, start][1], end),
                )
                for start in range(lines - 1, end)
                if (lines - 1, start) in reach
            )
    cuts = reach[count, len(words)][1]
    return tuple(" ".join(words[start:end]) for start, end in pairwise(cuts))


def _width(line: str) -> float:
    """Return pixels at the reference size; spaces add up, kerning across them not."""
    words = line.split()
    return sum(map(_word_width, words)) + SPACE * (len(words) - 1)


@cache
def _word_width(word: str) -> float:
    return max(1.0, _font(REFERENCE_SIZE).getlength(word))


@cache
def _font(size: int) -> ImageFont.FreeTypeFont:
    path = Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans-Bold.ttf")
    return ImageFont.truetype(path, size, layout_engine=ImageFont.Layout.BASIC)
