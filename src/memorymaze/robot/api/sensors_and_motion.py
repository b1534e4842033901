"""What a body must provide to get the whole control API: four functions.

A body is a robot of ROS 2, a vehicle of another simulator, or the simulated robot itself.
`memorymaze.robot.steering.guide_robot.GuideRobot` makes a `SteppingRobot` of any of them;
docs/bodies.md tells how, with a body of 40 lines.
"""

import math
from collections.abc import Iterable
from typing import NamedTuple, Protocol, SupportsFloat, runtime_checkable

from memorymaze.basics.errors import RobotBodyError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.steps import CameraPicture, LidarScan


class OdometryReading(NamedTuple):
    """Where a body believes it is, and when."""

    time: float
    """Seconds by the body's clock, which may begin anywhere and never goes back."""
    pose: Pose
    """Metres and radians in a frame that stays where it is, wherever that is: x and y to
    the left of it in the floor's plane, headings counter-clockwise. It may drift."""
    speed: float
    """Metres per second over the floor, whichever way; at least 0."""


def checked_place(told: object) -> Pose:
    """Return what a body's `pose_in_site` told, if it is a `Pose` of finite numbers."""
    if isinstance(told, Pose) and _are_finite(told):
        return told
    raise RobotBodyError(
        f"pose_in_site: expected a Pose of finite numbers, got {told!r}"
    )


def checked_reading(told: object) -> OdometryReading:
    """Return what a body's `odometry` told, if it is a reading of finite numbers."""
    if (
        isinstance(told, OdometryReading)
        and isinstance(told.pose, Pose)  # pyright: ignore[reportUnnecessaryIsInstance]
        and _are_finite((told.time, *told.pose, told.speed))
    ):
        return told
    raise RobotBodyError(
        "odometry: expected an OdometryReading of finite numbers, with a Pose, got "
        f"{told!r}"
    )


def _are_finite(numbers: Iterable[object]) -> bool:
    return all(
        isinstance(each, SupportsFloat) and math.isfinite(each) for each in numbers
    )


@runtime_checkable
class SensorsAndMotion(Protocol):
    """A wheeled body that can turn on the spot, with odometry, a LiDAR and a camera.

    It fits into a circle of 0.25 m around the point that odometry tells of. All sensors
    see from there: the camera looks ahead, the LiDAR all round, in one plane low enough
    to meet what stands in the way.
    """

    def odometry(self) -> OdometryReading:
        """Return where the body is now, by its wheels or by what localises it."""
        ...

    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        """Go for given speeds, and return when the time has passed.

        Afterwards the body goes on as it is until the next call: a real one for a few
        tenths of a second at most, and then stops by itself.

        Args:
            speed: Metres per second ahead; negative backs up.
            turn_rate: Radians per second, left positive.
            seconds: More than 0, a multiple of 10 ms; mostly 0.05.
        """
        ...

    def lidar_scan(self) -> LidarScan:
        """Return the latest scan in the horizontal plane: one beam, all round."""
        ...

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """Return the latest picture, scaled and cut to what is asked for, with depth.

        Args:
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians; pixels are square.

        Raises:
            RenderingError: The body has no camera.
        """
        ...
