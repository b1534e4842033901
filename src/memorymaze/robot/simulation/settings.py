"""The numbers of a simulation: the robot's abilities and the limits of an episode."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import check_number, check_word
from memorymaze.robot.steering.settings import TICK, RobotSettings

TIMESTEP = TICK
"""Seconds of a physics step."""

TurningPoints = Literal["annotated", "lidar"]
"""Where turning points come from: the site plan, or the robot's LiDAR and odometry."""

MovedBy = Literal["physics", "kinematic"]
"""What moves the robot: the physics engine, or its speeds alone."""


@dataclass(frozen=True, slots=True)
class SimulationSettings(RobotSettings):
    """What the simulated robot can do and when an episode is broken off.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    sampling_period: float = 0.2
    """Greatest simulated time between two poses of the trajectory, seconds."""
    wheel_noise: float = 0.01
    """Standard deviation of each wheel's relative speed error, drawn per decision."""
    turning_points: TurningPoints = "annotated"
    """where the robot knows turning points from: annotated (the site plan), or lidar (its
    scans and odometry)"""
    motion: MovedBy = "physics"
    """what moves the robot: physics (wheels, friction, contacts), or kinematic (it goes for
    its speeds exactly; faster, for training and benches; docs/robot.md)"""

    def __post_init__(self) -> None:
        """Check every value."""
        # Not super(): a class with slots is another one than its body sees.
        RobotSettings.__post_init__(self)
        name = "simulation setting"
        check_number(f"{name} sampling_period", self.sampling_period, above=0)
        check_number(f"{name} wheel_noise", self.wheel_noise, least=0)
        check_word(f"{name} turning_points", self.turning_points, TurningPoints)
        check_word(f"{name} motion", self.motion, MovedBy)

    def check_motion(self, *, as_in_plan: bool) -> None:
        """Refuse a robot without physics where things stand or people walk."""
        if self.motion == "kinematic" and not as_in_plan:
            raise SettingsError(
                "motion: kinematic expects a building as in its plan, got one with "
                "obstacles or people, whom a robot touches by physics alone; give "
                "motion=physics, or leave obstacles and ask out"
            )
