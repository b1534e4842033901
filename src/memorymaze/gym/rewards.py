"""What an agent that learns is rewarded for."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import check_kind, check_number


@dataclass(frozen=True, slots=True)
class StepProgress:
    """What one step has brought."""

    nearer: float
    """Metres by which the shortest walk to the goal became shorter."""
    collisions: int
    """Things newly touched."""
    success: bool
    """Whether the agent stopped within the success distance."""


@dataclass(frozen=True, slots=True)
class RewardSettings:
    """The sum of four parts; the default leads to the goal, and stopping there pays.

    Raises:
        SettingsError: A value is no finite number.
    """

    progress: float = 1.0
    """Per metre by which the shortest walk to the goal becomes shorter."""
    success: float = 10.0
    """For stopping within the success distance of the goal."""
    step: float = -0.01
    """For every step."""
    collision: float = -0.1
    """For every thing newly touched."""

    def __post_init__(self) -> None:
        """Check every value."""
        for each in fields(self):
            check_number(f"reward: {each.name}", getattr(self, each.name))

    def of(self, progress: StepProgress) -> float:
        """Return the reward of a step."""
        return (
            self.progress * progress.nearer
            + self.success * progress.success
            + self.step
            + self.collision * progress.collisions
        )


SPARSE = RewardSettings(progress=0.0, success=1.0, step=0.0, collision=0.0)

RewardChoice = Literal["progress", "sparse"] | RewardSettings | Mapping[str, Any]


def reward_settings(choice: RewardChoice) -> RewardSettings:
    """Return the rewards that a setting means: a name, numbers by name, or settings."""
    if isinstance(choice, RewardSettings):
        return choice
    if choice == "progress":
        return RewardSettings()
    if choice == "sparse":
        return SPARSE
    names = [each.name for each in fields(RewardSettings)]
    wanted = (
        "'progress', 'sparse', RewardSettings(…) or numbers for some of "
        f"{', '.join(names)}"
    )
    check_kind("reward", choice, str | Mapping, wanted)
    if not isinstance(choice, str) and set(choice) <= set(names):
        return RewardSettings(**choice)
    raise SettingsError(f"reward: expected {wanted}, got {choice!r}")
