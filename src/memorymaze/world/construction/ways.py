"""Destinations on a floor, the shortest ways to them, signs that point, and routes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import networkx as nx
import numpy as np
from shapely import LineString, Point

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, moved, turn_between
from memorymaze.world.construction.floor import MadeFloor, point_id
from memorymaze.world.construction.layout import UnsuitableFloor
from memorymaze.world.construction.rooms import MadeDoor, MadeRoom
from memorymaze.world.construction.skeleton import IN_LINE, SkeletonLeg
from memorymaze.world.construction.things import Furnisher
from memorymaze.world.sites.records import RouteTurn

AHEAD = math.radians(40)
"""Ways that bend less are straight on for a sign."""
FARTHEST_SIGNED = 75.0
"""Metres from a sign to what it points to."""
CLEARLY = 4.0
"""Metres that the way a sign points must be shorter than any other."""
SIGNED_SHARE = 0.6
"""Share of the ways into junctions with a sign."""
LONGEST_TEXT = 44
"""Characters of a sign."""
GOAL_NEAR = 3.8
"""Metres from the middle line to a goal."""
TURNS = (3, 10)
"""Turns of a route."""
SLIGHT = math.radians(60)
"""A turn by less is slight."""
NO_GOALS = ("stairwell", "storage")
"""Uses of rooms that no one asks the way to."""
NUMBERED_LATER = 0.85
"""How far numbered rooms stand behind named ones as goals, from 0 to 1."""
DETOUR = 1.6
"""Alternatives are at most so many times as long as the reference."""
SHARED = 0.75
"""Share of its length that an alternative may have in common with another way."""
START_INSIDE = 1.3
"""Metres from an entrance to where a route starts."""


@dataclass(frozen=True)
class Destination:
    """Something to walk to, with the place on a leg where one is there."""

    name: str
    leg: tuple[int, int]
    """Nodes of the leg."""
    along: float
    """Metres from the first node."""
    place: XY
    """On the middle line."""
    away: float
    """Metres from the middle line to the thing itself."""
    room: MadeRoom | None
    """The room that it is; None of a hall."""
    door: MadeDoor | None
    """The door of the room that is there."""


@dataclass(frozen=True)
class MadeWay:
    """A way from an entrance to a destination."""

    line: tuple[XY, ...]
    turns: tuple[RouteTurn, ...]

    @property
    def length(self) -> float:
        """Metres."""
        return sum(math.dist(*step) for step in pairwise(self.line))

    def shared_with(self, other: "MadeWay") -> float:
        """Return the share of its length that it has in common with another."""
        near = LineString(other.line).buffer(0.1)
        return LineString(self.line).intersection(near).length / self.length


@dataclass(frozen=True)
class MadeRoute:
    """A reference way with its alternatives."""

    destination: Destination
    ways: tuple[MadeWay, ...]
    """The reference first."""


class Ways:
    """Shortest ways on a floor's skeleton."""

    def __init__(self, floor: MadeFloor, rooms: Sequence[MadeRoom]) -> None:
        """Find what can be walked to."""
        self._floor = floor
        self._skeleton = floor.skeleton
        graph = self._skeleton.graph
        self._lengths = dict(nx.all_pairs_dijkstra_path_length(graph, weight="length"))
        self._legs = [
            ((node, other), self._skeleton.line(node, other))
            for node, other in graph.edges
        ]
        found = [
            self._destination(room.name, door.place, room, door)
            for room in rooms
            for door in room.doors
        ]
        self.rooms = [each for each in found if each is not None]
        self.signed = [
            each for each in self.rooms if each.room and each.room.destination
        ]
        for hall, polygon in zip(floor.layout.halls, floor.halls, strict=True):
            middle = polygon.representative_point()
            there = self._destination(hall.name, (middle.x, middle.y))
            if there is not None:
                self.signed.append(there)

    def _destination(
        self,
        name: str,
        place: XY,
        room: MadeRoom | None = None,
        door: MadeDoor | None = None,
    ) -> Destination | None:
        """Return a destination on the leg that is nearest in sight."""
        thing = Point(place)
        for (node, other), line in sorted(
            self._legs, key=lambda each: each[1].distance(thing)
        )[:3]:
            along = min(max(line.project(thing), 0.6), line.length - 0.6)
            stand = line.interpolate(along)
            sight = LineString([(stand.x, stand.y), place])
            if self._floor.walkable.buffer(0.05).covers(sight):
                return Destination(
                    name,
                    (node, other),
                    along,
                    (stand.x, stand.y),
                    stand.distance(thing),
                    room,
                    door,
                )
        return None

    def distances_by_leg(
        self, node: int, goal: Destination
    ) -> list[tuple[float, SkeletonLeg]]:
        """Return how far it is to a destination by each leg of a node, nearest first."""
        near, far = goal.leg
        length = self._skeleton.graph.edges[goal.leg]["length"]
        found: list[tuple[float, SkeletonLeg]] = []
        for leg in self._skeleton.legs(node):
            if {node, leg.to} == {near, far}:
                direct = goal.along if node == near else length - goal.along
                found.append((direct, leg))
                continue
            onward = self._lengths[leg.to]
            rest = min(onward[near] + goal.along, onward[far] + length - goal.along)
            found.append((leg.length + rest, leg))
        return sorted(found, key=lambda each: each[0])

    def hang_signs(self, furnisher: Furnisher, rng: np.random.Generator) -> None:
        """Hang signs before junctions that point the shortest ways."""
        streets = self._floor.layout.streets
        for node, point in self._floor.turning_points.items():
            legs = self._skeleton.legs(node)
            if len(legs) < 3:
                continue
            for leg in legs:
                signed = leg.street is not None and streets[leg.street].signed
                if not signed or leg.length < 6.0 or rng.random() > SIGNED_SHARE:
                    continue
                text = self._pointing(node, leg)
                if text is None:
                    continue
                place = self._skeleton.places[node]
                reach = max(
                    (x - place[0]) * math.cos(leg.heading)
                    + (y - place[1]) * math.sin(leg.heading)
                    for x, y in point.polygon.exterior.coords
                )
                hung = moved(place, leg.heading, reach + 0.5)
                furnisher.hang("hanging sign", hung, leg.heading, text)

    def _pointing(self, node: int, came_by: SkeletonLeg) -> str | None:
        """Return what a sign says to who comes by a leg."""
        course = came_by.heading + math.pi
        shown: dict[str, list[str]] = {"←": [], "↑": [], "→": []}
        used: dict[str, int] = {}
        named: set[str] = set()
        told = 0
        reachable = [(self.distances_by_leg(node, goal), goal) for goal in self.signed]
        reachable.sort(key=lambda each: (each[0][0][0], each[1].name))
        for ways, goal in reachable:
            if goal.name in named:
                continue
            named.add(goal.name)
            (distance, leg), (other, _) = ways[:2]
            if distance > FARTHEST_SIGNED or other - distance < CLEARLY:
                continue
            if leg.to == came_by.to or distance < 3.0:
                continue
            turn = turn_between(course, leg.heading)
            arrow = "↑" if abs(turn) < AHEAD else "←" if turn > 0 else "→"
            if used.setdefault(arrow, leg.to) != leg.to:
                continue
            if told + len(goal.name) + 4 > LONGEST_TEXT:
                continue
            shown[arrow].append(goal.name)
            told += len(goal.name) + 4
        parts = [
            f"{arrow} {', '.join(names)}" if arrow != "→" else f"{', '.join(names)} →"
            for arrow, names in shown.items()
            if names
        ]
        return "   ".join(parts) or None

    def routes(self, rng: np.random.Generator) -> list[MadeRoute]:
        """Choose a shorter and a longer route, each with its alternatives.

        Raises:
            UnsuitableFloor: There are none.
        """
        drawn = [
            (start, goal)
            for start, _ in self._floor.layout.entrances
            for goal in self.rooms
            if goal.away <= GOAL_NEAR and goal.room and goal.room.use not in NO_GOALS
        ]
        # Places with a name first, in any order; now and then a numbered room.
        luck = rng.random(len(drawn))
        named = np.array(
            [goal.room is not None and goal.room.destination for _, goal in drawn],
            dtype=bool,
        )
        order = np.argsort(luck + np.where(named, 0.0, NUMBERED_LATER))
        chosen: list[MadeRoute] = []
        for wanted in ((TURNS[0], 5), (4, TURNS[1])):
            for index in order:
                start, goal = drawn[index]
                if any(route.destination.name == goal.name for route in chosen):
                    continue
                route = self._route(start, goal)
                if route and wanted[0] <= len(route.ways[0].turns) <= wanted[1]:
                    chosen.append(route)
                    break
            else:
                raise UnsuitableFloor(f"no route of {wanted} turns")
        return chosen

    def _route(self, start: XY, goal: Destination) -> MadeRoute | None:
        entrance = self._skeleton.node_at(start)
        if entrance is None:
            raise ValueError(f"no street ends at the entrance {start}")
        found = list(islice(self._ways_to(entrance, goal), 24))
        shortest = found[0].length
        sensible = [way for way in found if way.length <= 1.2 * shortest]
        reference = min(sensible, key=lambda way: way.length + 5 * len(way.turns))
        if not TURNS[0] <= len(reference.turns) <= TURNS[1]:
            return None
        ways = [reference]
        for way in found:
            if (
                TURNS[0] <= len(way.turns) <= TURNS[1]
                and way.length <= DETOUR * reference.length
                and len(ways) < 3
                and all(way.shared_with(other) <= SHARED for other in ways)
            ):
                ways.append(way)
        return MadeRoute(goal, tuple(ways))

    def _ways_to(self, entrance: int, goal: Destination) -> Iterator[MadeWay]:
        """Yield ways to a destination, the shortest first."""
        graph = self._skeleton.graph.copy()
        near, far = goal.leg
        length = graph.edges[goal.leg]["length"]
        graph.remove_edge(near, far)
        graph.add_edge(near, -1, length=goal.along)
        graph.add_edge(-1, far, length=length - goal.along)
        for nodes in nx.shortest_simple_paths(graph, entrance, -1, weight="length"):
            yield self._way(nodes, goal)

    def _way(self, nodes: Sequence[int], goal: Destination) -> MadeWay:
        places = [self._skeleton.places[node] for node in nodes[:-1]] + [goal.place]
        places[0] = moved(places[0], heading_to(*places[:2]), START_INSIDE)
        kept = [places[0]]
        turns: list[RouteTurn] = []
        for index in range(1, len(places) - 1):
            bend = turn_between(
                heading_to(places[index - 1], places[index]),
                heading_to(places[index], places[index + 1]),
            )
            if abs(bend) > IN_LINE:
                side = "left" if bend > 0 else "right"
                slight = "slight_" if abs(bend) <= SLIGHT else ""
                turns.append(RouteTurn(point_id(nodes[index]), f"{slight}{side}"))
            if abs(bend) > 1e-3:
                kept.append(places[index])
        return MadeWay((*kept, places[-1]), tuple(turns))
