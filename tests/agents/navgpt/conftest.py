"""A corridor of viewpoints without a simulator, and replies that a model may give."""

import math
from collections.abc import Callable, Sequence

import pytest

from memorymaze.robot.api.viewpoints import (
    Journey,
    Outlook,
    Panorama,
    SeenThing,
    WayOn,
)

NORTH_TO_NORTH_WEST = tuple(math.pi / 2 - k * math.pi / 4 for k in range(8))


def panorama_of(
    things: dict[int, Sequence[SeenThing]] | None = None, summary: str = "A corridor."
) -> Panorama:
    """A look around with things in some of the eight directions."""
    seen = things or {}
    return Panorama(
        tuple(
            Outlook(heading, f"View {k}.", tuple(seen.get(k, ())))
            for k, heading in enumerate(NORTH_TO_NORTH_WEST)
        ),
        summary,
        "templates",
    )


class CorridorRobot:
    """Viewpoints 2 m apart from south to north, called 000…, 111…, 222…"""

    def __init__(self, count: int = 5, *, blocked: Sequence[str] = ()) -> None:
        self.ids = [str(k) * 32 for k in range(count)]
        self.place = 0
        self.blocked = blocked
        self.start_heading = math.pi / 2
        self.wishes: list[str] = []

    @property
    def viewpoint(self) -> str:
        return self.ids[self.place]

    def ways_on(self) -> list[WayOn]:
        near = [k for k in (self.place - 1, self.place + 1) if 0 <= k < len(self.ids)]
        return [
            WayOn(self.ids[k], math.copysign(math.pi / 2, k - self.place), 2.0)
            for k in near
        ]

    def look_around(self) -> Panorama:
        return panorama_of(summary=f"This is place {self.place}.")

    def go_to(self, viewpoint: str) -> Journey:
        self.wishes.append(viewpoint)
        if viewpoint not in self.ids:
            return Journey("unknown", 0.0, "")
        if viewpoint not in [way.viewpoint for way in self.ways_on()]:
            return Journey("not_adjacent", 0.0, "")
        if viewpoint in self.blocked:
            return Journey("blocked", 2.4, "obstacle")
        self.place = self.ids.index(viewpoint)
        return Journey("arrived", 2.0, "")


@pytest.fixture
def corridor() -> Callable[..., CorridorRobot]:
    """Make a robot at the south end of a corridor of viewpoints."""
    return CorridorRobot


@pytest.fixture
def go() -> Callable[[str], str]:
    """Make a reply that goes to a viewpoint."""
    return lambda viewpoint: (
        f'Thought: I go on.\nAction: go_to_viewpoint\nAction Input: "{viewpoint}"'
    )


@pytest.fixture
def look() -> Callable[..., Panorama]:
    """Make a look around."""
    return panorama_of
