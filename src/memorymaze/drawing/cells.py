"""A plan as cells of a terminal: which are solid, and which cell a place is in."""

import math
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from shapely import contains_xy, get_coordinates, segmentize, union_all

from memorymaze.drawing.shapes import plan_bounds, plan_shapes
from memorymaze.sites import Site

MARGIN = 2.0
"""Metres shown round the plan."""
WALL = 0.6
"""Metres that walls are drawn thick at least."""
SAMPLES = 3
"""Places looked at per half of a cell, each way."""
SOLID_SHARE = 0.6
"""Of these, from which on it counts as solid."""


class Extent(NamedTuple):
    """A part of a plan, metres."""

    west: float
    south: float
    east: float
    north: float

    def holds(self, x: float, y: float) -> bool:
        """Whether a place is in it, and not at its very edge."""
        return self.west + 1 < x < self.east - 1 and self.south + 1 < y < self.north - 1


@dataclass(frozen=True, slots=True, eq=False)
class CellMap:
    """A plan in a grid of half cells, each as high as it is wide."""

    solid: NDArray[np.bool_]
    """Walls and rooms, (2 * rows, columns); the first row is the northernmost."""
    metres: float
    """Width of a cell."""
    west: float
    north: float

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """Return row and column of the cell that a place is in, maybe outside."""
        return (
            math.floor((self.north - y) / (2 * self.metres)),
            math.floor((x - self.west) / self.metres),
        )


def plan_extent(site: Site) -> Extent:
    """Return the extent of a whole plan."""
    return Extent(*plan_bounds(site, MARGIN))


def cell_map(site: Site, extent: Extent, columns: int, rows: int) -> CellMap:
    """Fit a part of a plan into the cells of a terminal; it is in their middle."""
    wide, high = extent.east - extent.west, extent.north - extent.south
    metres = max(wide / columns, high / (2 * rows))
    west = (extent.west + extent.east - columns * metres) / 2
    north = (extent.south + extent.north + 2 * rows * metres) / 2
    within = (np.arange(SAMPLES) + 0.5) / SAMPLES
    xs = west + metres * (np.arange(columns)[:, np.newaxis] + within).ravel()
    ys = north - metres * (np.arange(2 * rows)[:, np.newaxis] + within).ravel()
    x, y = np.meshgrid(xs, ys)
    floor = site.walkable_floor
    thick = max(WALL, metres)
    shapes = plan_shapes(site)
    rooms = chain.from_iterable(s.polygons for s in shapes if s.kind == "room")
    built = union_all([*rooms, floor.buffer(thick)])
    solid = contains_xy(built, x, y) & ~contains_xy(floor, x, y)
    shape = (2 * rows, SAMPLES, columns, SAMPLES)
    shares = solid.reshape(shape).mean(axis=(1, 3))
    cells = CellMap(shares > SOLID_SHARE, metres, west, north)
    _open_ways(cells, site)
    return cells


def _open_ways(cells: CellMap, site: Site) -> None:
    """Clear what lies on a corridor's middle, however narrow it is on this scale."""
    lines = [corridor.centre_line for corridor in site.corridors]
    lines += [route.line for route in site.routes]
    for line in lines:
        for x, y in get_coordinates(segmentize(line, cells.metres / 2)).tolist():
            row = math.floor((cells.north - y) / cells.metres)
            column = math.floor((x - cells.west) / cells.metres)
            if 0 <= row < len(cells.solid) and 0 <= column < cells.solid.shape[1]:
                cells.solid[row, column] = False
