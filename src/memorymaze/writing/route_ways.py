"""Ways between turning points, and those along the lines of routes."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from shapely import LineString, Point, Polygon
from shapely.ops import substring

from memorymaze.errors import SitePlanError
from memorymaze.geometry.pose import heading_to
from memorymaze.sites.records import Route


class Way(NamedTuple):
    """A way out of a turning point, up to the next one."""

    heading: float
    """Radians."""
    line: tuple[tuple[float, float], ...]
    """From where it leaves to where it ends, metres."""
    end: str | None
    """Turning point it leads to; None where it ends without one."""


def carried_on(way: Way, guess: Way) -> Way:
    """Return a route's last way with what lies beyond the goal."""
    if way.end is not None:
        return way
    beyond = math.dist(way.line[0], guess.line[-1])
    if beyond <= math.dist(way.line[0], way.line[-1]):
        return way
    return Way(way.heading, (*way.line, guess.line[-1]), guess.end)


def overlaps(line: LineString, polygon: Polygon) -> list[tuple[float, float]]:
    """Return the stretches of a line inside a polygon, metres along it."""
    inside = line.intersection(polygon)
    parts = [inside] if isinstance(inside, LineString) else getattr(inside, "geoms", [])
    spans = sorted(
        tuple(
            sorted((
                line.project(Point(p.coords[0])),
                line.project(Point(p.coords[-1])),
            ))
        )
        for p in parts
        if isinstance(p, LineString) and p.length > 0.05
    )
    joined: list[tuple[float, float]] = []
    for start, end in spans:
        if joined and start - joined[-1][1] < 0.1:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((start, end))
    return joined


def route_ways(
    route: Route, passed: Sequence[tuple[float, str]]
) -> Iterator[tuple[str | None, Way]]:
    """Yield the ways along a route: from its start, then from each turning point."""
    stops = [(0.0, None), *passed, (route.line.length, None)]
    for (start, name), (end, following) in pairwise(stops):
        if end - start < 0.05:
            if name is None and following is not None:
                x, y = route.line.coords[0][:2]
                yield None, Way(route.start_heading, ((x, y), (x, y)), following)
            continue
        piece = substring(route.line, start, end)
        if not isinstance(piece, LineString):
            raise SitePlanError(f"route {route.id}: expected a line, got a point")
        line = tuple((float(x), float(y)) for x, y, *_ in piece.coords)
        # A turn's bend may lie beyond the middle of its polygon.
        longest = max(pairwise(line), key=lambda leg: math.dist(*leg))
        yield name, Way(heading_to(*longest), line, following)
