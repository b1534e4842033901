"""The numbers of a simulation: the robot's abilities and the limits of an episode."""

from dataclasses import dataclass, field, fields
from typing import Literal, get_args

from memorymaze.errors import SettingsError
from memorymaze.options import check_number
from memorymaze.robot.api import DETECTION_RANGE

TIMESTEP = 0.01
"""Seconds of a physics step."""

TurningPoints = Literal["annotated", "lidar"]
"""Where turning points come from: the site plan, or the robot's LiDAR and odometry."""


@dataclass(frozen=True, slots=True)
class SimulationSettings:
    """What the robot can do and when an episode is broken off.

    The command line has an option for each field with a `metavar`.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    control_period: float = 0.05
    """Seconds from one steering decision to the next; a multiple of the 10 ms
    physics step."""
    sampling_period: float = 0.2
    """Greatest simulated time between two poses of the trajectory, seconds."""
    max_speed: float = 1.0
    """Metres per second."""
    max_acceleration: float = 1.5
    """Of speeding up and braking, metres per second squared."""
    rolling_speed: float = 0.5
    """Greatest speed at which a move that is done hands over to the next call."""
    max_turn_rate: float = 1.8
    """Radians per second."""
    max_turn_acceleration: float = 4.0
    """Radians per second squared."""
    wheel_noise: float = 0.01
    """Standard deviation of each wheel's relative speed error, drawn per decision."""
    time_budget: float = 1200.0
    """Simulated seconds after which the episode ends as `budget`."""
    call_budget: int = field(default=10_000, metadata={"metavar": "N"})
    """calls of the control API in an episode"""
    stuck_limit: int = 40
    """Calls in a row with neither motion nor anything new that end it as `stuck`."""
    turning_points: TurningPoints = field(
        default="annotated", metadata={"metavar": "SOURCE"}
    )
    """where the robot knows turning points from: annotated (the site plan), or lidar (its
    scans and odometry)"""
    detection_range: float = field(
        default=DETECTION_RANGE, metadata={"metavar": "METRES"}
    )
    """how far things are detected; 40 with --sail, to the end of every hall"""

    def __post_init__(self) -> None:
        """Check every value."""
        if self.turning_points not in get_args(TurningPoints):
            raise SettingsError(
                "simulation setting turning_points: expected one of "
                f"{', '.join(get_args(TurningPoints))}; got {self.turning_points!r}"
            )
        for each in fields(self):
            if each.name == "turning_points":
                continue
            lowest_is_meant = each.name in ("rolling_speed", "wheel_noise")
            check_number(
                f"simulation setting {each.name}",
                getattr(self, each.name),
                least=0,
                above=None if lowest_is_meant else 0,
                whole=each.name in ("call_budget", "stuck_limit"),
                may_be_infinite=each.name == "time_budget",
            )
        steps = self.control_period / TIMESTEP
        if steps < 1 or abs(steps - round(steps)) > 1e-6:
            raise SettingsError(
                "simulation setting control_period: expected a multiple of the "
                f"physics step of {TIMESTEP} s, got {self.control_period}"
            )
        if self.rolling_speed > self.max_speed:
            raise SettingsError(
                "simulation setting rolling_speed: expected at most max_speed "
                f"{self.max_speed} m/s, got {self.rolling_speed}"
            )
