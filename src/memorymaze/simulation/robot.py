"""`SimulatedRobot`: the guide robot's control API on a simulated building."""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.errors import CommandError, EpisodeOver
from memorymaze.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.perception.visible_object import CameraView
from memorymaze.robot.api import (
    DIRECTIONS,
    Detection,
    Direction,
    MoveEnd,
    MoveResult,
    TurnResult,
)
from memorymaze.simulation.call_log import CallLog
from memorymaze.simulation.driving import Driver, TimeIsUp
from memorymaze.simulation.lanes import plan_lane
from memorymaze.simulation.path_following import LaneFollower
from memorymaze.simulation.route_following import follow_line
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.simulation.trace import Collision, TraceEvent
from memorymaze.simulation.turning_directions import (
    direction_of,
    exit_meant,
    parse_direction,
)
from memorymaze.simulation.turning_points import Visit, meeting_point
from memorymaze.simulation.wheeled_base import ROBOT_RADIUS
from memorymaze.sites.records import Exit

__all__ = ["Detector", "SimulatedRobot"]

REPLAN_OFFSET = 0.35
"""Metres beside its lane from which on a robot plans anew."""
REPLAN_ANGLE = math.radians(40)
"""Angle to its lane from which on a robot plans anew."""
SPIN_FIRST = math.radians(8)
"""Angle to a new lane's beginning from which on the robot first turns on the spot."""
BACK_SECTOR = math.radians(35)
"""`around` faces an exit that lies within this angle of a half turn."""


class Detector(Protocol):
    """Finds objects by name in a camera view; keeps its tracks for one episode."""

    def detect(self, view: CameraView, query: str) -> list[Detection]:
        """Return what fits the words, the nearest first."""
        ...


