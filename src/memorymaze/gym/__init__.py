"""Gymnasium environments: follow an instruction, step by step, in one of the buildings.

Importing this registers `MemoryMaze/University-v0`, `MemoryMaze/Museum5F-v0`,
`MemoryMaze/Museum7F-v0` and `MemoryMaze/Site-v0`. Observations,
actions and rewards are in here; episodes, robot and scores are those of `runs`.
"""

from memorymaze.gym.actions import ContinuousActions, DiscreteActions
from memorymaze.gym.environment import (
    ENVIRONMENTS,
    NavigationEnvironment,
    register_environments,
)
from memorymaze.gym.observations import Senses
from memorymaze.gym.rewards import RewardSettings

__all__ = [
    "ENVIRONMENTS",
    "ContinuousActions",
    "DiscreteActions",
    "NavigationEnvironment",
    "RewardSettings",
    "Senses",
    "register_environments",
]

register_environments()
