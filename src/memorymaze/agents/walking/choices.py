"""The ways out of a crossing, as one who comes in by a heading tells them."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from memorymaze.agents.walking.floor_map import FloorMap
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


class KnownChoices(dict[tuple[int, float], Choices]):
    """The ways out of the crossings of a map, by crossing and heading to come in by."""

    def __init__(self, floor: FloorMap) -> None:
        """Take a map as it is; what is added to it later is not told."""
        super().__init__()
        self._floor = floor

    def __missing__(self, key: tuple[int, float]) -> Choices:
        """Work out the ways once; there are few headings to come in by."""
        at, heading = key
        crossing = self._floor.crossings[at]
        self[key] = choices_at(crossing.exits, crossing.closed, heading)
        return self[key]

    def halls(self) -> Iterator[list[tuple[int, int]]]:
        """Yield all ways out, those straight on from one together with it."""
        further: dict[tuple[int, int], tuple[int, int]] = {}
        for way, stretch in self._floor.stretches.items():
            ahead = self[stretch.end, stretch.arrival].forward
            if ahead is not None:
                further[way] = stretch.end, ahead[0]
        left = dict.fromkeys(self._floor.ways_out())
        led_to = set(further.values())
        # Where halls are a ring none begins anywhere.
        for begin in sorted(left, key=led_to.__contains__):
            hall: list[tuple[int, int]] = []
            way: tuple[int, int] | None = begin
            while way in left:
                hall.append(way)
                del left[way]
                way = further.get(way)
            if hall:
                yield hall
