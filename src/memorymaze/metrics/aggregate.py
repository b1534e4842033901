"""Means over episodes, with intervals that respect that people give many of them."""

from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.errors import UndefinedMetricError

__all__ = ["Estimate", "mean", "participant_bootstrap"]


class Estimate(NamedTuple):
    """A mean over episodes and how sure one can be of it."""

    mean: float
    """Of all episodes alike."""
    low: float | None
    """Lower end of the interval; None with fewer than two participants."""
    high: float | None
    """Upper end of the interval; None with fewer than two participants."""
    episodes: int
    """How many values there are."""
    participants: int
    """How many people they come from."""


def mean(values: ArrayLike) -> float:
    """Return the mean of one metric over episodes.

    >>> mean([1.0, 0.0, 0.0, 1.0])
    0.5

    Raises:
        UndefinedMetricError: There is no value, or one is not finite.
    """
    return float(_checked(values).mean())


def participant_bootstrap(
    values: ArrayLike,
    participants: Sequence[Hashable],
    rng: np.random.Generator,
    *,
    level: float = 0.95,
    resamples: int = 10_000,
) -> Estimate:
    """Return the mean and its percentile interval, resampling whole participants.

    The texts of one person resemble each other, so drawing episodes one by one would
    give intervals that are too narrow. Each resample draws as many participants as
    there are, with replacement, and takes the mean over all their episodes. Source:
    Efron and Tibshirani 1993, "An Introduction to the Bootstrap", percentile interval,
    with participants as the units.

    >>> rng = np.random.default_rng(0)
    >>> participant_bootstrap([1, 1, 0, 0], ["p1", "p1", "p2", "p2"], rng)
    Estimate(mean=0.5, low=0.0, high=1.0, episodes=4, participants=2)

    Args:
        values: One metric, one number per episode, shape (n,).
        participants: Who gave each episode's instruction, n ids.
        rng: Source of chance; the same seed gives the same interval.
        level: Share of resamples inside the interval, between 0 and 1.
        resamples: How many, >= 1.

    Raises:
        UndefinedMetricError: There is no value, or one is not finite.
        ValueError: The number of participants, `level` or `resamples` has no meaning.
    """
    numbers = _checked(values)
    if len(participants) != len(numbers):
        raise ValueError(
            f"expected a participant for each of {len(numbers)} values, got "
            f"{len(participants)}"
        )
    if not (0 < level < 1 and resamples >= 1):
        raise ValueError(
            f"expected a level between 0 and 1 and resamples >= 1, got {level} and "
            f"{resamples}"
        )
    people = {person: index for index, person in enumerate(dict.fromkeys(participants))}
    owner = np.array([people[person] for person in participants], dtype=np.intp)
    count = len(people)
    low = high = None
    if count > 1:
        draws = rng.multinomial(count, np.full(count, 1 / count), size=resamples)
        totals = draws @ np.bincount(owner, weights=numbers, minlength=count)
        means = totals / (draws @ np.bincount(owner, minlength=count))
        tail = (1 - level) / 2
        low, high = (float(end) for end in np.quantile(means, [tail, 1 - tail]))
    return Estimate(float(numbers.mean()), low, high, len(numbers), count)


def _checked(values: ArrayLike) -> NDArray[np.float64]:
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.ndim != 1 or numbers.size == 0:
        raise UndefinedMetricError(
            f"expected at least one value, got an array of shape {numbers.shape}"
        )
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if len(wrong):
        raise UndefinedMetricError(
            f"expected finite values, got {numbers[wrong[0]]} at index {wrong[0]}"
        )
    return numbers
