"""`GuideRobot`: the control API on a body of one's own."""

import math
from collections.abc import Callable
from contextlib import AbstractContextManager, suppress
from typing import TypeVar

from memorymaze.basics.errors import CommandError, EpisodeOver
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.robot.api.control import (
    Detection,
    Direction,
    MoveEnd,
    MoveResult,
    SignText,
    TurnResult,
)
from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion
from memorymaze.robot.api.steps import CameraPicture, LidarScan
from memorymaze.robot.perception.camera_view import CameraView, PictureView
from memorymaze.robot.perception.detector import Detector
from memorymaze.robot.perception.sign_reading import SignReader
from memorymaze.robot.steering.calls import Call, CallEnd, CallLog, TraceEvent
from memorymaze.robot.steering.commands import (
    degrees_to_turn,
    metres_ahead,
    parse_direction,
    radians_to_turn,
    words_to_look_for,
)
from memorymaze.robot.steering.driving import Driver, TimeIsUp
from memorymaze.robot.steering.floor import KnownFloor
from memorymaze.robot.steering.pilot import Pilot
from memorymaze.robot.steering.sensed_floor import SensedFloor
from memorymaze.robot.steering.settings import RobotSettings

_Result = TypeVar("_Result")


class GuideRobot:
    """A guide robot with a body of one's own; implements `Robot` and `SteppingRobot`.

    A move that is done hands over rolling, at up to `rolling_speed`; looking does not
    stop it, the next move carries on, and anything else first brings it to rest (within
    0.1 m). Every call raises `EpisodeOver` once the episode is over, and `CommandError`
    for arguments without meaning.
    """

    def __init__(
        self,
        body: SensorsAndMotion,
        floor: KnownFloor | None = None,
        settings: RobotSettings | None = None,
        on_event: Callable[[TraceEvent], None] | None = None,
        *,
        detector: Detector | None = None,
        sign_reader: SignReader | None = None,
    ) -> None:
        """Begin an episode where the body stands.

        Args:
            body: What moves and measures.
            floor: What is known of the floor; None for what the LiDAR sees, in the frame
                of the body's odometry.
            settings: Abilities and limits; the defaults when None.
            on_event: Called after each call of the control API.
            detector: Eyes of `detect_from_RGB_image`, such as a `PictureDetector`; with
                None nothing is ever seen.
            sign_reader: Eyes of `read_signs`; with None nothing is ever read.
        """
        self.settings = settings or RobotSettings()
        """Its abilities and the limits of the episode."""
        self._body = body
        self._floor = floor or SensedFloor(body)
        self._driver = Driver(body, self._floor, self.settings)
        self._pilot = Pilot(self._driver, self.settings)
        self._log = CallLog(self.settings, on_event)
        self._detector = detector
        self._sign_reader = sign_reader
        self._refused_turns = 0

    # What agents call.

    def move_forward(self, distance: float) -> MoveResult:
        """See `Robot.move_forward`."""
        with self._call("move_forward", distance=distance) as call:
            metres = call.arguments["distance"] = metres_ahead("move_forward", distance)
            return self._moved(call, lambda: self._pilot.move(metres))

    def detect_turning_point(self) -> list[Direction]:
        """See `Robot.detect_turning_point`."""
        with self._call("detect_turning_point") as call:
            return call.returns(self._pilot.directions())

    def turning_point_id(self) -> int | None:
        """See `Robot.turning_point_id`."""
        with self._call("turning_point_id") as call:
            return call.returns(self._floor.turning_points.number)

    def turn(self, direction: str) -> TurnResult:
        """See `Robot.turn`; unknown words are refused with `turned` False."""
        with self._call("turn", direction=str(direction)) as call:
            try:
                way = parse_direction(direction)
                result = self._in_time(lambda: self._pilot.turn(way), _turn_cut_short)
            except CommandError as error:
                result = TurnResult(False, 0.0, str(error))
            self._refused_turns += not result.turned
            return call.returns(result)

    def turn_by(self, degrees: float) -> TurnResult:
        """See `Robot.turn_by`."""
        with self._call("turn_by", degrees=degrees) as call:
            radians = degrees_to_turn(degrees)
            return call.returns(
                self._in_time(lambda: self._pilot.turn_by(radians), _turn_cut_short)
            )

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        """See `Robot.detect_from_RGB_image`."""
        with self._call("detect_from_RGB_image", object=object) as call:
            words = words_to_look_for(object)
            if self._detector is None:
                return call.returns([])
            return call.returns(self._detector.detect(self.camera_view(), words))

    def read_signs(self) -> list[SignText]:
        """See `Robot.read_signs`."""
        with self._call("read_signs") as call:
            if self._sign_reader is None:
                return call.returns([])
            return call.returns(self._sign_reader.read(self.camera_view()))

    def say(self, text: str) -> None:
        """See `Robot.say`."""
        with self._call("say", text=str(text)):
            pass

    def distance_travelled(self) -> float:
        """See `Robot.distance_travelled`."""
        with self._call("distance_travelled") as call:
            return call.returns(self._driver.distance)

    def stop(self) -> None:
        """See `Robot.stop`.

        Raises:
            EpisodeOver: Always; it ends the episode.
        """
        self._log.begin()
        self.finish()
        raise EpisodeOver(self.stopped_by or "agent")

    # What agents that go step by step call besides; programs do not.

    def step_forward(self, distance: float) -> float:
        """See `SteppingRobot.step_forward`."""
        with self._call("step_forward", distance=distance) as call:
            metres = call.arguments["distance"] = metres_ahead("step_forward", distance)
            before = self._driver.distance
            return call.returns(
                self._in_time(
                    lambda: self._pilot.step_forward(metres),
                    lambda: self._driver.distance - before,
                )
            )

    def rotate(self, angle: float) -> float:
        """See `SteppingRobot.rotate`."""
        with self._call("rotate", angle=angle) as call:
            radians = call.arguments["angle"] = radians_to_turn(angle)
            before = self._driver.pose.heading
            return call.returns(
                self._in_time(
                    lambda: self._pilot.rotate(radians),
                    lambda: turn_between(before, self._driver.pose.heading),
                )
            )

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SteppingRobot.camera_picture`."""
        asked = {"width": width, "height": height, "horizontal_fov": horizontal_fov}
        with self._call("camera_picture", **asked):
            return self._body.camera_picture(width, height, horizontal_fov)

    def lidar_scan(self) -> LidarScan:
        """See `SteppingRobot.lidar_scan`."""
        return self._body.lidar_scan()

    # What those call who run the agent.

    def camera_view(self) -> CameraView:
        """Return what the camera sees, for detectors and readers of signs."""
        return PictureView(self._driver.pose, self._body.camera_picture)

    def finish(self) -> str:
        """End the episode, as `stop` does, but return why it ended instead of raising.

        Does nothing when it is over already.

        Returns:
            `agent`, `budget` or `stuck`.
        """
        if self._log.stopped_by is None:
            self._log.stopped_by = "agent"
            with suppress(TimeIsUp):
                self._pilot.come_to_rest()
            self._log.end("stop", {}, None, self._moment())
        return self._log.stopped_by

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

    def _moved(self, call: Call, motion: Callable[[], MoveEnd]) -> MoveResult:
        before = self._driver.distance
        reason = self._in_time(motion, _out_of_time)
        return call.returns(MoveResult(self._driver.distance - before, reason))

    def _in_time(
        self, motion: Callable[[], _Result], cut_short: Callable[[], _Result]
    ) -> _Result:
        """Return what a motion returns, or what is left to say when the time is up."""
        try:
            return motion()
        except TimeIsUp:
            self._log.stopped_by = "budget"
            return cut_short()

    def _call(self, name: str, **arguments: object) -> AbstractContextManager[Call]:
        return self._log.call(name, arguments, self._moment)

    def _moment(self) -> CallEnd:
        """Return when and where a call ended."""
        return CallEnd(self._driver.time, self._driver.pose, self._driver.distance)


def _out_of_time() -> MoveEnd:
    return "budget"


def _turn_cut_short() -> TurnResult:
    return TurnResult(False, 0.0, "the time budget ran out")
