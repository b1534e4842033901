"""Walls as boxes along the boundary of a floor; plain geometry, no physics engine."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from shapely import Polygon
from shapely.geometry.polygon import orient

WALL_THICKNESS = 0.1
"""Metres; all of it stands outside the floor."""


@dataclass(frozen=True, slots=True)
class Wall:
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


def walls_around(floor: Polygon) -> list[Wall]:
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


def _walls_along(corners: list[tuple[float, float]], ring: int) -> Iterator[Wall]:
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
        yield Wall(
            x=ax + ux * middle + uy * WALL_THICKNESS / 2,
            y=ay + uy * middle - ux * WALL_THICKNESS / 2,
            half_length=(end - start) / 2,
            half_thickness=WALL_THICKNESS / 2,
            heading=math.atan2(uy, ux),
            ring=ring,
        )
