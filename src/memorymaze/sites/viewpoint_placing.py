"""Where the viewpoints of a navigation graph stand; joining them is done elsewhere."""

import math
from itertools import combinations, pairwise

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon
from shapely.ops import nearest_points

from memorymaze.sites.records import Area, Site

FloatArray = NDArray[np.float64]

APART = 0.6
"""Metres: a viewpoint nearer than this to another one is not set."""
SHIFT = 1.5
"""Metres a viewpoint is moved to get off an obstacle or a wall."""


def place_viewpoints(site: Site, standing: Polygon, spacing: float) -> FloatArray:
    """Choose places in all turning points, on all centre lines, and in all areas.

    Args:
        site: Where.
        standing: Floor on which the robot's middle can be, in one piece; metres.
        spacing: Metres along centre lines and across areas, at most.

    Returns:
        Metres, shape (N, 2), in an order that only depends on the site.
    """
    places = _Places(standing)
    for point in site.turning_points:
        places.add(point.polygon.centroid)
    ways = [corridor.centre_line for corridor in site.corridors]
    for one, other in combinations(ways, 2):
        crossing = one.intersection(other)
        if isinstance(crossing, Point) and not crossing.is_empty:
            places.add(crossing)
    for way in ways:
        _along(way, places, spacing)
    for area in site.areas:
        _across(area, places, spacing)
    if not places.points:
        places.add(standing.representative_point())
    return np.array(places.points)


class _Places:
    """Viewpoints set so far."""

    def __init__(self, standing: Polygon) -> None:
        self.standing = standing
        self.points: list[tuple[float, float]] = []
        shapely.prepare(standing)

    def add(self, wanted: Point, apart: float = APART) -> None:
        """Set a viewpoint at or near a point, unless one is there or none can be."""
        spot = wanted
        if not self.standing.covers(spot):
            spot = nearest_points(self.standing, wanted)[0]
            if spot.distance(wanted) > SHIFT:
                return
        if all(math.dist((spot.x, spot.y), other) >= apart for other in self.points):
            self.points.append((spot.x, spot.y))


def _along(way: LineString, places: _Places, spacing: float) -> None:
    """Fill the gaps between viewpoints on a centre line."""
    end_gap = min(APART, way.length / 2)
    stations = {end_gap, way.length - end_gap}
    stations |= {
        way.project(Point(place))
        for place in places.points
        if way.distance(Point(place)) < APART
    }
    ordered = sorted(stations)
    for station in (ordered[0], ordered[-1]):
        places.add(way.interpolate(station))
    for start, end in pairwise(ordered):
        steps = math.ceil((end - start) / spacing - 1e-9)
        for step in range(1, steps):
            places.add(way.interpolate(start + (end - start) * step / steps))


def _across(area: Area, places: _Places, spacing: float) -> None:
    """Set a lattice of viewpoints along the area's longer and shorter direction."""
    frame = area.polygon.minimum_rotated_rectangle
    corners = (
        np.array(frame.exterior.coords)[:4] if isinstance(frame, Polygon) else None
    )
    if corners is None:
        return
    origin, first, second = corners[0], corners[1] - corners[0], corners[3] - corners[0]
    shares = [
        (np.arange(count) + 0.5) / count
        for side in (first, second)
        if (count := max(1, math.ceil(float(np.hypot(*side)) / spacing)))
    ]
    for along in shares[0]:
        for across in shares[1]:
            spot = Point(origin + along * first + across * second)
            if area.polygon.covers(spot):
                places.add(spot, apart=spacing / 2)
