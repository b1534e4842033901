"""Motion in simulated time: along lanes, on the spot, to a point; and what it leaves.

Everything that moves the robot goes through `Driver.tick`, which also samples the
trajectory, counts collisions and takes note of turning points.
"""

import math
from collections.abc import Callable
from typing import Literal

import numpy as np

from memorymaze.geometry.pose import Pose, turn_between
from memorymaze.geometry.trajectory import TimedPose, Trajectory
from memorymaze.simulation.motion.lanes import LaneFollower
from memorymaze.simulation.motion.wheeled_base import WheeledBase
from memorymaze.simulation.obstacles.surroundings import (
    LANE_STEP,
    Hindrance,
    Surroundings,
    find_hindrance,
)
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.turning_points import (
    AnnotatedTurningPoints,
    TurningPointSource,
)
from memorymaze.simulation.settings import TIMESTEP, SimulationSettings
from memorymaze.simulation.trace import Collision

ARRIVED = 0.015
"""Metres before a lane's end at which the robot brakes for good."""
BRAKING_SHARE = 0.75
"""Share of the greatest acceleration that planned braking uses."""
HEADING_TOLERANCE = 0.004
"""Radians."""
BLOCKED_TICKS = 16
"""Decisions in a row without motion after which the robot gives up."""
SAME_TOUCH = 1.0
"""Seconds within which touching the same thing again is the same collision."""

HELD_SPEED = 0.06
"""Speed in metres per second below which a robot that yields is waiting."""
PLACES_AHEAD = 18
"""Places of the lane, `LANE_STEP` apart, that are watched for people."""

DriveEnd = Literal["distance", "end", "blocked", "held"]


class TimeIsUp(Exception):
    """The episode's time budget ran out during a motion."""


