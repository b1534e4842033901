"""Bodies of users' own for `--robot`: the simulated one behind the four functions."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.sensors_and_motion import OdometryReading
from memorymaze.robot.simulation.body import SimulatedBody
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.world.sites import Site

_scene = cache(build_scene)
opened: list["Wheels"] = []
"""All bodies of this process."""


@dataclass(frozen=True)
class WheelOptions:
    """What can be set."""

    dies_after: float = 1e9
    """Seconds after which it answers no more."""


class Wheels:
    """The simulated body, of which nothing but the four functions is seen."""

    Options = WheelOptions

    def __init__(
        self,
        site: Site,
        start: Pose,
        settings: SimulationSettings,
        rng: np.random.Generator,
        *,
        options: WheelOptions | None = None,
    ) -> None:
        self._body = SimulatedBody(_scene(site), start, settings, rng)
        self._dies_after = (options or WheelOptions()).dies_after
        self.closed = 0
        opened.append(self)
        for name in ("lidar_scan", "camera_picture"):
            setattr(self, name, getattr(self._body, name))

    def odometry(self) -> OdometryReading:
        return self._body.odometry()

    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        if self._body.time > self._dies_after:
            raise ConnectionError("no answer from the wheels")
        self._body.drive(speed, turn_rate, seconds)

    def close(self) -> None:
        self.closed += 1


class Localised(Wheels):
    """The same, which also knows where it is on the plan."""

    def pose_in_site(self) -> Pose:
        return self._body.pose


class Slips(Wheels):
    """The same, whose odometry is three metres off after five seconds."""

    def odometry(self) -> OdometryReading:
        read = super().odometry()
        x, y, heading = read.pose
        return read._replace(pose=Pose(x, y + 3.0 * (read.time > 5.0), heading))


class Leaps(Localised):
    """The same, which believes after five seconds that it is far aside."""

    def pose_in_site(self) -> Pose:
        x, y, heading = self._body.pose
        return Pose(x, y + 50.0 * (self._body.time > 5.0), heading)


class TellsTuple(Localised):
    """The same, which tells three numbers instead of a pose."""

    def pose_in_site(self) -> Any:
        return tuple(super().pose_in_site())


class GetsLost(Localised):
    """The same, which after three seconds knows no more how far it has come."""

    def pose_in_site(self) -> Pose:
        lost = self._body.time > 3.0
        return super().pose_in_site()._replace(**({"x": math.nan} if lost else {}))


class Overflows(Wheels):
    """The same, whose odometry after three seconds is no number."""

    def odometry(self) -> OdometryReading:
        read = super().odometry()
        return read._replace(speed=math.inf if read.time > 3.0 else read.speed)


_made: Iterator[int] = iter(range(1000))


def second_dies(*given: Any) -> Localised:
    """Give bodies of which the second one made dies after two seconds."""
    number = next(_made)
    return Localised(*given, options=WheelOptions(2.0 if number == 1 else 1e9))


def no_body(*given: Any) -> str:
    """Give something else."""
    return "wheels"


def unreachable(*given: Any) -> Localised:
    """Raise, as where no robot is there."""
    raise ConnectionError("nobody answers")


class Stays(Localised):
    """The same, which cannot be put away."""

    def close(self) -> None:
        raise OSError("stuck in the door")


class Lost(Localised):
    """The same, which cannot tell where it begins."""

    def pose_in_site(self) -> Pose:
        raise ConnectionError("no map")
