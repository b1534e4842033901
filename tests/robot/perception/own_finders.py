"""Finders of objects of users' own for `--with detector=`."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.robot.perception import FoundBox

made: list["Middle"] = []
"""All that were made in this process."""


@dataclass(frozen=True)
class MiddleOptions:
    """What can be set."""

    score: float = 0.8
    """how sure it is"""
    broken: bool = False
    """whether it raises"""


class Middle:
    """Finds whatever it is asked for in the middle of the picture."""

    Options = MiddleOptions

    def __init__(self, options: MiddleOptions) -> None:
        self.options = options
        made.append(self)

    def find(self, rgb: NDArray[np.uint8], query: str) -> Sequence[FoundBox]:
        if self.options.broken:
            raise RuntimeError("out of memory")
        height, width, _ = rgb.shape
        # As models give them: numbers that are not Python's own.
        box: Any = np.array([width, height, 2 * width, 2 * height], np.float32) / 3
        return [FoundBox(box, query.strip() or "thing", np.float32(self.options.score))]


class Shares:
    """Gives boxes as shares of the picture."""

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        return [FoundBox((0.2, 0.2, 0.8, 0.8), "door", 0.9)]


class Tuples:
    """Gives no `FoundBox`."""

    def find(self, rgb: NDArray[np.uint8], query: str) -> Any:
        return [((1, 2, 3, 4), "door", 0.9)]


class Turned:
    """Gives boxes as left, top, width and height."""

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        return [FoundBox((60, 40, 20, 10), "door", 0.9)]


class Paints:
    """Paints over the picture."""

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        rgb[:] = 0
        return []


class Tires:
    """Is less sure each time it looks."""

    def __init__(self) -> None:
        self.looks = 0

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        self.looks += 1
        return [FoundBox((1, 1, 30, 30), "door", 1 / self.looks)]


class Blind:
    """Finds nothing."""

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        return []


class Gone:
    """Cannot be made."""

    def __init__(self) -> None:
        raise OSError("no weights")

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        raise NotImplementedError


class Mute:
    """Finds by no words."""

    def find(self, rgb: NDArray[np.uint8]) -> list[FoundBox]:
        return []
