"""What the control API means by its motions: moving on, turning into ways, following a line."""

import math

from memorymaze.basics.geometry.pose import turn_between, wrap_angle
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.api.control import DIRECTIONS, Direction, MoveEnd, TurnResult
from memorymaze.robot.steering.commands import direction_of, exit_meant
from memorymaze.robot.steering.detours import FreeSpace
from memorymaze.robot.steering.driving import DriveEnd, Driver
from memorymaze.robot.steering.floor import GETS_PAST, LOOK_AROUND, Surroundings
from memorymaze.robot.steering.lanes import Lane, LaneFollower, plan_lane
from memorymaze.robot.steering.primitive_motions import drive_on, go_straight, spin_by
from memorymaze.robot.steering.settings import RobotSettings
from memorymaze.robot.steering.turning_points import Stay, WayOut

REPLAN_OFFSET = 0.35
"""Metres beside its lane from which on a robot plans anew."""
REPLAN_ANGLE = math.radians(40)
"""Angle to its lane from which on a robot plans anew."""
SPIN_FIRST = math.radians(8)
"""Angle to a new lane's beginning from which on the robot first turns on the spot."""
ON_WAY = 0.1
"""Metres between a lane and its way within which a robot is not going round something."""
SHORT_LANE = 2.0
"""Metres of a lane left with which it is planned anew wherever the robot is."""
LEAST_PART = 0.2
"""Metres that are driven at least before it is looked at again."""
BACK_SECTOR = math.radians(35)
"""`around` faces an exit that lies within this angle of a half turn."""

NEARLY = math.radians(1)
"""Angle by which a turn by degrees may be off and still is the one asked for."""


