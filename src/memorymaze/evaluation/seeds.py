"""Random numbers of an episode: the same whatever ran before, and wherever."""

import hashlib

import numpy as np

__all__ = ["episode_generators"]


def episode_generators(
    seed: int, episode_id: str
) -> tuple[np.random.Generator, np.random.Generator]:
    """Return the generators of an episode: the robot's and the agent's.

    They depend on the run's seed and the episode's id alone, so neither the number of
    workers nor the order of episodes changes a result.
    """
    digest = hashlib.sha256(episode_id.encode()).digest()
    root = np.random.SeedSequence([seed, int.from_bytes(digest[:16], "big")])
    robot, agent = root.spawn(2)
    return np.random.default_rng(robot), np.random.default_rng(agent)
