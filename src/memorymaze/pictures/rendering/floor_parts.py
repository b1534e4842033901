"""The walkable floor cut into parts that have one material and one direction each."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import MultiPolygon, Polygon, affinity, box, prepare
from shapely.geometry.base import BaseGeometry

from memorymaze.sites.records import Area, Corridor, Site, TurningPoint

BAY = 2.4
"""Metres between lamps; the pictures of floors, walls and ceilings repeat with it."""
SLICE = 6.0
"""Longest edge of the pieces into which parts are cut, metres."""
SMALLEST = 1e-4
"""Square metres below which a left-over piece is dropped."""


@dataclass(frozen=True, eq=False)
class FloorPart:
    """A piece of floor that no other part overlaps."""

    polygon: Polygon
    floor_material: str
    wall_material: str
    open_air: bool
    x: float
    """Where its pattern begins, metres."""
    y: float
    """Where its pattern begins, metres."""
    heading: float
    """Along which its pattern runs, radians."""
    width: float
    """Metres across the heading."""
    is_hall: bool
    """Whether it is an area or the middle of one, not a way."""

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points along and across the part's pattern, metres, (N, 2)."""
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        offsets = points - np.array([self.x, self.y])
        return offsets @ np.array([[cosine, -sine], [sine, cosine]])

    def world(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where points along and across the pattern lie in the world, (N, 2)."""
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        return points @ np.array([[cosine, sine], [-sine, cosine]]) + (self.x, self.y)


def floor_parts(site: Site) -> list[FloorPart]:
    """Cut the walkable floor into parts: areas first, then corridors, then the rest."""
    parts: list[FloorPart] = []
    taken: BaseGeometry = Polygon()
    sources: list[Area | Corridor] = [*site.areas, *site.corridors]
    for source in sources:
        rest = source.polygon.difference(taken)
        taken = taken.union(source.polygon)
        parts += [_part(source, piece) for piece in polygons_of(rest)]
    for point in site.turning_points:
        rest = point.polygon.difference(taken)
        taken = taken.union(point.polygon)
        model = _nearest(point, parts, sources)
        parts += [_part(model, piece) for piece in polygons_of(rest)]
    return parts


def polygons_of(shape: BaseGeometry) -> Iterator[Polygon]:
    """Yield the polygons of a shape that are more than a sliver."""
    if isinstance(shape, Polygon):
        if shape.area > SMALLEST:
            yield shape
    elif isinstance(shape, MultiPolygon) or hasattr(shape, "geoms"):
        for piece in shape.geoms:  # pyright: ignore[reportAttributeAccessIssue]
            yield from polygons_of(piece)


def sliced(part: FloorPart) -> Iterator[Polygon]:
    """Yield the part in pieces of at most `SLICE` by `SLICE`, along its own heading."""
    turned = affinity.rotate(
        part.polygon, -part.heading, origin=(part.x, part.y), use_radians=True
    )
    prepare(turned)
    west, south, east, north = turned.bounds
    columns = max(1, math.ceil((east - west) / SLICE))
    rows = max(1, math.ceil((north - south) / SLICE))
    wide, high = (east - west) / columns, (north - south) / rows
    for column in range(columns):
        for row in range(rows):
            x, y = west + column * wide, south + row * high
            piece = turned.intersection(box(x, y, x + wide, y + high))
            for polygon in polygons_of(piece):
                yield affinity.rotate(
                    polygon, part.heading, origin=(part.x, part.y), use_radians=True
                )


def _part(source: Area | Corridor, piece: Polygon) -> FloorPart:
    if isinstance(source, Corridor):
        (ax, ay), (bx, by) = source.centre_line.coords
        heading = math.atan2(by - ay, bx - ax)
        x, y, width = ax, ay, source.width
        # Lamps stand in the middles of bays: share the corridor's length evenly.
        spare = source.length % BAY
        x += math.cos(heading) * spare / 2
        y += math.sin(heading) * spare / 2
        open_air = False
    else:
        heading, width = _long_direction(source.polygon)
        x, y = source.polygon.centroid.coords[0]
        open_air = source.open_air
    return FloorPart(
        piece,
        source.floor_material,
        source.wall_material,
        open_air,
        x,
        y,
        heading,
        width,
        isinstance(source, Area),
    )


def _long_direction(polygon: Polygon) -> tuple[float, float]:
    """Return heading of the longest side, and the extent across it."""
    ring = np.array(polygon.exterior.coords)[:, :2]
    edges = np.diff(ring, axis=0)
    longest = edges[int(np.argmax(np.hypot(edges[:, 0], edges[:, 1])))]
    heading = math.atan2(longest[1], longest[0])
    across = ring @ np.array([-math.sin(heading), math.cos(heading)])
    return heading, float(across.max() - across.min())


def _nearest(
    point: TurningPoint, parts: list[FloorPart], sources: list[Area | Corridor]
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
