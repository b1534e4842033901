"""The walls of a floor as straight pieces, and what of them is still free."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

from shapely import LineString, Point, Polygon
from shapely.geometry.polygon import orient

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose, heading_to
from memorymaze.world.construction.floor import MadeFloor

SHORTEST_WALL = 0.8
"""Metres of wall that are worth furnishing."""


@dataclass
class MadeWall:
    """A straight piece of wall with floor on its left, from start to end."""

    start: XY
    end: XY
    street: int | None
    """Number of the street it bounds; None for a hall's wall."""
    hall: int | None
    """Number of the hall it bounds; None for a street's wall."""
    program: str
    zone: int
    taken: list[tuple[float, float]] = field(default_factory=list[tuple[float, float]])
    """Stretches with doors and things, metres from the start."""

    @property
    def length(self) -> float:
        """Metres."""
        return math.dist(self.start, self.end)

    @property
    def heading(self) -> float:
        """Radians, along the wall."""
        return heading_to(self.start, self.end)

    @property
    def facing(self) -> float:
        """Radians, from the wall to the floor."""
        return self.heading + math.pi / 2

    def at(self, along: float, before: float = 0.0) -> XY:
        """Return the place so many metres along it and before it, on the floor."""
        return Pose(*self.start, self.heading).at(along, before)

    def strip(self, start: float, end: float, near: float, far: float) -> Polygon:
        """Return the rectangle along a stretch of it; negative depths lie behind."""
        return Polygon([
            self.at(start, near),
            self.at(end, near),
            self.at(end, far),
            self.at(start, far),
        ])

    def is_free(self, start: float, end: float) -> bool:
        """Return whether nothing is on a stretch of it yet."""
        return (
            start >= 0.0
            and end <= self.length
            and all(end <= low or start >= high for low, high in self.taken)
        )

    def take(self, start: float, end: float) -> None:
        """Note that something is on a stretch of it."""
        self.taken.append((start, end))


def walls_of(floor: MadeFloor) -> list[MadeWall]:
    """Return all walls, round the outside first."""
    outline = orient(floor.walkable)
    rings = [outline.exterior, *outline.interiors]
    return [
        wall
        for ring in rings
        for wall in _walls_of_ring(floor, [(x, y) for x, y, *_ in ring.coords])
    ]


def _walls_of_ring(floor: MadeFloor, ring: list[XY]) -> Iterator[MadeWall]:
    for start, end in pairwise(ring):
        if math.dist(start, end) < SHORTEST_WALL:
            continue
        middle = Point((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        hall = _hall_at(floor, middle)
        street = None if hall is not None else _street_at(floor, middle)
        if hall is not None:
            bounded = floor.layout.halls[hall]
            yield MadeWall(start, end, None, hall, bounded.program, bounded.zone)
        elif street is not None:
            along = floor.layout.streets[street]
            yield MadeWall(start, end, street, None, along.program, along.zone)


def _hall_at(floor: MadeFloor, place: Point) -> int | None:
    for number, polygon in enumerate(floor.halls):
        if polygon.boundary.distance(place) < 0.02:
            return number
    return None


def _street_at(floor: MadeFloor, place: Point) -> int | None:
    for (street, _), polygon in floor.corridors.items():
        if polygon.boundary.distance(place) < 0.02:
            return street
    return None


def end_wall(walls: list[MadeWall], place: XY) -> MadeWall | None:
    """Return the wall that closes a street at its end."""
    for wall in walls:
        line = LineString([wall.start, wall.end])
        if line.distance(Point(place)) < 0.05 and wall.is_free(
            wall.length / 2 - 0.2, wall.length / 2 + 0.2
        ):
            return wall
    return None
