"""`SimulatedRobot`: the guide robot's control API on a simulated building."""

import math
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, suppress
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.errors import (
    CommandError,
    EpisodeOver,
    RenderingError,
)
from memorymaze.geometry.pose import Pose, turn_between
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.perception.camera_view import CameraView
from memorymaze.perception.detector import Detector, TruthDetector
from memorymaze.perception.sign_reading import SignReader, TruthSignReader
from memorymaze.robot.api import (
    Detection,
    Direction,
    MoveEnd,
    MoveResult,
    SignText,
    TurnResult,
)
from memorymaze.robot.asking import Question, seconds_to_say
from memorymaze.robot.steps import CameraPicture, LidarScan
from memorymaze.simulation.cameras import (
    CameraFrame,
    CameraMaker,
    PanoramaFrame,
    RobotCameras,
)
from memorymaze.simulation.motion.commands import (
    check_speeds,
    degrees_to_turn,
    metres_ahead,
    parse_direction,
    radians_to_turn,
    words_to_look_for,
)
from memorymaze.simulation.motion.driving import Driver, TimeIsUp
from memorymaze.simulation.motion.pilot import Pilot
from memorymaze.simulation.obstacles.crowd import Person
from memorymaze.simulation.obstacles.surroundings import NearMiss, Surroundings
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.lidar import Lidar, LidarSettings
from memorymaze.simulation.senses.odometry import Odometry, OdometrySettings
from memorymaze.simulation.senses.turning_points import LidarTurningPoints
from memorymaze.simulation.senses.visibility import RayCamera, camera_elsewhere
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.simulation.trace import Call, CallLog, Collision, Moment, TraceEvent

Result = TypeVar("Result")