class SimulatedRobot:
    """A guide robot in a simulated building; implements `memorymaze.robot.api.Robot`.

    Simulated time passes only while a call moves the robot. A move that is done hands
    over rolling, at up to `rolling_speed`; looking does not stop it, the next move
    carries on, and anything else first brings it to rest (within 0.1 m). Every call
    raises `EpisodeOver` once the episode is over, and `CommandError` for arguments
    without meaning.
    """

    def __init__(
        self,
        scene: Scene,
        start: Pose,
        settings: SimulationSettings | None = None,
        rng: np.random.Generator | None = None,
        on_event: Callable[[TraceEvent], None] | None = None,
        *,
        detector: Detector | None = None,
    ) -> None:
        """Put a robot into a building.

        Args:
            scene: The building.
            start: Where the episode begins.
            settings: Abilities and limits; the defaults when None.
            rng: Source of the wheels' noise; the same state gives the same walk.
                None seeds one with 0.
            on_event: Called after each call of the control API.
            detector: Eyes of `detect_from_RGB_image`; None knows what the camera
                really sees.
        """
        self.scene = scene
        """The building it is in."""
        self.settings = settings or SimulationSettings()
        """Its abilities and the limits of the episode."""
        self._driver = Driver(
            scene, start, self.settings, rng or np.random.default_rng(0)
        )
        self._log = CallLog(self.settings, on_event)
        self._detector = detector
        self._course = self._driver.pose.heading
        self._fresh = True
        self._towards: str | None = None
        self._follower: LaneFollower | None = None
        self._refused_turns = 0

    # What agents call.

    def move_forward(self, distance: float) -> MoveResult:
        """See `Robot.move_forward`."""
        self._log.begin()
        arguments = {"distance": distance}
        try:
            metres = _distance(distance)
        except CommandError as error:
            self._end("move_forward", arguments, {"error": str(error)})
            raise
        before = self._driver.distance
        reason: MoveEnd
        try:
            reason = self._move(metres)
        except TimeIsUp:
            reason = "budget"
            self._log.stopped_by = "budget"
        result = MoveResult(self._driver.distance - before, reason)
        self._end("move_forward", arguments, asdict(result))
        return result

    def detect_turning_point(self) -> list[Direction]:
        """See `Robot.detect_turning_point`."""
        self._log.begin()
        directions = self._directions()
        self._end("detect_turning_point", {}, directions)
        return list(directions)

    def turning_point_id(self) -> int | None:
        """See `Robot.turning_point_id`."""
        self._log.begin()
        number = self._driver.visits.number
        self._end("turning_point_id", {}, number)
        return number

    def turn(self, direction: str) -> TurnResult:
        """See `Robot.turn`; unknown words are refused with `turned` False."""
        self._log.begin()
        arguments = {"direction": direction}
        try:
            result = self._turn(parse_direction(direction))
        except CommandError as error:
            result = TurnResult(False, 0.0, str(error))
        except TimeIsUp:
            self._log.stopped_by = "budget"
            result = TurnResult(False, 0.0, "the time budget ran out")
        self._refused_turns += not result.turned
        self._end("turn", arguments, asdict(result))
        return result

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        """See `Robot.detect_from_RGB_image`."""
        self._log.begin()
        arguments = {"object": object}
        if not isinstance(object, str) or not object.strip():
            message = (
                "detect_from_RGB_image: expected what to look for in a few words, "
                f"got {object!r}"
            )
            self._end("detect_from_RGB_image", arguments, {"error": message})
            raise CommandError(message)
        found = self._eyes().detect(self.camera_view(), object)
        self._end("detect_from_RGB_image", arguments, [asdict(each) for each in found])
        return found

    def say(self, text: str) -> None:
        """See `Robot.say`."""
        self._log.begin()
        self._end("say", {"text": str(text)}, None)

    def distance_travelled(self) -> float:
        """See `Robot.distance_travelled`."""
        self._log.begin()
        distance = self._driver.distance
        self._end("distance_travelled", {}, distance)
        return distance

    def stop(self) -> None:
        """See `Robot.stop`.

        Raises:
            EpisodeOver: Always; it ends the episode.
        """
        self._log.begin()
        self.finish()
        raise EpisodeOver(self.stopped_by or "agent")

    # What the evaluation calls.

    def finish(self) -> str:
        """End the episode, as `stop` does, but return why it ended instead of raising.

        Does nothing when it is over already.

        Returns:
            `agent`, `budget` or `stuck`.
        """
        if self._log.stopped_by is None:
            self._log.stopped_by = "agent"
            try:
                self._driver.come_to_rest(self._follower)
            except TimeIsUp:
                self._log.stopped_by = "budget"
            self._end("stop", {}, None)
        return self._log.stopped_by

    def follow(self, line: ArrayLike) -> MoveResult:
        """Drive along a given line to its end; privileged, for the oracle.

        Obstacles are not looked at. It stops and turns on the spot where the line bends
        by more than 25 degrees.

        Args:
            line: Vertices, metres, shape (N, 2).

        Raises:
            CommandError: The line has no meaning.
        """
        self._log.begin()
        points = np.asarray(line, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
            raise CommandError(
                f"follow: expected finite points of shape (N, 2), got {line!r}"
            )
        before = self._driver.distance
        self._follower = None
        reason: MoveEnd
        try:
            reason = "done" if follow_line(self._driver, points) else "wall"
        except TimeIsUp:
            reason = "budget"
            self._log.stopped_by = "budget"
        self._face(self._driver.pose.heading, None)
        result = MoveResult(self._driver.distance - before, reason)
        self._end("follow", {"line": points.tolist()}, asdict(result))
        return result

    def camera_view(self) -> CameraView:
        """Return what the camera sees from where the robot is."""
        from memorymaze.simulation.visibility import RayCamera

        self._driver.base.update_view()
        return RayCamera(self.scene, self._driver.base.data)

    @property
    def pose(self) -> Pose:
        """Where it is."""
        return self._driver.pose

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self._driver.time

    @property
    def collisions(self) -> tuple[Collision, ...]:
        """Every time its body touched something."""
        return tuple(self._driver.collisions)

    @property
    def refused_turns(self) -> int:
        """Calls of `turn` that found no way or were no direction."""
        return self._refused_turns

    @property
    def calls(self) -> int:
        """Calls of the control API so far."""
        return self._log.calls

    @property
    def stopped_by(self) -> str | None:
        """Why the episode is over: `agent`, `budget` or `stuck`; None while it runs."""
        return self._log.stopped_by

    def trajectory(self) -> Trajectory:
        """Return where it has been: every 0.2 s and after every call."""
        return self._driver.trajectory()

    # How it moves.

    def _move(self, distance: float) -> MoveEnd:
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
        how = driver.follow(follower, distance, self.settings.rolling_speed)
        self._course = follower.station.course
        if how == "distance":
            return "done"
        if how == "end":
            return "obstacle" if follower.lane.end == "obstacle" else "wall"
        self._follower = None
        touched = driver.collisions[-1].kind if driver.collisions else "wall"
        return "obstacle" if touched == "landmark" else "wall"

    def _planned(self) -> LaneFollower:
        driver = self._driver
        driver.come_to_rest(self._follower)
        pose = driver.pose
        way = self.scene.straight_ways.way(
            (pose.x, pose.y), self._course, fresh=self._fresh, towards=self._towards
        )
        lane = plan_lane(way, pose, self.scene.clearance, self.settings.max_speed)
        follower = LaneFollower(lane)
        follower.update(pose)
        if lane.length > 0 and abs(follower.off_course) > SPIN_FIRST:
            driver.spin_to(lane.stations[0].heading)
            follower.update(driver.pose)
        self._follower = follower
        self._fresh = False
        return follower

    def _directions(self) -> list[Direction]:
        visit = self._driver.visits.current
        if visit is None:
            return []
        found = {
            direction_of(turn_between(self._course, each.heading))
            for each in visit.onward()
        }
        return [direction for direction in DIRECTIONS if direction in found]

    def _turn(self, direction: Direction) -> TurnResult:
        visit = self._driver.visits.current
        if direction == "around":
            return self._turn_around(visit)
        if visit is None:
            return TurnResult(
                False,
                0.0,
                "this is not a turning point; only 'around' is possible here",
            )
        exits = list(visit.point.exits) if visit.turned else visit.onward()
        angles = [turn_between(self._course, each.heading) for each in exits]
        chosen = exit_meant(direction, angles)
        if chosen is None:
            there_are = ", ".join((*self._directions(), "around"))
            return TurnResult(
                False,
                0.0,
                f"no way lies {_in_words(direction)}; there are: {there_are}",
            )
        return self._turn_into(visit, exits[chosen], direction)

    def _turn_into(self, visit: Visit, chosen: Exit, direction: str) -> TurnResult:
        driver = self._driver
        driver.come_to_rest(self._follower)
        before = driver.pose.heading
        place = (driver.pose.x, driver.pose.y)
        if self._follower is not None:
            station = self._follower.station
            place = (station.way_x, station.way_y)
        meeting = meeting_point(
            visit.point, chosen, place, self._course, self.scene.straight_ways
        )
        if self.scene.clearance.is_free(
            [driver.pose[:2], meeting], ROBOT_RADIUS + 0.02
        ):
            driver.drive_to(*meeting)
        driver.spin_to(chosen.heading)
        self._face(chosen.heading, chosen.to)
        angle = math.degrees(turn_between(before, driver.pose.heading))
        return TurnResult(
            True, angle, f"turned {abs(angle):.0f} degrees, {_in_words(direction)}"
        )

    def _turn_around(self, visit: Visit | None) -> TurnResult:
        driver = self._driver
        driver.come_to_rest(self._follower)
        before = driver.pose.heading
        back = self._course + math.pi
        towards = None
        if visit is not None:
            behind = min(
                visit.point.exits,
                key=lambda each: abs(turn_between(back, each.heading)),
                default=None,
            )
            if (
                behind is not None
                and abs(turn_between(back, behind.heading)) <= BACK_SECTOR
            ):
                back, towards = behind.heading, behind.to
        driver.spin_to(back)
        self._face(back, towards)
        angle = math.degrees(turn_between(before, driver.pose.heading))
        return TurnResult(True, angle, "turned around")

    def _face(self, course: float, towards: str | None) -> None:
        """Take a new course, from where the robot stands."""
        self._course = wrap_angle(course)
        self._towards = towards
        self._fresh = True
        self._follower = None
        self._driver.visits.note_turn()

    def _eyes(self) -> Detector:
        if self._detector is None:
            from memorymaze.perception.truth_detector import TruthDetector

            self._detector = TruthDetector()
        return self._detector

    def _end(self, call: str, arguments: Mapping[str, object], result: object) -> None:
        self._driver.sample()
        self._log.end(
            call,
            arguments,
            result,
            time=self.time,
            pose=self.pose,
            distance=self._driver.distance,
        )


def _distance(distance: object) -> float:
    if (
        isinstance(distance, int | float)
        and not isinstance(distance, bool)
        and math.isfinite(distance)
        and distance > 0
    ):
        return float(distance)
    raise CommandError(
        f"move_forward: expected a distance in metres greater than 0, got {distance!r}"
    )


def _in_words(direction: str) -> str:
    return {
        "forward": "straight on",
        "left": "to the left",
        "right": "to the right",
    }.get(direction, direction.replace("_", " "))
