"""The guide robot's body without physics: it goes for the speeds asked for, exactly.

Where it would come nearer to a wall or an obstacle of the plan than its radius, it stops
there and slides along, and touches it.
"""

import math
from collections.abc import Iterable

import numpy as np
import shapely
from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.simulation.motion.wheeled_base import WHEEL_OFFSET, WheelErrors
from memorymaze.robot.simulation.settings import TIMESTEP, SimulationSettings


def arc_chord(heading: float, speed: float, turn_rate: float, seconds: float) -> XY:
    """Return how far speeds lead, metres along the axes in which headings are told."""
    half = turn_rate * seconds / 2
    chord = speed * seconds * (math.sin(half) / half if half else 1.0)
    return chord * math.cos(heading + half), chord * math.sin(heading + half)


def held_back(
    place: XY, motion: XY, near: Iterable[tuple[int, XY]]
) -> tuple[XY, dict[int, XY]]:
    """Return what is left of a robot's motion, and where it touches what.

    `near` are the numbers of what stands within its reach, and the nearest points;
    nearest first. It stops a radius before each, and slides along.
    """
    (x, y), (dx, dy) = place, motion
    touched: dict[int, XY] = {}
    within: list[tuple[int, XY, XY, float]] = []
    for number, point in near:
        distance = math.dist(place, point)
        if distance > 0:
            normal = (point[0] - x) / distance, (point[1] - y) / distance
            within.append((number, point, normal, max(distance - ROBOT_RADIUS, 0.0)))
    for number, point, (nx, ny), gap in within:
        excess = dx * nx + dy * ny - gap
        if excess > 0:
            dx, dy = dx - excess * nx, dy - excess * ny
            touched[number] = point
    # In a corner, sliding along the one leads into the other.
    if any(dx * nx + dy * ny > gap + 1e-9 for _, _, (nx, ny), gap in within):
        return (0.0, 0.0), touched
    return (dx, dy), touched


class Touchables:
    """What a robot may touch, on the plan; shared by all robots of a building."""

    def __init__(
        self,
        walls: Iterable[tuple[int, LineString]],
        obstacles: Iterable[tuple[int, Polygon]],
    ) -> None:
        """Take walls and footprints with their geoms."""
        parts: list[tuple[int, BaseGeometry]] = [*walls, *obstacles]
        self._geoms = [geom for geom, _ in parts]
        self._tree = STRtree([shape for _, shape in parts])

    def room(self, place: XY) -> float:
        """Return how far a robot may go from a place, whichever way, touching nothing."""
        _, distances = self._tree.query_nearest(
            Point(place), return_distance=True, all_matches=False
        )
        return float(distances[0]) - ROBOT_RADIUS

    def near(self, place: XY, reach: float) -> list[tuple[int, XY]]:
        """Return the geoms within reach, metres, and their nearest points; nearest first."""
        here = Point(place)
        numbers = self._tree.query(here, predicate="dwithin", distance=reach)
        shapes = self._tree.geometries[numbers]
        points = shapely.get_coordinates(shapely.shortest_line(shapes, here))[::2]
        found = zip(numbers.tolist(), points.tolist(), strict=True)
        return sorted(
            ((self._geoms[number], (x, y)) for number, (x, y) in found),
            key=lambda each: math.dist(place, each[1]),
        )


class KinematicBase:
    """The moving robot in one episode, in the place of a `WheeledBase`."""

    def __init__(
        self,
        model: mujoco.MjModel,
        start: Pose,
        settings: SimulationSettings,
        rng: np.random.Generator,
        touchables: Touchables,
    ) -> None:
        """Put the robot at rest on its start pose; cameras and LiDAR look at the model."""
        self.data = mujoco.MjData(model)
        self.pose = start
        self.velocity = (0.0, 0.0)
        self._model = model
        self._errors = WheelErrors(settings.wheel_noise, rng)
        self._touchables = touchables
        self._room = 0.0
        self._touched: dict[int, XY] = {}
        self._steps = 0
        self.update_view()

    @property
    def time(self) -> float:
        """See `WheeledBase.time`."""
        return self._steps * TIMESTEP

    @property
    def speed(self) -> float:
        """See `WheeledBase.speed`."""
        return math.hypot(*self.velocity)

    def drive(self, speed: float, turn_rate: float, steps: int) -> None:
        """See `WheeledBase.drive`."""
        left, right = self._errors.wheel_speeds(speed, turn_rate)
        speed, turn_rate = (left + right) / 2, (right - left) / (2 * WHEEL_OFFSET)
        self._touched = {}
        way = abs(speed) * steps * TIMESTEP
        if way > self._room:
            self._room = self._touchables.room((self.pose.x, self.pose.y))
        if way <= self._room:
            self._move(speed, turn_rate, steps * TIMESTEP)
            self._room -= way
        else:
            # Near something each step is short, so that what is nearest stays nearest.
            for _ in range(steps):
                self._move(speed, turn_rate, TIMESTEP, may_touch=True)
            self._room = 0.0
        self._steps += steps

    def _move(
        self, speed: float, turn_rate: float, seconds: float, *, may_touch: bool = False
    ) -> None:
        """Go along an arc, or as much of it as there is room for."""
        x, y, heading = self.pose
        dx, dy = arc_chord(heading, speed, turn_rate, seconds)
        if may_touch:
            reach = ROBOT_RADIUS + math.hypot(dx, dy)
            near = self._touchables.near((x, y), reach)
            (dx, dy), touched = held_back((x, y), (dx, dy), near)
            self._touched |= touched
        self.pose = Pose(x + dx, y + dy, wrap_angle(heading + turn_rate * seconds))
        self.velocity = dx / seconds, dy / seconds

    def rest(self, steps: int) -> None:
        """See `WheeledBase.rest`."""
        self._steps += steps

    def touched_geoms(self) -> list[int]:
        """See `WheeledBase.touched_geoms`."""
        return list(self._touched)

    def touched_places(self) -> list[XY]:
        """See `WheeledBase.touched_places`."""
        return list(self._touched.values())

    def update_view(self) -> None:
        """See `WheeledBase.update_view`."""
        x, y, heading = self.pose
        self.data.qpos[:7] = (x, y, 0, *about_z(heading))
        mujoco.mj_kinematics(self._model, self.data)
        mujoco.mj_camlight(self._model, self.data)
