"""Motion in time: along lanes, on the spot, to a point.

Everything that moves the robot goes through `Driver.tick`, which tells what is known of
the floor where the robot is.
"""

import math
from typing import Literal

from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion
from memorymaze.robot.steering.floor import LANE_STEP, KnownFloor
from memorymaze.robot.steering.lanes import LaneFollower
from memorymaze.robot.steering.settings import TICK, RobotSettings

ARRIVED = 0.015
"""Metres before a lane's end at which the robot brakes for good."""
BRAKING_SHARE = 0.75
"""Share of the greatest acceleration that planned braking uses."""
HEADING_TOLERANCE = 0.004
"""Radians."""
BLOCKED_TICKS = 16
"""Decisions in a row without motion after which the robot gives up."""
STANDING = 0.002
"""Measured speed in metres per second at which a robot that braked stands."""
MOST_SETTLING = 40
"""Decisions after braking in which it must; odometry may never measure so little."""
HELD_SPEED = 0.06
"""Speed in metres per second below which a robot that yields is waiting."""
PLACES_AHEAD = 18
"""Places of the lane, `LANE_STEP` apart, that are watched for people."""

DriveEnd = Literal["distance", "end", "blocked", "held"]


class TimeIsUp(Exception):
    """The episode's time budget ran out during a motion."""


