"""The middle lines of a floor's streets as a graph of nodes and straight legs."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
from shapely import LineString, Point, STRtree

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.construction.layout import (
    Layout,
    UnsuitableFloor,
)

SAME_NODE = 0.3
"""Places nearer to each other than this many metres are one node."""
SHORTEST_LEG = 2.2
"""Metres between two nodes."""
IN_LINE = math.radians(15)
"""Legs that bend less than this are in line."""
NARROWEST = math.radians(38)
"""The least angle between two legs of a node."""


@dataclass(frozen=True)
class SkeletonLeg:
    """A straight piece between two nodes, as seen from one of them."""

    to: int
    heading: float
    """Radians, away from the node."""
    width: float
    street: int | None
    """Number of its street; None for a way across a hall."""
    piece: int
    """Number of the street's straight piece."""
    hall: str | None
    """Hall that a way across crosses."""
    length: float


@dataclass(frozen=True)
class _Piece:
    start: XY
    end: XY
    width: float
    street: int | None
    piece: int
    hall: str | None


class Skeleton:
    """Nodes where streets meet, bend or end, and the legs between them."""

    def __init__(self, layout: Layout) -> None:
        """Cut the streets where they cross.

        Raises:
            UnsuitableFloor: Nodes or legs lie too close, or more than four legs meet.
        """
        self.graph: nx.Graph[int] = nx.Graph()
        self.places: list[XY] = []
        pieces = list(_pieces(layout))
        lines = [LineString([each.start, each.end]) for each in pieces]
        tree = STRtree(lines)
        for index, piece in enumerate(pieces):
            stops = [piece.start, piece.end]
            near = tree.query(lines[index], "dwithin", SAME_NODE / 2)
            for other in sorted(near.tolist()):
                if other != index:
                    stops += _meeting_places(lines[index], lines[other])
            self._add(piece, stops)
        self._check()

    def legs(self, node: int) -> list[SkeletonLeg]:
        """Return the legs of a node by heading."""
        found = [
            SkeletonLeg(
                other,
                heading_to(self.places[node], self.places[other]),
                **self.graph.edges[node, other]["leg"],
                length=math.dist(self.places[node], self.places[other]),
            )
            for other in self.graph.neighbors(node)
        ]
        return sorted(found, key=lambda each: each.heading)

    def node_at(self, place: XY) -> int | None:
        """Return the node at a place."""
        for node, known in enumerate(self.places):
            if math.dist(place, known) < SAME_NODE:
                return node
        return None

    def line(self, node: int, other: int) -> LineString:
        """Return the straight line between two nodes."""
        return LineString([self.places[node], self.places[other]])

    def _add(self, piece: _Piece, stops: list[XY]) -> None:
        stops.sort(key=lambda place: math.dist(piece.start, place))
        nodes: list[int] = []
        for stop in stops:
            node = self.node_at(stop)
            if node is None:
                node = len(self.places)
                self.places.append((round(stop[0], 3), round(stop[1], 3)))
                self.graph.add_node(node)
            if node not in nodes:
                nodes.append(node)
        leg = {
            "width": piece.width,
            "street": piece.street,
            "piece": piece.piece,
            "hall": piece.hall,
        }
        for node, other in pairwise(nodes):
            if self.graph.has_edge(node, other):
                raise UnsuitableFloor("two streets lie on each other")
            length = math.dist(self.places[node], self.places[other])
            self.graph.add_edge(node, other, length=length, leg=leg)

    def _check(self) -> None:
        for node in self.graph:
            legs = self.legs(node)
            if len(legs) > 4:
                raise UnsuitableFloor("more than four legs meet")
            for index, leg in enumerate(legs):
                if leg.length < SHORTEST_LEG:
                    raise UnsuitableFloor("two nodes lie too close")
                for other in legs[:index]:
                    if abs(turn_between(leg.heading, other.heading)) < NARROWEST:
                        raise UnsuitableFloor("two legs lie too close")
        if not nx.is_connected(self.graph):
            raise UnsuitableFloor("streets that do not hang together")


def _pieces(layout: Layout) -> Iterator[_Piece]:
    for number, street in enumerate(layout.streets):
        for piece, (start, end) in enumerate(pairwise(street.points)):
            yield _Piece(start, end, street.width, number, piece, None)
    for across in layout.ways_across:
        for start, end in pairwise(across.points):
            yield _Piece(start, end, 3.0, None, 0, across.hall)


def _meeting_places(line: LineString, other: LineString) -> list[XY]:
    """Return where another line crosses or touches this one."""
    found = [
        (end[0], end[1])
        for end in other.coords
        if line.distance(Point(end)) < SAME_NODE / 2
    ]
    on_line = [line.interpolate(line.project(Point(place))) for place in found]
    if not on_line:
        crossing = line.intersection(other)
        on_line = [crossing] if isinstance(crossing, Point) else []
    return [(place.x, place.y) for place in on_line]
