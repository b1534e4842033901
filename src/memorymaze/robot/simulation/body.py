"""`SimulatedBody`: what moves and measures in a simulated building, and what that leaves.

It is driven and read through `SensorsAndMotion`, as any robot's body. What is known of it
besides is for the evaluation: the true pose, collisions, the trajectory.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.robot.api.sensors_and_motion import OdometryReading
from memorymaze.robot.api.steps import CameraPicture, LidarScan
from memorymaze.robot.perception.camera_view import CameraView
from memorymaze.robot.simulation.motion.kinematic_base import KinematicBase
from memorymaze.robot.simulation.motion.wheeled_base import WheeledBase
from memorymaze.robot.simulation.obstacles.surroundings import ObstacleSurroundings
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.senses.lidar import Lidar, LidarSettings
from memorymaze.robot.simulation.senses.odometry import Odometry, OdometrySettings
from memorymaze.robot.simulation.senses.visibility import RayCamera, camera_elsewhere
from memorymaze.robot.simulation.settings import TIMESTEP, SimulationSettings
from memorymaze.robot.steering.turning_points import LidarTurningPoints
from memorymaze.world.looks import OWN, Looks

if TYPE_CHECKING:
    from memorymaze.robot.simulation.cameras import SceneCameras
    from memorymaze.world.cameras import CameraFrame

SAME_TOUCH = 1.0
"""Seconds within which touching the same thing again is the same collision."""
AHEAD = 0.1
"""Cosine of the angle to straight ahead below which what it touches is beside it."""


@dataclass(frozen=True, slots=True)
class Collision:
    """The robot's body touched something; one record however long the touch lasted."""

    time: float
    """Simulated seconds since the start of the episode."""
    pose: Pose
    """Where the robot was at the first touch."""
    kind: str
    """`wall`, `door`, `landmark`, `thing` or `person`."""
    object_id: str | None
    """Id of what was touched; None for a wall."""


def base_for(
    scene: Scene, start: Pose, settings: SimulationSettings, rng: np.random.Generator
) -> WheeledBase | KinematicBase:
    """Put what moves the robot at rest on its start pose.

    Raises:
        SettingsError: The building has things or people, which takes physics.
    """
    settings.check_motion(as_in_plan=scene.obstacles is None)
    if settings.motion == "kinematic":
        return KinematicBase(scene.model, start, settings, rng, scene.touchables)
    tangible = scene.tangible, scene.tangible_geoms
    open_floor = None
    if scene.open_floor is not None:
        open_floor = scene.open_floor, scene.touchables.room
    return WheeledBase(scene.model, start, settings, rng, tangible, open_floor)


