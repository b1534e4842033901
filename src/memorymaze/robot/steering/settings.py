"""What a robot can do, and when an episode is broken off."""

from dataclasses import dataclass, fields

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import check_number
from memorymaze.robot.api.control import DETECTION_RANGE

TICK = 0.01
"""Seconds; bodies are driven for multiples of it."""


@dataclass(frozen=True, slots=True)
class RobotSettings:
    """What the robot can do and when an episode is broken off.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    control_period: float = 0.05
    """Seconds from one steering decision to the next; a multiple of 10 ms."""
    max_speed: float = 1.0
    """Metres per second."""
    max_acceleration: float = 1.5
    """Of speeding up and braking, metres per second squared."""
    rolling_speed: float = 0.5
    """Greatest speed at which a move that is done hands over to the next call; 0 has every
    move end at rest."""
    max_turn_rate: float = 1.8
    """Radians per second."""
    max_turn_acceleration: float = 4.0
    """Radians per second squared."""
    time_budget: float = 1200.0
    """Seconds after which the episode ends as `budget`."""
    call_budget: int = 10_000
    """Calls of the control API in an episode."""
    stuck_limit: int = 40
    """Calls in a row with neither motion nor anything new that end it as `stuck`."""
    detection_range: float = DETECTION_RANGE
    """How far things are detected, metres; 40 on SAIL, to the end of every hall."""

    def __post_init__(self) -> None:
        """Check every value."""
        for each in fields(RobotSettings):
            check_number(
                f"robot setting {each.name}",
                getattr(self, each.name),
                least=0,
                above=None if each.name == "rolling_speed" else 0,
                whole=each.name in ("call_budget", "stuck_limit"),
                may_be_infinite=each.name == "time_budget",
            )
        ticks = self.control_period / TICK
        if ticks < 1 or abs(ticks - round(ticks)) > 1e-6:
            raise SettingsError(
                f"robot setting control_period: expected a multiple of {TICK} s, got "
                f"{self.control_period}"
            )
        if self.rolling_speed > self.max_speed:
            raise SettingsError(
                "robot setting rolling_speed: expected at most max_speed "
                f"{self.max_speed} m/s, got {self.rolling_speed}"
            )
