"""Means over episodes, with intervals that know that people give many of them."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry.points import FloatArray


@dataclass(frozen=True, slots=True)
class Estimate:
    """A mean and, where it can be told, how sure one can be of it."""

    mean: float
    low: float | None = None
    """Lower end of the interval; None where nothing is known of the spread."""
    high: float | None = None
    """Upper end of the interval; None where nothing is known of the spread."""


def mean(values: ArrayLike) -> float:
    """Return the mean of one metric over episodes.

    >>> mean([1.0, 0.0, 0.0, 1.0])
    0.5

    Raises:
        UndefinedMetricError: There is no value, or one is not finite.
    """
    return float(_checked(values, 1).mean())


def participant_bootstrap(
    values: ArrayLike,
    participants: Sequence[str],
    rng: np.random.Generator,
    *,
    cells: Sequence[Hashable] | None = None,
    level: float = 0.95,
    resamples: int = 10_000,
) -> list[Estimate]:
    """Return means with percentile intervals, drawing whole participants again.

    The texts of one person resemble each other, so drawing episodes one by one would
    give intervals that are too narrow: each draw takes participants with all their
    episodes. With cells, such as the routes of a study, a mean is the unweighted mean
    of the cells' means, and participants are drawn separately among those who
    contributed to the same cells, so that no cell runs empty. Source: Efron and
    Tibshirani 1993, "An Introduction to the Bootstrap", percentile interval, with
    participants as the units.

    An interval has no width where all episodes agree, which says nothing of certainty;
    it is None where no two participants contributed to the same cells.

    >>> rng = np.random.default_rng(0)
    >>> participant_bootstrap([[1], [1], [0], [0]], ["a", "a", "b", "b"], rng)
    [Estimate(mean=0.5, low=0.0, high=1.0)]

    Args:
        values: One row per episode, one column per metric, shape (n, m).
        participants: Who gave each episode's instruction, n ids.
        rng: Source of chance; the same seed gives the same intervals.
        cells: Which cell each episode belongs to, n labels; None for a single cell.
        level: Share of the draws inside the interval, between 0 and 1.
        resamples: Number of draws, >= 1.

    Returns:
        One estimate per column.

    Raises:
        UndefinedMetricError: There is no value, or one is not finite.
        ValueError: `participants`, `cells`, `level` or `resamples` has no meaning.
    """
    table = _checked(values, 2)
    labels = [None] * len(table) if cells is None else list(cells)
    if not len(participants) == len(labels) == len(table):
        raise ValueError(
            f"expected a participant and a cell for each of {len(table)} episodes, got "
            f"{len(participants)} and {len(labels)}"
        )
    if not (0 < level < 1 and resamples >= 1):
        raise ValueError(
            f"expected a level between 0 and 1 and resamples >= 1, got {level} and "
            f"{resamples}"
        )
    sums, counts = tallies(table, participants, labels)
    means = (sums.sum(axis=0) / counts.sum(axis=0)[:, None]).mean(axis=0)
    _, group = np.unique(counts > 0, axis=0, return_inverse=True)
    group = group.reshape(-1)
    if np.bincount(group).max() < 2:
        return [Estimate(float(middle)) for middle in means]
    weights = _draws(group, rng, resamples)
    drawn = np.zeros((resamples, table.shape[1]))
    for cell in range(counts.shape[1]):
        drawn += (weights @ sums[:, cell]) / (weights @ counts[:, cell])[:, None]
    tail = (1 - level) / 2
    low, high = np.quantile(drawn / counts.shape[1], [tail, 1 - tail], axis=0)
    return [
        Estimate(float(middle), float(lower), float(upper))
        for middle, lower, upper in zip(means, low, high, strict=True)
    ]


def _checked(values: ArrayLike, ndim: int) -> FloatArray:
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.ndim != ndim or numbers.size == 0:
        raise UndefinedMetricError(
            f"expected at least one value in {ndim} dimension(s), got an array of "
            f"shape {numbers.shape}"
        )
    wrong = np.argwhere(~np.isfinite(numbers))
    if len(wrong):
        raise UndefinedMetricError(
            f"expected finite values, got {numbers[tuple(wrong[0])]} for episode "
            f"{wrong[0][0]}"
        )
    return numbers


def tallies(
    table: FloatArray, participants: Sequence[str], cells: Sequence[Hashable]
) -> tuple[FloatArray, FloatArray]:
    """Return sums (participants, cells, metrics) and counts (participants, cells)."""
    # Sorted, so that the order of the episodes changes nothing.
    people = {name: index for index, name in enumerate(sorted(set(participants)))}
    numbers = {cell: index for index, cell in enumerate(dict.fromkeys(cells))}
    rows = np.array([people[name] for name in participants], dtype=np.intp)
    columns = np.array([numbers[cell] for cell in cells], dtype=np.intp)
    sums = np.zeros((len(people), len(numbers), table.shape[1]))
    counts = np.zeros((len(people), len(numbers)))
    np.add.at(sums, (rows, columns), table)
    np.add.at(counts, (rows, columns), 1.0)
    return sums, counts


def _draws(
    group: NDArray[np.intp], rng: np.random.Generator, resamples: int
) -> FloatArray:
    """Return how often each participant is drawn, shape (resamples, participants)."""
    weights = np.zeros((resamples, len(group)))
    for number in range(int(group.max()) + 1):
        members = np.flatnonzero(group == number)
        share = np.full(len(members), 1 / len(members))
        weights[:, members] = rng.multinomial(len(members), share, size=resamples)
    return weights
