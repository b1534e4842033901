"""Wheel odometry: where the robot believes it is, from how it really moved."""

import math
from dataclasses import dataclass, fields

import numpy as np

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose, turn_between, wrap_angle
from memorymaze.basics.options import check_number


@dataclass(frozen=True, slots=True)
class OdometrySettings:
    """How far odometry is off; the defaults are exact."""

    scale_error: float = 0.0
    """Relative error of every distance: 0.01 measures 1.01 m for each metre."""
    heading_drift: float = 0.0
    """Radians of heading gained per metre driven, left positive."""
    turn_scale_error: float = 0.0
    """Relative error of every change of heading."""
    distance_noise: float = 0.0
    """Standard deviation of the error over one metre, metres; grows with the square
    root of the distance."""
    heading_noise: float = 0.0
    """Standard deviation of the heading's error over one metre, radians; grows the same
    way."""

    def __post_init__(self) -> None:
        """Check every value."""
        lowest = {"scale_error": -1, "turn_scale_error": -1, "heading_drift": -math.inf}
        for each in fields(self):
            least = lowest.get(each.name, 0)
            value = getattr(self, each.name)
            check_number(f"odometry setting {each.name}", value, least)


class Odometry:
    """Adds up motions; its frame has the start at the origin, facing along +x."""

    def __init__(
        self,
        start: Pose,
        settings: OdometrySettings | None = None,
        rng: np.random.Generator | None = None,
    ) -> None:
        """Begin at the origin, at a true start pose; noise needs a random generator."""
        self.settings = settings or OdometrySettings()
        """How far it is off."""
        self._noisy = (
            self.settings.distance_noise > 0 or self.settings.heading_noise > 0
        )
        if self._noisy and rng is None:
            raise SettingsError(
                "odometry with noise: expected a random generator, got None"
            )
        self._rng = rng
        self._exact = self.settings == OdometrySettings()
        self._start = start
        self._truth = start
        self._pose = Pose(0.0, 0.0, 0.0)

    @property
    def pose(self) -> Pose:
        """Where the robot believes it is, metres and radians from the start pose."""
        return self._pose

    def update(self, truth: Pose) -> Pose:
        """Take note of a motion."""
        before, self._truth = self._truth, truth
        if self._exact:
            self._pose = _seen_from(self._start, truth)
            return self._pose
        moved = _seen_from(before, truth)
        distance = math.hypot(moved.x, moved.y)
        settings = self.settings
        scale = 1.0 + settings.scale_error
        turn = turn_between(before.heading, truth.heading)
        turn = turn * (1.0 + settings.turn_scale_error)
        turn += settings.heading_drift * distance
        if self._noisy and self._rng is not None and distance > 0:
            along, about = self._rng.normal(0.0, math.sqrt(distance), 2).tolist()
            scale += settings.distance_noise * along / distance
            turn += settings.heading_noise * about
        here = self._pose
        cosine, sine = math.cos(here.heading), math.sin(here.heading)
        self._pose = Pose(
            here.x + scale * (moved.x * cosine - moved.y * sine),
            here.y + scale * (moved.x * sine + moved.y * cosine),
            wrap_angle(here.heading + turn),
        )
        return self._pose


def _seen_from(origin: Pose, pose: Pose) -> Pose:
    dx, dy = pose.x - origin.x, pose.y - origin.y
    cosine, sine = math.cos(origin.heading), math.sin(origin.heading)
    return Pose(
        dx * cosine + dy * sine,
        dy * cosine - dx * sine,
        turn_between(origin.heading, pose.heading),
    )
