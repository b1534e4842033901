"""What a recipe says of a floor: streets, halls, and ways across halls.

All else - rooms, doors, signs, things, routes - is made from this.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from shapely import Polygon
from shapely.affinity import affine_transform

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose

Sides = Literal["both", "left", "right", "none"]
MIRRORED: dict[Sides, Sides] = {"left": "right", "right": "left"}


class UnsuitableFloor(Exception):
    """A drawn floor breaks a rule; draw another."""


@dataclass(frozen=True)
class Street:
    """A corridor, straight or bent, with what lies along it."""

    points: tuple[XY, ...]
    """Its middle line; a loop ends where it starts."""
    width: float
    program: str
    """What rooms and things lie along it: a key of the kind's programs."""
    zone: int
    """Wing or building it belongs to, from 0; the hundreds of its room numbers."""
    name: str | None = None
    rooms: Sides = "both"
    """Which sides of it have rooms, seen along the line."""
    signed: bool = True
    """Whether signs hang where it meets others."""

    @property
    def is_loop(self) -> bool:
        """Whether it ends where it starts."""
        return self.points[0] == self.points[-1]


@dataclass(frozen=True)
class MadeHall:
    """Open floor over or beside streets; its holes are blocks one walks around."""

    polygon: Polygon
    name: str
    program: str
    zone: int
    open_air: bool = False


@dataclass(frozen=True)
class Across:
    """A way across a hall where no corridor leads."""

    points: tuple[XY, ...]
    hall: str
    """Name of the hall."""


@dataclass
class Layout:
    """A floor as a recipe draws it."""

    streets: list[Street] = field(default_factory=list[Street])
    halls: list[MadeHall] = field(default_factory=list[MadeHall])
    ways_across: list[Across] = field(default_factory=list[Across])
    entrances: list[tuple[XY, str]] = field(default_factory=list[tuple[XY, str]])
    """Ends of streets that lead outside, with what they are called."""

    def street(
        self,
        points: Sequence[XY],
        width: float,
        program: str,
        zone: int,
        name: str | None = None,
        *,
        rooms: Sides = "both",
        signed: bool = True,
    ) -> None:
        """Add a street."""
        self.streets.append(
            Street(tuple(points), width, program, zone, name, rooms, signed)
        )

    def hall(
        self,
        polygon: Polygon,
        name: str,
        program: str,
        zone: int,
        across: Sequence[Sequence[XY]] = (),
        *,
        open_air: bool = False,
    ) -> None:
        """Add a hall and the ways across it."""
        self.halls.append(MadeHall(polygon, name, program, zone, open_air))
        self.ways_across += [Across(tuple(points), name) for points in across]

    def turned(self, quarters: int, *, mirrored: bool) -> "Layout":
        """Return the floor mirrored, or not, and turned by quarters to the left."""
        cosine, sine = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters]
        flip = -1 if mirrored else 1
        matrix = (cosine, -sine * flip, sine, cosine * flip, 0, 0)

        def moved(place: XY) -> XY:
            return (
                matrix[0] * place[0] + matrix[1] * place[1] + 0.0,
                matrix[2] * place[0] + matrix[3] * place[1] + 0.0,
            )

        streets = [
            replace(
                each,
                points=tuple(map(moved, each.points)),
                rooms=MIRRORED.get(each.rooms, each.rooms) if mirrored else each.rooms,
            )
            for each in self.streets
        ]
        halls = [
            replace(each, polygon=affine_transform(each.polygon, matrix))
            for each in self.halls
        ]
        ways_across = [
            replace(each, points=tuple(map(moved, each.points)))
            for each in self.ways_across
        ]
        entrances = [(moved(place), name) for place, name in self.entrances]
        return Layout(streets, halls, ways_across, entrances)


@dataclass(frozen=True)
class WingFrame:
    """A place and a heading that a wing is drawn in."""

    origin: XY = (0.0, 0.0)
    heading_deg: float = 0.0

    def at(self, ahead: float, left: float = 0.0) -> XY:
        """Return the place so many metres ahead and to the left."""
        x, y = Pose(*self.origin, math.radians(self.heading_deg)).at(ahead, left)
        return round(x, 3), round(y, 3)

    def line(self, *places: XY) -> tuple[XY, ...]:
        """Return places of this frame as places of the floor."""
        return tuple(self.at(*place) for place in places)

    def box(self, ahead: float, right: float, end: float, left: float) -> Polygon:
        """Return the rectangle between two corners."""
        return Polygon(
            self.line((ahead, right), (end, right), (end, left), (ahead, left))
        )

    def octagon(
        self, ahead: float, right: float, end: float, left: float, cut: float
    ) -> Polygon:
        """Return the rectangle between two corners with its corners cut off."""
        return Polygon(
            self.line(
                (ahead + cut, right),
                (end - cut, right),
                (end, right + cut),
                (end, left - cut),
                (end - cut, left),
                (ahead + cut, left),
                (ahead, left - cut),
                (ahead, right + cut),
            )
        )

    def moved(self, ahead: float, left: float, turn_deg: float = 0.0) -> "WingFrame":
        """Return the frame so many metres ahead and to the left, turned."""
        return WingFrame(self.at(ahead, left), self.heading_deg + turn_deg)
