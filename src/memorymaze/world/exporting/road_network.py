"""A site's floor as roads, and junctions where they meet.

A corridor is a road wherever nothing but walls lies beside it. All else, turning points
and halls with whatever opens to them, is a junction: a connecting road from each way into
it to each other, and beside these roads that cover what is left of its floor.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count, pairwise, permutations
from typing import NamedTuple, cast

import numpy as np
import shapely
from shapely import LineString, Point, Polygon, get_coordinates, get_parts, union_all

from memorymaze.basics.geometry.pose import Pose, heading_to, wrap_angle
from memorymaze.world.exporting.reference_lines import (
    ReferenceLine,
    RoadBorders,
    rounded_line,
    slices_along,
    straight_line,
    way_through,
)
from memorymaze.world.sites.records import Corridor, Site, TurningPoint, floor_pieces

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
BORDER_STEP = 0.25
"""Metres along a connecting road between places where it is fitted into the floor."""
NARROWING = 0.5
"""Metres that its sides go in or out along a metre, at most; at steps readers take one
lane for another."""
STRAIGHT = 1e-3
"""Metres that a border may lie off the straight line that stands for it."""

CorridorSpan = tuple[float, float]
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
    borders: tuple[RoadBorders, ...]
    """From its start to its end, straight in between."""
    lanes: tuple[int, int]
    """How many on the left, on the right. On the right one goes along the line."""
    junction: int | None = None
    """Id of the one that it is in."""
    before: RoadEnd | None = None
    """Of the road that leads onto it, where that is no matter of a junction."""
    after: RoadEnd | None = None
    """Of the road that it leads onto."""

    @property
    def is_way(self) -> bool:
        """Whether one gets from one place to another on it, or it only covers floor."""
        return self.before is not None or self.junction is None

    @property
    def outline(self) -> Polygon:
        """The floor that it covers."""
        right = [self.line.beside(each.at, each.right) for each in self.borders]
        left = [self.line.beside(each.at, each.left) for each in self.borders]
        return Polygon([*right, *reversed(left)]).buffer(0)

    def end(self, contact: str) -> RoadEnd:
        """Return one of its two ends."""
        here = self.borders[0 if contact == "start" else -1]
        x, y = self.line.beside(here.at, (here.left + here.right) / 2)
        outwards = math.pi if contact == "start" else 0.0
        heading = wrap_angle(self.line.pose(here.at).heading + outwards)
        half_width = (here.left - here.right) / 2
        return RoadEnd(self.id, contact, Pose(x, y, heading), half_width)


@dataclass(frozen=True, slots=True)
class RoadJunction:
    """Floor on which one gets from each way into it to every other."""

    id: int
    name: str
    polygon: Polygon
    ends: tuple[RoadEnd, ...]
    """Of the ways into it."""


def road_network(site: Site) -> tuple[list[Road], list[RoadJunction]]:
    """Make the roads and junctions of a site, no two of which have the same id."""
    ids = count(1)
    places = [
        *(each.polygon for each in site.areas),
        *(each.polygon for each in site.turning_points if not _is_end(each, site)),
    ]
    open_floor = list(places)
    roads: list[Road] = []
    for corridor in site.corridors:
        others = [each.polygon for each in site.corridors if each is not corridor]
        taken = _taken(corridor, [*open_floor, *others])
        for span, is_road in _spans(corridor.length, taken):
            floor = _between(corridor, span)
            if is_road:
                roads.append(_corridor_road(floor, corridor, next(ids)))
            else:
                places.append(floor)
    junctions: list[RoadJunction] = []
    for polygon in floor_pieces(places) if places else ():
        roads = [part for road in roads for part in _without_loop(road, polygon, ids)]
        ends = [road.end("start") for road in roads if road.before is None]
        ends += [road.end("end") for road in roads if road.after is None]
        here = tuple(end for end in ends if _is_at(end, polygon))
        junctions.append(RoadJunction(next(ids), _name(polygon, site), polygon, here))
    for junction in junctions:
        roads += _roads_in(junction, ids)
    return roads, junctions


def _is_end(point: TurningPoint, site: Site) -> bool:
    """Tell a turning point that is only the end of a corridor."""
    return len(point.exits) == 1 and any(
        each.polygon.buffer(TOUCHING).covers(point.polygon) for each in site.corridors
    )


def _is_at(end: RoadEnd, polygon: Polygon) -> bool:
    return polygon.distance(Point(end.pose.x, end.pose.y)) < 2 * TOUCHING


def _name(polygon: Polygon, site: Site) -> str:
    around = polygon.buffer(TOUCHING)
    parts = (*site.areas, *site.turning_points, *site.corridors)
    return " ".join(each.id for each in parts if around.covers(each.polygon))


def _taken(corridor: Corridor, others: Sequence[Polygon]) -> list[CorridorSpan]:
    """Return where along a corridor other floor is open to it, in order."""
    line = corridor.centre_line
    spans: list[CorridorSpan] = []
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


def _spans(
    length: float, taken: Sequence[CorridorSpan]
) -> Iterator[tuple[CorridorSpan, bool]]:
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


def _between(corridor: Corridor, span: CorridorSpan) -> Polygon:
    """Return a corridor between two cuts across it, or a cut and its own end."""
    far = 2 * (corridor.length + corridor.width)
    begin = span[0] if span[0] > 0 else -far
    end = span[1] if span[1] < corridor.length else far
    line = straight_line(_start_of(corridor), corridor.length)
    corners = ((begin, -far), (end, -far), (end, far), (begin, far))
    cut = Polygon([line.beside(at, side) for at, side in corners])
    return cast(Polygon, corridor.polygon.intersection(cut))


def _start_of(corridor: Corridor) -> Pose:
    (x, y), stop = corridor.centre_line.coords
    return Pose(x, y, heading_to((x, y), (stop[0], stop[1])))


def _corridor_road(floor: Polygon, corridor: Corridor, number: int) -> Road:
    slices = list(slices_along(floor, _start_of(corridor)))
    borders = [slices[0][0], *(end for _, end in slices)]
    return _straight_road(number, corridor.id, _start_of(corridor), borders, (1, 1))


def _straight_road(
    number: int,
    name: str,
    start: Pose,
    borders: Sequence[RoadBorders],
    lanes: tuple[int, int],
) -> Road:
    """Return the road between places along a line from a pose."""
    begin, length = borders[0].at, borders[-1].at - borders[0].at
    line = straight_line(straight_line(start, length).pose(begin), length)
    moved = tuple(each._replace(at=each.at - begin) for each in borders)
    return Road(number, name, line, moved, lanes)


def _without_loop(road: Road, polygon: Polygon, ids: Iterator[int]) -> Iterator[Road]:
    """Yield a road, or its halves where it leads from a junction back to it.

    CARLA's reader finds no way onto a road that has the same junction at both ends.
    """
    if not all(_is_at(road.end(contact), polygon) for contact in ("start", "end")):
        yield road
        return
    begin, end = road.borders[0], road.borders[-1]
    middle = RoadBorders(*(sum(both) / 2 for both in zip(begin, end, strict=True)))
    start = road.line.pose(0.0)
    first = _straight_road(road.id, road.name, start, (begin, middle), (1, 1))
    second = _straight_road(next(ids), road.name, start, (middle, end), (1, 1))
    yield replace(first, after=second.end("start"))
    yield replace(second, before=first.end("end"))


def _roads_in(junction: RoadJunction, ids: Iterator[int]) -> Iterator[Road]:
    """Yield the connecting roads of a junction, and what else covers its floor."""
    floor = junction.polygon
    connecting = list(_connecting_roads(junction, ids))
    yield from connecting
    covered = union_all([each.outline for each in connecting])
    if floor.intersection(covered).area >= COVERED * floor.area:
        return
    walls = pairwise((x, y) for x, y, *_ in floor.exterior.coords)
    start, stop = max(walls, key=lambda wall: math.dist(*wall))
    along = Pose(*start, heading_to(start, stop))
    within = junction.id if junction.ends else None
    for each in slices_along(floor, along):
        widest = max(at.left - at.right for at in each)
        lanes = max(1, math.ceil(widest / STRIPE)), 0
        road = _straight_road(next(ids), junction.name, along, each, lanes)
        yield replace(road, junction=within)


def _connecting_roads(junction: RoadJunction, ids: Iterator[int]) -> Iterator[Road]:
    """Yield a road from each way to each other, or straight on from the only one."""
    floor = junction.polygon
    for before, after in permutations(junction.ends, 2):
        way = way_through(floor, before.pose, after.pose)
        if way is not None:
            line = rounded_line(way, floor)
            borders = [
                each._replace(left=(each.left + each.right) / 2)
                for each in _fitted(line, before.half_width, after.half_width, floor)
            ]
            yield Road(
                next(ids),
                f"{before.road} to {after.road}",
                line,
                _straightened(borders),
                (0, 1),
                junction.id,
                before,
                after,
            )
    if len(junction.ends) == 1:
        (end,) = junction.ends
        line = straight_line(end.pose, _sight(floor, end.pose))
        if line.length > SHORTEST_ROAD:
            borders = _fitted(line, end.half_width, end.half_width, floor)
            name = f"{end.road} on"
            straight = _straightened(borders)
            yield Road(next(ids), name, line, straight, (1, 1), junction.id, end)


def _sight(floor: Polygon, pose: Pose) -> float:
    """Return how far straight ahead the floor goes on, metres."""
    line = straight_line(pose, floor.length)
    ray = LineString([pose[:2], line.beside(line.length, 0.0)])
    beyond = ray.difference(floor.buffer(TOUCHING, join_style="mitre"))
    return Point(pose[:2]).distance(beyond)


def _fitted(
    line: ReferenceLine, half_width: float, half_width_there: float, floor: Polygon
) -> list[RoadBorders]:
    """Return borders as wide as the ways at both ends, but nowhere beyond the floor."""
    steps = math.ceil(line.length / BORDER_STEP) + 1
    places = sorted({*np.linspace(0.0, line.length, steps).tolist(), *line.starts})
    wanted = np.interp(places, (0.0, line.length), (half_width, half_width_there))
    apart = NARROWING * np.abs(np.subtract.outer(places, places))
    around = floor.buffer(TOUCHING, join_style="mitre")
    sides: list[list[float]] = []
    for side in (-1, 1):
        # Beyond the middle of its circle an arc's borders would cross.
        bends = [side * line.stretch(at)[0].curvature for at in places]
        reach = np.minimum(wanted, [1 / bend if bend > 0 else np.inf for bend in bends])
        rays = shapely.linestrings([
            [line.beside(at, 0.0), line.beside(at, side * max(each, STRAIGHT))]
            for at, each in zip(places, reach.tolist(), strict=True)
        ])
        walls = shapely.difference(rays, around)
        reach = np.fmin(reach, shapely.distance(shapely.get_point(rays, 0), walls))
        sides.append((side * (reach + apart).min(axis=1)).tolist())
    return [RoadBorders(*each) for each in zip(places, *sides, strict=True)]


def _straightened(borders: Sequence[RoadBorders]) -> tuple[RoadBorders, ...]:
    """Leave out places between which both borders run straight."""
    kept: set[float] = set()
    for side in ("right", "left"):
        line = LineString([(each.at, getattr(each, side)) for each in borders])
        kept |= {at for at, _ in line.simplify(STRAIGHT).coords}
    return tuple(each for each in borders if each.at in kept)