class Pilot:
    """Steers one robot through one episode.

    It keeps a course: the heading of the way the robot is on. Directions are told
    relative to it and not to the heading of the moment, which differs while the robot
    goes round an obstacle. Every motion raises `TimeIsUp` when the time budget ends.
    """

    def __init__(self, driver: Driver, settings: RobotSettings) -> None:
        """Begin with the start heading as the course."""
        self._driver = driver
        self._floor = driver.floor
        self._settings = settings
        around = driver.floor.surroundings
        self._patience = math.inf if around is None else around.patience
        self._course = driver.pose.heading
        self._fresh = True
        self._towards: str | None = None
        self._follower: LaneFollower | None = None
        self._planned_at = 0.0

    def come_to_rest(self) -> None:
        """Brake until the robot stands."""
        self._driver.come_to_rest(self._follower)

    def move(self, distance: float) -> MoveEnd:
        """Drive up to some metres along the straight way; return why it ended."""
        driver = self._driver
        follower = self._follower
        if follower is not None:
            follower.update(driver.pose)
        if (
            follower is None
            or abs(follower.offset) > REPLAN_OFFSET
            or abs(follower.off_course) > REPLAN_ANGLE
        ):
            follower = self._planned()
        left = distance
        while True:
            follower = self._planned_on(follower)
            part = min(left, self._until_new_plan())
            before = driver.distance
            how, follower = self._follow(follower, part, ends=part == left)
            self._course = follower.station.course
            if how != "distance" or part == left:
                break
            left -= driver.distance - before
        if how == "distance":
            if self._settings.rolling_speed == 0:
                self.come_to_rest()
            return "done"
        if how == "held":
            self._follower = None
            return "obstacle"
        if how == "end":
            return "obstacle" if follower.lane.end == "obstacle" else "wall"
        self._follower = None
        return self._floor.what_blocks()

    def _until_new_plan(self) -> float:
        """Return how far to drive before looking whether the way is to be found anew."""
        driven = self._driver.distance - self._planned_at
        return max(self._floor.horizon - driven, LEAST_PART)

    def _planned_on(self, follower: LaneFollower) -> LaneFollower:
        """Return the lane from here on, where what is known of the way has grown.

        A robot that is going round something first gets past it.
        """
        if self._driver.distance - self._planned_at < self._floor.horizon:
            return follower
        station = follower.station
        beside = math.dist(station[:2], (station.way_x, station.way_y))
        if beside > ON_WAY and follower.remaining > SHORT_LANE:
            return follower
        lane = self._straight_lane(self._floor.clearance)
        return self._joined(lane)

    def _follow(
        self, follower: LaneFollower, distance: float, *, ends: bool
    ) -> tuple[DriveEnd, LaneFollower]:
        """Drive along a lane, to roll on from its end or to go on at full speed."""
        settings, around = self._settings, self._floor.surroundings
        speed = settings.rolling_speed if ends else settings.max_speed
        if around is None:
            return self._driver.follow(follower, distance, speed), follower
        return self._move_among_people(follower, distance, speed, around)

    def _move_among_people(
        self,
        follower: LaneFollower,
        distance: float,
        end_speed: float,
        surroundings: Surroundings,
    ) -> tuple[DriveEnd, LaneFollower]:
        """Drive on; wait for people, or go round those who stand, as patience lasts."""
        driver = self._driver
        until = driver.distance + distance
        driver.held_for = 0.0
        while True:
            left = max(until - driver.distance, 1e-3)
            how = driver.follow(
                follower,
                left,
                end_speed,
                min(driver.held_for + LOOK_AROUND, surroundings.patience),
            )
            if how != "held":
                return how, follower
            if driver.held_for >= surroundings.patience:
                self.come_to_rest()
                return how, follower
            clearance = surroundings.clearance_now(driver.pose[:2])
            if clearance is not None:
                follower = self._round_people(follower, clearance)

    def _round_people(
        self, follower: LaneFollower, clearance: FreeSpace
    ) -> LaneFollower:
        """Return a lane round those who stand; the old one where there is no way."""
        lane = self._straight_lane(clearance)
        past = GETS_PAST + (self._driver.room_ahead or 0.0)
        if lane.length < min(past, follower.remaining):
            return follower
        return self._joined(lane)

    def _planned(self) -> LaneFollower:
        self.come_to_rest()
        follower = self._joined(self._straight_lane(self._floor.clearance))
        self._fresh = False
        return follower

    def _straight_lane(self, clearance: FreeSpace) -> Lane:
        pose = self._driver.pose
        way = self._floor.straight_way(
            pose[:2], self._course, fresh=self._fresh, towards=self._towards
        )
        return plan_lane(way, pose, clearance, self._settings.max_speed)

    def _joined(self, lane: Lane) -> LaneFollower:
        """Begin a lane, facing along it."""
        driver = self._driver
        self._planned_at = driver.distance
        follower = LaneFollower(lane)
        follower.update(driver.pose)
        if lane.length > 0 and abs(follower.off_course) > SPIN_FIRST:
            driver.spin_to(lane.stations[0].heading)
            follower.update(driver.pose)
        self._follower = follower
        return follower

    def directions(self) -> list[Direction]:
        """Return where one can go on from the turning point the robot is in."""
        stay = self._floor.turning_points.current
        if stay is None:
            return []
        found = {
            direction_of(turn_between(self._course, each.heading))
            for each in stay.onward()
        }
        return [direction for direction in DIRECTIONS if direction in found]

    def turn(self, direction: Direction) -> TurnResult:
        """Face the way that lies in a direction, if there is one."""
        stay = self._floor.turning_points.current
        if direction == "around":
            return self._turn_around(stay)
        if stay is None:
            return TurnResult(
                False,
                0.0,
                "this is not a turning point; only 'around' is possible here",
            )
        exits = stay.choices()
        angles = [turn_between(self._course, each.heading) for each in exits]
        chosen = exit_meant(direction, angles)
        if chosen is None:
            there_are = ", ".join((*self.directions(), "around"))
            return TurnResult(
                False,
                0.0,
                f"no way lies {_in_words(direction)}; there are: {there_are}",
            )
        return self._turn_into(stay, exits[chosen], direction)

    def turn_by(self, angle: float) -> TurnResult:
        """Turn on the spot by some radians; what it then faces need be no way."""
        turned = self.rotate(angle)
        complete = abs(turned - angle) < NEARLY
        message = f"turned {abs(math.degrees(turned)):.0f} degrees"
        if not complete:
            message = f"something is in the way: {message}"
        return TurnResult(complete, math.degrees(turned), message)

    def _turn_into(self, stay: Stay, way: WayOut, direction: str) -> TurnResult:
        driver = self._driver
        self.come_to_rest()
        before = driver.pose.heading
        place = (driver.pose.x, driver.pose.y)
        if self._follower is not None:
            station = self._follower.station
            place = (station.way_x, station.way_y)
        meeting = stay.meeting_point(way, place, self._course)
        if self._floor.clearance.is_free(
            [driver.pose[:2], meeting], ROBOT_RADIUS + 0.02
        ):
            driver.drive_to(*meeting, patience=self._patience)
        driver.spin_to(way.heading)
        self.face(way.heading, way.to)
        angle = math.degrees(turn_between(before, driver.pose.heading))
        return TurnResult(
            True, angle, f"turned {abs(angle):.0f} degrees, {_in_words(direction)}"
        )

    def _turn_around(self, stay: Stay | None) -> TurnResult:
        driver = self._driver
        self.come_to_rest()
        before = driver.pose.heading
        back = self._course + math.pi
        towards = None
        behind = min(
            () if stay is None else stay.ways,
            key=lambda each: abs(turn_between(back, each.heading)),
            default=None,
        )
        if (
            behind is not None
            and abs(turn_between(back, behind.heading)) <= BACK_SECTOR
        ):
            back, towards = behind.heading, behind.to
        driver.spin_to(back)
        self.face(back, towards)
        angle = math.degrees(turn_between(before, driver.pose.heading))
        return TurnResult(True, angle, "turned around")

    def face(self, course: float, towards: str | None) -> None:
        """Take a new course, from where the robot stands."""
        self._course = wrap_angle(course)
        self._towards = towards
        self._fresh = True
        self._follower = None
        self._floor.turning_points.note_turn()

    def step_forward(self, distance: float) -> float:
        """Drive straight ahead, without keeping to the way; return metres moved."""
        self.come_to_rest()
        moved = go_straight(self._driver, distance, self._settings, self._patience)
        self._stand_anew()
        return moved

    def rotate(self, angle: float) -> float:
        """Turn on the spot by some radians; return what was turned."""
        self.come_to_rest()
        turned = spin_by(self._driver, angle, self._settings)
        self._stand_anew()
        self._floor.turning_points.note_turn()
        return turned

    def drive(self, speed: float, turn_rate: float, seconds: float) -> float:
        """Go for speeds for some time, rolling on afterwards; return metres driven."""
        driver, period = self._driver, self._settings.control_period
        driven = drive_on(driver, speed, turn_rate, seconds, period)
        self._stand_anew()
        if turn_rate:
            self._floor.turning_points.note_turn()
        return driven

    def _stand_anew(self) -> None:
        """Take the way the robot faces as its course."""
        self._course = self._driver.pose.heading
        self._towards = None
        self._fresh = True
        self._follower = None


def _in_words(direction: str) -> str:
    return {
        "forward": "straight on",
        "left": "to the left",
        "right": "to the right",
    }.get(direction, direction.replace("_", " "))
