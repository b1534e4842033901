"""Which turning point follows which on a site plan, and what stands near them.

This is the floor as a walker knows it who is told where to turn: no grid, no physics.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal, NamedTuple, cast

import numpy as np
from shapely import LineString, Point, Polygon, distance, get_parts
from shapely.ops import nearest_points, substring
from shapely.prepared import PreparedGeometry, prep

from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.texts.writing.things import Thing, things_of
from memorymaze.world.sites.records import Exit, Route, RouteTurn, Site, TurningPoint


class GraphWay(NamedTuple):
    """A way out of a turning point, up to the next one."""

    heading: float
    """Radians."""
    line: tuple[tuple[float, float], ...]
    """From where it leaves to where it ends, metres."""
    end: str | None
    """Turning point it leads to; None where it ends without one."""


def _carried_on(way: GraphWay, guess: GraphWay) -> GraphWay:
    """Return a route's last way with what lies beyond the goal."""
    start = way.line[0]
    goes_on = math.dist(start, guess.line[-1]) > math.dist(start, way.line[-1])
    if way.end is not None or not goes_on:
        return way
    return GraphWay(way.heading, (*way.line, guess.line[-1]), guess.end)


def _overlaps(line: LineString, polygon: Polygon) -> list[tuple[float, float]]:
    """Return the stretches of a line inside a polygon, metres along it."""
    spans = sorted(
        sorted(line.project(Point(end)) for end in (part.coords[0], part.coords[-1]))
        for part in get_parts(line.intersection(polygon))
        if isinstance(part, LineString) and part.length > 0.05
    )
    joined: list[tuple[float, float]] = []
    for start, end in spans:
        if joined and start - joined[-1][1] < 0.1:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((start, end))
    return joined


TurnSide = Literal["left", "right", "slight_left", "slight_right"]
"""Where a turn leads."""

STRAIGHT = math.radians(28)
"""A way that differs less from the walker's heading goes straight on."""
TURNING_BACK = math.radians(150)
"""A way that differs more goes back."""
SLIGHT = math.radians(12)
"""The least bend that is told as a slight turn."""
NEAR = 5.0
"""Metres from a turning point within which a thing marks it."""
RAY = 200.0
OFF_THE_FLOOR = 0.8
"""Metres that a thing may stand behind the rim of the floor."""


def side_of_turn(turn: RouteTurn) -> TurnSide:
    """Return where a route turns; the loader of sites admits no other direction."""
    return cast(TurnSide, turn.direction)


def side_of_angle(angle: float) -> Literal["left", "right"]:
    """Return which side a signed turn in radians goes: left or right."""
    return "left" if angle > 0 else "right"


def turn_angle(side: TurnSide) -> float:
    """Return the signed turn that a side stands for, radians."""
    angle = math.pi / 4 if side.startswith("slight") else math.pi / 2
    return angle if side.endswith("left") else -angle


