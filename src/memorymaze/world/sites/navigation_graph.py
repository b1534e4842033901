"""Navigation graphs in the manner of Room-to-Room (R2R), made from site plans.

Anderson et al. 2018, "Vision-and-Language Navigation" (CVPR): viewpoints about 2 m
apart, joined where one can walk straight from one to the other.
"""

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise, product
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree
from shapely import LineString, MultiPolygon, Point, Polygon, get_coordinates
from shapely.ops import nearest_points

from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.geometry.floor import Floor
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.robot_size import CAMERA_HEIGHT, ROBOT_RADIUS
from memorymaze.world.sites.records import Area, Site

APART = 0.6
"""Metres: a viewpoint nearer than this to another one is not set."""
LONGEST_EDGE = 5.0
"""Metres that one may walk between two viewpoints."""
SHIFT = 1.5
"""Metres a viewpoint is moved to get off an obstacle or a wall."""


class Viewpoint(NamedTuple):
    """A place from which one looks around and goes on."""

    id: str
    """32 hexadecimal digits, the same in every graph with a viewpoint here."""
    x: float
    """Metres."""
    y: float
    """Metres."""


@dataclass(frozen=True)
class NavigationGraph:
    """Viewpoints, and which of them one can walk between in a straight line."""

    site: str
    """Name of the site."""
    viewpoints: tuple[Viewpoint, ...]
    edges: frozenset[tuple[int, int]]
    """Places in `viewpoints`, the smaller first; every viewpoint reaches every other."""

    @cached_property
    def neighbours(self) -> Mapping[str, tuple[Viewpoint, ...]]:
        """Where one can go from each viewpoint, by id."""
        there: dict[str, list[Viewpoint]] = {each.id: [] for each in self.viewpoints}
        for first, second in sorted(self.edges):
            there[self.viewpoints[first].id].append(self.viewpoints[second])
            there[self.viewpoints[second].id].append(self.viewpoints[first])
        return {identity: tuple(each) for identity, each in there.items()}

    def nearest(self, x: float, y: float) -> Viewpoint:
        """Return the viewpoint nearest to a point, in a straight line; metres."""
        return min(self.viewpoints, key=lambda each: math.dist((x, y), each[1:]))

    def connectivity(self) -> list[dict[str, object]]:
        """Return the graph in the shape of R2R's `{scan}_connectivity.json`.

        One entry per viewpoint: `image_id`, `pose` (4 x 4, row by row; the position is
        at 3, 7 and 11), `height` (metres), `included`, and `unobstructed` and `visible`
        (one truth value per viewpoint, the same here).
        """
        joined = np.zeros((len(self.viewpoints),) * 2, dtype=bool)
        for first, second in self.edges:
            joined[first, second] = joined[second, first] = True
        return [
            {
                "image_id": each.id,
                "pose": [
                    *(1.0, 0.0, 0.0, each.x),
                    *(0.0, 1.0, 0.0, each.y),
                    *(0.0, 0.0, 1.0, CAMERA_HEIGHT),
                    *(0.0, 0.0, 0.0, 1.0),
                ],
                "height": CAMERA_HEIGHT,
                "included": True,
                "unobstructed": row,
                "visible": row,
            }
            for each, row in zip(self.viewpoints, joined.tolist(), strict=True)
        ]


def navigation_graph(
    site: Site,
    *,
    spacing: float = 2.25,
    robot_radius: float = ROBOT_RADIUS,
) -> NavigationGraph:
    """Make the navigation graph of a site.

    Viewpoints stand in every turning point, where centre lines cross, along centre
    lines, and across areas. Two are joined exactly when the straight line between them
    is free for the robot and not too long. Where that leaves the graph in parts, more
    viewpoints are set along shortest walks between them. Floor that the robot cannot
    reach from the largest piece it can drive in has no viewpoints.

    Args:
        site: With a floor that hangs together.
        spacing: Metres between viewpoints along centre lines and across areas, at most.
        robot_radius: Metres kept from walls and obstacles.

    Raises:
        SitePlanError: The robot fits nowhere, or just not between two places.
    """
    standing = standing_floor(site, robot_radius)
    floor = Floor(standing)
    places = _place_viewpoints(site, standing, spacing)
    edges = _edges(places, floor)
    while (parts := _parts(len(places), edges)).any():
        bridge = _bridge(places, parts, floor)
        places = np.concatenate([places, bridge])
        edges = _edges(places, floor)
    return NavigationGraph(
        site.name,
        tuple(Viewpoint(_identity(site.name, x, y), x, y) for x, y in places.tolist()),
        frozenset((int(first), int(second)) for first, second in edges),
    )


