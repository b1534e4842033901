"""What floors are covered with, as things that a camera sees: carpet, tiles, wood."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from shapely import Polygon, contains_xy

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import heading_to
from memorymaze.robot.perception.camera_view import ObjectDescription
from memorymaze.world.sites.floor_surfaces import cut_up, surface_pieces
from memorymaze.world.sites.records import Corridor, Site

PIECE = 3.0
"""Longest edge of a piece of floor that is seen as one thing, metres."""
TILE = 0.5
"""Metres between the points that cover a piece, at most."""
FEWEST = 2
"""Points along each edge."""
_CALLED = {"carpet": "carpet", "linoleum": "linoleum", "tile": "tiles"}
"""What people call a floor of some material without saying that it is a floor."""


class CoveredPiece(NamedTuple):
    """A piece of floor with one covering."""

    description: ObjectDescription
    centre: FloatArray
    """Metres, (3,)."""
    half_size: FloatArray
    """Half the extent of the box around it, along the axes of the plan, metres, (3,)."""
    points: FloatArray
    """Middles of the tiles that cover it, metres, (N, 3)."""
    half_tile: FloatArray
    """Half the edges of a tile, metres, (2,)."""


def covered_pieces(site: Site) -> Iterator[CoveredPiece]:
    """Yield the floor of a site in pieces.

    Where a landmark lies that is a covering itself, that is seen.
    """
    laid = [
        each.footprint for each in site.landmarks if each.category.endswith(" floor")
    ]
    for _, source, polygon in surface_pieces(site):
        if any(polygon.intersects(each) for each in laid):
            continue
        described, heading = describe_covering(source.floor_material), 0.0
        if isinstance(source, Corridor):
            (ax, ay), (bx, by) = source.centre_line.coords
            heading = heading_to((ax, ay), (bx, by))
        for piece in cut_up(polygon, PIECE, heading, (0.0, 0.0)):
            yield _piece(described, piece)


def describe_covering(material: str) -> ObjectDescription:
    """Return how people could name a floor."""
    return ObjectDescription(
        f"{material} floor", material=material, name=_CALLED.get(material)
    )


def is_floor_piece(description: ObjectDescription) -> bool:
    """Tell whether it is of a piece of floor, and of no thing that lies on it."""
    return description.material is not None and description == describe_covering(
        description.material
    )


def _piece(described: ObjectDescription, polygon: Polygon) -> CoveredPiece:
    west, south, east, north = polygon.bounds
    xs, ys = _middles(west, east), _middles(south, north)
    x, y = (each.ravel() for each in np.meshgrid(xs, ys))
    inside = contains_xy(polygon, x, y)
    if not inside.any():
        middle = polygon.representative_point()
        x, y, inside = np.array([middle.x]), np.array([middle.y]), np.array([True])
    points = np.stack([x[inside], y[inside], np.zeros(int(inside.sum()))], axis=1)
    return CoveredPiece(
        described,
        np.array([(west + east) / 2, (south + north) / 2, 0.0]),
        np.array([(east - west) / 2, (north - south) / 2, 0.0]),
        points,
        np.array([(east - west) / len(xs) / 2, (north - south) / len(ys) / 2]),
    )


def _middles(start: float, end: float) -> FloatArray:
    count = max(math.ceil((end - start) / TILE), FEWEST)
    return start + (np.arange(count, dtype=np.float64) + 0.5) * (end - start) / count
