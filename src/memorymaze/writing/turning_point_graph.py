"""Which turning point follows which on a site plan, and what stands near them.

This is the floor as a walker knows it who is told where to turn: no grid, no physics.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal, NamedTuple, cast

from shapely import LineString, Point, Polygon, get_parts
from shapely.ops import nearest_points, substring
from shapely.prepared import PreparedGeometry, prep

from memorymaze.errors import SitePlanError
from memorymaze.geometry.pose import heading_to, turn_between
from memorymaze.sites.records import Exit, Route, RouteTurn, Site, TurningPoint
from memorymaze.writing.things import Thing, things_of


class Way(NamedTuple):
    """A way out of a turning point, up to the next one."""

    heading: float
    """Radians."""
    line: tuple[tuple[float, float], ...]
    """From where it leaves to where it ends, metres."""
    end: str | None
    """Turning point it leads to; None where it ends without one."""


def carried_on(way: Way, guess: Way) -> Way:
    """Return a route's last way with what lies beyond the goal."""
    if way.end is not None:
        return way
    beyond = math.dist(way.line[0], guess.line[-1])
    if beyond <= math.dist(way.line[0], way.line[-1]):
        return way
    return Way(way.heading, (*way.line, guess.line[-1]), guess.end)


def overlaps(line: LineString, polygon: Polygon) -> list[tuple[float, float]]:
    """Return the stretches of a line inside a polygon, metres along it."""
    inside = line.intersection(polygon)
    parts = [inside] if isinstance(inside, LineString) else getattr(inside, "geoms", [])
    spans = sorted(
        tuple(
            sorted((
                line.project(Point(p.coords[0])),
                line.project(Point(p.coords[-1])),
            ))
        )
        for p in parts
        if isinstance(p, LineString) and p.length > 0.05
    )
    joined: list[tuple[float, float]] = []
    for start, end in spans:
        if joined and start - joined[-1][1] < 0.1:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((start, end))
    return joined


def route_ways(
    route: Route, passed: Sequence[tuple[float, str]]
) -> Iterator[tuple[str | None, Way]]:
    """Yield the ways along a route: from its start, then from each turning point."""
    stops = [(0.0, None), *passed, (route.line.length, None)]
    for (start, name), (end, following) in pairwise(stops):
        if end - start < 0.05:
            if name is None and following is not None:
                x, y = route.line.coords[0][:2]
                yield None, Way(route.start_heading, ((x, y), (x, y)), following)
            continue
        piece = substring(route.line, start, end)
        if not isinstance(piece, LineString):
            raise SitePlanError(f"route {route.id}: expected a line, got a point")
        line = tuple((float(x), float(y)) for x, y, *_ in piece.coords)
        # A turn's bend may lie beyond the middle of its polygon.
        longest = max(pairwise(line), key=lambda leg: math.dist(*leg))
        yield name, Way(heading_to(*longest), line, following)


Side = Literal["left", "right", "slight_left", "slight_right"]
"""Where a turn leads."""

STRAIGHT = math.radians(28)
"""A way that differs less from the walker's heading goes straight on."""
BACK = math.radians(150)
"""A way that differs more goes back."""
SLIGHT = math.radians(12)
"""The least bend that is told as a slight turn."""
NEAR = 5.0
"""Metres from a turning point within which a thing marks it."""
RAY = 200.0
OFF_THE_FLOOR = 0.8
"""Metres that a thing may stand behind the rim of the floor."""


def side_of_turn(turn: RouteTurn) -> Side:
    """Return where a route turns; the loader of sites admits no other direction."""
    return cast(Side, turn.direction)


def side_of(angle: float) -> Literal["left", "right"]:
    """Return which side a signed turn in radians goes: left or right."""
    return "left" if angle > 0 else "right"


