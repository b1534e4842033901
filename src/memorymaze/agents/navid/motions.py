"""What a policy may answer: a stop, or up to three primitive motions of one kind."""

from dataclasses import dataclass
from typing import Literal

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


STANDARD_MOTIONS = Motions()
"""25 cm and 30 degrees, as the released model was trained."""


@dataclass(frozen=True, slots=True)
class Command:
    """One answer: a motion, several times over."""

    motion: Motion
    count: int = 1
    """Primitives, from 1; 1 for `stop`."""
