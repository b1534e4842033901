"""`OwnBody`: a body of a user's own in a building that has a plan."""

import math
import warnings
from collections import deque
from collections.abc import Callable
from typing import NoReturn, Protocol, TypeVar, runtime_checkable

from memorymaze.basics.errors import RenderingError, RobotBodyError
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.basics.physics_engine import mujoco
from memorymaze.robot.api.sensors_and_motion import (
    OdometryReading,
    SensorsAndMotion,
    checked_place,
    checked_reading,
)
from memorymaze.robot.api.steps import CameraPicture, LidarScan
from memorymaze.robot.perception.camera_view import CameraView
from memorymaze.robot.simulation.body import BodyInSite
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.senses.visibility import RayCamera, camera_elsewhere
from memorymaze.robot.simulation.settings import TIMESTEP, SimulationSettings
from memorymaze.robot.steering.turning_points import LidarTurningPoints

_Answer = TypeVar("_Answer")

PUSHED, MOVED = 0.1, 0.3
"""Metres it was told to go of late, and the share of them below which something holds it."""


@runtime_checkable
class KnowsItsPlace(Protocol):
    """What a body may have besides, where something knows where it truly is."""

    def pose_in_site(self) -> Pose:
        """Return where it is on the plan: metres, x east, y north; radians."""
        ...


@runtime_checkable
class CanBeClosed(Protocol):
    """What a body may have besides, where something has to be put away."""

    def close(self) -> None:
        """Put it away; may be called again."""
        ...


class OwnBody(BodyInSite):
    """A user's own body, and where it goes in a building.

    It steers by the plan where it knows its place there, else by LiDAR and odometry. Then
    its walk is told by its odometry from the start on, which may drift. It counts no
    collisions; things that the plan tells of are seen from where it is.
    """

    def __init__(
        self,
        scene: Scene,
        start: Pose,
        settings: SimulationSettings,
        body: SensorsAndMotion,
    ) -> None:
        """Take a body that stands at the start of an episode."""
        super().__init__(scene, start, settings)
        self.body = body
        """The user's own."""
        self.localised = isinstance(body, KnowsItsPlace)
        self.lost: str | None = None
        """Why it does nothing any more."""
        self._start = start
        self._first = self._read = self._odometer()
        self._data = mujoco.MjData(scene.model)
        self._told: deque[tuple[float, Pose]] = deque(maxlen=10)
        self._locate()

    @property
    def time(self) -> float:
        """Seconds by its clock since the start."""
        return self._read.time - self._first.time

    def odometry(self) -> OdometryReading:
        """Return where it is on the plan; where it does not know that, what it believes."""
        if not self.localised:
            return self._read
        return OdometryReading(self.time, self.pose, self._read.speed)

    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        """See `SensorsAndMotion.drive`."""
        before = self.pose
        self._asked(lambda: self.body.drive(speed, turn_rate, seconds))
        self._read = self._odometer()
        self._locate()
        self._told.append((abs(speed) * seconds, before))
        self._has_moved()

    def lidar_scan(self) -> LidarScan:
        """See `SensorsAndMotion.lidar_scan`."""
        return self._asked(self.body.lidar_scan)

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SensorsAndMotion.camera_picture`."""
        return self._asked(
            lambda: self.body.camera_picture(width, height, horizontal_fov)
        )

    def camera_frame(self, width: int, height: int, horizontal_fov: float) -> NoReturn:
        """Raise `RenderingError`: nobody knows what its pixels show."""
        raise RenderingError(
            "expected the simulated robot, whose camera also tells what each pixel "
            "shows, got a body of your own, which takes pictures with camera_picture "
            "alone; leave --robot out"
        )

    def rest(self, seconds: float) -> None:
        """Stand for so long, in whole ticks."""
        ticks = round(seconds / TIMESTEP)
        if ticks > 0:
            self.drive(0.0, 0.0, ticks * TIMESTEP)

    def touches_ahead(self, course: float) -> bool:
        """Whether it was told to go and hardly moved."""
        told = sum(metres for metres, _ in self._told)
        if told < PUSHED:
            return False
        return math.dist(self._told[0][1][:2], self.pose[:2]) < MOVED * told

    def look(self) -> RayCamera:
        """See `BodyInSite.look`; the picture is its own."""
        return camera_elsewhere(self.scene, self._data, self.pose, self.camera_picture)

    def view_from(self, pose: Pose) -> CameraView:
        """See `BodyInSite.view_from`."""
        return camera_elsewhere(self.scene, self._data, pose)

    def lidar_turning_points(self, start: Pose) -> LidarTurningPoints:
        """See `BodyInSite.lidar_turning_points`."""
        return LidarTurningPoints(
            lambda _pose, _time: self.lidar_scan(),
            start,
            lambda _pose: self._by_odometry(),
        )

    def close(self) -> None:
        """Let go of the user's body, where that can be closed.

        One that cannot be put away is told, and takes nothing from its episode.
        """
        if not isinstance(self.body, CanBeClosed):
            return
        try:
            self.body.close()
        except Exception as error:
            if self.lost is None:
                warnings.warn(
                    f"the robot's body is not put away: {error}", stacklevel=2
                )

    def _asked(self, call: Callable[[], _Answer]) -> _Answer:
        """Return what the user's body answers; what it raises ends the episode."""
        if self.lost is not None:
            raise RobotBodyError(self.lost)
        try:
            return call()
        except RenderingError:
            # It has no camera, which is no failure.
            raise
        except Exception as error:
            told = str(error) if isinstance(error, RobotBodyError) else repr(error)
            self.lost = f"the robot's body failed: {told}"
            raise RobotBodyError(self.lost) from error

    def _odometer(self) -> OdometryReading:
        return self._asked(lambda: checked_reading(self.body.odometry()))

    def _locate(self) -> None:
        body = self.body
        if isinstance(body, KnowsItsPlace):
            self.pose = self._asked(lambda: checked_place(body.pose_in_site()))
        else:
            self.pose = self._by_odometry()

    def _by_odometry(self) -> Pose:
        """Return where it is if its odometry has been right since the start."""
        (x0, y0, heading0), (x, y, heading) = self._first.pose, self._read.pose
        turned = self._start.heading - heading0
        cos, sin = math.cos(turned), math.sin(turned)
        return Pose(
            self._start.x + cos * (x - x0) - sin * (y - y0),
            self._start.y + sin * (x - x0) + cos * (y - y0),
            wrap_angle(heading + turned),
        )
