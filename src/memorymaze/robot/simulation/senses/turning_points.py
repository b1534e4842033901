"""Turning points as the site plan tells them, as in the paper (Sec. III-B)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import shapely
from shapely import Point, Polygon

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.simulation.motion.straight_ways import counter_clockwise
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.steering.turning_points import Stay, WayOut, where_lines_meet
from memorymaze.world.sites.records import Exit, TurningPoint

WAY_BACK_TOLERANCE = math.radians(75)
"""Greatest angle between an exit and straight back for it to be the way it came."""
CELL = 2.0
"""Metres; turning points are found by squares of this size."""
OTHER_FLOOR_PENALTY = 0.5
"""Radians added to that angle when the exit leads to other floor than it came from."""


class AnnotatedTurningPoints:
    """Follows one robot through the plan's; implements `TurningPointSource`."""

    def __init__(self, scene: Scene) -> None:
        """Begin outside all turning points."""
        self._scene = scene
        self._cells, self._floors = _outlines(scene), _floors(scene)
        self._visits: dict[str, _Visit] = {}
        self._numbers: dict[str, int] = {}
        self._current: _Visit | None = None

    @property
    def current(self) -> "_Visit | None":
        """The stay that counts now: of overlapping ones, where the centre is nearest."""
        return self._current

    @property
    def number(self) -> int | None:
        """See `TurningPointSource.number`."""
        current = self._current
        return None if current is None else self._numbers[current.point.id]

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `TurningPointSource.update`."""
        if travel is None:
            return
        x, y, _ = pose
        before, self._visits = self._visits, {}
        nearest, least = None, math.inf
        for outline in self._cells.get((x // CELL, y // CELL), ()):
            if outline.covers(x, y):
                point = outline.point
                visit = before.get(point.id)
                if visit is None:
                    came_by = self._way_back(point, x, y, travel)
                    visit = _Visit(point, self._scene, came_by)
                self._visits[point.id] = visit
                distance = (x - outline.centre_x) ** 2 + (y - outline.centre_y) ** 2
                if distance < least:
                    nearest, least = visit, distance
        self._current = nearest
        if nearest is not None and nearest.point.id not in self._numbers:
            self._numbers[nearest.point.id] = len(self._numbers) + 1

    def note_turn(self) -> None:
        """See `TurningPointSource.note_turn`."""
        for visit in self._visits.values():
            visit.turned = True

    def _way_back(
        self, point: TurningPoint, x: float, y: float, travel: float
    ) -> Exit | None:
        best, least = None, WAY_BACK_TOLERANCE
        here = Point(x, y)
        for each in point.exits:
            angle = abs(turn_between(travel + math.pi, each.heading))
            if shapely.distance(self._floors[each.to], here) > 0.3:
                angle += OTHER_FLOOR_PENALTY
            if angle < least:
                best, least = each, angle
        return best


@dataclass(slots=True)
class _Visit(Stay):
    """A stay in a turning point of the site plan."""

    point: TurningPoint
    scene: Scene
    came_by: WayOut | None = None
    turned: bool = False

    @property
    def ways(self) -> Sequence[Exit]:
        """See `Stay.ways`."""
        return self.point.exits

    def meeting_point(self, way: WayOut, place: XY, course: float) -> XY:
        """Return where the robot's line meets the centre line of the way it chose.

        Where they meet elsewhere, the place on the chosen way nearest to the centre. An
        exit into an open area has no centre line: its line goes through the centre.
        """
        point = self.point
        centre = point.polygon.centroid
        direction = math.cos(way.heading), math.sin(way.heading)
        through = (centre.x, centre.y)
        axis = self.scene.straight_ways.axis_through(point, way)
        if axis is not None:
            direction = axis.ux, axis.uy
            through = axis.at(axis.local(*through)[0])
        meeting = where_lines_meet(place, course, through, direction)
        for wish in (meeting, through):
            if wish is not None and point.polygon.covers(Point(wish)):
                return wish
        return (centre.x, centre.y)


@dataclass(frozen=True, slots=True)
class _Outline:
    """A turning point's polygon as plain numbers."""

    point: TurningPoint
    corners: tuple[XY, ...]
    centre_x: float
    centre_y: float

    def covers(self, x: float, y: float) -> bool:
        px, py = self.corners[-1]
        for qx, qy in self.corners:
            if (qx - px) * (y - py) - (qy - py) * (x - px) < -1e-9:
                return False
            px, py = qx, qy
        return True


@lru_cache(maxsize=8)
def _outlines(scene: Scene) -> dict[tuple[float, float], list[_Outline]]:
    """Return the turning points that reach into each square, in the plan's order.

    Asked 20 times a simulated second.
    """
    cells: dict[tuple[float, float], list[_Outline]] = {}
    for point in scene.site.turning_points:
        centre = point.polygon.centroid
        corners = counter_clockwise(point.polygon)
        outline = _Outline(point, corners, centre.x, centre.y)
        west, south, east, north = (each // CELL for each in point.polygon.bounds)
        for column in range(int(west), int(east) + 1):
            for row in range(int(south), int(north) + 1):
                cells.setdefault((column, row), []).append(outline)
    return cells


@lru_cache(maxsize=8)
def _floors(scene: Scene) -> dict[str, Polygon]:
    site = scene.site
    return {
        each.id: each.polygon
        for each in (*site.corridors, *site.areas, *site.turning_points)
    }
