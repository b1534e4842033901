"""The names under which `gymnasium.make` finds the environments."""

import gymnasium

ENVIRONMENTS: dict[str, str | None] = {
    "MemoryMaze/University-v0": "university",
    "MemoryMaze/Museum5F-v0": "museum_5f",
    "MemoryMaze/Museum7F-v0": "museum_7f",
    "MemoryMaze/Site-v0": None,
}
"""Site of each environment; None where the user gives it as `site=`."""


def register_environments() -> None:
    """Make the environments known to Gymnasium; what it knows already stays."""
    for name, site in ENVIRONMENTS.items():
        if name not in gymnasium.registry:
            gymnasium.register(
                name,
                entry_point="memorymaze.gym.environment:NavigationEnvironment",
                kwargs={} if site is None else {"site": site},
            )
