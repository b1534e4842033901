"""What is true from a place on a floor: the way to somewhere, where a thing is, what is here."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice, pairwise
from typing import Literal, NamedTuple

import networkx as nx
from shapely import LineString, Point
from shapely.ops import nearest_points, substring

from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.basics.geometry.pose import Pose, heading_to, turn_between
from memorymaze.robot.perception.camera_view import ObjectDescription
from memorymaze.robot.perception.matching import MATCH_THRESHOLD, match_score
from memorymaze.robot.simulation.senses.sight_targets import (
    describe_door,
    describe_landmark,
)
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.things import with_article
from memorymaze.texts.writing.turning_point_graph import (
    STRAIGHT,
    TURNING_BACK,
    TurningPointGraph,
)
from memorymaze.world.sites.records import Route, RouteTurn, Site

Bearing = Literal["ahead", "left", "right", "back"]

HERE, THERE = "here", "there"
"""Nodes of the place one starts from and of the destination."""
SLIGHT = math.radians(60)
"""A turn by less is slight."""
PER_TURN = 5.0
"""Metres that people walk further to save a turn."""
WAYS_COMPARED = 8
BESIDE_WAY = 4.0
"""Metres from the line of a way within which one is on that way."""
NEAR = 5.0
"""Metres within which a thing tells where something is."""
SEEN_FROM = 25.0
"""Metres within which things in sight are pointed at."""
FURTHER_ON = 15.0
"""Metres as one walks within which somebody says that it comes further on."""


class NamedPlace(NamedTuple):
    """Something of a site that a name can mean."""

    id: str
    position: tuple[float, float]
    """Metres."""


@dataclass(frozen=True, slots=True)
class WayThere:
    """A way from where one stands, ready to be described."""

    start: Bearing
    """How one sets off, seen the way the asker faces."""
    facts: RouteFacts


@dataclass(frozen=True, slots=True)
class Whereabouts:
    """Where a thing is, from where one stands."""

    bearing: Bearing | None
    """Seen the way the asker faces; None where it is out of sight."""
    metres: float
    """As one walks."""
    near: str | None
    """Something it is close to, with its article."""


@dataclass(frozen=True)
class FloorKnowledge:
    """What somebody knows who knows a floor."""

    site: Site
    grid: FloorGrid
    """Of its walkable floor."""

    def places_called(self, words: str) -> tuple[NamedPlace, ...]:
        """Return what on the floor a name can mean: destinations first, then what fits best."""
        named = {
            route.goal_landmark: NamedPlace(
                route.goal_landmark, _place(route.line.coords[-1])
            )
            for route in self.site.routes
            if _plain(route.goal) == _plain(words)
        }
        if named:
            return tuple(named.values())
        scores = [(match_score(words, told), place) for told, place in self._described]
        best = max((score for score, _ in scores), default=0.0)
        if best < MATCH_THRESHOLD:
            return ()
        return tuple(place for score, place in scores if score == best)

    @cached_property
    def _described(self) -> tuple[tuple[ObjectDescription, NamedPlace], ...]:
        found = [
            (describe_door(each, self.site), each.id, each.line.centroid)
            for each in self.site.doors
        ]
        found += [
            (describe_landmark(each), each.id, each.position)
            for each in self.site.landmarks
        ]
        found += [
            (ObjectDescription("hall", name=each.name), each.id, each.polygon.centroid)
            for each in (*self.site.areas, *self.site.corridors)
            if each.name
        ]
        return tuple(
            (told, NamedPlace(name, (spot.x, spot.y))) for told, name, spot in found
        )

    def walk_to(self, here: Pose, place: NamedPlace) -> float:
        """Return the metres one walks to as near as one gets to a place."""
        spot, _ = nearest_points(self.site.walkable_floor, Point(place.position))
        return self.grid.walks.distance((here.x, here.y), (spot.x, spot.y))

    def nearest_called(self, words: str, here: Pose) -> NamedPlace | None:
        """Return the nearest place that a name can mean; None where there is none."""
        return min(
            self.places_called(words),
            key=lambda place: self.walk_to(here, place),
            default=None,
        )

    def whereabouts(self, place: NamedPlace, here: Pose) -> Whereabouts:
        """Return where a place is, seen from here."""
        spot = Point(place.position)
        eye = Point(here.x, here.y)
        seen = eye.distance(spot) <= SEEN_FROM and self._graph.sees(eye, spot)
        bearing = side_of_heading(here, heading_to((here.x, here.y), place.position))
        return Whereabouts(
            bearing if seen else None, self.walk_to(here, place), self.thing_near(place)
        )

    def thing_near(self, place: NamedPlace) -> str | None:
        """Return something that a place is close to, with its article."""
        spot = Point(place.position)
        near = [
            (spot.distance(Point(thing.position)), thing)
            for thing in self._graph.things
            if thing.id != place.id
        ]
        for metres, thing in sorted(near, key=lambda each: each[0]):
            if metres > NEAR:
                return None
            if self._graph.sees(spot, Point(thing.position)):
                return with_article(thing, definite=True)
        return None

    def way_to(self, words: str, here: Pose) -> WayThere | None:
        """Return the way to a destination that people would tell; None where none is known.

        It goes over the turning points; a turn saved is worth some metres.
        """
        place = self.nearest_called(words, here)
        if place is None:
            return None
        lines = list(self._lines_to(here, place))
        found = [(line, self._route(line, words, place)) for line in lines]
        for _, (graph, route) in sorted(
            found, key=lambda each: each[0].length + PER_TURN * len(each[1][1].turns)
        ):
            facts = RouteFacts(graph, route)
            try:
                _ = facts.plan
            except SitePlanError:  # It cannot be told where to turn.
                continue
            return WayThere(side_of_heading(here, route.start_heading), facts)
        return None

    @cached_property
    def _graph(self) -> TurningPointGraph:
        return TurningPointGraph(self.site)

    @cached_property
    def _legs(self) -> dict[tuple[str, str], LineString]:
        """The shortest lines from one turning point to the next."""
        middles = {
            name: point.polygon.centroid for name, point in self._graph.points.items()
        }
        legs: dict[tuple[str, str], LineString] = {}
        for name, ways in self._graph.ways.items():
            for way in ways:
                if way.end is None or way.end == name:
                    continue
                start, end = middles[name], middles[way.end]
                line = _line([(start.x, start.y), *way.line, (end.x, end.y)])
                known = legs.get((name, way.end))
                if known is None or line.length < known.length:
                    legs[name, way.end] = line
                    legs.setdefault((way.end, name), line.reverse())
        return legs

    def _lines_to(self, here: Pose, place: NamedPlace) -> Iterator[LineString]:
        """Yield the lines of ways to a place, the shortest first."""
        start = (here.x, here.y)
        stand = self._stand_before(place)
        legs = dict(self._legs)
        legs |= {(HERE, name): line for name, line in self._joining(start)}
        legs |= {(name, THERE): line.reverse() for name, line in self._joining(stand)}
        direct = LineString([start, stand])
        if self._graph.floor.covers(direct) or direct.length < 0.5:
            legs[HERE, THERE] = direct
        elif along := self._along_a_leg(start, stand):
            legs[HERE, THERE] = along
        graph = nx.DiGraph()
        graph.add_nodes_from((HERE, THERE))
        for (name, other), line in legs.items():
            graph.add_edge(name, other, length=line.length)
        try:
            paths = nx.shortest_simple_paths(graph, HERE, THERE, weight="length")
            for nodes in islice(paths, WAYS_COMPARED):
                points = [
                    point for leg in pairwise(nodes) for point in legs[leg].coords
                ]
                yield _line(_without_turning_back([_place(point) for point in points]))
        except nx.NetworkXNoPath:
            return

    def _along_a_leg(
        self, start: tuple[float, float], end: tuple[float, float]
    ) -> LineString | None:
        """Return the line between two places on one leg; None where they are on none."""
        for leg in self._legs.values():
            feet = [leg.project(Point(place)) for place in (start, end)]
            ties = [
                LineString([place, leg.interpolate(foot)])
                for place, foot in zip((start, end), feet, strict=True)
            ]
            if all(
                tie.length <= BESIDE_WAY and self._graph.floor.covers(tie)
                for tie in ties
            ):
                between = substring(leg, feet[0], feet[1])
                return _line([start, *map(_place, between.coords), end])
        return None

    def _stand_before(self, place: NamedPlace) -> tuple[float, float]:
        """Return where one stands who is there."""
        goals = [
            r.line.coords[-1] for r in self.site.routes if r.goal_landmark == place.id
        ]
        if goals:
            return _place(goals[0])
        spot = Point(place.position)
        feet = [line.interpolate(line.project(spot)) for line in self._legs.values()]
        feet = [foot for foot in feet if self._graph.sees(foot, spot)]
        edge, _ = nearest_points(self.site.walkable_floor, spot)
        nearest = min(feet, key=spot.distance, default=edge)
        if nearest.distance(spot) > BESIDE_WAY:
            nearest = edge
        return nearest.x, nearest.y

    def _joining(self, spot: tuple[float, float]) -> Iterator[tuple[str, LineString]]:
        """Yield the turning points one comes to first from a place, with the lines there."""
        here = Point(spot)
        lines: dict[str, LineString] = {}
        for (_, end), leg in self._legs.items():
            if leg.distance(here) > BESIDE_WAY:
                continue
            at = leg.project(here)
            foot = leg.interpolate(at)
            if leg.length - at < 0.05 or not self._graph.floor.covers(
                LineString([foot, here])
            ):
                continue
            rest = substring(leg, at, leg.length)
            line = _line([spot, *map(_place, rest.coords)])
            straight = _line([spot, _place(leg.coords[-1])])
            if self._graph.floor.covers(straight):
                line = straight
            if end not in lines or line.length < lines[end].length:
                lines[end] = line
        for name, point in self._graph.points.items():
            middle = point.polygon.centroid
            straight = _line([spot, (middle.x, middle.y)])
            if name not in lines and self._leads_nowhere_else(name, straight, here):
                lines[name] = straight
        yield from lines.items()

    def _leads_nowhere_else(self, name: str, line: LineString, start: Point) -> bool:
        return self._graph.floor.covers(line) and not any(
            other != name
            and point.polygon.intersection(line).length > 0.05
            and not point.polygon.covers(start)
            for other, point in self._graph.points.items()
        )

    def _route(
        self, line: LineString, words: str, place: NamedPlace
    ) -> tuple[TurningPointGraph, Route]:
        """Return a line as a route of the floor, with its turns."""
        line = self._from_the_rim(line)
        route = Route(
            "asked",
            line,
            "R0",
            "alternative",
            heading_to(*map(_place, line.coords[:2])),
            words,
            place.id,
            line.length,
            (),
            "",
        )
        known = replace(self.site, routes=(*self.site.routes, route))
        graph = TurningPointGraph(known)
        ways = list(graph.ways_along(route))
        turns: list[RouteTurn] = []
        for (_, before), (point, after) in pairwise(ways):
            angle = turn_between(before.heading, after.heading)
            if point is not None and abs(angle) >= STRAIGHT:
                side = "left" if angle > 0 else "right"
                slight = "slight_" if abs(angle) <= SLIGHT else ""
                turns.append(RouteTurn(point, f"{slight}{side}"))
        first = ways[0][1].heading if ways else route.start_heading
        return graph, replace(route, turns=tuple(turns), start_heading=first)

    def _from_the_rim(self, line: LineString) -> LineString:
        """Begin where one leaves the turning point one stands in, which is no opening."""
        start = Point(line.coords[0])
        for point in self._graph.points.values():
            if point.polygon.covers(start):
                inside = point.polygon.intersection(line).length
                if inside < line.length - 0.5:
                    return _line([
                        *map(_place, substring(line, inside, line.length).coords)
                    ])
        return line


def side_of_heading(here: Pose, heading: float) -> Bearing:
    """Return where a heading leads, seen the way one faces."""
    angle = turn_between(here.heading, heading)
    if abs(angle) <= math.pi / 4:
        return "ahead"
    if abs(angle) >= 3 * math.pi / 4:
        return "back"
    return "left" if angle > 0 else "right"


def _without_turning_back(
    points: list[tuple[float, float]],
) -> list[tuple[float, float]]:
    """Leave out where somebody would go somewhere and the same way back."""
    kept: list[tuple[float, float]] = []
    for point in points:
        if kept and math.dist(kept[-1], point) <= 0.02:
            continue
        while len(kept) > 1 and _is_back(kept[-2], kept[-1], point):
            kept.pop()
        if not kept or math.dist(kept[-1], point) > 0.02:
            kept.append(point)
    return kept if len(kept) > 1 else [points[0], points[-1]]


def _is_back(
    start: tuple[float, float], middle: tuple[float, float], end: tuple[float, float]
) -> bool:
    if math.dist(middle, end) <= 0.02:
        return False
    turn = turn_between(heading_to(start, middle), heading_to(middle, end))
    return abs(turn) > TURNING_BACK


def _plain(words: str) -> str:
    return words.casefold().strip().removeprefix("the ").strip()


def _place(point: tuple[float, ...]) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def _line(points: list[tuple[float, float]]) -> LineString:
    """Return a line without points that are told twice."""
    kept = points[:1]
    for point in points[1:]:
        if math.dist(point, kept[-1]) > 0.02:
            kept.append(point)
    return LineString(kept if len(kept) > 1 else [points[0], points[-1]])
