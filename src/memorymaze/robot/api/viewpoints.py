"""A robot that goes from viewpoint to viewpoint of a navigation graph.

NavGPT is made for such a robot, as in Room-to-Room (R2R): it sees all round at each
viewpoint and may go to the ones next to it. It is a role of its own and no part of
`Robot`: agents that are given a `Robot` cannot reach a graph through it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

EIGHT_DIRECTIONS = 8
"""Directions of a look around: north first, then clockwise, 45 degrees apart."""

JourneyEnd = Literal["arrived", "blocked", "not_adjacent", "unknown"]
"""How a wish to go somewhere ended; the last two are refused, without motion."""


@dataclass(frozen=True, slots=True)
class WayOn:
    """A viewpoint one can go to from here, in a straight line."""

    viewpoint: str
    """Its id: 32 hexadecimal digits, which tell nothing."""
    heading: float
    """Radians counter-clockwise from east, in (-pi, pi]."""
    distance: float
    """Metres."""


@dataclass(frozen=True, slots=True)
class SeenThing:
    """A thing seen from a viewpoint."""

    name: str
    """What it is, in a few words; several things may have the same."""
    heading: float
    """Of its middle, radians counter-clockwise from east, in (-pi, pi]."""
    distance: float
    """Metres to the nearest part seen of it."""


@dataclass(frozen=True, slots=True)
class Outlook:
    """What is seen in one of eight directions, 45 degrees wide."""

    heading: float
    """Of its middle, radians counter-clockwise from east, in (-pi, pi]."""
    scene: str
    """One sentence on what is seen."""
    things: tuple[SeenThing, ...]
    """Things within the robot's range of a few metres, the nearest first."""


@dataclass(frozen=True, slots=True)
class Panorama:
    """What is seen all round from a viewpoint."""

    outlooks: tuple[Outlook, ...]
    """Eight: north first, then clockwise."""
    summary: str
    """One sentence on the whole place, without directions."""
    described_by: str
    """What wrote the sentences: `templates`, or the name of a vision model."""


@dataclass(frozen=True, slots=True)
class Journey:
    """What came of a wish to go to a viewpoint."""

    end: JourneyEnd
    distance: float
    """Metres really driven, the way back from a blocked one too."""
    reason: str
    """What was in the way where it is `blocked`: `wall` or `obstacle`; else empty."""


class ViewpointRobot(Protocol):
    """A robot on a navigation graph; see the module.

    Every call may raise `EpisodeOver` once the episode is over; an agent lets it pass
    through.
    """

    @property
    def viewpoint(self) -> str:
        """Id of the viewpoint where the robot is."""
        ...

    @property
    def start_heading(self) -> float:
        """The way the robot faced when the episode began, radians as in `Pose`."""
        ...

    def ways_on(self) -> Sequence[WayOn]:
        """Return the viewpoints one can go to from here."""
        ...

    def look_around(self) -> Panorama:
        """Return what is seen from here."""
        ...

    def go_to(self, viewpoint: str) -> Journey:
        """Drive to a viewpoint next to this one.

        Where something blocks the way, the robot drives back to where it came from.
        An id that is not next to this viewpoint, or none of the graph, is refused.

        Raises:
            EpisodeOver: A budget ran out on the way.
        """
        ...
