"""Shapes that ways are made of: convex pieces around a place, and fitting strips."""

import math
from collections.abc import Callable
from typing import cast

import shapely
from shapely import MultiPoint, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import nearest_points

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import moved

HAIR = 1e-3
"""Metres below which nothing is told apart; plans have whole millimetres."""
MOST_CUTS = 200
"""Cuts that make a region convex; a round wall takes one per corner of it."""


def polygons(geometry: BaseGeometry) -> list[Polygon]:
    """Return the sound polygons in a geometry, with whole millimetres, largest first."""
    if geometry.is_empty:
        return []
    sound = geometry if geometry.is_valid else shapely.make_valid(geometry)
    # A geometry remembers its precision, and buffers of such ones can lose holes.
    rounded = shapely.set_precision(shapely.set_precision(sound, HAIR), 0)
    parts = shapely.get_parts(rounded).tolist()
    parts = [each for part in parts for each in shapely.get_parts(part).tolist()]
    found = [part for part in parts if isinstance(part, Polygon) and part.area > 0]
    return sorted(found, key=lambda part: (-part.area, part.bounds))


def strip(
    start: XY, heading: float, length: float, left: float, right: float
) -> Polygon:
    """Return the rectangle along a heading, so many metres to the left and the right."""
    end = moved(start, heading, length)
    across = heading + math.pi / 2
    return Polygon([
        moved(start, across, -right),
        moved(end, across, -right),
        moved(end, across, left),
        moved(start, across, left),
    ])


def furthest(fits: Callable[[float], bool], most: float) -> float:
    """Return the greatest number up to `most` that fits; 0 is taken to fit."""
    if fits(most):
        return most
    low, high = 0.0, most
    while high - low > HAIR:
        middle = (low + high) / 2
        low, high = (middle, high) if fits(middle) else (low, middle)
    return low


def convex_region(floor: Polygon, centre: XY, radius: float) -> Polygon | None:
    """Return a convex piece of floor around a place on it, up to a radius; else None.

    A disc is cut along the nearest wall inside it until there is none. The first cuts of
    Deits and Tedrake (2015, "Computing large convex regions of obstacle-free space").
    """
    middle = Point(centre)
    if not floor.contains(middle):
        return None
    region = middle.buffer(radius, quad_segs=4)
    for _ in range(MOST_CUTS):
        walls = floor.boundary.intersection(region.buffer(-HAIR))
        if walls.is_empty:
            corners = shapely.get_coordinates(region).round(3)
            hull = MultiPoint(corners).convex_hull
            return hull if isinstance(hull, Polygon) else None
        nearest = nearest_points(middle, walls)[1]
        gap = middle.distance(nearest)
        if gap < 10 * HAIR:
            return None
        heading = math.atan2(nearest.y - middle.y, nearest.x - middle.x)
        far = 3 * radius
        kept = strip(moved(centre, heading, gap - far), heading, far, far, far)
        region = cast(Polygon, region.intersection(kept))
    return None
