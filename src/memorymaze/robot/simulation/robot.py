"""`SimulatedRobot`: the guide robot in a building, with what the evaluation asks."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import CommandError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.robot.api.asking import Question, seconds_to_say
from memorymaze.robot.api.control import MoveEnd, MoveResult
from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion
from memorymaze.robot.perception.camera_view import CameraView
from memorymaze.robot.perception.detector import Detector, TruthDetector
from memorymaze.robot.perception.sign_reading import SignReader, TruthSignReader
from memorymaze.robot.simulation.body import BodyInSite, Collision, SimulatedBody
from memorymaze.robot.simulation.motion.line_following import follow_line
from memorymaze.robot.simulation.obstacles.crowd import Person
from memorymaze.robot.simulation.obstacles.surroundings import (
    NearMiss,
    ObstacleSurroundings,
)
from memorymaze.robot.simulation.own_body import OwnBody
from memorymaze.robot.simulation.plan_floor import PlanFloor
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.senses.lidar_settings import LidarSettings
from memorymaze.robot.simulation.senses.odometry import OdometrySettings
from memorymaze.robot.simulation.senses.turning_points import AnnotatedTurningPoints
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.calls import CallEnd, TraceEvent
from memorymaze.robot.steering.commands import check_speeds, seconds_to_stand
from memorymaze.robot.steering.driving import TimeIsUp
from memorymaze.robot.steering.guide_robot import GuideRobot
from memorymaze.robot.steering.turning_points import TurningPointSource
from memorymaze.world.looks import OWN, Looks

if TYPE_CHECKING:
    from memorymaze.world.cameras import CameraFrame


class SimulatedRobot(GuideRobot):
    """A guide robot on a simulated body, with the plan's knowledge of the floor.

    Simulated time passes only while a call moves the robot.
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
        looks: Looks = OWN,
        knows_plan: bool = True,
        body: SensorsAndMotion | None = None,
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
            looks: How things look to its camera: `own`, `mesh`, or the path of a GLB file
                with models.
            knows_plan: Whether it steers by the plan and knows where it is on it. One that
                does not has its LiDAR and its odometry, as any robot on a body of one's
                own; `follow` is not for it.
            body: A body of a user's own that stands at the start; None for the simulated
                one. It has its own noise, LiDAR and cameras, and knows the plan where it
                has a `pose_in_site` (`OwnBody`).

        Raises:
            SettingsError: There are to be people, and the package for them is missing.
        """
        self.scene = scene
        """The building it is in."""
        settings = settings or SimulationSettings()
        placed: BodyInSite
        if body is not None:
            placed = OwnBody(scene, start, settings, body)
        else:
            placed = simulated = SimulatedBody(
                scene,
                start,
                settings,
                rng or np.random.default_rng(0),
                lidar=lidar,
                odometry=odometry,
                localised=knows_plan,
                looks=looks,
            )
            if scene.obstacles is not None:
                placed.surroundings = ObstacleSurroundings(
                    scene,
                    simulated.base.data,
                    start,
                    keep_free,
                    obstacles_rng or np.random.default_rng(scene.obstacles.seed),
                )
        super().__init__(
            placed,
            PlanFloor(placed, _turning_points(placed, start, settings))
            if placed.localised
            else None,
            settings,
            on_event,
            detector=detector or TruthDetector(settings.detection_range),
            sign_reader=sign_reader or TruthSignReader(),
        )
        self._body: BodyInSite = placed

    def __repr__(self) -> str:
        """Say where it is, and when."""
        x, y, heading = self.pose
        return (
            f"SimulatedRobot({self.scene.site.name}: x {x:.2f} m, y {y:.2f} m, heading "
            f"{math.degrees(heading):.0f} degrees, {self.time:.1f} s, "
            f"{self._driver.distance:.1f} m driven)"
        )

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
        stood = seconds_to_stand(seconds)
        if self._log.stopped_by is not None:
            return 0.0
        before = self._driver.standing_time
        try:
            self._pilot.come_to_rest()
            self._driver.come_to_rest()
            if self.surroundings is None:
                self._body.rest(stood)
                self._driver.note_rest(stood)
            else:
                self._driver.stand(stood)
        except TimeIsUp:
            self._log.stopped_by = "budget"
        self._body.sample()
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
        if not self._body.localised:
            raise CommandError(
                "follow: expected a robot that knows where it is on the plan, got one made "
                "with knows_plan=False"
            )
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
            return self._moved(call, lambda: self._follow(points))

    def watch(self, on_motion: Callable[[float, Pose], None]) -> None:
        """Have time and pose told while it moves, to something that only looks."""
        self._body.on_motion = on_motion

    def camera_view(self) -> CameraView:
        """Return what the camera sees from where the robot is."""
        return self._body.camera_view()

    def camera_view_from(self, pose: Pose) -> CameraView:
        """Return what the camera would see now if the robot were elsewhere."""
        return self._body.view_from(pose)

    def camera_frame(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> "CameraFrame":
        """Draw what the camera sees from where the robot is: colours, depth, ids.

        The first call builds the building's looks, which takes seconds.

        Args:
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians.

        Raises:
            RenderingError: This machine cannot draw; says what to install.
        """
        return self._body.camera_frame(width, height, horizontal_fov)

    @property
    def pose(self) -> Pose:
        """Where it is."""
        return self._body.pose

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self._body.time

    @property
    def collisions(self) -> tuple[Collision, ...]:
        """Every time its body touched something."""
        return tuple(self._body.collisions)

    @property
    def surroundings(self) -> ObstacleSurroundings | None:
        """Things and people around it; None in a building that is as in its plan."""
        return self._body.surroundings

    @property
    def near_misses(self) -> tuple[NearMiss, ...]:
        """Every time a person and its body were closer than 0.3 m."""
        around = self._body.surroundings
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

    def trajectory(self) -> Trajectory:
        """Return where it has been: every 0.2 s and after every call."""
        return self._body.trajectory()

    @property
    def tells_by_odometry(self) -> bool:
        """Whether its pose is what its odometry makes of the start, which may drift."""
        return isinstance(self._body, OwnBody) and not self._body.localised

    @property
    def lost(self) -> str | None:
        """Why its body does nothing any more; None while it does."""
        return self._body.lost if isinstance(self._body, OwnBody) else None

    def close(self) -> None:
        """Let go of its body; its walk can still be asked for."""
        self._body.close()

    def _follow(self, points: NDArray[np.float64]) -> MoveEnd:
        how = follow_line(self._driver, points, self.settings.max_speed)
        self._pilot.face(self._driver.pose.heading, None)
        if how == "blocked":
            return self._floor.what_blocks()
        return "done" if how == "arrived" else "obstacle"

    def _moment(self) -> CallEnd:
        self._body.sample()
        return CallEnd(self.time, self.pose, self._driver.distance)


def _turning_points(
    body: BodyInSite, start: Pose, settings: SimulationSettings
) -> TurningPointSource:
    if settings.turning_points == "lidar":
        return body.lidar_turning_points(start)
    annotated = AnnotatedTurningPoints(body.scene)
    annotated.update(start, start.heading, 0.0)
    return annotated