def standing_floor(site: Site, robot_radius: float = ROBOT_RADIUS) -> Polygon:
    """Return where a robot's middle can be, on the largest piece it can drive in."""
    eroded = site.free_floor.buffer(-robot_radius, join_style="mitre")
    if eroded.is_empty:
        raise SitePlanError(
            f"{site.source or site.name}: expected floor that a robot of "
            f"{2 * robot_radius:.2f} m fits on, got none"
        )
    pieces = eroded.geoms if isinstance(eroded, MultiPolygon) else [eroded]
    return max((each for each in pieces), key=lambda piece: piece.area)


def _identity(site: str, x: float, y: float) -> str:
    words = f"{site}:{x:.3f}:{y:.3f}".encode()
    return hashlib.md5(words, usedforsecurity=False).hexdigest()


def _edges(places: FloatArray, floor: Floor) -> NDArray[np.intp]:
    """Return the pairs of places that see each other closely enough, shape (E, 2)."""
    pairs = KDTree(places).query_pairs(LONGEST_EDGE, output_type="ndarray")
    free = floor.joins(places[pairs[:, 0]], places[pairs[:, 1]])
    return np.sort(pairs[free], axis=1)


def _parts(count: int, edges: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the part of the graph each place is in, shape (N,); 0 for the first."""
    joined = csr_array(
        (np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count)
    )
    return connected_components(joined, directed=False)[1]


def _bridge(places: FloatArray, parts: NDArray[np.intp], floor: Floor) -> FloatArray:
    """Return places along the shortest walk from part 0 to the part nearest to it.

    A shortest walk bends at corners of the floor. Far corners are only looked at where
    the near ones lead nowhere.
    """
    spots = np.concatenate([places, get_coordinates(floor.polygon)])
    others = np.flatnonzero(parts)
    reach = LONGEST_EDGE
    while True:
        pairs = KDTree(spots).query_pairs(reach, output_type="ndarray")
        pairs = pairs[floor.joins(spots[pairs[:, 0]], spots[pairs[:, 1]])]
        steps = np.hypot(*(spots[pairs[:, 0]] - spots[pairs[:, 1]]).T)
        lengths, before, _ = dijkstra(
            csr_array((steps + 1e-9, tuple(pairs.T)), shape=(len(spots),) * 2),
            directed=False,
            indices=np.flatnonzero(parts == 0),
            min_only=True,
            return_predecessors=True,
        )
        here = int(others[np.argmin(lengths[others])])
        if np.isfinite(lengths[here]):
            break
        if reach > np.ptp(spots, axis=0).sum():
            raise SitePlanError(
                "expected floor on which a robot can drive everywhere, got places that "
                "hang together only by a point; widen the way near "
                f"({spots[here][0]:.2f}, {spots[here][1]:.2f})"
            )
        reach *= 2
    walk = [spots[here]]
    while before[here] >= 0:
        here = int(before[here])
        walk.append(spots[here])
    stops: list[FloatArray] = []
    for start, end in pairwise(walk):
        count = math.ceil(float(np.hypot(*(end - start))) / LONGEST_EDGE)
        stops += [start + (end - start) * step / count for step in range(1, count + 1)]
    return np.array(stops[:-1])


def _place_viewpoints(site: Site, standing: Polygon, spacing: float) -> FloatArray:
    """Choose places in all turning points, on all centre lines, and in all areas.

    (N, 2) metres, in an order that only depends on the site.
    """
    places = _Places(standing, max(APART, spacing / 2))
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

    def __init__(self, standing: Polygon, cell: float) -> None:
        self.standing = standing
        self.points: list[tuple[float, float]] = []
        self._cell = cell
        # By square cells, so that a large hall takes seconds.
        self._near: dict[tuple[int, int], list[tuple[float, float]]] = {}
        shapely.prepare(standing)

    def add(self, wanted: Point, apart: float = APART) -> None:
        """Set a viewpoint at or near a point, unless one is there or none can be.

        Those are there that are less than `apart`, at most a cell, from it; metres.
        """
        spot = wanted
        if not self.standing.covers(spot):
            spot = nearest_points(self.standing, wanted)[0]
            if spot.distance(wanted) > SHIFT:
                return
        place = (spot.x, spot.y)
        column, row = (math.floor(part / self._cell) for part in place)
        around = product((column - 1, column, column + 1), (row - 1, row, row + 1))
        near = (other for cell in around for other in self._near.get(cell, ()))
        if all(math.dist(place, other) >= apart for other in near):
            self.points.append(place)
            self._near.setdefault((column, row), []).append(place)


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
