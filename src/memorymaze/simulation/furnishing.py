"""How doors and landmarks stand in the room: boxes of their true size.

- Floor: on the floor.
- Ceiling: the lower edge at 2.3 m where that fits under the ceiling; otherwise the
  upper edge at the ceiling.
- Wall: the middle at 1.5 m, moved so that it keeps 0.1 m from floor and ceiling where
  its size allows. What hangs over a door has its lower edge 5 cm above the door. A
  wall item that is an obstacle (a drinking fountain) stands on the floor.
- Doors: 2.1 m high leaves that stand out of the wall by 2 cm, open or closed.
"""

import math
from typing import NamedTuple

from shapely import LineString

from memorymaze.sites.records import Door, Landmark, Site

DOOR_HEIGHT = 2.1
DOOR_PROUD = 0.02
HANGING_HEIGHT = 2.3
EYE_LEVEL = 1.5
EDGE_GAP = 0.1
OVER_DOOR_GAP = 0.05


class Solid(NamedTuple):
    """An upright box."""

    position: tuple[float, float, float]
    """Centre, metres."""
    half_size: tuple[float, float, float]
    """Half its depth, its length across the front and its height, metres."""
    heading: float
    """The way its front faces, radians."""


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