@dataclass(frozen=True)
class TurningPointGraph:
    """A floor as turning points and the ways between them.

    The lines of routes count before what is guessed from the plan's polygons.
    """

    site: Site

    @cached_property
    def points(self) -> Mapping[str, TurningPoint]:
        """Turning points by id."""
        return {point.id: point for point in self.site.turning_points}

    @cached_property
    def things(self) -> tuple[Thing, ...]:
        """All that people could mention."""
        return things_of(self.site)

    @cached_property
    def things_by_words(self) -> Mapping[str, Thing]:
        """The first of the things that are called the same."""
        return {thing.words: thing for thing in reversed(self.things)}

    @cached_property
    def ways(self) -> Mapping[str, tuple[GraphWay, ...]]:
        """Ways out of each turning point."""
        guessed = {
            point.id: [self._way(point, leaving) for leaving in point.exits]
            for point in self.site.turning_points
        }
        for route in self.site.routes:
            for start, way in self.ways_along(route):
                if start is None:
                    continue
                known = guessed[start]
                same = [
                    index
                    for index, each in enumerate(known)
                    if abs(turn_between(each.heading, way.heading)) < STRAIGHT
                ]
                if same:
                    known[same[0]] = _carried_on(way, known[same[0]])
                else:
                    known.append(way)
        return {name: tuple(ways) for name, ways in guessed.items()}

    @cached_property
    def marks(self) -> Mapping[str, frozenset[str]]:
        """The words for things that stand near each turning point, in sight of it."""
        spots = [Point(thing.position) for thing in self.things]
        return {
            point.id: frozenset(
                self.things[index].words
                for index in np.flatnonzero(distance(point.polygon, spots) <= NEAR)
                if self.is_seen_from(point, self.things[index])
            )
            for point in self.site.turning_points
        }

    def is_seen_from(self, point: TurningPoint, thing: Thing) -> bool:
        """Tell whether a thing is near a turning point and to be seen from in it."""
        spot = Point(thing.position)
        if point.polygon.distance(spot) > NEAR:
            return False
        edge, _ = nearest_points(point.polygon, spot)
        return any(self.sees(eye, spot) for eye in (edge, point.polygon.centroid))

    def sees(self, eye: Point, spot: Point) -> bool:
        """Tell whether no wall lies between two places.

        The last of the way may lead off the floor: things stand in niches and on walls.
        """
        sight = LineString([eye, spot])
        if sight.length <= OFF_THE_FLOOR:
            return True
        return self.floor.contains(substring(sight, 0.0, sight.length - OFF_THE_FLOOR))

    @cached_property
    def floor(self) -> "PreparedGeometry[Polygon]":
        """The walkable floor and a little more, ready to be looked at often."""
        return prep(self.site.walkable_floor.buffer(0.05))

    @cached_property
    def passed(self) -> Mapping[str, tuple[tuple[float, str], ...]]:
        """The turning points on each route, by its id: metres along its line, and id."""
        return {
            route.id: tuple(
                sorted(
                    ((start + end) / 2, point.id)
                    for point in self.site.turning_points
                    for start, end in _overlaps(route.line, point.polygon)
                )
            )
            for route in self.site.routes
        }

    def first_way(self, route: Route, *, around: bool = False) -> GraphWay:
        """Return the way from a route's start, ahead or back."""
        if around:
            start = (route.start.x, route.start.y)
            return self._ray(start, route.start.heading + math.pi, None)
        return next(way for _, way in self.ways_along(route))

    def ways_along(self, route: Route) -> Iterator[tuple[str | None, GraphWay]]:
        """Yield the ways along a route: from its start, then from each turning point."""
        stops = [(0.0, None), *self.passed[route.id], (route.line.length, None)]
        for (start, name), (end, following) in pairwise(stops):
            if end - start < 0.05:
                if name is None and following is not None:
                    x, y = route.line.coords[0][:2]
                    yield (
                        None,
                        GraphWay(route.start_heading, ((x, y), (x, y)), following),
                    )
                continue
            piece = substring(route.line, start, end)
            line = tuple((float(x), float(y)) for x, y, *_ in piece.coords)
            # A turn's bend may lie beyond the middle of its polygon.
            longest = max(pairwise(line), key=lambda leg: math.dist(*leg))
            yield name, GraphWay(heading_to(*longest), line, following)

    def leaving(
        self, point: str, heading: float, side: TurnSide | None
    ) -> GraphWay | None:
        """Return the way that someone takes who comes with a heading, if one lies there.

        `side` is None for going straight on.
        """
        angles = [(turn_between(heading, w.heading), w) for w in self.ways[point]]
        if side is None:
            fitting = [(abs(a), w) for a, w in angles if abs(a) < STRAIGHT]
        else:
            wanted = turn_angle(side)
            least = SLIGHT if side.startswith("slight") else STRAIGHT
            fitting = [
                (abs(a - wanted), w)
                for a, w in angles
                if least <= abs(a) < TURNING_BACK and (a > 0) == (wanted > 0)
            ]
        return min(fitting, default=(0.0, None), key=lambda pair: pair[0])[1]

    def only_way(self, point: str, heading: float) -> GraphWay | None:
        """Return the way on where a turning point leaves no choice, else None."""
        onward = [
            way
            for way in self.ways[point]
            if abs(turn_between(heading, way.heading)) < TURNING_BACK
        ]
        return onward[0] if len(onward) == 1 else None

    def _way(self, point: TurningPoint, leaving: Exit) -> GraphWay:
        centre = self._middle(point.id)
        if leaving.to in self.points:
            line = (centre, self._middle(leaving.to))
            return GraphWay(leaving.heading, line, leaving.to)
        floor = self._floors.get(leaving.to)
        ahead: list[tuple[float, str]] = []
        for other in self.site.turning_points if floor is not None else ():
            if other.id == point.id or not other.polygon.intersects(floor):
                continue
            middle = self._middle(other.id)
            turn = turn_between(leaving.heading, heading_to(centre, middle))
            along = math.dist(centre, middle) * math.cos(turn)
            aside = abs(math.dist(centre, middle) * math.sin(turn))
            if along > 0.5 and aside < max(3.0, 0.35 * along):
                ahead.append((along, other.id))
        if not ahead:
            return self._ray(centre, leaving.heading, point.id)
        end = min(ahead)[1]
        return GraphWay(leaving.heading, (centre, self._middle(end)), end)

    def _middle(self, point: str) -> tuple[float, float]:
        centroid = self.points[point].polygon.centroid
        return centroid.x, centroid.y

    def _ray(
        self, start: tuple[float, float], heading: float, own: str | None
    ) -> GraphWay:
        """Walk straight on until a turning point or a wall."""
        x, y = start
        far = x + RAY * math.cos(heading), y + RAY * math.sin(heading)
        free = LineString([start, far]).intersection(self.site.walkable_floor)
        reach = [
            piece
            for piece in get_parts(free)
            if isinstance(piece, LineString)
            and piece.distance(Point(start)) < 0.1
            and piece.length > 0
        ]
        if not reach:
            return GraphWay(heading, (start, start), None)
        wall = max(reach[0].coords, key=lambda corner: math.dist(corner, start))
        line = LineString([start, wall])
        hits = [
            (span[0], other.id)
            for other in self.site.turning_points
            if other.id != own
            for span in _overlaps(line, other.polygon)
        ]
        if hits:
            end = min(hits)[1]
            return GraphWay(heading, (start, self._middle(end)), end)
        x, y = line.coords[-1][:2]
        return GraphWay(heading, (start, (x, y)), None)

    @cached_property
    def _floors(self) -> Mapping[str, Polygon]:
        return {
            part.id: part.polygon for part in (*self.site.corridors, *self.site.areas)
        }
