"""What follows from where things are drawn: exits, turns, rooms of doors, goals of routes.

All of it is proposed once, when a feature is drawn or when it is asked for, and can be
changed by hand.
"""

import math
from collections.abc import Iterator
from itertools import combinations, count, pairwise
from typing import Any

from shapely import LineString, Point, Polygon, union_all
from shapely.affinity import scale

from memorymaze.geometry.pose import heading_to, turn_between
from memorymaze.importing.reference_route import goals_of, turns_along
from memorymaze.sites.floor_rules import ROOM_OFF_DOOR, SAME_EXIT, TOUCH, exit_reach
from memorymaze.sites.plan_writing import degrees, polygon_feature
from memorymaze.sites.records import Area, Corridor, Site, TurningPoint
from memorymaze.sites.route_rules import GOAL_NEAR

_Feature = dict[str, Any]
_Floor = Corridor | Area | TurningPoint
STRAIGHT_ON = math.radians(150)
"""Exits at a larger angle are a way through."""
CROSSING = math.radians(20)
"""Corridors at a smaller angle go on in each other."""
SHAPES = {1: "dead_end", 2: "corner", 3: "t_junction"}
"""By the number of exits; more are a crossing."""


def completed(feature: _Feature, site: Site) -> _Feature:
    """Return a drawn feature with what follows from its place on the plan."""
    properties: _Feature = dict(feature["properties"])
    coordinates = feature["geometry"]["coordinates"]
    match properties["kind"]:
        case "turning_point":
            properties |= _ways_out(feature["id"], Polygon(coordinates[0]), site)
        case "door":
            line = LineString(coordinates)
            near = [(room.polygon.distance(line), room.id) for room in site.rooms]
            gap, room = min(near, default=(math.inf, None))
            properties["room"] = room if gap <= ROOM_OFF_DOOR else None
        case "route":
            properties |= _way(LineString(coordinates), site)
        case _:
            pass
    return {**feature, "properties": properties}


def missing_turning_points(site: Site, ids: set[str]) -> Iterator[_Feature]:
    """Make the turning points where corridors meet and none is drawn yet."""
    taken = [point.polygon for point in site.turning_points]
    for one, other in combinations(site.corridors, 2):
        place = _meeting_place(one, other)
        if place is None or any(
            place.intersection(each).area > place.area / 2 for each in taken
        ):
            continue
        taken.append(place)
        free = next(n for n in count(1) if f"tp_{n}" not in ids)
        ids.add(f"tp_{free}")
        feature = polygon_feature(f"tp_{free}", "turning_point", place, name=None)
        yield completed(feature, site)


def _floor_of(site: Site) -> tuple[_Floor, ...]:
    return (*site.corridors, *site.areas, *site.turning_points)


def _meeting_place(one: Corridor, other: Corridor) -> Polygon | None:
    """Return what both corridors cover when each goes on across the other."""
    turn = abs(turn_between(_course(one), _course(other))) % math.pi
    if not CROSSING < turn < math.pi - CROSSING:
        return None
    further = (one.width + other.width) / math.sin(turn)
    place = _strip(one, further).intersection(_strip(other, further))
    if not isinstance(place, Polygon) or place.is_empty:
        return None
    if max(place.distance(one.polygon), place.distance(other.polygon)) > TOUCH:
        return None
    return place


def _strip(corridor: Corridor, further: float) -> Polygon:
    """Return a corridor that goes on straight at both ends, by so many metres."""
    line = corridor.centre_line
    longer = 1 + 2 * further / line.length
    return scale(line, longer, longer).buffer(corridor.width / 2, cap_style="flat")


def _course(corridor: Corridor) -> float:
    return heading_to(*_ends(corridor.centre_line))


def _ends(line: LineString) -> tuple[tuple[float, float], tuple[float, float]]:
    x, y = line.coords.xy
    return (x[0], y[0]), (x[-1], y[-1])


def _ways_out(own_id: str, place: Polygon, site: Site) -> _Feature:
    """Return the exits of a turning point, and the shape that they make."""
    others = [each for each in _floor_of(site) if each.id != own_id]
    floor = union_all([each.polygon.buffer(1e-6) for each in others] + [place])
    middle, reach = place.centroid, exit_reach(place)
    touching = [each for each in others if each.polygon.distance(place) <= TOUCH]
    along = [course for each in touching for course in _courses(each)]
    exits: list[tuple[float, str]] = []
    for heading in (*along, *_across_edges(place)):
        end = (
            middle.x + reach * math.cos(heading),
            middle.y + reach * math.sin(heading),
        )
        leading = [
            (not isinstance(each, Corridor), isinstance(each, TurningPoint), each.id)
            for each in touching
            if each.polygon.distance(Point(end)) <= TOUCH and _is_way_in(each, heading)
        ]
        is_new = all(abs(turn_between(heading, e)) >= SAME_EXIT for e, _ in exits)
        probe = LineString([(middle.x, middle.y), end])
        if is_new and leading and floor.covers(probe):
            exits.append((heading, min(leading)[-1]))
    shape = SHAPES.get(len(exits), "crossing")
    if len(exits) == 2 and abs(turn_between(exits[0][0], exits[1][0])) > STRAIGHT_ON:
        shape = "opening"
    return {
        "shape": shape,
        "exits": [{"to": to, "heading_deg": degrees(way)} for way, to in sorted(exits)],
    }


def _courses(floor: _Floor) -> list[float]:
    """Return the two directions along a corridor."""
    if not isinstance(floor, Corridor):
        return []
    return [_course(floor), turn_between(math.pi, _course(floor))]


def _is_way_in(floor: _Floor, heading: float) -> bool:
    """Tell whether one walks into floor in a direction: corridors only along them."""
    courses = _courses(floor)
    return not courses or any(
        abs(turn_between(heading, each)) < SAME_EXIT for each in courses
    )


def _across_edges(place: Polygon) -> Iterator[float]:
    x, y = place.exterior.coords.xy
    for start, end in pairwise(zip(x, y, strict=True)):
        for side in (math.pi / 2, -math.pi / 2):
            yield turn_between(-side, heading_to(start, end))


def _way(line: LineString, site: Site) -> _Feature:
    """Return what follows from a route's line."""
    places = [(x, y) for x, y, *_ in line.coords]
    end = Point(places[-1])
    found: _Feature = {
        "start_heading_deg": degrees(heading_to(places[0], places[1])),
        "turns": list(turns_along(places, site)),
    }
    # The wall of a room is often nearer than what one is led to.
    near = [
        (isinstance(shape, Polygon), shape.distance(end), identity, words)
        for identity, (shape, words) in goals_of(site).items()
        if shape.distance(end) <= GOAL_NEAR
    ]
    if near:
        *_, found["goal_landmark"], found["goal"] = min(near)
    return found
