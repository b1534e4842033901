"""Rules of rooms, doors and landmarks."""

import math
from collections.abc import Iterator

from shapely import Point, Polygon

from memorymaze.sites.problems import Finding
from memorymaze.sites.records import Door, Landmark, Site

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


def thing_findings(site: Site, floor: Polygon) -> Iterator[Finding]:
    """Find what is wrong with rooms, doors and landmarks."""
    rooms = {room.id: room.polygon for room in site.rooms}
    for room in site.rooms:
        covered = room.polygon.intersection(floor).area
        if covered > ROOM_ON_FLOOR:
            yield Finding(
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


def _door(door: Door, rooms: dict[str, Polygon], band: Polygon) -> Iterator[Finding]:
    if not band.covers(door.line):
        middle = door.line.centroid
        yield Finding(
            door.id,
            "door-on-wall",
            "expected a door on the boundary of the walkable floor, got one off it "
            f"near ({middle.x:.2f}, {middle.y:.2f}); move both ends onto the wall",
        )
    low, high = DOOR_WIDTHS
    if not low <= round(door.line.length, 3) <= high:
        yield Finding(
            door.id,
            "door-width",
            f"expected a width of {low} to {high} m, got {door.line.length:.2f} m",
            "warning",
        )
    if door.room in rooms:
        gap = rooms[door.room].distance(door.line)
        if gap > ROOM_OFF_DOOR:
            yield Finding(
                door.id,
                "door-at-room",
                f"expected its room within {ROOM_OFF_DOOR} m, got {door.room!r}, "
                f"{gap:.2f} m away",
            )


def _landmark(
    thing: Landmark, floor: Polygon, room_for_obstacles: Polygon
) -> Iterator[Finding]:
    if thing.mount == "floor" and floor.distance(thing.position) > THING_OFF_FLOOR:
        yield Finding(
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
        yield Finding(
            thing.id,
            "landmark-inside-walls",
            "expected an obstacle in front of the wall, got one that reaches more "
            f"than {OBSTACLE_IN_WALL} m into it, with {inside:.2f} m²",
        )
    if thing.obstacle and thing.mount == "ceiling":
        yield Finding(
            thing.id,
            "landmark-overhead",
            "expected a ceiling-mounted thing to be no obstacle, got obstacle true; the "
            "robot will drive round the floor below it",
            "warning",
        )


def _wall_mounted(thing: Landmark, floor: Polygon) -> Iterator[Finding]:
    gap = floor.boundary.distance(thing.footprint)
    if gap > MOUNTED_OFF_WALL:
        yield Finding(
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
        yield Finding(
            thing.id,
            "landmark-faces-floor",
            "expected a wall-mounted thing whose front faces the floor, got heading "
            f"{math.degrees(thing.heading) % 360:.0f} degrees, which faces into a wall",
        )