class Driver:
    """Drives one robot through one episode."""

    def __init__(
        self,
        scene: Scene,
        start: Pose,
        settings: SimulationSettings,
        rng: np.random.Generator,
    ) -> None:
        """Put the robot at rest on its start pose, with nobody around."""
        tangible = scene.tangible, scene.tangible_geoms
        self.base = WheeledBase(scene.model, start, settings, rng, tangible)
        self.pose = self.base.pose
        """Where the robot is now."""
        self.turning_points: TurningPointSource = AnnotatedTurningPoints(scene)
        """What it knows of turning points."""
        self.collisions: list[Collision] = []
        self.distance = 0.0
        """Metres driven, backwards as well."""
        self.surroundings: Surroundings | None = None
        """What there is beyond the plan; None for nothing, which costs nothing."""
        self.waiting_time = 0.0
        """Seconds spent waiting for people."""
        self.held_for = 0.0
        """Seconds the robot has been waiting since it last got on."""
        self.hindrance: Hindrance | None = None
        """Who was in the way when the robot last looked."""
        self.on_motion: Callable[[float, Pose], None] | None = None
        """Called with time and pose after each control period; must change nothing."""
        self._scene = scene
        self._settings = settings
        self._period = settings.control_period
        self._steps = round(settings.control_period / TIMESTEP)
        self._samples = [TimedPose(0.0, *start)]
        self._sample_due = settings.sampling_period
        self._touches: dict[int, float] = {}
        self._moved_until = 0.0
        self._standing_steps = 0
        self.turning_points.update(start, start.heading, 0.0)

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self.base.time

    @property
    def standing_time(self) -> float:
        """Seconds it stood for something outside the building; not in the budget."""
        return self._standing_steps * TIMESTEP

    def sample(self) -> None:
        """Add the present pose to the trajectory."""
        if self._samples[-1].time < self.time:
            self._samples.append(TimedPose(self.time, *self.pose))
        self._sample_due = self.time + self._settings.sampling_period

    def trajectory(self) -> Trajectory:
        """Return the poses so far."""
        return Trajectory(self._samples)

    def tick(
        self,
        speed: float,
        turn_rate: float,
        travel: float | None,
        steps: int | None = None,
    ) -> float:
        """Let one control period pass, or so many physics steps; return metres moved.

        Wanted are metres per second ahead and radians per second; `travel` is the way
        the robot is going, radians, None while it only turns. Raises `TimeIsUp` when
        the time budget is used up.
        """
        base = self.base
        if base.time - self.standing_time >= self._settings.time_budget:
            raise TimeIsUp
        limit = self._settings.max_turn_rate
        base.drive(speed, max(-limit, min(limit, turn_rate)), steps or self._steps)
        before, self.pose = self.pose, base.pose
        moved = math.hypot(self.pose.x - before.x, self.pose.y - before.y)
        self.distance += moved
        self.turning_points.update(self.pose, travel, base.time)
        if self.surroundings is not None:
            self._let_others_move(self.surroundings, moved)
        touched = base.touched_geoms()
        if touched:
            self._note_touches(touched)
        if base.time >= self._sample_due - 1e-9:
            self.sample()
        if self.on_motion is not None:
            self.on_motion(base.time, self.pose)
        return moved

    def follow(
        self,
        follower: LaneFollower,
        distance: float,
        end_speed: float,
        patience: float = math.inf,
    ) -> DriveEnd:
        """Drive along a lane, some metres at most, and return why it ended.

        The distance is driven, at up to `end_speed` at its end; the lane is at its end;
        the robot pushed against something and did not move; or people have held it for
        as long as `patience` lasts, seconds.
        """
        braking = BRAKING_SHARE * self._settings.max_acceleration
        driven, idle = 0.0, 0
        while True:
            follower.update(self.pose)
            if follower.remaining <= ARRIVED:
                self.come_to_rest(follower)
                return "end"
            left = distance - driven
            if left <= 1e-4:
                return "distance"
            speed = min(
                follower.speed_limit,
                math.sqrt(2 * braking * follower.remaining),
                math.sqrt(end_speed * end_speed + 2 * braking * left),
            )
            if abs(follower.off_course) > 0.6:
                speed = min(speed, 0.3)
            if self.surroundings is not None:
                speed = min(speed, self._yielding_speed(_places_ahead(follower)))
                if self.hindrance is not None and self.held_for >= patience:
                    return "held"
            steps = self._steps
            if self.base.speed > 0 and left < 1:
                steps = min(steps, max(1, round(left / (self.base.speed * TIMESTEP))))
            moved = self.tick(
                speed,
                follower.turn_rate(self.base.speed),
                follower.station.course,
                steps,
            )
            driven += moved
            idle = idle + 1 if moved < 0.1 * self.base.speed * steps * TIMESTEP else 0
            if idle >= BLOCKED_TICKS:
                self.come_to_rest()
                return "blocked"

    def come_to_rest(self, follower: LaneFollower | None = None) -> None:
        """Brake until the robot stands, steering along a lane if there is one."""
        self.hindrance = None
        base = self.base
        travel = None if follower is None else follower.station.course
        while abs(base.speed) > 1e-6 or abs(base.turn_rate) > 1e-6:
            turn_rate = 0.0
            if follower is not None:
                follower.update(self.pose)
                turn_rate = follower.turn_rate(base.speed)
            self.tick(0.0, turn_rate, travel)
        while abs(self._measured_speed()) > 0.002:
            self.tick(0.0, 0.0, travel)

    def wait(self, seconds: float) -> None:
        """Stand and let time pass; counts as waiting for people."""
        self.come_to_rest()
        begin = self.time
        while self.time - begin < seconds - 1e-9:
            self.tick(0.0, 0.0, None)
        self.waiting_time += self.time - begin

    def stand(self, seconds: float) -> float:
        """Come to rest and stand for simulated seconds, while people go on walking.

        Where there are none nothing changes, so that nothing has to be computed: the
        walk is the same however long the robot stands.
        """
        self.come_to_rest()
        left = steps = round(seconds / TIMESTEP)
        if self.surroundings is None:
            self.base.rest(steps)
            self._standing_steps += steps
            return steps * TIMESTEP
        while left > 0:
            part = min(left, self._steps)
            # Before the tick, which looks at the budget.
            self._standing_steps += part
            self.tick(0.0, 0.0, None, part)
            left -= part
        return steps * TIMESTEP

    def spin_to(self, heading: float) -> None:
        """Turn on the spot until the robot faces a heading, radians."""
        self.hindrance = None
        braking = BRAKING_SHARE * self._settings.max_turn_acceleration
        while True:
            error = turn_between(self.pose.heading, heading)
            if abs(error) < HEADING_TOLERANCE and abs(self.base.turn_rate) < 0.1:
                break
            rate = min(math.sqrt(2 * braking * abs(error)), 10.0 * abs(error))
            self.tick(0.0, math.copysign(rate, error), None)
        self.come_to_rest()

    def drive_to(self, x: float, y: float, patience: float = math.inf) -> None:
        """Drive straight to a point, backing up to it when it is close behind.

        It gives up when people have held it for as long as `patience` lasts, seconds.
        """
        distance = math.hypot(x - self.pose.x, y - self.pose.y)
        if distance < 0.05:
            return
        bearing = math.atan2(y - self.pose.y, x - self.pose.x)
        backwards = (
            abs(turn_between(self.pose.heading, bearing)) > math.pi / 2
            and distance < 1.5
        )
        facing = bearing + math.pi if backwards else bearing
        self.spin_to(facing)
        sign = -1.0 if backwards else 1.0
        braking = BRAKING_SHARE * self._settings.max_acceleration
        ux, uy = math.cos(bearing), math.sin(bearing)
        idle = 0
        while idle < BLOCKED_TICKS:
            left = (x - self.pose.x) * ux + (y - self.pose.y) * uy
            if left <= ARRIVED:
                break
            aside = (y - self.pose.y) * ux - (x - self.pose.x) * uy
            error = turn_between(self.pose.heading, facing)
            speed = min(self._settings.max_speed, math.sqrt(2 * braking * left))
            speed = min(speed, self.yielding_speed_to(left, bearing))
            if self.surroundings is not None and self.held_for >= patience:
                break
            turn_rate = 2.0 * error + 2.0 * speed * sign * aside
            moved = self.tick(sign * speed, turn_rate, bearing)
            idle = idle + 1 if moved < 0.1 * abs(self.base.speed) * self._period else 0
        self.come_to_rest()

    def yielding_speed_to(self, distance: float, course: float) -> float:
        """Return the greatest speed that lets people pass on a straight way.

        It is inf where nobody is in the way.
        """
        if self.surroundings is None:
            return math.inf
        x, y = LANE_STEP * math.cos(course), LANE_STEP * math.sin(course)
        return self._yielding_speed([
            (self.pose.x + k * x, self.pose.y + k * y, course)
            for k in range(2 + math.ceil(distance / LANE_STEP))
        ])

    def _yielding_speed(self, places: list[tuple[float, float, float]]) -> float:
        """Return the greatest speed that lets people pass; notes who is in the way."""
        surroundings = self.surroundings
        crowd = None if surroundings is None else surroundings.crowd
        self.hindrance = None
        if crowd is not None:
            self.hindrance = find_hindrance(crowd, places, abs(self.base.speed))
        if self.hindrance is None:
            return math.inf
        braking = BRAKING_SHARE * self._settings.max_acceleration
        return math.sqrt(2 * braking * self.hindrance.ahead)

    def _let_others_move(self, surroundings: Surroundings, moved: float) -> None:
        duration = self.time - self._moved_until
        self._moved_until = self.time
        vx, vy = self.base.data.qvel[:2].tolist()
        surroundings.advance(self.time, self.pose, (vx, vy))
        if moved > HELD_SPEED * duration:
            self.held_for = 0.0
        elif self.hindrance is not None:
            self.held_for += duration
            self.waiting_time += duration

    def _measured_speed(self) -> float:
        vx, vy = self.base.data.qvel[:2].tolist()
        return math.hypot(vx, vy)

    def _note_touches(self, geoms: list[int]) -> None:
        for geom in sorted(set(geoms)):
            last = self._touches.get(geom)
            if last is None or self.time - last > SAME_TOUCH:
                thing = self._scene.objects[geom]
                name = None if thing.record is None else thing.record.id
                self.collisions.append(
                    Collision(self.time, self.pose, thing.kind, name)
                )
            self._touches[geom] = self.time


def _places_ahead(follower: LaneFollower) -> list[tuple[float, float, float]]:
    return [
        (each.x, each.y, each.heading) for each in follower.stations_ahead(PLACES_AHEAD)
    ]
