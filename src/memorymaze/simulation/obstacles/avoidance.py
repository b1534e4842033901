"""How people avoid each other, walls and the robot: ORCA, by the library navground.

J. van den Berg, S. J. Guy, M. Lin, D. Manocha: Reciprocal n-Body Collision Avoidance,
ISRR 2009.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon, STRtree, box

from memorymaze.extras import require_extra

if TYPE_CHECKING:
    from navground.core import LineSegment
    from navground.core.behaviors import ORCABehavior

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
        """Index what people cannot walk through.

        Raises:
            SettingsError: The library is not installed.
        """
        require_extra(
            "people",
            "navground",
            purpose="obstacles, people who walk about",
            otherwise="run with people=0",
        )
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
