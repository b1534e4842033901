"""The ways out of a crossing, as one who comes in by a heading tells them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from memorymaze.basics.geometry.pose import wrap_angle

FORWARD, SLIGHT, BACK = math.radians(15), math.radians(60), math.radians(160)


@dataclass(frozen=True)
class Choices:
    """The ways out of a crossing, seen by someone who comes in by a heading."""

    ways: tuple[tuple[int, float], ...]
    """Index of the exit and its angle, radians, left positive; without the way back."""

    @cached_property
    def forward(self) -> tuple[int, float] | None:
        """The way that goes on, if one does."""
        best = min(self.ways, key=lambda way: abs(way[1]), default=None)
        return best if best is not None and abs(best[1]) <= SLIGHT else None

    def on(self, side: str) -> list[tuple[int, float]]:
        """The ways to a side; slanted ones count when there is another way on."""
        sign = 1 if side == "left" else -1
        ahead = self.forward
        return [
            way
            for way in self.ways
            if way[1] * sign > FORWARD
            and (abs(way[1]) > SLIGHT or (ahead is not None and way is not ahead))
        ]


def choices_at(exits: Sequence[float], closed: set[int], heading: float) -> Choices:
    """Return the ways out of a crossing for someone who arrives with a heading."""
    return Choices(
        tuple(
            (index, angle)
            for index, each in enumerate(exits)
            if index not in closed and abs(angle := wrap_angle(each - heading)) <= BACK
        )
    )