class SimulatedRobot:
    """A guide robot in a simulated building; implements `Robot` and `SteppingRobot`.

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
        sign_reader: SignReader | None = None,
        obstacles_rng: np.random.Generator | None = None,
        keep_free: Sequence[tuple[float, float]] = (),
        lidar: LidarSettings | None = None,
        odometry: OdometrySettings | None = None,
        cameras: CameraMaker | None = None,
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
            sign_reader: Eyes of `read_signs`; None knows what is written on things.
            obstacles_rng: Source of where things stand and how people walk, in a scene
                that has them; None seeds one with the seed of its settings.
            keep_free: Points besides the start where nothing may stand, metres.
            lidar: What its LiDAR measures and how well; the defaults when None. A
                child of `rng` gives the noise.
            odometry: How far its odometry is off, for `turning_points="lidar"`; exact
                when None. Another child of `rng` gives the noise.
            cameras: What draws its pictures, such as `memorymaze.pictures.robot_cameras`;
                None for a robot that takes none.

        Raises:
            SettingsError: There are to be people, and the package for them is missing.
        """
        self.scene = scene
        """The building it is in."""
        self.settings = settings or SimulationSettings()
        """Its abilities and the limits of the episode."""
        rng = rng or np.random.default_rng(0)
        self._driver = Driver(scene, start, self.settings, rng)
        if scene.obstacles is not None:
            self._driver.surroundings = Surroundings(
                scene,
                self._driver.base.data,
                start,
                keep_free,
                obstacles_rng or np.random.default_rng(scene.obstacles.seed),
            )
        lidar_rng, odometry_rng = rng.spawn(2)
        self._lidar = Lidar(scene, self._driver.base.data, lidar, lidar_rng)
        if self.settings.turning_points == "lidar":
            self._driver.turning_points = LidarTurningPoints(
                self._lidar, Odometry(start, odometry, odometry_rng), start
            )
        self._pilot = Pilot(scene, self._driver, self.settings)
        self._log = CallLog(self.settings, on_event)
        self._detector = detector or TruthDetector(self.settings.detection_range)
        self._sign_reader = sign_reader or TruthSignReader()
        self._camera_maker = cameras
        self._refused_turns = 0
        self._look: tuple[tuple[float, Pose], RayCamera] | None = None
        """When and where the camera looked last, and what it sees there."""

    def __repr__(self) -> str:
        """Say where it is, and when."""
        x, y, heading = self.pose
        return (
            f"SimulatedRobot({self.scene.site.name}: x {x:.2f} m, y {y:.2f} m, heading "
            f"{math.degrees(heading):.0f} degrees, {self.time:.1f} s, "
            f"{self._driver.distance:.1f} m driven)"
        )

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
            return call.returns(self._driver.turning_points.number)

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
            return call.returns(self._detector.detect(self.camera_view(), words))

    def read_signs(self) -> list[SignText]:
        """See `Robot.read_signs`."""
        with self._call("read_signs") as call:
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
            before = self.pose.heading
            return call.returns(
                self._in_time(
                    lambda: self._pilot.rotate(radians),
                    lambda: turn_between(before, self.pose.heading),
                )
            )

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SteppingRobot.camera_picture`; the first call takes seconds."""
        asked = {"width": width, "height": height, "horizontal_fov": horizontal_fov}
        with self._call("camera_picture", **asked):
            return self._draw(width, height, horizontal_fov)

    # What the evaluation calls.

    def drive(self, speed: float, turn_rate: float, seconds: float) -> float:
        """Go for given speeds for some time, whatever is in the way; then roll on.

        Args:
            speed: Ahead, metres per second, at most `max_speed`; negative backs up.
            turn_rate: Radians per second, left positive, at most `max_turn_rate`.
            seconds: More than 0; in steps of the physics, 10 ms.

        Returns:
            Metres driven.

        Raises:
            CommandError: A number has no meaning.
            EpisodeOver: The episode is over.
        """
        asked = {"speed": speed, "turn_rate": turn_rate, "seconds": seconds}
        with self._call("drive", **asked) as call:
            check_speeds(self.settings, asked)
            before = self._driver.distance
            return call.returns(
                self._in_time(
                    lambda: self._pilot.drive(speed, turn_rate, seconds),
                    lambda: self._driver.distance - before,
                )
            )

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

    def wait(self, seconds: float) -> float:
        """Stand while time passes, as for a language model that thinks; no call.

        A robot that rolls comes to rest first. The time budget is for walking: what is
        stood here does not count against it. Does nothing when the episode is over.

        Args:
            seconds: Simulated, at least 0.

        Returns:
            Seconds stood, a multiple of the physics step.

        Raises:
            CommandError: The time has no meaning.
        """
        if not (math.isfinite(seconds) and seconds >= 0):
            raise CommandError(f"wait: expected 0 or more seconds, got {seconds!r}")
        if self._log.stopped_by is not None:
            return 0.0
        before = self._driver.standing_time
        try:
            self._pilot.come_to_rest()
            self._driver.stand(seconds)
        except TimeIsUp:
            self._log.stopped_by = "budget"
        self._driver.sample()
        return round(self._driver.standing_time - before, 6)

    def ask(self, question: Question, answer: Callable[[Person], str]) -> str | None:
        """Put a question to the nearest person in hearing; None where nobody is.

        Both stand while they speak, which does not count against the time budget. What
        they say is asked for when the robot is at rest.
        """
        with self._call("ask", question=str(question)) as call:
            around = self.surroundings
            person = None if around is None else around.person_in_hearing(self.pose)
            if person is None:
                return call.returns(None)
            self.wait(0.0)
            words = answer(person)
            seconds = seconds_to_say(str(question)) + seconds_to_say(words)
            person.stand_still(self.time + seconds)
            self.wait(seconds)
            return call.returns(words)

    def follow(self, line: ArrayLike) -> MoveResult:
        """Drive along a given line to its end; privileged, for the oracle.

        The plan's own obstacles are not looked at; it goes round things that were left
        in the way, and round people or waits for them. It stops and turns on the spot where the line bends
        by more than 25 degrees.

        Args:
            line: Vertices, metres, shape (N, 2).

        Raises:
            CommandError: The line has no meaning.
        """
        with self._call("follow", line=line) as call:
            points = np.asarray(line, dtype=np.float64)
            if (
                points.ndim != 2
                or points.shape[1:] != (2,)
                or not np.isfinite(points).all()
            ):
                raise CommandError(
                    f"follow: expected finite points of shape (N, 2), got {line!r}"
                )
            call.arguments["line"] = points.tolist()
            return self._moved(call, lambda: self._pilot.follow(points))

    def watch(self, on_motion: Callable[[float, Pose], None]) -> None:
        """Have time and pose told while it moves, to something that only looks."""
        self._driver.on_motion = on_motion

    def lidar_scan(self) -> LidarScan:
        """See `SteppingRobot.lidar_scan`."""
        return self._lidar.scan(self.pose, self.time)

    def camera_view(self) -> CameraView:
        """Return what the camera sees from where the robot is."""
        moment = (self.time, self.pose)
        if self._look is None or self._look[0] != moment:
            self._driver.base.update_view()
            camera = RayCamera(self.scene, self._driver.base.data, self._draw)
            self._look = (moment, camera)
        return self._look[1]

    def _draw(self, width: int, height: int, horizontal_fov: float) -> CameraPicture:
        frame = self.camera_frame(width, height, horizontal_fov)
        return CameraPicture(frame.rgb, frame.depth)

    def camera_view_from(self, pose: Pose) -> CameraView:
        """Return what the camera would see now if the robot were elsewhere."""
        return camera_elsewhere(self.scene, self._driver.base.data, pose)

    def camera_frame(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraFrame:
        """Draw what the camera sees from where the robot is: colours, depth, ids.

        The first call builds the building's looks, which takes seconds.

        Args:
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians.

        Raises:
            RenderingError: This machine cannot draw; says what to install.
        """
        return self._eyes.frame(self.pose, width, height, horizontal_fov)

    def panorama(self, width: int = 1024) -> PanoramaFrame:
        """Draw the view all round from the camera's place.

        Args:
            width: Pixels, even; the picture is half as high.

        Raises:
            RenderingError: This machine cannot draw; says what to install.
        """
        return self._eyes.panorama(self.pose, width)

    @cached_property
    def _eyes(self) -> RobotCameras:
        if self._camera_maker is None:
            raise RenderingError(
                "expected a robot with cameras, got one made without; give "
                "SimulatedRobot cameras=memorymaze.pictures.robot_cameras"
            )
        return self._camera_maker(self.scene, self._driver.base.data)

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
    def surroundings(self) -> Surroundings | None:
        """Things and people around it; None in a building that is as in its plan."""
        return self._driver.surroundings

    @property
    def near_misses(self) -> tuple[NearMiss, ...]:
        """Every time a person and its body were closer than 0.3 m."""
        around = self._driver.surroundings
        closeness = None if around is None else around.closeness
        return () if closeness is None else tuple(closeness.near_misses)

    @property
    def waiting_time(self) -> float:
        """Simulated seconds it stood because people were in the way."""
        return self._driver.waiting_time

    @property
    def standing_time(self) -> float:
        """Simulated seconds it stood in `wait` and in `ask`."""
        return self._driver.standing_time

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

    def _moved(self, call: Call, motion: Callable[[], MoveEnd]) -> MoveResult:
        before = self._driver.distance
        reason = self._in_time(motion, _out_of_time)
        return call.returns(MoveResult(self._driver.distance - before, reason))

    def _in_time(
        self, motion: Callable[[], Result], cut_short: Callable[[], Result]
    ) -> Result:
        """Return what a motion returns, or what is left to say when the time is up."""
        try:
            return motion()
        except TimeIsUp:
            self._log.stopped_by = "budget"
            return cut_short()

    def _call(self, name: str, **arguments: object) -> AbstractContextManager[Call]:
        return self._log.call(name, arguments, self._moment)

    def _moment(self) -> Moment:
        self._driver.sample()
        return Moment(self.time, self.pose, self._driver.distance)


def _out_of_time() -> MoveEnd:
    return "budget"


def _turn_cut_short() -> TurnResult:
    return TurnResult(False, 0.0, "the time budget ran out")
