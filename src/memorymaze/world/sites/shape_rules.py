"""Rules of one part's own shape; breaking one refuses loading."""

import math
from itertools import pairwise

from shapely import LineString, Polygon, get_coordinates
from shapely.validation import explain_validity

from memorymaze.world.sites.problems import SiteProblem
from memorymaze.world.sites.records import (
    Area,
    Corridor,
    Door,
    PlanPart,
    Room,
    Route,
    TurningPoint,
)

SMALLEST_AREA = 0.01
"""A floor or room smaller than this many square metres is a slip of the pen."""
SHORTEST_LINE = 0.01
"""Metres."""
CONVEX_SLACK = 1e-6
"""Square metres a four-cornered corridor may lack of its hull."""


def shape_problem(part: PlanPart) -> SiteProblem | None:
    """Return what is wrong with the shape of a part, if anything is."""
    match part:
        case Corridor():
            return _polygon(part.id, part.polygon) or _four_corners(part)
        case Area() | TurningPoint() | Room():
            return _polygon(part.id, part.polygon)
        case Door() | Route():
            return _line(part.id, part.line)
        case _:
            return None


def _polygon(identity: str, polygon: Polygon) -> SiteProblem | None:
    if not polygon.is_valid:
        return SiteProblem(
            identity,
            "polygon-valid",
            "expected a simple polygon with its holes inside, got: "
            f"{explain_validity(polygon)}",
        )
    if polygon.area < SMALLEST_AREA:
        return SiteProblem(
            identity,
            "polygon-valid",
            f"expected an area of at least {SMALLEST_AREA} m², got {polygon.area:.2g} m²; "
            "coordinates are metres, not degrees of longitude and latitude",
        )
    return None


def _line(identity: str, line: LineString) -> SiteProblem | None:
    for first, second in pairwise((x, y) for x, y, *_ in line.coords):
        if math.dist(first, second) < SHORTEST_LINE:
            return SiteProblem(
                identity,
                "line-steps",
                f"expected positions at least {SHORTEST_LINE} m apart, got {first} and "
                f"{second}; remove one",
            )
    return None


def _four_corners(corridor: Corridor) -> SiteProblem | None:
    polygon = corridor.polygon
    places = get_coordinates(polygon.exterior).tolist()
    corners, holes = len(places) - 1, len(polygon.interiors)
    shortest = min(math.dist(*side) for side in pairwise(places))
    if holes or corners != 4 or shortest < SHORTEST_LINE:
        return SiteProblem(
            corridor.id,
            "corridor-four-corners",
            f"expected exactly 4 corners and no holes, got {corners} corners and "
            f"{holes} holes; split a bent corridor in two, or make it an area",
        )
    lacking = polygon.convex_hull.area - polygon.area
    if lacking > CONVEX_SLACK:
        return SiteProblem(
            corridor.id,
            "corridor-convex",
            f"expected a convex shape, got one that lacks {lacking:.3f} m² "
            "of its hull; move the corner that points inwards, or make it an area",
        )
    return None
