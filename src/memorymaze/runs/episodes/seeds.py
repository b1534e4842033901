"""Random numbers of an episode: the same whatever ran before, and wherever."""

import hashlib
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class EpisodeSeeds:
    """Where the random numbers of an episode come from, apart for each purpose."""

    robot: np.random.Generator
    agent: np.random.Generator
    detector: np.random.Generator
    """Of the mistakes that the detector makes."""
    people: tuple[int, ...]
    """Of what people remember; each adds a number of its own."""


def seeds_of(seed: int, episode_id: str) -> EpisodeSeeds:
    """Return the seeds of an episode.

    They depend on the run's seed and the episode's id alone, so neither the number of
    workers nor the order of episodes changes a result.
    """
    robot, agent, detector, people = _root(seed, episode_id).spawn(4)
    words = people.generate_state(4)
    return EpisodeSeeds(
        np.random.default_rng(robot),
        np.random.default_rng(agent),
        np.random.default_rng(detector),
        tuple(int(word) for word in words),
    )


def obstacle_generator(seed: int, episode_id: str) -> np.random.Generator:
    """Return the generator of an episode's things and people.

    The seed of the run has no part in it, so that every agent and every repetition meets
    the same.
    """
    return np.random.default_rng(_root(seed, episode_id))


def _root(seed: int, episode_id: str) -> np.random.SeedSequence:
    digest = hashlib.sha256(episode_id.encode()).digest()
    return np.random.SeedSequence([seed, int.from_bytes(digest[:16], "big")])
