"""Which piece of the walkable floor has the surfaces of which area or corridor."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from shapely import MultiPolygon, Polygon, affinity, box, prepare
from shapely.geometry.base import BaseGeometry

from memorymaze.world.sites.records import Area, Corridor, Site, TurningPoint

SMALLEST = 1e-4
"""Square metres below which a left-over piece is dropped."""


class SurfacePiece(NamedTuple):
    """A piece of floor that no other overlaps."""

    id: str
    """Of the area, corridor or turning point it is a piece of."""
    source: Area | Corridor
    """Whose surfaces it has."""
    polygon: Polygon


def surface_pieces(site: Site) -> Iterator[SurfacePiece]:
    """Cut the walkable floor into pieces: areas first, then corridors, then the rest."""
    taken: BaseGeometry = Polygon()
    sources: list[Area | Corridor] = [*site.areas, *site.corridors]
    for source in sources:
        rest = source.polygon.difference(taken)
        taken = taken.union(source.polygon)
        for piece in polygons_of(rest):
            yield SurfacePiece(source.id, source, piece)
    for point in site.turning_points:
        rest = point.polygon.difference(taken)
        taken = taken.union(point.polygon)
        for piece in polygons_of(rest):
            yield SurfacePiece(point.id, _nearest(point, sources), piece)


def polygons_of(shape: BaseGeometry) -> Iterator[Polygon]:
    """Yield the polygons of a shape that are more than a sliver."""
    if isinstance(shape, Polygon):
        if shape.area > SMALLEST:
            yield shape
    elif isinstance(shape, MultiPolygon) or hasattr(shape, "geoms"):
        for piece in shape.geoms:  # pyright: ignore[reportAttributeAccessIssue]
            yield from polygons_of(piece)


def cut_up(
    polygon: Polygon, longest: float, heading: float, origin: tuple[float, float]
) -> Iterator[Polygon]:
    """Yield a polygon in pieces of at most so many metres along and across a heading."""
    turned = affinity.rotate(polygon, -heading, origin=origin, use_radians=True)
    prepare(turned)
    west, south, east, north = turned.bounds
    columns = max(1, math.ceil((east - west) / longest))
    rows = max(1, math.ceil((north - south) / longest))
    wide, high = (east - west) / columns, (north - south) / rows
    for column in range(columns):
        for row in range(rows):
            x, y = west + column * wide, south + row * high
            piece = turned.intersection(box(x, y, x + wide, y + high))
            for each in polygons_of(piece):
                yield affinity.rotate(each, heading, origin=origin, use_radians=True)


def _nearest(
    point: TurningPoint, sources: Sequence[Area | Corridor]
) -> Area | Corridor:
    if not sources:
        return Area(point.id, point.polygon, None, "tile", "plaster", open_air=False)
    return min(
        sources,
        key=lambda each: (
            each.polygon.distance(point.polygon),
            -each.polygon.intersection(point.polygon).area,
        ),
    )