class BodyInSite(ABC):
    """A body in a building that has a plan, in one episode; a `SensorsAndMotion`."""

    localised = True
    """Whether odometry tells where it is in the building."""
    surroundings: ObstacleSurroundings | None = None
    """What there is beyond the plan; None for nothing, which costs nothing."""

    def __init__(self, scene: Scene, start: Pose, settings: SimulationSettings) -> None:
        """Begin to keep where it goes."""
        self.scene = scene
        """The building it is in."""
        self.pose = start
        """Where it really is, as far as anybody knows."""
        self.collisions: list[Collision] = []
        self.on_motion: Callable[[float, Pose], None] | None = None
        """Called with time and pose after each motion; must change nothing."""
        self._samples = [TimedPose(0.0, *start)]
        self._sampling_period = settings.sampling_period
        self._sample_due = settings.sampling_period
        self._look: tuple[tuple[float, Pose], RayCamera] | None = None
        """When and where the camera looked last, and what it sees there."""

    @property
    @abstractmethod
    def time(self) -> float:
        """Seconds by its clock since the start."""

    @abstractmethod
    def odometry(self) -> OdometryReading:
        """See `SensorsAndMotion.odometry`."""

    @abstractmethod
    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        """See `SensorsAndMotion.drive`."""

    @abstractmethod
    def lidar_scan(self) -> LidarScan:
        """See `SensorsAndMotion.lidar_scan`."""

    @abstractmethod
    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SensorsAndMotion.camera_picture`."""

    @abstractmethod
    def camera_frame(
        self, width: int, height: int, horizontal_fov: float
    ) -> "CameraFrame":
        """Draw what the camera sees, and what each pixel shows."""

    @abstractmethod
    def rest(self, seconds: float) -> None:
        """Let time pass for a robot at rest where nothing moves."""

    @abstractmethod
    def touches_ahead(self, course: float) -> bool:
        """Whether it touches something in its way."""

    @abstractmethod
    def look(self) -> RayCamera:
        """Look at the plan from where it is."""

    @abstractmethod
    def view_from(self, pose: Pose) -> CameraView:
        """Return what the camera would see now if the robot were elsewhere."""

    @abstractmethod
    def lidar_turning_points(self, start: Pose) -> LidarTurningPoints:
        """Return turning points that its scans and its odometry tell of."""

    def camera_view(self) -> CameraView:
        """Return what the camera truly sees: one look a moment, often asked about."""
        moment = (self.time, self.pose)
        if self._look is None or self._look[0] != moment:
            self._look = (moment, self.look())
        return self._look[1]

    def sample(self) -> None:
        """Add the present pose to the trajectory."""
        if self._samples[-1].time < self.time:
            self._samples.append(TimedPose(self.time, *self.pose))
        self._sample_due = self.time + self._sampling_period

    def trajectory(self) -> Trajectory:
        """Return the poses so far."""
        return Trajectory(self._samples)

    def close(self) -> None:
        """Let go of what the body holds; a simulated one holds nothing."""
        return

    def _has_moved(self) -> None:
        if self.time >= self._sample_due - 1e-9:
            self.sample()
        if self.on_motion is not None:
            self.on_motion(self.time, self.pose)


class SimulatedBody(BodyInSite):
    """The robot's body that the physics engine moves."""

    def __init__(
        self,
        scene: Scene,
        start: Pose,
        settings: SimulationSettings,
        rng: np.random.Generator,
        *,
        lidar: LidarSettings | None = None,
        odometry: OdometrySettings | None = None,
        localised: bool = True,
        looks: Looks = OWN,
    ) -> None:
        """Put it at rest on its start pose, with nobody around.

        Children of `rng` give the noise of LiDAR and odometry. A `localised` body knows
        where it is in the building; another one has its wheels' odometry alone, from the
        start pose on.
        """
        super().__init__(scene, start, settings)
        self.base = base_for(scene, start, settings, rng)
        self.pose = self.base.pose
        lidar_rng, odometry_rng = rng.spawn(2)
        self.lidar = Lidar(scene, self.base.data, lidar, lidar_rng)
        """Its LiDAR, which can measure from elsewhere as well."""
        self.wheel_odometry = Odometry(start, odometry, odometry_rng)
        """Where it would believe it is by its wheels."""
        self.localised = localised
        self._looks: Looks = looks
        self._touches: dict[int, float] = {}

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self.base.time

    # What steering calls.

    def odometry(self) -> OdometryReading:
        """See `SensorsAndMotion.odometry`."""
        pose = self.pose if self.localised else self.wheel_odometry.pose
        return OdometryReading(self.base.time, pose, self.base.speed)

    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        """See `SensorsAndMotion.drive`."""
        base = self.base
        base.drive(speed, turn_rate, round(seconds / TIMESTEP))
        self.pose = pose = base.pose
        if not self.localised:
            self.wheel_odometry.update(pose)
        if self.surroundings is not None:
            self.surroundings.advance(base.time, pose, base.velocity)
        touched = base.touched_geoms()
        if touched:
            self._note_touches(touched)
        self._has_moved()

    def lidar_scan(self) -> LidarScan:
        """See `SensorsAndMotion.lidar_scan`."""
        return self.lidar.scan(self.pose, self.time)

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SensorsAndMotion.camera_picture`; the first call takes seconds."""
        frame = self.camera_frame(width, height, horizontal_fov)
        return CameraPicture(frame.rgb, frame.depth)

    # What the simulation knows besides.

    def camera_frame(
        self, width: int, height: int, horizontal_fov: float
    ) -> "CameraFrame":
        """See `BodyInSite.camera_frame`; the first call takes seconds."""
        return self._cameras.frame(self.pose, width, height, horizontal_fov)

    def rest(self, seconds: float) -> None:
        """Let time pass for a robot at rest in a building where nothing moves.

        Nothing changes, so that nothing has to be computed.
        """
        self.base.rest(round(seconds / TIMESTEP))

    def touches_ahead(self, course: float) -> bool:
        """Whether it touches something in its way."""
        ahead_x, ahead_y = math.cos(course), math.sin(course)
        for x, y in self.base.touched_places():
            dx, dy = x - self.pose.x, y - self.pose.y
            if dx * ahead_x + dy * ahead_y > AHEAD * math.hypot(dx, dy):
                return True
        return False

    def look(self) -> RayCamera:
        """See `BodyInSite.look`."""
        self.base.update_view()
        return RayCamera(self.scene, self.base.data, self.camera_picture)

    def view_from(self, pose: Pose) -> CameraView:
        """See `BodyInSite.view_from`."""
        return camera_elsewhere(self.scene, self.base.data, pose)

    def lidar_turning_points(self, start: Pose) -> LidarTurningPoints:
        """See `BodyInSite.lidar_turning_points`."""
        return LidarTurningPoints(self.lidar.scan, start, self.wheel_odometry.update)

    @cached_property
    def _cameras(self) -> "SceneCameras":
        # Robots that never draw load neither OpenGL nor the looks of things.
        from memorymaze.robot.simulation.cameras import SceneCameras

        return SceneCameras(self.scene, self.base.data, self._looks)

    def _note_touches(self, geoms: list[int]) -> None:
        for geom in sorted(set(geoms)):
            last = self._touches.get(geom)
            if last is None or self.time - last > SAME_TOUCH:
                thing = self.scene.objects[geom]
                name = None if thing.record is None else thing.record.id
                self.collisions.append(
                    Collision(self.time, self.pose, thing.kind, name)
                )
            self._touches[geom] = self.time
