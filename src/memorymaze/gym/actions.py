"""What an action of an agent means for the robot.

`DiscreteActions`: the four actions of vision-and-language navigation in continuous
environments. `ContinuousActions`: speeds for a time step.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from gymnasium import spaces

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry import polyline
from memorymaze.basics.options import check_number
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.budgets import perfect_time
from memorymaze.world.sites import Route


@dataclass(frozen=True, slots=True)
class DiscreteActions:
    """0 stops, 1 goes ahead, 2 turns left, 3 turns right.

    Raises:
        SettingsError: A value has no meaning.
    """

    forward: float = 0.25
    """Metres of a step ahead."""
    turn_deg: float = 15.0
    """Degrees of a turn on the spot."""

    def __post_init__(self) -> None:
        """Check every value."""
        check_number("actions: forward", self.forward, above=0, most=10)
        check_number("actions: turn_deg", self.turn_deg, above=0, most=180)

    @property
    def space(self) -> "spaces.Space[Any]":
        """The four actions."""
        return spaces.Discrete(4)

    def act(self, robot: SimulatedRobot, action: Any) -> bool:
        """Do an action; return whether it was to stop."""
        number = int(action)
        if number == 1:
            robot.step_forward(self.forward)
        elif number:
            angle = math.radians(self.turn_deg)
            robot.rotate(angle if number == 2 else -angle)
        return number == 0

    def steps_needed(self, route: Route, settings: SimulationSettings) -> float:
        """Return how many steps a perfect follower of a route takes."""
        line = np.array(route.line.coords)[:, :2]
        headings = np.arctan2(*np.diff(line, axis=0).T[::-1])
        turned = np.abs(np.diff(np.unwrap(headings))).sum()
        ahead = polyline.length(line) / self.forward
        return float(ahead + turned / math.radians(self.turn_deg) + 1)


@dataclass(frozen=True, slots=True)
class ContinuousActions:
    """Two numbers: speed ahead, 0 to 1, and turn rate, -1 to 1, left positive.

    They are shares of the robot's greatest speed (1 m/s) and turn rate (1.8 rad/s),
    held for a time step. Where both are less than `stop_below`, the agent stops for
    good: it says "we are there".

    Raises:
        SettingsError: A value has no meaning.
    """

    time_step: float = 0.5
    """Seconds of an action; a multiple of the physics step of 10 ms."""
    stop_below: float = 0.02
    """Share of both speeds below which an action means to stop."""

    def __post_init__(self) -> None:
        """Check every value."""
        check_number("actions: time_step", self.time_step, above=0, most=60)
        check_number("actions: stop_below", self.stop_below, above=0, most=1)
        if abs(self.time_step * 100 - round(self.time_step * 100)) > 1e-6:
            raise SettingsError(
                "actions: expected a time_step in whole steps of 0.01 s, got "
                f"{self.time_step!r}"
            )

    @property
    def space(self) -> "spaces.Space[Any]":
        """Speed and turn rate, as shares."""
        low, high = np.array([0, -1], np.float32), np.array([1, 1], np.float32)
        return spaces.Box(low, high, dtype=np.float32)

    def act(self, robot: SimulatedRobot, action: Any) -> bool:
        """Do an action; return whether it was to stop."""
        ahead, left = (float(share) for share in action)
        if ahead < self.stop_below and abs(left) < self.stop_below:
            return True
        settings = robot.settings
        robot.drive(
            ahead * settings.max_speed, left * settings.max_turn_rate, self.time_step
        )
        return False

    def steps_needed(self, route: Route, settings: SimulationSettings) -> float:
        """Return how many steps a perfect follower of a route takes."""
        return perfect_time(route, settings) / self.time_step + 1


ActionSet = DiscreteActions | ContinuousActions


def action_set(choice: Literal["discrete", "continuous"] | ActionSet) -> ActionSet:
    """Return the actions that a setting means."""
    if isinstance(choice, DiscreteActions | ContinuousActions):
        return choice
    if choice == "discrete":
        return DiscreteActions()
    if choice == "continuous":
        return ContinuousActions()
    raise SettingsError(
        "actions: expected 'discrete', 'continuous', DiscreteActions(…) or "
        f"ContinuousActions(…), got {choice!r}"
    )


def most_steps(
    actions: ActionSet, routes: Iterable[Route], settings: SimulationSettings
) -> int:
    """Return three times what a perfect follower of the longest route needs."""
    needed = max(actions.steps_needed(route, settings) for route in routes)
    return math.ceil(3 * needed)
