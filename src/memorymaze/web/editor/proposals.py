"""What follows from where things are drawn: exits, turns, rooms of doors, goals of routes.

All of it is proposed once, when a feature is drawn or when it is asked for, and can be
changed by hand.
"""

import math
from collections.abc import Iterator
from dataclasses import asdict
from itertools import combinations, count, pairwise
from typing import Any

from shapely import LineString, Point, Polygon
from shapely.affinity import scale

from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.importing.reference_route import goals_of, turns_along
from memorymaze.world.sites.exits import (
    TOUCH,
    Course,
    FloorShapes,
    exit_reach,
    exits_along,
    shape_of,
)
from memorymaze.world.sites.floor_rules import ROOM_OFF_DOOR, exact_union
from memorymaze.world.sites.plan import feature_of, in_millimetres, rounded_degrees
from memorymaze.world.sites.records import Corridor, Site, TurningPoint
from memorymaze.world.sites.route_rules import GOAL_NEAR

_Feature = dict[str, Any]
BEYOND = 0.5
"""Metres at least beyond a turning point that tell what one comes to."""
CROSSING = math.radians(20)
"""Corridors at a smaller angle go on in each other."""


def completed(feature: _Feature, site: Site) -> _Feature:
    """Return a drawn feature with what follows from its place on the plan."""
    properties: _Feature = dict(feature["properties"])
    coordinates = feature["geometry"]["coordinates"]
    match properties["kind"]:
        case "turning_point":
            point = _turning_point(
                feature["id"], Polygon(coordinates[0]), properties["name"], site
            )
            properties |= feature_of(point)["properties"]
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
        yield feature_of(_turning_point(f"tp_{free}", place, None, site))


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


def _turning_point(
    identity: str, place: Polygon, name: str | None, site: Site
) -> TurningPoint:
    """Return a turning point with its exits and the shape that they make."""
    parts = FloorShapes(*(
        {each.id: each.polygon for each in kind if each.id != identity}
        for kind in (site.corridors, site.areas, site.turning_points)
    ))  # fmt: skip
    shapes = [shape for kind in parts for shape in kind.values()]
    floor = exact_union([*shapes, place])
    # Into corridors one walks along them only.
    leading = [
        (heading, {each.id: each.polygon})
        for each in site.corridors
        if each.id != identity and each.polygon.distance(place) <= TOUCH
        for heading in (_course(each), turn_between(math.pi, _course(each)))
    ] + [(heading, {}) for heading in _across_edges(place)]
    courses = [
        Course(heading, _straight(heading, place), parts._replace(corridors=along))
        for heading, along in leading
    ]
    exits = list(exits_along(courses, place, floor))
    exits.sort(key=lambda each: each.heading % (2 * math.pi))
    shape = shape_of(exits, parts.areas)
    return in_millimetres(TurningPoint(identity, place, name, shape, tuple(exits)))


def _straight(heading: float, place: Polygon) -> LineString:
    """Return the way straight ahead from the middle of a place to what lies beyond."""
    x, y = place.centroid.x, place.centroid.y

    def ahead(distance: float) -> LineString:
        end = (x + distance * math.cos(heading), y + distance * math.sin(heading))
        return LineString([(x, y), end])

    within = ahead(place.length).intersection(place).length
    return ahead(max(exit_reach(place), within + BEYOND))


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
        "start_heading_deg": rounded_degrees(heading_to(places[0], places[1])),
        "turns": [asdict(turn) for turn in turns_along(places, site)],
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
