"""Lines that roads run along: straight pieces and arcs, and what lies beside them."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np
from scipy.sparse.csgraph import dijkstra
from shapely import LineString, Point, Polygon, get_coordinates, get_parts, get_rings
from shapely.affinity import affine_transform

from memorymaze.basics.geometry.floor import Floor
from memorymaze.basics.geometry.pose import (
    Pose,
    heading_to,
    moved,
    turn_between,
    wrap_angle,
)

TANGENTS = (3.0, 1.5, 0.75, 0.3, 0.1)
"""Metres of a straight piece that a bend rounds off at most; less where there is no
room for that."""
KINK = math.radians(0.5)
"""A turn smaller than this is not rounded."""
DETOUR = 1.5
"""How many times longer than the straight line a way with one bend may be."""
BERTH = 0.45
"""Metres kept from corners on a way round them, where there is room."""
NARROWEST = 0.1
"""Metres; no way leads through what is narrower."""
SAME_PLACE = 0.02
"""Metres between corners that count as one along a line."""
ON_EDGE = 5e-3
"""Metres that a way may lie off the floor, or its pieces apart."""

PlanPoint = tuple[float, float]


class LineStretch(NamedTuple):
    """A straight piece, or an arc of a circle."""

    start: Pose
    length: float
    """Metres."""
    curvature: float
    """Per metre, left positive; 0 is straight."""

    def pose(self, along: float) -> Pose:
        """Return the pose so many metres along."""
        x, y, heading = self.start
        turned = self.curvature * along
        # The chord is along the mean heading, and sinc(0) is 1.
        chord = along * float(np.sinc(turned / 2 / math.pi))
        middle = heading + turned / 2
        return Pose(
            x + chord * math.cos(middle),
            y + chord * math.sin(middle),
            wrap_angle(heading + turned),
        )


class ReferenceLine(tuple[LineStretch, ...]):
    """Stretches that follow on each other."""

    @cached_property
    def starts(self) -> list[float]:
        """Metres along it at which each stretch starts, and those at its end."""
        return list(accumulate((each.length for each in self), initial=0.0))

    @property
    def length(self) -> float:
        """Metres."""
        return self.starts[-1]

    def stretch(self, at: float) -> tuple[LineStretch, float]:
        """Return the stretch so many metres along, and how many metres along that."""
        number = min(max(bisect_right(self.starts, at) - 1, 0), len(self) - 1)
        return self[number], at - self.starts[number]

    def pose(self, at: float) -> Pose:
        """Return the pose so many metres along."""
        stretch, along = self.stretch(at)
        return stretch.pose(along)

    def trace(self, step: float = 0.1) -> list[PlanPoint]:
        """Return points along it, metres apart."""
        count = math.ceil(self.length / step) + 1
        return [self.beside(at, 0.0) for at in np.linspace(0.0, self.length, count)]

    def beside(self, at: float, offset: float) -> PlanPoint:
        """Return the point so many metres along and, to the left, beside it."""
        x, y, heading = self.pose(at)
        return x - offset * math.sin(heading), y + offset * math.cos(heading)


class RoadBorders(NamedTuple):
    """Between which offsets from a line something lies; left is positive."""

    at: float
    """Metres along the line."""
    right: float
    """Metres."""
    left: float
    """Metres."""


FloorSlice = tuple[RoadBorders, RoadBorders]
"""What lies between two places along a line, with straight borders."""


def straight_line(start: Pose, length: float) -> ReferenceLine:
    """Return the line so many metres straight on from a pose."""
    return ReferenceLine([LineStretch(start, length, 0.0)])


def rounded_line(points: Sequence[PlanPoint], floor: Polygon) -> ReferenceLine:
    """Return the line through points, with its bends rounded off on the floor."""
    around = floor.buffer(ON_EDGE, join_style="mitre")
    *wider, narrowest = (_rounded(points, tangent) for tangent in TANGENTS)
    fitting = (each for each in wider if around.covers(LineString(each.trace())))
    return next(fitting, narrowest)


def _rounded(points: Sequence[PlanPoint], longest: float) -> ReferenceLine:
    corners = [points[0]]
    corners += [
        each for each in points[1:] if math.dist(each, corners[-1]) > SAME_PLACE
    ]
    headings = [heading_to(*leg) for leg in pairwise(corners)]
    last = len(headings) - 1
    room = [
        math.dist(*leg) / (1 if number in (0, last) else 2)
        for number, leg in enumerate(pairwise(corners))
    ]
    if last == 1:
        room = [min(room)] * 2
    made: list[LineStretch] = []
    here = corners[0]
    for number, (before, after) in enumerate(pairwise(headings), start=1):
        corner, turn = corners[number], turn_between(before, after)
        if abs(turn) < KINK:
            made.append(LineStretch(Pose(*here, before), math.dist(here, corner), 0.0))
            here = corner
            continue
        tangent = min(room[number - 1], room[number], longest)
        entry = moved(corner, before, -tangent)
        if math.dist(here, entry) > ON_EDGE:
            made.append(LineStretch(Pose(*here, before), math.dist(here, entry), 0.0))
        radius = tangent / math.tan(abs(turn) / 2)
        curvature = math.copysign(1 / radius, turn)
        made.append(LineStretch(Pose(*entry, before), radius * abs(turn), curvature))
        here = moved(corner, after, tangent)
    if not made or math.dist(here, corners[-1]) > ON_EDGE:
        made.append(
            LineStretch(Pose(*here, headings[-1]), math.dist(here, corners[-1]), 0.0)
        )
    return ReferenceLine(made)


def way_through(floor: Polygon, start: Pose, end: Pose) -> list[PlanPoint] | None:
    """Return points of a way over a floor, or None where it is too narrow.

    Both poses look into the floor from its edge.
    """
    here, there = (start.x, start.y), (end.x, end.y)
    around = floor.buffer(ON_EDGE, join_style="mitre")
    corner = _meeting(start, end)
    straight = math.dist(here, there)
    onwards = abs(turn_between(start.heading, heading_to(here, there)))
    offwards = abs(turn_between(end.heading, heading_to(there, here)))
    ways = [[here, there]] if max(onwards, offwards) < KINK else []
    if corner is not None:
        ways.append([here, corner, there])
    inset = min(1.0, straight / 3)
    inner, outer = moved(here, start.heading, inset), moved(there, end.heading, inset)
    ways.append([here, inner, outer, there])
    for way in ways:
        line = LineString(way)
        if line.length <= DETOUR * straight and around.covers(line):
            return way
    walk = _walk(floor, inner, outer)
    return None if walk is None else [here, *walk, there]


def slices_along(floor: Polygon, start: Pose) -> Iterator[FloorSlice]:
    """Cut a floor across a straight line at all corners, so that borders run straight.

    Metres along the line may be negative; slices that follow on each other need not touch.
    """
    cosine, sine = math.cos(start.heading), math.sin(start.heading)
    shift = (
        -cosine * start.x - sine * start.y,
        sine * start.x - cosine * start.y,
    )
    flat = affine_transform(floor, (cosine, sine, -sine, cosine, *shift))
    edges = [
        (min(edge), max(edge))
        for ring in get_rings(get_parts(flat))
        for edge in pairwise([(x, y) for x, y in get_coordinates(ring).tolist()])
    ]
    stops: list[float] = []
    for stop in sorted(get_coordinates(flat)[:, 0].tolist()):
        if not stops or stop - stops[-1] > SAME_PLACE:
            stops.append(stop)
    for begin, finish in pairwise(stops):
        yield from _slices(edges, begin, finish)


def _slices(
    edges: Sequence[tuple[PlanPoint, PlanPoint]], begin: float, finish: float
) -> Iterator[FloorSlice]:
    """Yield what lies between the edges that pass the middle of a piece, in pairs."""
    middle = (begin + finish) / 2
    passing = [edge for edge in edges if edge[0][0] <= middle < edge[1][0]]
    passing.sort(key=lambda edge: _height(edge, middle))
    for low, high in zip(passing[::2], passing[1::2], strict=True):
        first, last = (
            RoadBorders(at, min(sides), max(sides))
            for at in (begin, finish)
            for sides in [(_height(low, at), _height(high, at))]
        )
        yield first, last


def _height(edge: tuple[PlanPoint, PlanPoint], at: float) -> float:
    (x, y), (other_x, other_y) = edge
    at = min(max(at, x), other_x)
    return y + (other_y - y) * (at - x) / (other_x - x)


def _meeting(start: Pose, end: Pose) -> PlanPoint | None:
    """Return the point that two poses look at, in front of both."""
    across = math.sin(turn_between(start.heading, end.heading))
    if abs(across) < math.sin(KINK):
        return None
    dx, dy = end.x - start.x, end.y - start.y
    ahead = (dx * math.sin(end.heading) - dy * math.cos(end.heading)) / across
    other = (dx * math.sin(start.heading) - dy * math.cos(start.heading)) / across
    if min(ahead, other) < SAME_PLACE:
        return None
    return moved((start.x, start.y), start.heading, ahead)


def _walk(floor: Polygon, start: PlanPoint, end: PlanPoint) -> list[PlanPoint] | None:
    """Return a shortest walk that bends where there is room beside corners."""
    bends = [
        get_coordinates(floor.buffer(-berth, join_style="mitre").simplify(NARROWEST))
        for berth in (BERTH, NARROWEST)
    ]
    spots = np.concatenate([[start, end], *bends])
    narrow = floor.buffer(-NARROWEST / 2)
    if narrow.is_empty or not all(narrow.covers(Point(each)) for each in (start, end)):
        return None
    tails, heads = np.triu_indices(len(spots), k=1)
    seen = Floor(narrow).joins(spots[tails], spots[heads])
    tails, heads = tails[seen], heads[seen]
    steps = np.zeros((len(spots),) * 2)
    # Two equal spots would count as not joined.
    steps[tails, heads] = np.hypot(*(spots[tails] - spots[heads]).T) + 1e-9
    lengths, before = dijkstra(
        steps, directed=False, indices=1, return_predecessors=True
    )
    if not math.isfinite(lengths[0]):
        return None
    walk, here = [start], 0
    while before[here] >= 0:
        here = int(before[here])
        walk.append((float(spots[here][0]), float(spots[here][1])))
    return walk
