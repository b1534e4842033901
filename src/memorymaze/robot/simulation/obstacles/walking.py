"""How people get about: shortest ways between doors, and evading others, walls and the robot.

Ways lead along the middle of corridors. Evading is ORCA, by the library navground: J. van
den Berg, S. J. Guy, M. Lin, D. Manocha: Reciprocal n-Body Collision Avoidance, ISRR 2009.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from shapely import LineString, Polygon, STRtree, box

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.floor import Floor
from memorymaze.basics.geometry.points import XY, FloatArray
from memorymaze.world.sites.navigation_graph import navigation_graph
from memorymaze.world.sites.records import Site

if TYPE_CHECKING:
    from navground.core import LineSegment
    from navground.core.behaviors import ORCABehavior


WAY_SPACING = 0.4
"""Metres between the points of a way; at most."""
BEFORE_DOOR = 0.75
"""Metres from a door to the place where people stand before it."""
CONSIDERED = 8
"""Viewpoints that a way may begin at."""
ROUNDING = 4
"""Passes that round a way's corners."""
HORIZON = 5.0
"""Metres within which others are looked at."""
TIME_HORIZON = 2.0
"""Seconds ahead within which people evade each other."""
WALL_TIME_HORIZON = 0.6
"""Seconds ahead within which people evade walls."""
MARGIN = 0.06
"""Metres people like to keep from each other and from walls."""
FASTEST = 1.25
"""Greatest speed, as a multiple of that of walking undisturbed."""
CELL = 1.0
"""Metres; walls near a person are looked up by the cell the person is in."""
WALL_REACH = 1.8
"""Metres around a cell within which its walls lie."""


class Walks:
    """Shortest ways between places of one site, over its navigation graph."""

    def __init__(self, site: Site) -> None:
        """Join the site's viewpoints."""
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
        """Where people walk to: before doors, or viewpoints where there are too few."""
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
    return polyline.smoothed_rows(polyline.resample(line, WAY_SPACING), ROUNDING)


class Disc(NamedTuple):
    """Somebody to evade."""

    x: float
    y: float
    vx: float
    vy: float
    radius: float


class Avoidance:
    """Chooses velocities for the people of one episode."""

    def __init__(self, floor: Polygon, solids: Sequence[Polygon]) -> None:
        """Index what people cannot walk through."""
        from navground import core
        from navground.core import behaviors, kinematics

        self._core: Any = core
        self._behaviors: Any = behaviors
        self._kinematics: Any = kinematics
        rings = [floor.exterior, *floor.interiors, *(each.exterior for each in solids)]
        self._edges = [
            (start[:2], end[:2])
            for ring in rings
            for start, end in pairwise(ring.coords)
        ]
        self._tree = STRtree([LineString(edge) for edge in self._edges])
        self._near: dict[tuple[int, int], list[LineSegment]] = {}

    def mind(self, radius: float, speed: float) -> "ORCABehavior":
        """Return what decides for one person, of this radius and walking speed."""
        fastest = FASTEST * speed
        behavior = self._behaviors.ORCABehavior(
            self._kinematics.OmnidirectionalKinematics(fastest), radius
        )
        behavior.optimal_speed = speed
        behavior.max_speed = fastest
        behavior.horizon = HORIZON
        behavior.time_horizon = TIME_HORIZON
        behavior.static_time_horizon = WALL_TIME_HORIZON
        behavior.safety_margin = MARGIN
        behavior.max_number_of_neighbors = 8
        return behavior

    def decide(
        self,
        mind: "ORCABehavior",
        me: Disc,
        wanted: tuple[float, float],
        others: Sequence[Disc],
        period: float,
    ) -> tuple[float, float]:
        """Return the velocity nearest to the wanted one that hits nobody."""
        core = self._core
        mind.position = np.array([me.x, me.y], dtype=np.float32)
        mind.velocity = np.array([me.vx, me.vy], dtype=np.float32)
        state: Any = mind.environment_state
        state.line_obstacles = self._walls_near(me.x, me.y)
        state.neighbors = [
            core.Neighbor((each.x, each.y), each.radius, (each.vx, each.vy), number)
            for number, each in enumerate(others)
        ]
        mind.target = core.Target.Velocity(wanted)
        twist = mind.compute_cmd(period, core.Frame.absolute)
        vx, vy = (float(part) for part in twist.velocity)
        return vx, vy

    def _walls_near(self, x: float, y: float) -> "list[LineSegment]":
        cell = (math.floor(x / CELL), math.floor(y / CELL))
        if cell not in self._near:
            around = box(
                cell[0] * CELL - WALL_REACH,
                cell[1] * CELL - WALL_REACH,
                (cell[0] + 1) * CELL + WALL_REACH,
                (cell[1] + 1) * CELL + WALL_REACH,
            )
            shapely.prepare(around)
            found = sorted(self._tree.query(around, predicate="intersects").tolist())
            self._near[cell] = [
                self._core.LineSegment(*self._edges[number]) for number in found
            ]
        return self._near[cell]
