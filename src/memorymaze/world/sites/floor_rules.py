"""Rules of the floor, and of what stands on it and lies along it."""

import math
from collections.abc import Iterable, Iterator

import shapely
from shapely import Point, Polygon, union_all
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.pose import turn_between
from memorymaze.world.sites.exits import SAME_EXIT, TOUCH, exit_reach, is_free
from memorymaze.world.sites.problems import PLAN, SiteProblem
from memorymaze.world.sites.records import (
    Corridor,
    Door,
    Landmark,
    Site,
    TurningPoint,
)

CORRIDOR_WIDTHS = (1.8, 8.0)
"""Metres; the wider half is for the ways between a museum's exhibits."""
FLOOR_ACROSS = (35.0, 110.0)
"""Metres along the longer side of the floor's bounding box."""
CONVEX_SLACK = 0.01
"""Square metres a turning point may lack of its hull."""
SLIVER_AREA = 0.05
"""A hole smaller than this many square metres is a seam that does not close."""
SMALLEST_SLIVER = 1e-4
"""Holes smaller than this many square metres come from rounding."""
PASSABLE_RADIUS = 0.25
"""Metres."""
SMALLEST_POCKET = 0.5
"""Square metres for the robot's middle that must be cut off to be worth a word."""
DOOR_WIDTHS = (0.8, 2.4)
"""Metres."""
DOOR_OFF_WALL = 0.05
"""Metres between a door and the floor's boundary that rounding may make."""
ROOM_OFF_DOOR = 0.5
"""Metres of wall that may lie between a door and its room."""
ROOM_ON_FLOOR = 0.05
"""Square metres of the floor that a room may cover by rounding."""
THING_OFF_FLOOR = 0.35
"""Metres the middle of a floor landmark may lie outside the floor, in a niche."""
OBSTACLE_IN_WALL = 0.3
"""Metres an obstacle may reach into a wall."""
MOUNTED_OFF_WALL = 0.3
"""Metres between a wall-mounted landmark and its wall."""
FREE_IN_FRONT = 0.25
"""Metres in front of a wall-mounted landmark that are floor, so it can be seen."""


def exact_floor(site: Site) -> Polygon:
    """Return the union of the floor as drawn, with seams of up to 2 micrometres closed.

    `Site.walkable_floor` forgives more, so a gap is seen here first. Where the floor
    hangs together only with that forgiveness, this is `Site.walkable_floor`.
    """
    floor = exact_union([each.polygon for each in site.floor_parts])
    # A union in one piece can be a collection of one.
    pieces = shapely.get_parts(floor).tolist()
    return pieces[0] if len(pieces) == 1 else site.walkable_floor


def exact_union(parts: Iterable[Polygon]) -> BaseGeometry:
    """Return the union of floor as drawn, with seams of up to 2 micrometres closed."""
    return union_all([each.buffer(1e-6, join_style="mitre") for each in parts])


def floor_findings(site: Site, floor: Polygon) -> Iterator[SiteProblem]:
    """Find what is wrong with the floor."""
    yield from _seams(site, floor)
    yield from _narrow_places(site)
    for corridor in site.corridors:
        yield from _corridor(corridor)
    parts = {each.id: each.polygon for each in site.floor_parts}
    for point in site.turning_points:
        yield from _turning_point(point, parts, floor)


def _seams(site: Site, floor: Polygon) -> Iterator[SiteProblem]:
    if floor is site.walkable_floor:
        yield SiteProblem(
            PLAN,
            "floor-seams",
            "expected neighbours that overlap or share an edge exactly, got gaps of up "
            "to 2 mm between them; move the corners onto each other",
        )
    for hole in floor.interiors:
        area = Polygon(hole).area
        if SMALLEST_SLIVER < area < SLIVER_AREA:
            middle = Polygon(hole).centroid
            yield SiteProblem(
                PLAN,
                "floor-seams",
                f"expected holes of at least {SLIVER_AREA} m², got one of {area:.4f} m² "
                f"at ({middle.x:.2f}, {middle.y:.2f}); let the polygons around it overlap",
            )


def extent_findings(floor: Polygon) -> Iterator[SiteProblem]:
    """Find whether a floor is larger or smaller than those of the benchmark."""
    west, south, east, north = floor.bounds
    across = max(east - west, north - south)
    if not FLOOR_ACROSS[0] <= across <= FLOOR_ACROSS[1]:
        yield SiteProblem(
            PLAN,
            "floor-extent",
            f"expected a floor {FLOOR_ACROSS[0]:.0f} to {FLOOR_ACROSS[1]:.0f} m "
            f"across, as in the benchmark, got {across:.1f} m",
            "warning",
        )


def _narrow_places(site: Site) -> Iterator[SiteProblem]:
    passable = site.free_floor.buffer(-PASSABLE_RADIUS)
    pieces = [
        piece
        for piece in getattr(passable, "geoms", [passable])
        if piece.area > SMALLEST_POCKET
    ]
    for piece in sorted(pieces, key=lambda each: each.area)[:-1]:
        where = piece.representative_point()
        yield SiteProblem(
            PLAN,
            "floor-passable",
            "expected a floor that a robot of 0.5 m can drive all over, got a piece of "
            f"{piece.area:.1f} m² at ({where.x:.2f}, {where.y:.2f}) that walls or "
            "obstacles cut off",
            "warning",
        )


def _corridor(corridor: Corridor) -> Iterator[SiteProblem]:
    ring = corridor.polygon.exterior.coords
    narrowest = min(math.dist(ring[i][:2], ring[i + 1][:2]) for i in range(4))
    low, high = CORRIDOR_WIDTHS
    for width in (narrowest, corridor.width):
        if not low <= round(width, 3) <= high:
            yield SiteProblem(
                corridor.id,
                "corridor-width",
                f"expected a width of {low} to {high} m, as in the benchmark, got "
                f"{width:.2f} m",
                "warning",
            )
            return