class Driver:
    """Drives one robot through one episode.

    Speeds change no faster than the settings allow.
    """

    def __init__(
        self, body: SensorsAndMotion, floor: KnownFloor, settings: RobotSettings
    ) -> None:
        """Take a body that stands."""
        self._body = body
        self._began, pose, _ = body.odometry()
        self.pose: Pose = pose
        """Where the robot is now, as steering knows it."""
        self.time = 0.0
        """Seconds since the start."""
        self.floor = floor
        """What is known of it."""
        self.speed = 0.0
        """Commanded speed ahead, metres per second."""
        self.turn_rate = 0.0
        """Commanded turn rate, radians per second, left positive."""
        self.distance = 0.0
        """Metres driven, backwards as well."""
        self.waiting_time = 0.0
        """Seconds spent waiting for people."""
        self.held_for = 0.0
        """Seconds the robot has been waiting since it last got on."""
        self.room_ahead: float | None = None
        """Metres it might drive when it last looked; None with nobody in the way."""
        self._settings = settings
        self._surroundings = floor.surroundings
        self._period = settings.control_period
        self._ticks = round(settings.control_period / TICK)
        self._ticks_stood = 0

    @property
    def standing_time(self) -> float:
        """Seconds it stood for something outside the building; not in the budget."""
        return self._ticks_stood * TICK

    def tick(
        self,
        speed: float,
        turn_rate: float,
        travel: float | None,
        ticks: int | None = None,
    ) -> float:
        """Let one control period pass, or so many ticks; return metres moved.

        Wanted are metres per second ahead and radians per second; `travel` is the way
        the robot is going, radians, None while it only turns. Raises `TimeIsUp` when
        the time budget is used up.
        """
        settings = self._settings
        if self.time - self.standing_time >= settings.time_budget:
            raise TimeIsUp
        duration = (ticks or self._ticks) * TICK
        limit = settings.max_turn_rate
        turn_rate = max(-limit, min(limit, turn_rate))
        self.speed = _approach(self.speed, speed, settings.max_acceleration * duration)
        self.turn_rate = _approach(
            self.turn_rate, turn_rate, settings.max_turn_acceleration * duration
        )
        self._body.drive(self.speed, self.turn_rate, duration)
        before, then = self.pose, self.time
        now, self.pose, _ = self._body.odometry()
        self.time = now - self._began
        moved = math.hypot(self.pose.x - before.x, self.pose.y - before.y)
        self.distance += moved
        self.floor.update(self.pose, travel, self.time)
        if self._surroundings is not None:
            self._count_waiting(moved, self.time - then)
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
            if self._surroundings is not None:
                speed = min(speed, self._yielding_speed(_places_ahead(follower)))
                if self.room_ahead is not None and self.held_for >= patience:
                    return "held"
            ticks = self._ticks
            if self.speed > 0 and left < 1:
                ticks = min(ticks, max(1, round(left / (self.speed * TICK))))
            moved = self.tick(
                speed,
                follower.turn_rate(self.speed),
                follower.station.course,
                ticks,
            )
            driven += moved
            idle = idle + 1 if moved < 0.1 * self.speed * ticks * TICK else 0
            if idle >= BLOCKED_TICKS:
                self.come_to_rest()
                return "blocked"

    def come_to_rest(self, follower: LaneFollower | None = None) -> None:
        """Brake until the robot stands, steering along a lane if there is one."""
        self.room_ahead = None
        travel = None if follower is None else follower.station.course
        while abs(self.speed) > 1e-6 or abs(self.turn_rate) > 1e-6:
            turn_rate = 0.0
            if follower is not None:
                follower.update(self.pose)
                turn_rate = follower.turn_rate(self.speed)
            self.tick(0.0, turn_rate, travel)
        for _ in range(MOST_SETTLING):
            if self._body.odometry().speed <= STANDING:
                break
            self.tick(0.0, 0.0, travel)

    def wait(self, seconds: float) -> None:
        """Stand and let time pass; counts as waiting for people."""
        self.come_to_rest()
        begin = self.time
        while self.time - begin < seconds - 1e-9:
            self.tick(0.0, 0.0, None)
        self.waiting_time += self.time - begin

    def stand(self, seconds: float) -> None:
        """Stand for some seconds, while people go on walking."""
        self.come_to_rest()
        left = round(seconds / TICK)
        while left > 0:
            part = min(left, self._ticks)
            # Before the tick, which looks at the budget.
            self._ticks_stood += part
            self.tick(0.0, 0.0, None, part)
            left -= part

    def note_rest(self, seconds: float) -> None:
        """Take note that time passed for a robot at rest, without a tick."""
        self._ticks_stood += round(seconds / TICK)
        self.time = self._body.odometry().time - self._began

    def spin_to(self, heading: float) -> None:
        """Turn on the spot until the robot faces a heading, radians."""
        self.room_ahead = None
        braking = BRAKING_SHARE * self._settings.max_turn_acceleration
        while True:
            error = turn_between(self.pose.heading, heading)
            if abs(error) < HEADING_TOLERANCE and abs(self.turn_rate) < 0.1:
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
            if self._surroundings is not None and self.held_for >= patience:
                break
            turn_rate = 2.0 * error + 2.0 * speed * sign * aside
            moved = self.tick(sign * speed, turn_rate, bearing)
            idle = idle + 1 if moved < 0.1 * abs(self.speed) * self._period else 0
        self.come_to_rest()

    def yielding_speed_to(self, distance: float, course: float) -> float:
        """Return the greatest speed that lets people pass on a straight way.

        It is inf where nobody is in the way.
        """
        if self._surroundings is None:
            return math.inf
        x, y = LANE_STEP * math.cos(course), LANE_STEP * math.sin(course)
        return self._yielding_speed([
            (self.pose.x + k * x, self.pose.y + k * y, course)
            for k in range(2 + math.ceil(distance / LANE_STEP))
        ])

    def _yielding_speed(self, places: list[tuple[float, float, float]]) -> float:
        """Return the greatest speed that lets people pass; notes who is in the way."""
        around = self._surroundings
        self.room_ahead = None
        if around is not None:
            self.room_ahead = around.room_ahead(places, abs(self.speed))
        if self.room_ahead is None:
            return math.inf
        braking = BRAKING_SHARE * self._settings.max_acceleration
        return math.sqrt(2 * braking * self.room_ahead)

    def _count_waiting(self, moved: float, duration: float) -> None:
        if moved > HELD_SPEED * duration:
            self.held_for = 0.0
        elif self.room_ahead is not None:
            self.held_for += duration
            self.waiting_time += duration


def _places_ahead(follower: LaneFollower) -> list[tuple[float, float, float]]:
    return [
        (each.x, each.y, each.heading) for each in follower.stations_ahead(PLACES_AHEAD)
    ]


def _approach(value: float, target: float, change: float) -> float:
    return max(value - change, min(value + change, target))
