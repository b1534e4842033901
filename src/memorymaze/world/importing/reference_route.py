"""A reference route between two places of a site, along the middle of its ways."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np
import shapely
from scipy.sparse.csgraph import dijkstra
from shapely import LineString, Point, Polygon
from shapely.ops import nearest_points

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.geometry.floor import Floor
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.sites.plan import in_millimetres
from memorymaze.world.sites.records import Door, Landmark, Room, Route, RouteTurn, Site
from memorymaze.world.sites.route_rules import CLEARANCE, GOAL_NEAR, STRAIGHT_ON

MIDDLE_NEAR = 4.0
"""Metres from a place to the middle line of the way that it lies at."""
IN_FRONT = 1.5
"""Metres before a goal at which one has arrived."""
OFF_MIDDLE = 3.0
"""Metres more that a bend at an inner corner counts, so that middle lines come first."""
SLIGHT = math.radians(60)
"""A turn by less is slight."""
SPACING = 0.02
"""Metres that routes keep beyond the clearance that is asked for."""
PLACE = re.compile(r"\s*(-?[0-9.]+)\s*,\s*(-?[0-9.]+)\s*")

_Goal = tuple[Point | LineString | Polygon, str]
"""Where something is, and its words."""


@dataclass(frozen=True)
class _End:
    """Where a route starts or ends."""

    place: XY
    goal: str | None
    """Id of what is there."""
    words: str
    """What people call it."""


def reference_route(site: Site, start: str, goal: str) -> Route:
    """Return a reference route through a site.

    Start and goal are ids or names of rooms, doors or things, or places `x,y` in metres;
    the goal has something within 4 m that people can be sent to. Raises `SettingsError`
    where there is no such place, or no way.
    """
    free = site.free_floor.buffer(-CLEARANCE - SPACING, join_style="mitre")
    pieces = [piece for piece in shapely.get_parts(free) if isinstance(piece, Polygon)]
    if not pieces:
        raise SettingsError(
            f"route: expected floor with {CLEARANCE} m around it in {site.name}, got none"
        )
    begin, end = _end(site, start, "from"), _end(site, goal, "to")
    if end.goal is None:
        raise SettingsError(
            f"route to {goal!r}: expected a room, door or thing within {GOAL_NEAR:.0f} m of "
            "the end, got none; name another goal"
        )
    from_piece, to_piece = (
        min(pieces, key=Point(each.place).distance) for each in (begin, end)
    )
    if from_piece is not to_piece:
        raise SettingsError(
            f"route: expected a way from {start!r} to {goal!r}, got none that keeps "
            f"{CLEARANCE} m from walls and obstacles"
        )
    middles = [each.centre_line for each in site.corridors]
    first, last = (_on_middle(each.place, from_piece, middles) for each in (begin, end))
    line = _shortest(first, last, from_piece, site)
    there = goals_of(site)[end.goal][0]
    while len(line) > 2 and there.distance(Point(line[-2])) <= IN_FRONT:
        line.pop()
    if not any(Point(last).distance(middle) < SPACING for middle in middles):
        line = _ended_near(line, there)
    numbers = {each.route for each in site.routes}
    number = next(n for n in range(1, len(numbers) + 2) if f"R{n}" not in numbers)
    walked = LineString(line)
    route = Route(
        f"route_r{number}_reference",
        walked,
        route=f"R{number}",
        role="reference",
        start_heading=heading_to(line[0], line[1]),
        goal=end.words,
        goal_landmark=end.goal,
        length=walked.length,
        turns=tuple(turns_along(line, site)),
        note="",
    )
    return in_millimetres(route)


def _end(site: Site, said: str, which: str) -> _End:
    """Return the place that somebody means."""
    goals = goals_of(site)
    written = PLACE.fullmatch(said)
    if written:
        try:
            place = (float(written[1]), float(written[2]))
        except ValueError:
            raise SettingsError(
                f"route {which} {said!r}: expected x,y in metres"
            ) from None
        spot = Point(place)
        if not site.walkable_floor.covers(spot):
            raise SettingsError(
                f"route {which} {said!r}: expected a place on the floor, got one "
                f"{site.walkable_floor.distance(spot):.1f} m off it"
            )
        near = min(goals, key=lambda each: goals[each][0].distance(spot), default=None)
        if near is None or goals[near][0].distance(spot) > GOAL_NEAR:
            return _End(place, None, said)
        return _End(place, near, goals[near][1])
    found = [said] if said in goals else _called(said, goals)
    if not found:
        known = [
            name for identity, (_, words) in goals.items() for name in (identity, words)
        ]
        raise SettingsError(
            f"route {which} {said!r}: expected x,y or the id or name of a room, door or "
            f"thing of {site.name}, got none of these{did_you_mean(said, known)}"
        )
    if len(found) > 1:
        raise SettingsError(
            f"route {which} {said!r}: expected one that is called so in {site.name}, got "
            f"{', '.join(found)}; give the id of one"
        )
    [identity] = found
    doors = [door.line for door in site.doors if door.room == identity]
    shape = doors[0] if doors else goals[identity][0]
    there = nearest_points(site.walkable_floor, shape.centroid)[0]
    return _End((there.x, there.y), identity, goals[identity][1])


def _called(said: str, goals: Mapping[str, _Goal]) -> list[str]:
    """Return the ids of the rooms that are called so, or else doors, or else things."""
    found = [
        (identity, type(shape))
        for identity, (shape, words) in goals.items()
        if said.casefold() == words.casefold()
    ]
    return [identity for identity, kind in found if kind is found[0][1]]


def goals_of(site: Site) -> dict[str, _Goal]:
    """Return what one can be sent to, with its words, rooms first."""

    def words(each: Room | Door | Landmark) -> str:
        if isinstance(each, Door):
            return each.label or f"the {each.style.replace('_', ' ')} door"
        if isinstance(each, Landmark):
            return each.name or each.text or f"the {each.category}"
        return each.name or f"the {each.use.replace('_', ' ')}"

    return {
        **{each.id: (each.polygon, words(each)) for each in site.rooms},
        **{each.id: (each.line, words(each)) for each in site.doors},
        **{each.id: (each.position, words(each)) for each in site.landmarks},
    }


def _on_middle(place: XY, free: Polygon, middles: Sequence[LineString]) -> XY:
    """Return the place on a middle line that is in front of another, or the nearest."""
    spot = Point(place)
    near = (
        [
            found
            for line in middles
            for found in [nearest_points(line.intersection(free), spot)[0]]
            if not found.is_empty and found.distance(spot) <= MIDDLE_NEAR
        ]
        if middles
        else []
    )
    best = min(near, key=spot.distance, default=None) or nearest_points(free, spot)[0]
    return (best.x, best.y)


def _shortest(start: XY, goal: XY, free: Polygon, site: Site) -> list[XY]:
    """Return the shortest line that bends where middle lines meet, or at inner corners."""
    meetings = [place for place in _meetings(site) if free.covers(Point(place))]
    corners = [
        (x, y)
        for ring in shapely.get_rings(free)
        for x, y in shapely.get_coordinates(ring)[:-1]
    ]
    places = np.array([start, goal, *meetings, *corners])
    tails, heads = np.triu_indices(len(places), k=1)
    seen = Floor(free).joins(places[tails], places[heads])
    tails, heads = tails[seen], heads[seen]
    steps = np.zeros((len(places), len(places)))
    extra = np.where(np.arange(len(places)) < 2 + len(meetings), 0.1, OFF_MIDDLE)
    extra[:2] = 0.0
    lengths = np.hypot(*(places[tails] - places[heads]).T)
    steps[tails, heads] = np.maximum(lengths + (extra[tails] + extra[heads]) / 2, 1e-6)
    _, before = dijkstra(steps, directed=False, indices=0, return_predecessors=True)
    way = [1]
    while way[-1] != 0:
        if before[way[-1]] < 0:
            raise SettingsError(
                "route: expected a way between start and goal, got none"
            )
        way.append(int(before[way[-1]]))
    line = [(float(x), float(y)) for x, y in places[way[::-1]]]
    line = [line[0], *(b for a, b in pairwise(line) if math.dist(a, b) > 0.05)]
    if len(line) < 2:
        raise SettingsError("route: expected two places apart, got one place twice")
    return line


def _ended_near(line: list[XY], goal: Point | LineString | Polygon) -> list[XY]:
    """Return a line without what goes on round a goal that is reached before its end."""
    near = goal.buffer(IN_FRONT)
    for place, step in enumerate(pairwise(line), start=1):
        entered = LineString(step).intersection(near)
        if not entered.is_empty and entered.distance(Point(step[0])) > 0.5:
            stop = nearest_points(entered, Point(step[0]))[0]
            return [*line[:place], (stop.x, stop.y)]
    return line


def _meetings(site: Site) -> Iterator[XY]:
    """Yield where the middle lines of corridors cross, ends of lines, middles of places."""
    for corridor, other in combinations(site.corridors, 2):
        if corridor.polygon.intersects(other.polygon):
            yield from _crossing(corridor.centre_line, other.centre_line)
    for corridor in site.corridors:
        for x, y, *_ in corridor.centre_line.coords:
            yield (x, y)
    for place in (*site.turning_points, *site.areas):
        middle = place.polygon.representative_point()
        yield (middle.x, middle.y)


def _crossing(line: LineString, other: LineString) -> Iterator[XY]:
    """Yield where two middle lines cross, each drawn out a little."""
    longer = [_drawn_out(each) for each in (line, other)]
    met = longer[0].intersection(longer[1])
    if isinstance(met, Point) and not met.is_empty:
        yield (met.x, met.y)


def _drawn_out(line: LineString) -> LineString:
    (x, y), (end_x, end_y) = line.coords
    scale = MIDDLE_NEAR / line.length
    dx, dy = (end_x - x) * scale, (end_y - y) * scale
    return LineString([(x - dx, y - dy), (end_x + dx, end_y + dy)])


def turns_along(line: Sequence[XY], site: Site) -> Iterator[RouteTurn]:
    """Yield the turns of a line at turning points, bends within one put together."""
    bends: dict[str, float] = {}
    for before, corner, after in zip(line, line[1:], line[2:], strict=False):
        angle = turn_between(heading_to(before, corner), heading_to(corner, after))
        spot = Point(corner)
        at = min(
            (
                each
                for each in site.turning_points
                if each.polygon.distance(spot) < 0.01
            ),
            key=lambda each: each.polygon.centroid.distance(spot),
            default=None,
        )
        if abs(angle) > STRAIGHT_ON and at is not None:
            bends[at.id] = bends.get(at.id, 0.0) + angle
    for at, angle in bends.items():
        if abs(angle) > STRAIGHT_ON:
            side = "left" if angle > 0 else "right"
            yield RouteTurn(at, side if abs(angle) >= SLIGHT else f"slight_{side}")
