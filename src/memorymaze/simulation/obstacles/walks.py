"""Ways people walk on a site: between doors, along the middle of corridors."""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from memorymaze.geometry import polyline
from memorymaze.geometry.floor import Floor
from memorymaze.sites.navigation_graph import navigation_graph
from memorymaze.sites.records import Site

WAY_SPACING = 0.4
"""Metres between the points of a way; at most."""
BEFORE_DOOR = 0.75
"""Metres from a door to the place where people stand before it."""
CONSIDERED = 8
"""Viewpoints that a way may begin at."""
ROUNDING = 4
"""Passes that round a way's corners."""

FloatArray = NDArray[np.float64]
XY = tuple[float, float]


class Walks:
    """Shortest ways between places of one site, over its navigation graph.

    Attributes:
        goals: Places people walk to: before doors, or viewpoints where a site has less
            than two doors; metres.
    """

    def __init__(self, site: Site) -> None:
        """Join the site's viewpoints.

        Raises:
            SitePlanError: Nobody can walk there.
        """
        graph = navigation_graph(site)
        self._floor = Floor(site.free_floor)
        self._places = np.array([(each.x, each.y) for each in graph.viewpoints])
        edges = np.array(sorted(graph.edges), dtype=np.intp).reshape(-1, 2)
        steps = np.hypot(*(self._places[edges[:, 0]] - self._places[edges[:, 1]]).T)
        count = len(self._places)
        self._lengths, self._before = dijkstra(
            csr_array((steps, (edges[:, 0], edges[:, 1])), shape=(count, count)),
            directed=False,
            return_predecessors=True,
        )
        doors = [
            place
            for door in site.doors
            if (place := self._before_door(door.line.coords)) is not None
        ]
        self.goals: list[XY] = doors
        if len(doors) < 2:
            self.goals = [(x, y) for x, y in self._places.tolist()]

    def way(self, start: XY, end: XY) -> FloatArray:
        """Return points of a short way between two places, at even steps, (N, 2)."""
        direct = np.array([start, end])
        if math.dist(start, end) < 4 and self._sees(start, np.array([end]))[0]:
            return _eased(direct)
        first, first_lengths = self._reached_from(start)
        last, last_lengths = self._reached_from(end)
        lengths = (
            first_lengths[:, None]
            + self._lengths[np.ix_(first, last)]
            + last_lengths[None, :]
        )
        i, j = np.unravel_index(int(np.argmin(lengths)), lengths.shape)
        begin, here = int(first[i]), int(last[j])
        nodes = [here]
        while here != begin:
            here = int(self._before[begin, here])
            nodes.append(here)
        inner = self._places[nodes[::-1]]
        line = np.concatenate([[start], inner, [end]])
        kept = [line[0]]
        kept += [b for a, b in pairwise(line) if math.dist(a, b) > 1e-6]
        return _eased(np.array(kept))

    def _reached_from(self, place: XY) -> tuple[NDArray[np.intp], FloatArray]:
        """Return viewpoints that a place sees, and how far they are."""
        distances = np.hypot(*(self._places - place).T)
        near = np.argsort(distances, kind="stable")[:CONSIDERED]
        seen = near[self._sees(place, self._places[near])]
        chosen = seen if len(seen) else near[:1]
        return chosen, distances[chosen]

    def _sees(self, place: XY, others: FloatArray) -> NDArray[np.bool_]:
        starts = np.broadcast_to(np.array(place), others.shape)
        return self._floor.joins(starts, others)

    def _before_door(self, ends: object) -> XY | None:
        """Return where one stands before a door, on the side that is floor."""
        (ax, ay), (bx, by) = np.asarray(ends)[:2, :2].tolist()
        width = math.hypot(bx - ax, by - ay)
        nx, ny = (ay - by) / width, (bx - ax) / width
        for side in (BEFORE_DOOR, -BEFORE_DOOR):
            x, y = (ax + bx) / 2 + side * nx, (ay + by) / 2 + side * ny
            if self._floor.contains(np.array([x]), np.array([y]))[0]:
                return x, y
        return None


def _eased(line: FloatArray) -> FloatArray:
    """Return a line at even steps, its corners rounded."""
    points = polyline.resample(line, WAY_SPACING)
    for _ in range(ROUNDING):
        points[1:-1] = (points[:-2] + 2 * points[1:-1] + points[2:]) / 4
    return points
