"""Random numbers of an episode: the same whatever ran before, and wherever."""

import hashlib

import numpy as np


def episode_generators(
    seed: int, episode_id: str
) -> tuple[np.random.Generator, np.random.Generator]:
    """Return the generators of an episode: the robot's and the agent's.

    They depend on the run's seed and the episode's id alone, so neither the number of
    workers nor the order of episodes changes a result.
    """
    robot, agent = _root(seed, episode_id).spawn(2)
    return np.random.default_rng(robot), np.random.default_rng(agent)


def detector_generator(seed: int, episode_id: str) -> np.random.Generator:
    """Return the generator of the mistakes that an episode's detector makes."""
    # The third child: the first two are the robot's and the agent's.
    return np.random.default_rng(_root(seed, episode_id).spawn(3)[2])


def passers_by_seed(seed: int, episode_id: str) -> tuple[int, ...]:
    """Return the seed of what an episode's people remember, to which each adds a number."""
    # The fourth child: three others are the robot's, the agent's and the detector's.
    words = _root(seed, episode_id).spawn(4)[3].generate_state(4)
    return tuple(int(word) for word in words)


def obstacle_generator(seed: int, episode_id: str) -> np.random.Generator:
    """Return the generator of an episode's things and people.

    The seed of the run has no part in it, so that every agent and every repetition meets
    the same.
    """
    return np.random.default_rng(_root(seed, episode_id))


def _root(seed: int, episode_id: str) -> np.random.SeedSequence:
    digest = hashlib.sha256(episode_id.encode()).digest()
    return np.random.SeedSequence([seed, int.from_bytes(digest[:16], "big")])
