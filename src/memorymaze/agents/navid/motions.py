"""What an agent that looks and moves is made of: primitive motions, and pictures of them."""

import hashlib
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.language.models.model import Picture

WIDTH, HEIGHT = 640, 480
"""Pixels of the pictures that a policy is shown."""
FIELD_OF_VIEW_DEG = 90.0


Motion = Literal["forward", "left", "right", "stop"]


@dataclass(frozen=True, slots=True)
class Motions:
    """The primitive motions, and how many of them one answer may ask for."""

    forward_m: float = 0.25
    """Metres of one primitive ahead."""
    turn_deg: int = 30
    """Degrees of one primitive turn."""
    most: int = 3
    """Primitives of one answer."""

    def amounts(self, motion: Motion) -> tuple[int, ...]:
        """Return what may be asked for: centimetres ahead, or degrees of a turn.

        >>> Motions().amounts("forward"), Motions(turn_deg=15).amounts("left")
        ((25, 50, 75), (15, 30, 45))
        """
        return tuple(self.unit(motion) * count for count in range(1, self.most + 1))

    def unit(self, motion: Motion) -> int:
        """Return the centimetres or degrees of one primitive."""
        return round(self.forward_m * 100) if motion == "forward" else self.turn_deg

    def count(self, motion: Motion, amount: float) -> int:
        """Return how many primitives an amount is: rounded down, `most` at most.

        >>> [Motions().count("left", degrees) for degrees in (13, 30, 45, 90, 360)]
        [0, 1, 1, 3, 3]
        """
        # A metre said as 0.75 is 75 cm, whatever floating point makes of it.
        return min(self.most, int((amount + 1e-6) // self.unit(motion)))


@dataclass(frozen=True, slots=True)
class Command:
    """One answer: a motion, several times over."""

    motion: Motion
    count: int = 1
    """Primitives, from 1; 1 for `stop`."""


@dataclass(frozen=True, eq=False)
class Frame:
    """One picture of the video, taken after a primitive motion."""

    step: int
    """Steps done before it; 0 for the picture at the start."""
    after: Motion | None
    """The primitive that led here; None at the start and where nothing was done."""
    rgb: NDArray[np.uint8]
    """Colours, (height, width, 3), first row at the top."""
    name: str
    """Differs for every place that other motions lead to, in every episode."""

    def jpeg(self, width: int = WIDTH) -> Picture:
        """Return it as a picture file in RGB order, made smaller if so wished."""
        image = Image.fromarray(self.rgb)
        if width != image.width:
            height = round(image.height * width / image.width)
            image = image.resize((width, height), Image.Resampling.LANCZOS)
        name = f"{self.name}-{width}"
        return Picture.of_pixels(np.asarray(image), name)


def frame_name(episode: str, before: str, motion: str) -> str:
    """Return the name of the picture after a motion, from the name before it.

    `before` names the picture before the motion; it is empty at the start.
    """
    return hashlib.sha256(f"{episode}|{before}|{motion}".encode()).hexdigest()[:24]