def turn_angle(side: Side) -> float:
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
    def ways(self) -> Mapping[str, tuple[Way, ...]]:
        """Ways out of each turning point."""
        guessed = {
            point.id: [self._way(point, leaving) for leaving in point.exits]
            for point in self.site.turning_points
        }
        for route in self.site.routes:
            for start, way in route_ways(route, self.passed(route)):
                if start is None:
                    continue
                known = guessed[start]
                same = [
                    index
                    for index, each in enumerate(known)
                    if abs(turn_between(each.heading, way.heading)) < STRAIGHT
                ]
                if same:
                    known[same[0]] = carried_on(way, known[same[0]])
                else:
                    known.append(way)
        return {name: tuple(ways) for name, ways in guessed.items()}

    @cached_property
    def marks(self) -> Mapping[str, frozenset[str]]:
        """The words for things that stand near each turning point, in sight of it."""
        return {
            point.id: frozenset(
                thing.words for thing in self.things if self.is_seen_from(point, thing)
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
        return self._open.contains(substring(sight, 0.0, sight.length - OFF_THE_FLOOR))

    @cached_property
    def _open(self) -> "PreparedGeometry[Polygon]":
        return prep(self.site.walkable_floor.buffer(0.05))

    def passed(self, route: Route) -> tuple[tuple[float, str], ...]:
        """Return the turning points on a route, each with metres along its line."""
        known = self._passed.get(route.id)
        if known is None:
            known = self._passed[route.id] = self._find_passed(route)
        return known

    def _find_passed(self, route: Route) -> tuple[tuple[float, str], ...]:
        found: list[tuple[float, str]] = []
        for point in self.site.turning_points:
            for start, end in overlaps(route.line, point.polygon):
                found.append(((start + end) / 2, point.id))
        return tuple(sorted(found))

    def first_way(self, route: Route, *, around: bool = False) -> Way:
        """Return the way from a route's start, ahead or back."""
        known = self._first_ways.get((route.id, around))
        if known is None and around:
            start = (route.start.x, route.start.y)
            known = self._ray(start, route.start.heading + math.pi, None)
        elif known is None:
            known = next(way for _, way in route_ways(route, self.passed(route)))
        self._first_ways[route.id, around] = known
        return known

    def leaving(self, point: str, heading: float, side: Side | None) -> Way | None:
        """Return the way that someone takes who comes with a heading.

        Args:
            point: Turning point id.
            heading: Radians, before the turn.
            side: Where to turn; None to go straight on.

        Returns:
            None where no way lies there.
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
                if least <= abs(a) < BACK and (a > 0) == (wanted > 0)
            ]
        return min(fitting, default=(0.0, None), key=lambda pair: pair[0])[1]

    def only_way(self, point: str, heading: float) -> Way | None:
        """Return the way on where a turning point leaves no choice, else None."""
        onward = [
            way
            for way in self.ways[point]
            if abs(turn_between(heading, way.heading)) < BACK
        ]
        return onward[0] if len(onward) == 1 else None

    def _way(self, point: TurningPoint, leaving: Exit) -> Way:
        centre = (point.polygon.centroid.x, point.polygon.centroid.y)
        graph = self._floors.get(leaving.to)
        if leaving.to in self.points:
            end = self.points[leaving.to].polygon.centroid
            return Way(leaving.heading, (centre, (end.x, end.y)), leaving.to)
        ahead: list[tuple[float, str]] = []
        for other in self.site.turning_points if graph is not None else ():
            if other.id == point.id or not other.polygon.intersects(graph):
                continue
            middle = (other.polygon.centroid.x, other.polygon.centroid.y)
            turn = turn_between(leaving.heading, heading_to(centre, middle))
            along = math.dist(centre, middle) * math.cos(turn)
            aside = abs(math.dist(centre, middle) * math.sin(turn))
            if along > 0.5 and aside < max(3.0, 0.35 * along):
                ahead.append((along, other.id))
        if not ahead:
            return self._ray(centre, leaving.heading, point.id)
        end = self.points[min(ahead)[1]].polygon.centroid
        return Way(leaving.heading, (centre, (end.x, end.y)), min(ahead)[1])

    def _ray(self, start: tuple[float, float], heading: float, own: str | None) -> Way:
        """Walk straight on until a turning point or a wall."""
        far = (
            start[0] + RAY * math.cos(heading),
            start[1] + RAY * math.sin(heading),
        )
        free = LineString([start, far]).intersection(self.site.walkable_floor)
        pieces = [p for p in get_parts(free) if isinstance(p, LineString)]
        reach = [p for p in pieces if p.distance(Point(start)) < 0.1 and p.length > 0]
        if not reach:
            return Way(heading, (start, start), None)
        line = LineString([
            start,
            max(reach[0].coords, key=lambda c: math.dist(c, start)),
        ])
        hits = [
            (span[0], other.id)
            for other in self.site.turning_points
            if other.id != own
            for span in overlaps(line, other.polygon)
        ]
        if hits:
            end = self.points[min(hits)[1]].polygon.centroid
            return Way(heading, (start, (end.x, end.y)), min(hits)[1])
        x, y = line.coords[-1][:2]
        return Way(heading, (start, (x, y)), None)

    @cached_property
    def _passed(self) -> dict[str, tuple[tuple[float, str], ...]]:
        """What was found before, by route id."""
        return {}

    @cached_property
    def _first_ways(self) -> dict[tuple[str, bool], Way]:
        """What was found before, by route id and whether it goes back."""
        return {}

    @cached_property
    def _floors(self) -> Mapping[str, Polygon]:
        return {
            part.id: part.polygon for part in (*self.site.corridors, *self.site.areas)
        }