def _turning_point(
    point: TurningPoint, parts: dict[str, Polygon], floor: Polygon
) -> Iterator[SiteProblem]:
    lacking = point.polygon.convex_hull.area - point.polygon.area
    if lacking > CONVEX_SLACK or point.polygon.interiors:
        yield SiteProblem(
            point.id,
            "turning-point-convex",
            f"expected a convex shape, got one that lacks {lacking:.2f} m² of its hull",
        )
    reach = exit_reach(point.polygon)
    for index, way in enumerate(point.exits):
        degrees = math.degrees(way.heading) % 360
        neighbour = parts.get(way.to, point.polygon)
        gap = neighbour.distance(point.polygon)
        if gap > TOUCH:
            yield SiteProblem(
                point.id,
                "exit-touches",
                f"expected an exit to a neighbour, got {way.to!r}, {gap:.2f} m away",
            )
        if not is_free(point.polygon, way.heading, floor):
            yield SiteProblem(
                point.id,
                "exit-heading",
                f"expected floor along the exit to {way.to!r}, got a wall within "
                f"{reach:.1f} m of the middle at heading {degrees:.0f} degrees",
            )
        for other in point.exits[:index]:
            if abs(turn_between(way.heading, other.heading)) < SAME_EXIT:
                yield SiteProblem(
                    point.id,
                    "exit-apart",
                    "expected exits at least 20 degrees apart, got "
                    f"{way.to!r} and {other.to!r} near {degrees:.0f} degrees",
                    "warning",
                )


def thing_findings(site: Site, floor: Polygon) -> Iterator[SiteProblem]:
    """Find what is wrong with rooms, doors and landmarks."""
    rooms = {room.id: room.polygon for room in site.rooms}
    for room in site.rooms:
        covered = room.polygon.intersection(floor).area
        if covered > ROOM_ON_FLOOR:
            yield SiteProblem(
                room.id,
                "room-beside-floor",
                f"expected a room beside the walkable floor, got {covered:.2f} m² of "
                "floor inside it",
            )
    boundary = floor.boundary
    band = boundary.buffer(DOOR_OFF_WALL)
    for door in site.doors:
        yield from _door(door, rooms, band)
    room_for_obstacles = floor.buffer(OBSTACLE_IN_WALL)
    for landmark in site.landmarks:
        yield from _landmark(landmark, floor, room_for_obstacles)


def _door(
    door: Door, rooms: dict[str, Polygon], band: Polygon
) -> Iterator[SiteProblem]:
    if not band.covers(door.line):
        middle = door.line.centroid
        yield SiteProblem(
            door.id,
            "door-on-wall",
            "expected a door on the boundary of the walkable floor, got one off it "
            f"near ({middle.x:.2f}, {middle.y:.2f}); move both ends onto the wall",
        )
    low, high = DOOR_WIDTHS
    if not low <= round(door.line.length, 3) <= high:
        yield SiteProblem(
            door.id,
            "door-width",
            f"expected a width of {low} to {high} m, got {door.line.length:.2f} m",
            "warning",
        )
    if door.room in rooms:
        gap = rooms[door.room].distance(door.line)
        if gap > ROOM_OFF_DOOR:
            yield SiteProblem(
                door.id,
                "door-at-room",
                f"expected its room within {ROOM_OFF_DOOR} m, got {door.room!r}, "
                f"{gap:.2f} m away",
            )


def _landmark(
    thing: Landmark, floor: Polygon, room_for_obstacles: Polygon
) -> Iterator[SiteProblem]:
    if thing.mount == "floor" and floor.distance(thing.position) > THING_OFF_FLOOR:
        yield SiteProblem(
            thing.id,
            "landmark-on-floor",
            "expected a thing that stands on the walkable floor, got its middle "
            f"{floor.distance(thing.position):.2f} m outside it",
        )
    if thing.mount == "wall":
        yield from _wall_mounted(thing, floor)
    if (
        thing.obstacle
        and thing.mount == "floor"
        and not room_for_obstacles.covers(thing.footprint)
    ):
        inside = thing.footprint.difference(floor).area
        yield SiteProblem(
            thing.id,
            "landmark-inside-walls",
            "expected an obstacle in front of the wall, got one that reaches more "
            f"than {OBSTACLE_IN_WALL} m into it, with {inside:.2f} m²",
        )
    if thing.obstacle and thing.mount == "ceiling":
        yield SiteProblem(
            thing.id,
            "landmark-overhead",
            "expected a ceiling-mounted thing to be no obstacle, got obstacle true; the "
            "robot will drive round the floor below it",
            "warning",
        )


def _wall_mounted(thing: Landmark, floor: Polygon) -> Iterator[SiteProblem]:
    gap = floor.boundary.distance(thing.footprint)
    if gap > MOUNTED_OFF_WALL:
        yield SiteProblem(
            thing.id,
            "landmark-on-wall",
            f"expected a wall-mounted thing within {MOUNTED_OFF_WALL} m of a wall, got "
            f"{gap:.2f} m",
        )
    ahead = thing.size[1] / 2 + FREE_IN_FRONT
    front = Point(
        thing.position.x + ahead * math.cos(thing.heading),
        thing.position.y + ahead * math.sin(thing.heading),
    )
    if not floor.contains(front):
        yield SiteProblem(
            thing.id,
            "landmark-faces-floor",
            "expected a wall-mounted thing whose front faces the floor, got heading "
            f"{math.degrees(thing.heading) % 360:.0f} degrees, which faces into a wall",
        )
