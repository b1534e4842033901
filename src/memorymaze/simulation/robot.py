"""`SimulatedRobot`: the guide robot's control API on a simulated building."""

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.errors import (
    CommandError,
    EpisodeOver,
    RenderingError,
    SettingsError,
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
from memorymaze.robot.steps import CameraPicture
from memorymaze.simulation.cameras import (
    CameraFrame,
    CameraMaker,
    PanoramaFrame,
    RobotCameras,
)
from memorymaze.simulation.motion.driving import Driver, TimeIsUp
from memorymaze.simulation.motion.pilot import Pilot, parse_direction
from memorymaze.simulation.obstacles.surroundings import NearMiss, Surroundings
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.lidar import Lidar, LidarScan, LidarSettings
from memorymaze.simulation.senses.lidar_turning_points import LidarTurningPoints
from memorymaze.simulation.senses.odometry import Odometry, OdometrySettings
from memorymaze.simulation.senses.visibility import RayCamera, camera_elsewhere
from memorymaze.simulation.settings import TIMESTEP, SimulationSettings
from memorymaze.simulation.trace import CallLog, Collision, TraceEvent


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

    # What agents call.

    def move_forward(self, distance: float) -> MoveResult:
        """See `Robot.move_forward`."""
        self._log.begin()
        try:
            metres = _metres(distance)
        except CommandError as error:
            self._refuse("move_forward", {"distance": repr(distance)}, error)
            raise
        before = self._driver.distance
        reason: MoveEnd
        try:
            reason = self._pilot.move(metres)
        except TimeIsUp:
            reason = "budget"
            self._log.stopped_by = "budget"
        result = MoveResult(self._driver.distance - before, reason)
        self._end("move_forward", {"distance": metres}, asdict(result))
        return result

    def detect_turning_point(self) -> list[Direction]:
        """See `Robot.detect_turning_point`."""
        self._log.begin()
        directions = self._pilot.directions()
        self._end("detect_turning_point", {}, directions)
        return list(directions)

    def turning_point_id(self) -> int | None:
        """See `Robot.turning_point_id`."""
        self._log.begin()
        number = self._driver.turning_points.number
        self._end("turning_point_id", {}, number)
        return number

    def turn(self, direction: str) -> TurnResult:
        """See `Robot.turn`; unknown words are refused with `turned` False."""
        self._log.begin()
        try:
            result = self._pilot.turn(parse_direction(direction))
        except CommandError as error:
            result = TurnResult(False, 0.0, str(error))
        except TimeIsUp:
            self._log.stopped_by = "budget"
            result = TurnResult(False, 0.0, "the time budget ran out")
        self._refused_turns += not result.turned
        self._end("turn", {"direction": str(direction)}, asdict(result))
        return result

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        """See `Robot.detect_from_RGB_image`."""
        self._log.begin()
        if not _is_text(object):
            error = CommandError(
                "detect_from_RGB_image: expected what to look for in a few words, "
                f"got {object!r}"
            )
            self._refuse("detect_from_RGB_image", {"object": repr(object)}, error)
            raise error
        try:
            found = self._detector.detect(self.camera_view(), object)
        except CommandError as error:
            self._refuse("detect_from_RGB_image", {"object": object[:80]}, error)
            raise
        result = [asdict(each) for each in found]
        self._end("detect_from_RGB_image", {"object": object}, result)
        return found

    def read_signs(self) -> list[SignText]:
        """See `Robot.read_signs`."""
        self._log.begin()
        found = self._sign_reader.read(self.camera_view())
        self._end("read_signs", {}, [asdict(each) for each in found])
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

    # What agents that go step by step call besides; programs do not.

    def step_forward(self, distance: float) -> float:
        """See `SteppingRobot.step_forward`."""
        self._log.begin()
        try:
            metres = _metres(distance, "step_forward")
        except CommandError as error:
            self._refuse("step_forward", {"distance": repr(distance)}, error)
            raise
        before = self._driver.distance
        try:
            moved = self._pilot.step_forward(metres)
        except TimeIsUp:
            moved = self._driver.distance - before
            self._log.stopped_by = "budget"
        self._end("step_forward", {"distance": metres}, moved)
        return moved

    def rotate(self, angle: float) -> float:
        """See `SteppingRobot.rotate`."""
        self._log.begin()
        try:
            radians = _radians(angle)
        except CommandError as error:
            self._refuse("rotate", {"angle": repr(angle)}, error)
            raise
        before = self.pose.heading
        try:
            turned = self._pilot.rotate(radians)
        except TimeIsUp:
            turned = turn_between(before, self.pose.heading)
            self._log.stopped_by = "budget"
        self._end("rotate", {"angle": radians}, turned)
        return turned

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SteppingRobot.camera_picture`; the first call takes seconds."""
        self._log.begin()
        asked = {"width": width, "height": height, "horizontal_fov": horizontal_fov}
        try:
            picture = self._draw(width, height, horizontal_fov)
        except SettingsError as error:
            self._refuse("camera_picture", asked, error)
            raise
        self._end("camera_picture", asked, None)
        return picture

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
        self._log.begin()
        asked = {"speed": speed, "turn_rate": turn_rate, "seconds": seconds}
        try:
            self._check_drive(asked)
        except CommandError as error:
            said = {name: repr(value) for name, value in asked.items()}
            self._refuse("drive", said, error)
            raise
        before = self._driver.distance
        try:
            driven = self._pilot.drive(speed, turn_rate, seconds)
        except TimeIsUp:
            driven = self._driver.distance - before
            self._log.stopped_by = "budget"
        self._end("drive", asked, driven)
        return driven

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
            self._end("stop", {}, None)
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
        self._log.begin()
        points = np.asarray(line, dtype=np.float64)
        if (
            points.ndim != 2
            or points.shape[1:] != (2,)
            or not np.isfinite(points).all()
        ):
            raise CommandError(
                f"follow: expected finite points of shape (N, 2), got {line!r}"
            )
        before = self._driver.distance
        reason: MoveEnd
        try:
            reason = self._pilot.follow(points)
        except TimeIsUp:
            reason = "budget"
            self._log.stopped_by = "budget"
        result = MoveResult(self._driver.distance - before, reason)
        self._end("follow", {"line": points.tolist()}, asdict(result))
        return result

    def watch(self, on_motion: Callable[[float, Pose], None]) -> None:
        """Have time and pose told while it moves, to something that only looks."""
        self._driver.on_motion = on_motion

    def lidar_scan(self) -> LidarScan:
        """Return what the LiDAR measures from where the robot is."""
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
        """Simulated seconds it stood in `wait`."""
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

    def _check_drive(self, asked: Mapping[str, object]) -> None:
        bounds = {
            "speed": (-self.settings.max_speed, self.settings.max_speed),
            "turn_rate": (-self.settings.max_turn_rate, self.settings.max_turn_rate),
            "seconds": (TIMESTEP, math.inf),
        }
        for name, value in asked.items():
            lowest, highest = bounds[name]
            number = _finite(value)
            # Speeds often come as 32-bit numbers, which are a rounding error off.
            slack = 0.0 if math.isinf(highest) else 1e-6 * highest
            if number is None or not lowest - slack <= number <= highest + slack:
                raise CommandError(
                    f"drive: expected {name} from {lowest} to {highest}, got {value!r}"
                )

    def _refuse(
        self, call: str, arguments: Mapping[str, object], error: Exception
    ) -> None:
        self._end(call, arguments, {"error": str(error)})

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


def _is_text(value: object) -> bool:
    return isinstance(value, str) and bool(value.strip())


def _metres(distance: object, call: str = "move_forward") -> float:
    metres = _finite(distance)
    if metres is not None and metres > 0:
        return metres
    raise CommandError(
        f"{call}: expected a distance in metres greater than 0, got {distance!r}"
    )


def _radians(angle: object) -> float:
    radians = _finite(angle)
    # A full turn in whole steps may be a rounding error more.
    if radians is not None and 0 < abs(radians) <= 2 * math.pi + 1e-9:
        return radians
    raise CommandError(
        "rotate: expected an angle in radians, left positive, not 0 and at most a "
        f"full turn (2 pi), got {angle!r}"
    )


def _finite(value: object) -> float | None:
    # bool is an int to Python, but no measure.
    if isinstance(value, int | float | np.number) and not isinstance(value, bool):
        number = float(value)
        return number if math.isfinite(number) else None
    return None
