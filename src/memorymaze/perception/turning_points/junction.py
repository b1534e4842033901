"""A turning point as many sightings of it tell, and what makes a place one."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from memorymaze.geometry.pose import turn_between
from memorymaze.perception.turning_points.ways import SensedWay, reach_along

BEND = math.radians(15)
"""A way that bends less goes straight on: alone it makes no turning point."""
SAME_WAY = math.radians(35)
"""Ways seen at less than this angle from each other are one."""
SAME_PLACE = 2.0
"""Metres between two sightings of one turning point."""
MEMORY = 0.9
"""Share of a sighting's weight that is left at the next sighting."""


@dataclass(slots=True)
class _Belief:
    """A way as the sightings so far tell it."""

    way: SensedWay
    weight: float


@dataclass(slots=True)
class Junction:
    """A turning point, or what may become one."""

    x: float
    """Of the place where its ways meet, metres."""
    y: float
    """Of that place, metres."""
    radius: float
    """Of the free circle there, metres."""
    weight: float = 0.0
    """Of all sightings, the older ones less."""
    beliefs: list[_Belief] = field(default_factory=list[_Belief])
    """Ways that were seen."""
    number: int | None = None
    """In the order of first stays; None before the first."""

    def ways(self) -> list[SensedWay]:
        """Return the ways that most sightings tell."""
        return [each.way for each in self.beliefs if each.weight > 0.5 * self.weight]

    def see(
        self,
        x: float,
        y: float,
        radius: float,
        ways: Sequence[SensedWay],
        weight: float,
    ) -> None:
        """Take note of a sighting.

        Args:
            x: Of the place where its ways meet, metres.
            y: Of that place, metres.
            radius: Of the free circle there, metres.
            ways: All that lead away.
            weight: Of this sighting; 1 for a good one.
        """
        kept = MEMORY**weight
        self.weight = self.weight * kept + weight
        share = weight / self.weight
        self.x += share * (x - self.x)
        self.y += share * (y - self.y)
        self.radius += share * (radius - self.radius)
        for each in self.beliefs:
            each.weight *= kept
        left = list(self.beliefs)
        for way in ways:
            same = min(
                left,
                key=lambda each: abs(turn_between(each.way.heading, way.heading)),
                default=None,
            )
            if (
                same is None
                or abs(turn_between(same.way.heading, way.heading)) > SAME_WAY
            ):
                self.beliefs.append(_Belief(way, weight))
                continue
            left.remove(same)
            same.weight += weight
            same.way = same.way.moved_towards(way, weight / same.weight)
        self.beliefs = [each for each in self.beliefs if each.weight > 0.05]

    def holds(self, x: float, y: float, margin: float) -> bool:
        """Whether a place lies where the ways' strips cross."""
        ways = self.ways()
        dx, dy = x - self.x, y - self.y
        if math.hypot(dx, dy) > SAME_PLACE + self.radius:
            return False
        return all(
            dx * math.cos(way.heading) + dy * math.sin(way.heading)
            <= reach_along(way, ways, self.radius) + margin
            for way in ways
        )


def is_turning_point(ways: Sequence[SensedWay]) -> bool:
    """Whether ways are more than one that leads straight on, and more than an end."""
    if len(ways) != 2:
        return len(ways) > 2
    bend = turn_between(ways[0].heading + math.pi, ways[1].heading)
    return abs(bend) > BEND


def is_worth_telling(onward: Sequence[SensedWay], back: SensedWay | None) -> bool:
    """Whether ways onward are more than none and more than straight on alone.

    Args:
        onward: Every way but the one the robot came by.
        back: The way it came by; None when there is none.
    """
    if not onward:
        return False
    if len(onward) > 1 or back is None:
        return True
    return abs(turn_between(back.heading + math.pi, onward[0].heading)) > BEND
