"""The ways out of a turning point, and the shape that they make.

The rule of exits, the plan editor, made floors and imported ones take them from here; in
words they stand in `docs/buildings.md`.
"""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import moved, turn_between, wrap_angle
from memorymaze.world.sites.records import Exit
from memorymaze.world.sites.route_rules import STRAIGHT_ON

SAME_EXIT = math.radians(20)
"""Exits closer than this cannot be told apart."""
TOUCH = 0.01
"""Metres that may lie between a turning point and what its exit leads to."""
OPEN_REACH = 4.0
"""Metres of open floor that make a direction one can leave in."""
OPEN_APART = 1.0
"""Radians at least between a direction into the open and any other way out."""
SHAPES = ("dead_end", "corner", "t_junction", "crossing")
"""By the number of exits; more are a crossing too."""


class FloorShapes(NamedTuple):
    """What a turning point can lead to by ids, the kinds in the order in which they count."""

    corridors: Mapping[str, Polygon]
    areas: Mapping[str, Polygon]
    turning_points: Mapping[str, Polygon]


class Course(NamedTuple):
    """A way that may lead out of a turning point."""

    heading: float
    """Radians."""
    line: LineString
    """Where it goes, beyond the turning point too."""
    parts: FloorShapes
    """What it can lead into."""


def exits_along(
    courses: Iterable[Course],
    place: Polygon,
    floor: BaseGeometry,
    *,
    aside: Sequence[float] = (0.0,),
) -> Iterator[Exit]:
    """Yield the courses on which one can leave, each to what it leads into.

    Of those that cannot be told apart the first one counts. `aside` are turns, in
    radians, of which one may have to be taken to keep to the floor.
    """
    taken: list[Exit] = []
    for course in courses:
        to = _led_to(course.line.difference(place), _touching(place, course.parts))
        headings = (course.heading + each for each in aside)
        heading = next((h for h in headings if is_free(place, h, floor, TOUCH)), None)
        if (
            to is not None
            and heading is not None
            and all(_apart(heading, each) >= SAME_EXIT for each in taken)
        ):
            taken.append(Exit(to, wrap_angle(heading)))
            yield taken[-1]


def exits_into_the_open(
    course: float,
    place: Polygon,
    parts: FloorShapes,
    floor: BaseGeometry,
    found: Sequence[Exit],
) -> Iterator[Exit]:
    """Yield the ways into areas, square to a course, beside those that are found."""
    middle = _middle(place)
    reach = math.sqrt(place.area) / 2 + OPEN_REACH
    near = _touching(place, parts)
    taken = list(found)
    for quarter in range(1, 4):
        heading = course + quarter * math.pi / 2
        if any(_apart(heading, each) < OPEN_APART for each in taken):
            continue
        line = LineString([middle, moved(middle, heading, reach)])
        to = _led_to(line.difference(place), near)
        if to is not None and to in near.areas and floor.contains(line):
            taken.append(Exit(to, wrap_angle(heading)))
            yield taken[-1]


def shape_of(exits: Sequence[Exit], areas: Collection[str]) -> str:
    """Return the word of the format for a turning point; `areas` are ids."""
    if any(each.to in areas for each in exits):
        return "opening"
    if len(exits) == 2:
        bend = math.pi - _apart(exits[0].heading, exits[1])
        return "opening" if bend < STRAIGHT_ON else "corner"
    return SHAPES[min(len(exits), len(SHAPES)) - 1]


def is_free(
    place: Polygon,
    heading: float,
    floor: BaseGeometry,
    beyond: float = 0.0,
) -> bool:
    """Tell whether there is floor from the middle of a place to just beyond its edge."""
    middle = _middle(place)
    end = moved(middle, heading, exit_reach(place) + beyond)
    return floor.contains(LineString([middle, end]))


def exit_reach(place: Polygon) -> float:
    """Return how far from the middle of a turning point its exits must be free, metres."""
    return 0.75 * math.sqrt(place.area) + 0.8


def _touching(place: Polygon, parts: FloorShapes) -> FloorShapes:
    return FloorShapes(*(
        {name: part for name, part in kind.items() if part.distance(place) <= TOUCH}
        for kind in parts
    ))  # fmt: skip


def _led_to(beyond: BaseGeometry, parts: FloorShapes) -> str | None:
    """Return what most of a way lies in: a corridor before an area before others."""
    for kind in parts:
        shares = {
            identity: beyond.intersection(part).length
            for identity, part in kind.items()
        }
        if shares and max(shares.values()) > beyond.length / 3:
            return max(shares, key=lambda identity: shares[identity])
    return None


def _apart(heading: float, other: Exit) -> float:
    return abs(turn_between(heading, other.heading))


def _middle(place: Polygon) -> XY:
    middle = place.centroid
    return (middle.x, middle.y)
