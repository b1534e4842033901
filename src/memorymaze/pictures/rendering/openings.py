"""What is open or glazed in the walls, and what lies behind it; plain geometry."""

import math
from dataclasses import dataclass
from typing import Literal

from shapely import LineString, Point, prepare
from shapely.geometry.base import BaseGeometry

from memorymaze.pictures.looks.doors import is_seen_through as door_is_seen_through
from memorymaze.pictures.looks.windows import is_window
from memorymaze.simulation.solids import door_solid, landmark_solid
from memorymaze.sites.records import Site

Behind = Literal["outdoors", "room"]

DEEPEST = 2.6
"""Metres that a room is seen deep."""
SHALLOWEST = 0.12
DOUBLE_WALL = 0.8
"""Between floors nearer than this there is wall, not open air, metres."""


@dataclass(frozen=True, slots=True)
class Opening:
    """A rectangle in a wall that is not wall."""

    x: float
    """Middle, metres."""
    y: float
    """Middle, metres."""
    heading: float
    """Across the wall, to either side, radians."""
    half_width: float
    """Metres."""
    bottom: float
    """Metres over the floor."""
    top: float
    """Metres over the floor."""


def openings_of(site: Site) -> list[Opening]:
    """Return where windows, glazed doors and open doors break the walls."""
    openings: list[Opening] = []
    for door in site.doors:
        if door_is_seen_through(door):
            solid = door_solid(door, site)
            x, y, _ = solid.position
            _, half, half_height = solid.half_size
            openings.append(
                Opening(x, y, solid.heading, half - 0.02, 0.0, 2 * half_height - 0.02)
            )
    for landmark in site.landmarks:
        if is_window(landmark):
            solid = landmark_solid(landmark, site)
            x, y, z = solid.position
            _, half, half_height = solid.half_size
            openings.append(
                Opening(
                    x,
                    y,
                    solid.heading,
                    half - 0.03,
                    z - half_height + 0.03,
                    z + half_height - 0.03,
                )
            )
    return openings


class Surroundings:
    """Tells what is behind a place on a wall."""

    def __init__(self, site: Site) -> None:
        """Look at a site's rooms and floor."""
        self._floor: BaseGeometry = site.walkable_floor
        self._rooms = [room.polygon for room in site.rooms]
        self._holes = self._floor.convex_hull.difference(self._floor)
        self._site = site
        prepare(self._floor)

    def behind(self, x: float, y: float, heading: float) -> tuple[Behind, float]:
        """Return what is behind a wall, and how many metres deep one can look into it."""
        dx, dy = math.cos(heading), math.sin(heading)
        near = Point(x + 0.5 * dx, y + 0.5 * dy)
        ray = LineString([
            (x + 0.08 * dx, y + 0.08 * dy),
            (x + 12 * dx, y + 12 * dy),
        ])
        crossed = ray.intersection(self._floor)
        way = 12.0
        if not crossed.is_empty:
            way = crossed.distance(Point(x, y))
        if any(room.contains(near) for room in self._rooms):
            return "room", max(SHALLOWEST, min(DEEPEST, way - 0.12))
        if way < DOUBLE_WALL:
            return "room", max(SHALLOWEST, min(DEEPEST, way - 0.12))
        return "outdoors", way
