"""Gymnasium environments: follow an instruction, step by step, in one of the buildings.

Importing this registers `MemoryMaze/University-v0`, `MemoryMaze/Museum5F-v0`,
`MemoryMaze/Museum7F-v0` and `MemoryMaze/Site-v0`. It needs the extra `gym`.
"""

try:
    import gymnasium as _gymnasium
except ImportError as error:
    raise ImportError(
        "memorymaze.gym needs the package gymnasium; install it by "
        "`pip install 'memorymaze[gym]'`"
    ) from error

from memorymaze.gym.actions import ContinuousActions, DiscreteActions
from memorymaze.gym.environment import NavigationEnvironment
from memorymaze.gym.registration import ENVIRONMENTS, register_environments
from memorymaze.gym.rewards import RewardSettings

__all__ = [
    "ENVIRONMENTS",
    "ContinuousActions",
    "DiscreteActions",
    "NavigationEnvironment",
    "RewardSettings",
    "register_environments",
]

del _gymnasium
register_environments()
