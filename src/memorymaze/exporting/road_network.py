"""A site's floor as roads, and junctions where they meet.

A corridor is a road wherever nothing but walls lies beside it. All else, turning points
and halls with whatever opens to them, is a junction: a connecting road for each pair of
ways into it, and beside these roads that cover what is left of its floor.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, count, pairwise
from typing import NamedTuple, cast

import numpy as np
import shapely
from shapely import LineString, Point, Polygon, get_coordinates, get_parts, union_all

from memorymaze.exporting.reference_lines import (
    Across,
    ReferenceLine,
    Slice,
    rounded_line,
    slices_along,
    straight_line,
    way_through,
)
from memorymaze.geometry.pose import Pose, heading_to, wrap_angle
from memorymaze.sites.records import Corridor, Site, TurningPoint, floor_pieces

TOUCHING = 0.01
"""Metres that may lie between pieces of floor that are open to each other."""
OPENING = 0.3
"""Metres along which they touch at least."""
SHORTEST_ROAD = 0.5
"""Metres; a shorter piece of a corridor belongs to what is at its ends."""
SHORTEST_JUNCTION = 0.4
"""Metres of a corridor that a junction takes at least."""
STRIPE = 1.5
"""Metres across of the lanes that cover halls, at most: readers take the lane whose
middle is nearest, so a wide lane loses its edge to a narrow one beyond the wall."""
COVERED = 0.98
"""Share of its floor that the connecting roads of a junction without more cover."""
NARROWING = 0.5
"""Metres that the side of a connecting road goes in or out along a metre, at most. With
steps in them readers took one lane for another."""
BORDER_STEP = 0.25
"""Metres along a connecting road between places where it is fitted into the floor."""

Span = tuple[float, float]
"""Between which metres along a corridor something lies."""


class RoadEnd(NamedTuple):
    """Where a road begins or stops."""

    road: int
    """Its id."""
    contact: str
    """`start` or `end`."""
    pose: Pose
    """In the middle of it, looking out of the road."""
    half_width: float
    """Metres."""


@dataclass(frozen=True, slots=True)
class Road:
    """A strip of floor with lanes of equal width side by side."""

    id: int
    name: str
    line: ReferenceLine
    slices: tuple[Slice, ...]
    lanes: tuple[int, int]
    """How many on the left, on the right. On the right one goes along the line."""
    junction: int | None = None
    """Id of the one that it is in."""
    before: RoadEnd | None = None
    """Of the road that leads onto it, where that is no matter of a junction."""
    after: RoadEnd | None = None
    """Of the road that it leads onto."""

    @property
    def free_ends(self) -> list[RoadEnd]:
        """Its ends that no other road goes on from."""
        free = {"start": self.before is None, "end": self.after is None}
        return [self.end(contact) for contact in free if free[contact]]

    @property
    def is_way(self) -> bool:
        """Whether one gets from one place to another on it, or it only covers floor."""
        return self.before is not None or self.junction is None

    @property
    def outline(self) -> Polygon:
        """The floor that it covers."""
        places = [each for piece in self.slices for each in piece]
        left = [self.line.beside(each.at, each.left) for each in places]
        right = [self.line.beside(each.at, each.right) for each in places]
        return Polygon([*right, *reversed(left)]).buffer(0)

    def end(self, contact: str) -> RoadEnd:
        """Return one of its two ends."""
        at = self.slices[0][0] if contact == "start" else self.slices[-1][1]
        x, y = self.line.beside(at.at, (at.left + at.right) / 2)
        turned = math.pi if contact == "start" else 0.0
        heading = wrap_angle(self.line.pose(at.at).heading + turned)
        return RoadEnd(self.id, contact, Pose(x, y, heading), (at.left - at.right) / 2)


@dataclass(frozen=True, slots=True)
class RoadJunction:
    """Floor on which one gets from each way into it to every other."""

    id: int
    name: str
    polygon: Polygon
    ends: tuple[RoadEnd, ...]
    """Of the ways into it."""


@dataclass(frozen=True, slots=True)
class RoadNetwork:
    """All roads of a floor, and its junctions; no two have the same id."""

    roads: tuple[Road, ...]
    junctions: tuple[RoadJunction, ...]


def road_network(site: Site) -> RoadNetwork:
    """Make the roads and junctions of a site."""
    ids = count(1)
    open_floor = [
        *(each.polygon for each in site.areas),
        *(each.polygon for each in site.turning_points if not _is_end(each, site)),
    ]
    roads: list[Road] = []
    places = list(open_floor)
    for corridor in site.corridors:
        others = [each.polygon for each in site.corridors if each is not corridor]
        taken = _taken(corridor, [*open_floor, *others])
        for span, is_road in _spans(corridor.length, taken):
            floor = _between(corridor, span)
            if is_road:
                roads.append(_corridor_road(floor, corridor, ids))
            else:
                places.append(floor)
    junctions: list[RoadJunction] = []
    for polygon in floor_pieces(places) if places else ():
        roads = [part for road in roads for part in _without_loop(road, polygon, ids)]
        here = tuple(
            end for road in roads for end in road.free_ends if _at(end, polygon)
        )
        junctions.append(RoadJunction(next(ids), _name(polygon, site), polygon, here))
    for junction in junctions:
        roads += _roads_in(junction, ids)
    return RoadNetwork(tuple(roads), tuple(junctions))


def _at(end: RoadEnd, polygon: Polygon) -> bool:
    return polygon.distance(Point(end.pose.x, end.pose.y)) < 2 * TOUCHING


def _without_loop(road: Road, polygon: Polygon, ids: Iterator[int]) -> Iterator[Road]:
    """Yield a road, or its halves where it leads from a junction back to it.

    CARLA's reader finds no way onto a road that has the same junction at both ends.
    """
    if not all(_at(end, polygon) for end in (road.end("start"), road.end("end"))):
        yield road
        return
    begin, end = road.slices[0][0], road.slices[-1][1]
    middle = Across(*(sum(both) / 2 for both in zip(begin, end, strict=True)))
    stop = road.line.pose(middle.at)
    first = replace(
        road,
        line=straight_line(road.line[0].start, middle.at),
        slices=((begin, middle),),
    )
    rest = _moved((middle, end), middle.at)
    line = straight_line(stop, road.line.length - middle.at)
    second = replace(first, id=next(ids), line=line, slices=(rest,))
    yield replace(first, after=second.end("start"))
    yield replace(second, before=first.end("end"))


def _is_end(point: TurningPoint, site: Site) -> bool:
    """Tell a turning point that is only the end of a corridor."""
    return len(point.exits) == 1 and any(
        each.polygon.buffer(TOUCHING).covers(point.polygon) for each in site.corridors
    )


def _name(polygon: Polygon, site: Site) -> str:
    parts = (*site.areas, *site.turning_points, *site.corridors)
    inside = [each for each in parts if polygon.buffer(TOUCHING).covers(each.polygon)]
    return " ".join(each.id for each in inside)


def _taken(corridor: Corridor, others: Sequence[Polygon]) -> list[Span]:
    """Return where along a corridor other floor is open to it, in order."""
    line = corridor.centre_line
    spans: list[Span] = []
    for other in others:
        around = other.buffer(TOUCHING, join_style="mitre")
        for touching in get_parts(corridor.polygon.intersection(around)):
            if touching.area < OPENING * TOUCHING:
                continue
            along = [line.project(Point(each)) for each in get_coordinates(touching)]
            more = max(SHORTEST_JUNCTION - (max(along) - min(along)), 0.0) / 2
            begin, end = min(along) - more, max(along) + more
            spans.append((max(begin, 0.0), min(end, line.length)))
    return sorted(spans)


def _spans(length: float, taken: Sequence[Span]) -> Iterator[tuple[Span, bool]]:
    """Yield the pieces of a corridor along its way, and which of them are roads."""
    begin = reached = 0.0
    for start, stop in (*taken, (length, length)):
        if start - reached > SHORTEST_ROAD:
            if reached > begin:
                yield (begin, reached), False
            yield (reached, start), True
            begin = start
        reached = max(reached, stop)
    if length > begin:
        yield (begin, length), False


def _between(corridor: Corridor, span: Span) -> Polygon:
    """Return a corridor between two cuts across it, or a cut and its own end."""
    far = 2 * (corridor.length + corridor.width)
    begin = span[0] if span[0] > 0 else -far
    end = span[1] if span[1] < corridor.length else far
    line = straight_line(_start_of(corridor), corridor.length)
    corners = ((begin, -far), (end, -far), (end, far), (begin, far))
    cut = Polygon([line.beside(at, side) for at, side in corners])
    return cast(Polygon, corridor.polygon.intersection(cut))


def _start_of(corridor: Corridor) -> Pose:
    start, stop = corridor.centre_line.coords
    return Pose(
        start[0], start[1], heading_to((start[0], start[1]), (stop[0], stop[1]))
    )


def _corridor_road(floor: Polygon, corridor: Corridor, ids: Iterator[int]) -> Road:
    start = _start_of(corridor)
    slices = list(slices_along(floor, start))
    first, last = slices[0][0].at, slices[-1][1].at
    begin = straight_line(start, last).pose(first)
    line = straight_line(begin, last - first)
    moved = tuple(_moved(each, first) for each in slices)
    return Road(next(ids), corridor.id, line, moved, (1, 1))


def _floor_roads(
    floor: Polygon, name: str, ids: Iterator[int], junction: int | None
) -> Iterator[Road]:
    """Yield roads that cover a floor, along its longest wall."""
    walls = pairwise((x, y) for x, y, *_ in floor.exterior.coords)
    start, stop = max(walls, key=lambda wall: math.dist(*wall))
    along = Pose(*start, heading_to(start, stop))
    for each in slices_along(floor, along):
        begin, end = each[0].at, each[1].at
        line = straight_line(straight_line(along, end).pose(begin), end - begin)
        lanes = max(1, math.ceil(max(at.left - at.right for at in each) / STRIPE))
        yield Road(next(ids), name, line, (_moved(each, begin),), (lanes, 0), junction)


def _moved(piece: Slice, by: float) -> Slice:
    begin, end = piece
    return begin._replace(at=begin.at - by), end._replace(at=end.at - by)


def _roads_in(junction: RoadJunction, ids: Iterator[int]) -> Iterator[Road]:
    """Yield the connecting roads of a junction, and what else covers its floor."""
    floor = junction.polygon
    covered: list[Polygon] = []
    for road in _connecting_roads(junction, ids):
        covered.append(road.outline)
        yield road
    if floor.intersection(union_all(covered)).area >= COVERED * floor.area:
        return
    within = junction.id if junction.ends else None
    yield from _floor_roads(floor, junction.name, ids, within)


def _connecting_roads(junction: RoadJunction, ids: Iterator[int]) -> Iterator[Road]:
    """Yield a road from each way to each other, or straight on from the only one."""
    floor = junction.polygon
    for one, other in combinations(junction.ends, 2):
        way = way_through(floor, one.pose, other.pose)
        if way is None:
            continue
        for before, after, points in ((one, other, way), (other, one, way[::-1])):
            line = rounded_line(points, floor)
            both = _fitted(line, (before.half_width, after.half_width), floor)
            slices = tuple(
                (_right_half(start), _right_half(stop)) for start, stop in both
            )
            name = f"{before.road} to {after.road}"
            yield Road(
                next(ids), name, line, slices, (0, 1), junction.id, before, after
            )
    if len(junction.ends) == 1:
        (end,) = junction.ends
        line = straight_line(end.pose, _sight(floor, end.pose))
        if line.length > SHORTEST_ROAD:
            slices = _fitted(line, (end.half_width, end.half_width), floor)
            name = f"{end.road} on"
            yield Road(next(ids), name, line, slices, (1, 1), junction.id, end)


def _right_half(whole: Across) -> Across:
    return whole._replace(left=(whole.left + whole.right) / 2)


def _sight(floor: Polygon, pose: Pose) -> float:
    """Return how far straight ahead the floor goes on, metres."""
    far = straight_line(pose, floor.length)
    ray = LineString([pose[:2], far.beside(floor.length, 0.0)])
    walls = ray.difference(floor.buffer(TOUCHING, join_style="mitre"))
    return Point(pose[:2]).distance(walls)


def _fitted(
    line: ReferenceLine, half_widths: tuple[float, float], floor: Polygon
) -> tuple[Slice, ...]:
    """Return a road as wide as the ways at its ends, but nowhere beyond the floor."""
    steps = math.ceil(line.length / BORDER_STEP)
    evenly = np.linspace(0.0, line.length, steps + 1).tolist()
    places = sorted({*evenly, *line.starts})
    wanted = np.interp(places, (0.0, line.length), half_widths)
    around = floor.buffer(TOUCHING, join_style="mitre")
    sides: list[list[float]] = []
    for side in (-1, 1):
        reaches = [
            # Beyond the middle of its circle an arc's borders would cross.
            min(wide, 1 / bend if (bend := side * line.curvature(at)) > 0 else wide)
            for at, wide in zip(places, wanted.tolist(), strict=True)
        ]
        rays = shapely.linestrings([
            [line.beside(at, 0.0), line.beside(at, side * max(reach, 1e-3))]
            for at, reach in zip(places, reaches, strict=True)
        ])
        beyond = shapely.distance(
            shapely.get_point(rays, 0), shapely.difference(rays, around)
        )
        fitting = np.fmin(reaches, beyond)
        apart = NARROWING * np.abs(np.subtract.outer(places, places))
        sides.append((side * (fitting + apart).min(axis=1)).tolist())
    borders = [Across(*each) for each in zip(places, *sides, strict=True)]
    return tuple(pairwise(borders))
