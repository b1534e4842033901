"""Walls, doors and landmarks as boxes of their true size; plain geometry, no physics engine.

- Walls stand outside the floor, along its boundary, up to the ceiling; round a hole over
  which something hangs from the ceiling (a globe in an atrium) only a balustrade stands.
- What stands on the floor: on the floor.
- What hangs from the ceiling: the lower edge at 2.3 m where that fits under the ceiling;
  otherwise the upper edge at the ceiling.
- What hangs on a wall: the middle at 1.5 m, moved so that it keeps 0.1 m from floor and
  ceiling where its size allows. What hangs over a door has its lower edge 5 cm above the
  door. A wall item that is an obstacle (a drinking fountain) stands on the floor.
- Doors: 2.1 m high leaves that stand out of the wall by 2 cm, open or closed.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from shapely import LineString, Polygon
from shapely.geometry.polygon import orient

from memorymaze.world.sites.records import Door, Landmark, Site

WALL_THICKNESS = 0.1
"""Metres; all of it stands outside the floor."""
BALUSTRADE_HEIGHT = 1.1
"""Height in metres of the wall round a hole over which something hangs."""
DOOR_HEIGHT = 2.1
DOOR_PROUD = 0.02
HANGING_HEIGHT = 2.3
EYE_LEVEL = 1.5
EDGE_GAP = 0.1
OVER_DOOR_GAP = 0.05


@dataclass(frozen=True, slots=True)
class _Wall:
    """A straight piece of wall, a box on the ground plane."""

    x: float
    """Centre, metres."""
    y: float
    """Centre, metres."""
    half_length: float
    """Metres along the wall."""
    half_thickness: float
    """Metres across the wall."""
    heading: float
    """Along the wall, radians."""
    ring: int
    """0 on the floor's outer boundary, n on the boundary of its n-th hole."""
    face: LineString
    """Its side to the floor."""


def walls_around(floor: Polygon) -> list[_Wall]:
    """Return one wall per straight edge of the floor's boundary and of its holes.

    The walls' inner faces lie exactly on the boundary. Where the floor's corner is
    convex the walls reach past it by their thickness, so that no ray slips between.
    """
    turned = orient(floor)
    rings = [turned.exterior, *turned.interiors]
    return [
        wall
        for number, ring in enumerate(rings)
        for wall in _walls_along([(x, y) for x, y, *_ in ring.coords[:-1]], number)
    ]


def _walls_along(corners: list[tuple[float, float]], ring: int) -> Iterator[_Wall]:
    # Oriented rings keep the floor on their left.
    count = len(corners)
    for i, (ax, ay) in enumerate(corners):
        bx, by = corners[(i + 1) % count]
        length = math.hypot(bx - ax, by - ay)
        ux, uy = (bx - ax) / length, (by - ay) / length
        before, after = corners[i - 1], corners[(i + 2) % count]
        start, end = 0.0, length
        if ux * (before[1] - ay) - uy * (before[0] - ax) > 0:
            start -= WALL_THICKNESS
        if ux * (after[1] - by) - uy * (after[0] - bx) > 0:
            end += WALL_THICKNESS
        middle = (start + end) / 2
        yield _Wall(
            x=ax + ux * middle + uy * WALL_THICKNESS / 2,
            y=ay + uy * middle - ux * WALL_THICKNESS / 2,
            half_length=(end - start) / 2,
            half_thickness=WALL_THICKNESS / 2,
            heading=math.atan2(uy, ux),
            ring=ring,
            face=LineString([(ax, ay), (bx, by)]),
        )


class Solid(NamedTuple):
    """An upright box."""

    position: tuple[float, float, float]
    """Centre, metres."""
    half_size: tuple[float, float, float]
    """Half its depth, its length across the front and its height, metres."""
    heading: float
    """The way its front faces, radians."""


def wall_solids(site: Site) -> Iterator[Solid]:
    """Yield the walls of a site: up to the ceiling, or balustrades round open holes."""
    open_rings = rings_with_things_above(site)
    for wall in walls_around(site.walkable_floor):
        height = site.ceiling_height
        if wall.ring in open_rings:
            height = BALUSTRADE_HEIGHT
        yield Solid(
            (wall.x, wall.y, height / 2),
            (wall.half_length, wall.half_thickness, height / 2),
            wall.heading,
        )


def rings_with_things_above(site: Site) -> set[int]:
    """Return the holes of the floor (1 is the first) over which something hangs."""
    hanging = [each.position for each in site.landmarks if each.mount == "ceiling"]
    holes = orient(site.walkable_floor).interiors
    return {
        number
        for number, hole in enumerate(holes, start=1)
        if any(Polygon(hole).contains(position) for position in hanging)
    }


def door_solid(door: Door, site: Site) -> Solid:
    """Return the leaf of a door, on both sides of the wall's face."""
    (ax, ay), (bx, by) = [point[:2] for point in door.line.coords]
    height = min(DOOR_HEIGHT, site.ceiling_height)
    return Solid(
        ((ax + bx) / 2, (ay + by) / 2, height / 2),
        (DOOR_PROUD, math.hypot(bx - ax, by - ay) / 2, height / 2),
        math.atan2(by - ay, bx - ax) + math.pi / 2,
    )


def landmark_solid(landmark: Landmark, site: Site) -> Solid:
    """Return the box of a landmark, at its height over the floor."""
    length, depth, height = landmark.size
    bottom = _bottom(landmark, site)
    return Solid(
        (landmark.position.x, landmark.position.y, bottom + height / 2),
        (depth / 2, length / 2, height / 2),
        landmark.heading,
    )


def _bottom(landmark: Landmark, site: Site) -> float:
    height, ceiling = landmark.size[2], site.ceiling_height
    if landmark.mount == "floor":
        return 0.0
    if landmark.mount == "ceiling":
        return min(HANGING_HEIGHT, ceiling - height)
    if landmark.obstacle:
        return 0.0
    over_door = DOOR_HEIGHT + OVER_DOOR_GAP
    if over_door + height <= ceiling and _hangs_over_a_door(landmark, site):
        return over_door
    return max(min(EYE_LEVEL - height / 2, ceiling - EDGE_GAP - height), EDGE_GAP)


def _hangs_over_a_door(landmark: Landmark, site: Site) -> bool:
    """Whether a door covers most of the item's width on the same wall."""
    length, depth, _ = landmark.size
    x, y = landmark.position.x, landmark.position.y
    across = (-math.sin(landmark.heading), math.cos(landmark.heading))
    front = LineString([
        (x + side * across[0] * length / 2, y + side * across[1] * length / 2)
        for side in (-1, 1)
    ])
    return any(
        door.line.distance(landmark.position) < depth + 0.3
        and front.intersection(
            door.line.buffer(depth / 2 + 0.3, cap_style="flat")
        ).length
        > length / 2
        for door in site.doors
    )
