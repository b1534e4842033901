"""Placing labels on a drawing so that none covers another."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path
from numpy.typing import NDArray

Box = tuple[float, float, float, float]
"""West, south, east, north; metres on the plan."""


LINE_HEIGHT = 1.3
"""Of a line of text, as a multiple of the font size."""
HINTING = 1.08
"""Small letters in pictures are wider than their outlines by up to this factor."""


@dataclass(frozen=True, slots=True)
class PlacedLabel:
    """A label and where its middle goes."""

    text: str
    x: float
    """Metres on the plan."""
    y: float
    """Metres on the plan."""
    font_size: float
    """Points."""
    angle: float = 0.0
    """Radians counter-clockwise that the line of writing is turned by."""


class LabelSpace:
    """The boxes that labels have taken."""

    def __init__(self, metres_per_point: float) -> None:
        """Take no box yet; a point is 1/72 inch of the drawing."""
        self.metres_per_point = metres_per_point
        self._boxes = np.empty((256, 4))
        self._count = 0

    def extent(self, text: str, font_size: float) -> tuple[float, float]:
        """Return width and height of a text of one or more lines, metres."""
        lines = text.split("\n")
        width = max(_width(line, font_size) for line in lines)
        height = LINE_HEIGHT * font_size * len(lines)
        return width * self.metres_per_point, height * self.metres_per_point

    def is_free(self, box: Box) -> bool:
        """Tell whether a box covers none of those taken."""
        west, south, east, north = self._boxes[: self._count].T
        return not np.any(
            (west < box[2]) & (east > box[0]) & (south < box[3]) & (north > box[1])
        )

    def take(self, box: Sequence[float]) -> None:
        """Keep later labels off a box: west, south, east, north; metres."""
        if self._count == len(self._boxes):
            self._boxes = np.concatenate([self._boxes, np.empty_like(self._boxes)])
        self._boxes[self._count] = box
        self._count += 1

    def inside(
        self,
        texts: Iterable[str],
        frames: Iterable[Box],
        font_sizes: Sequence[float],
    ) -> PlacedLabel | None:
        """Write a text in the middle of a frame that it fits into, as large as it fits.

        Args:
            texts: The same label in several line breaks, the best first.
            frames: Where it may go, the best first.
            font_sizes: Points, the largest first.
        """
        choices, places = list(texts), list(frames)
        for font_size in font_sizes:
            for text in choices:
                extent = self.extent(text, font_size)
                for frame in places:
                    for angle in (0.0, math.pi / 2):
                        wide, high = extent if angle == 0.0 else extent[::-1]
                        x, y = (frame[0] + frame[2]) / 2, (frame[1] + frame[3]) / 2
                        box = (x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)
                        fits = (
                            wide <= frame[2] - frame[0] and high <= frame[3] - frame[1]
                        )
                        if fits and self.is_free(box):
                            self.take(box)
                            return PlacedLabel(text, x, y, font_size, angle)
        return None

    def along(
        self,
        text: str,
        middles: Iterable[tuple[float, float]],
        angle: float,
        font_size: float,
    ) -> PlacedLabel | None:
        """Write a line along a slant, its middle at the first place that is free."""
        length, height = self.extent(text, font_size)
        count = max(1, math.ceil(length / height))
        steps = (np.arange(count) + 0.5) / count * length - length / 2
        for x, y in middles:
            boxes = [
                (
                    east - height / 2,
                    north - height / 2,
                    east + height / 2,
                    north + height / 2,
                )
                for east, north in zip(
                    x + steps * math.cos(angle),
                    y + steps * math.sin(angle),
                    strict=True,
                )
            ]
            if all(self.is_free(box) for box in boxes):
                for box in boxes:
                    self.take(box)
                return PlacedLabel(text, x, y, font_size, angle)
        return None

    def beside(
        self, text: str, thing: Box, font_size: float, sheet: Box
    ) -> PlacedLabel | None:
        """Write a text beside a thing, or give up."""
        wide, high = self.extent(text, font_size)
        gap = 2 * self.metres_per_point
        for x, y in _spots_around(thing, wide, high, gap):
            box = (x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)
            on_sheet = (
                box[0] >= sheet[0]
                and box[1] >= sheet[1]
                and box[2] <= sheet[2]
                and box[3] <= sheet[3]
            )
            if on_sheet and self.is_free(box):
                self.take(box)
                return PlacedLabel(text, x, y, font_size)
        return None


def wrapped(text: str) -> list[str]:
    r"""Return a text on one line, then broken into ever more lines between words.

    >>> wrapped("Room for rent")
    ['Room for rent', 'Room for\nrent', 'Room\nfor\nrent']
    """
    words = text.split()
    versions: list[str] = []
    for width in range(len(text), 0, -1):
        lines: list[str] = []
        for word in words:
            if lines and len(lines[-1]) + 1 + len(word) <= width:
                lines[-1] += " " + word
            else:
                lines.append(word)
        version = "\n".join(lines)
        if version not in versions:
            versions.append(version)
    return versions


@lru_cache(maxsize=10_000)
def _width(line: str, font_size: float) -> float:
    """Return the width of a line of text, points."""
    font = FontProperties(size=font_size)
    width = text_to_path.get_text_width_height_descent(line, font, ismath=False)[0]
    return width * HINTING


def _spots_around(
    thing: Box, width: float, height: float, gap: float
) -> list[tuple[float, float]]:
    """Return middles for a label beside a thing, roughly the nearest ones first."""
    west, south, east, north = thing
    middle = np.array([(west + east) / 2, (south + north) / 2])
    reach = np.array([(east - west + width) / 2, (north - south + height) / 2])
    sides: NDArray[np.float64] = np.array(
        [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)],
        dtype=np.float64,
    )
    spots: list[tuple[float, float]] = []
    for extra in (gap, gap + height, gap + 2.5 * height):
        for slide in (0.0, 0.5, -0.5):
            for side in sides[:4]:
                along = side[::-1] * np.array([width, height]) * slide
                spot = middle + side * (reach + extra) + along
                spots.append((float(spot[0]), float(spot[1])))
        for side in sides[4:]:
            spot = middle + side * (reach + extra / 2)
            spots.append((float(spot[0]), float(spot[1])))
    return spots
