"""The floor that a robot can drive on, from what it knows of each cell.

Specks are taken for noise. Shapes are in metres in the map's frame.
"""

import math
from dataclasses import dataclass
from typing import cast

import contourpy
import numpy as np
import shapely
from numpy.typing import NDArray
from scipy import ndimage
from shapely import LineString, Polygon
from shapely.affinity import translate

from memorymaze.basics.errors import ImportFileError
from memorymaze.world.importing.occupancy import Cells, OccupancyGrid
from memorymaze.world.sites.floor_rules import PASSABLE_RADIUS

LARGEST_SPECK = 0.02
"""Square metres of what is not free amid free floor that is taken for noise."""
BACK_TO_WALL = 1.5
"""Radii of the robot beside where its middle can be that are floor: its corners too."""
SMOOTHING = 1.0
"""Cells over which the steps of an edge are smoothed."""
NEAR_WALL = 0.3
"""Metres from the floor's edge to cells known as wall."""
SHORTEST_GAP = 1.0
"""Metres of the floor's edge without a wall that are worth a word."""

_Contours = tuple[list[NDArray[np.float64]], list[NDArray[np.uint32]]]
"""Points of polygons, and where the rings of each begin among them."""


@dataclass(frozen=True)
class DrawnFloor:
    """The largest connected floor, as it is drawn by the cells."""

    floor: Polygon
    """With everything that stands on it as holes."""
    left_out: float
    """Square metres of free cells that the robot does not reach."""
    specks: int
    """Bits of noise that were taken for floor."""
    gaps: tuple[LineString, ...]
    """Stretches of the floor's edge beyond which nothing is known."""


def free_space(grid: OccupancyGrid, radius: float = PASSABLE_RADIUS) -> DrawnFloor:
    """Return the largest floor that a robot of a radius drives over."""
    rows, columns = np.nonzero(grid.free)
    if not len(rows):
        raise ImportFileError("expected free cells, got none; look at the thresholds")
    beside = math.ceil(NEAR_WALL / grid.resolution)
    south, west = max(rows.min() - beside, 0), max(columns.min() - beside, 0)
    window = (
        slice(south, rows.max() + 1 + beside),
        slice(west, columns.max() + 1 + beside),
    )
    largest_speck = LARGEST_SPECK / grid.resolution**2
    free, specks = _without_specks(np.pad(grid.free[window], 1), largest_speck)
    reach = radius / grid.resolution
    labels = _labelled(_depth(free) > reach)
    if not labels.any():
        raise ImportFileError(
            f"expected floor for a robot of {radius:g} m radius, got free cells that are "
            "nowhere wide enough; look at the resolution"
        )
    largest = labels == 1 + int(np.bincount(labels.ravel())[1:].argmax())
    reached = free & (_depth(~largest) < BACK_TO_WALL * reach)
    outline = _outline(reached, largest_speck)
    gaps = _gaps(outline, np.pad(grid.occupied[window], 1), grid.resolution)
    return DrawnFloor(
        grid.in_map(translate(outline, west - 1, south - 1)),
        float((free & ~reached).sum()) * grid.resolution**2,
        specks,
        tuple(grid.in_map(translate(gap, west - 1, south - 1)) for gap in gaps),
    )


def _without_specks(free: Cells, largest: float) -> tuple[Cells, int]:
    """Return free cells with the specks amid them, and how many there were."""
    labels = _labelled(~free)
    is_speck = np.bincount(labels.ravel()) <= largest
    is_speck[0] = False
    return free | is_speck[labels], int(is_speck.sum())


def _outline(cells: Cells, least: float) -> Polygon:
    """Return the cells' shape, its steps smoothed over, with holes of a size at least."""
    generator = contourpy.contour_generator(
        z=np.asarray(ndimage.gaussian_filter(cells.astype(np.float64), SMOOTHING)),
        fill_type=contourpy.FillType.OuterOffset,
    )
    rings, marks = cast(_Contours, generator.filled(0.5, np.inf))
    shapes: list[Polygon] = []
    for ring, starts in zip(rings, marks, strict=True):
        # Contours run through the middles of cells.
        outer, *holes = np.split(ring + 0.5, starts[1:-1])
        shapes += shapely.get_parts(Polygon(outer, holes).buffer(0)).tolist()
    largest = max(shapes, key=lambda shape: shape.area)
    holes = [hole for hole in largest.interiors if Polygon(hole).area > least]
    return Polygon(largest.exterior, holes)


def _gaps(outline: Polygon, known: Cells, resolution: float) -> list[LineString]:
    """Return the long stretches of the outer edge that have no wall beside them."""
    edge = shapely.get_coordinates(shapely.segmentize(outline.exterior, 1.0))
    rows, columns = np.clip(edge[:, ::-1].astype(int), 0, np.array(known.shape) - 1).T
    bare = _depth(~known)[rows, columns] > NEAR_WALL / resolution
    steps = np.stack([edge[:-1], edge[1:]], axis=1)[bare[:-1] & bare[1:]]
    whole = shapely.line_merge(shapely.MultiLineString(list(steps)))
    return [
        stretch
        for stretch in shapely.get_parts(whole).tolist()
        if stretch.length >= SHORTEST_GAP / resolution
    ]


def _depth(cells: Cells) -> NDArray[np.float64]:
    """Return how many cells it is from each to the nearest that is false."""
    return np.asarray(ndimage.distance_transform_edt(cells), dtype=np.float64)


def _labelled(cells: Cells) -> NDArray[np.int32]:
    """Return the numbers from 1 of the connected pieces; 0 is outside."""
    labels = ndimage.label(cells, structure=np.ones((3, 3)))
    return cast(tuple[NDArray[np.int32], int], labels)[0]
