"""Confidence intervals that know that one person's instructions belong together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.evaluation.results import EpisodeResult

__all__ = ["MEASURES", "Estimate", "estimate_means"]

MEASURES = ("sr", "osr", "spd", "cls")
"""What the paper's tables show of an episode."""

RESAMPLES = 10_000


@dataclass(frozen=True, slots=True)
class Estimate:
    """A mean and, where it was measured here, its 95 % interval."""

    mean: float
    low: float | None = None
    high: float | None = None


def estimate_means(
    cells: Sequence[Sequence[EpisodeResult]], seed: int = 0
) -> dict[str, Estimate]:
    """Return the mean of every measure over cells, with participant-bootstrap intervals.

    The mean is the unweighted mean of the cells' means, as the paper averages over
    routes; for one cell it is the cell's mean. For the interval, participants are drawn
    again with all their episodes, as often as there are: separately among those who
    contributed to the same cells, so that no cell runs empty. The interval goes from
    the 2.5th to the 97.5th percentile of 10,000 such draws. Where all episodes agree
    it has no width, which says nothing of certainty.

    Args:
        cells: Results that belong together, such as those of one route; none empty.
        seed: Of the draws.

    Returns:
        Estimates by the names in `MEASURES`.

    Raises:
        ValueError: There is no cell, or one is empty.
    """
    if not cells or not all(cells):
        raise ValueError("expected at least one episode in every cell")
    sums, counts = _tally(cells)
    means = (sums.sum(axis=0) / counts.sum(axis=0)[:, None]).mean(axis=0)
    weights = _draws(counts > 0, np.random.default_rng(seed))
    drawn = np.zeros((RESAMPLES, len(MEASURES)))
    for cell in range(len(cells)):
        drawn += (weights @ sums[:, cell]) / (weights @ counts[:, cell])[:, None]
    low, high = np.percentile(drawn / len(cells), [2.5, 97.5], axis=0)
    return {
        name: Estimate(float(means[index]), float(low[index]), float(high[index]))
        for index, name in enumerate(MEASURES)
    }


def _tally(
    cells: Sequence[Sequence[EpisodeResult]],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return sums (participants, cells, measures) and counts (participants, cells)."""
    names = sorted({result.participant for cell in cells for result in cell})
    number: Mapping[str, int] = {name: index for index, name in enumerate(names)}
    sums = np.zeros((len(names), len(cells), len(MEASURES)))
    counts = np.zeros((len(names), len(cells)))
    for index, cell in enumerate(cells):
        for result in cell:
            values = (result.success, result.oracle_success, result.spd, result.cls)
            sums[number[result.participant], index] += values
            counts[number[result.participant], index] += 1
    return sums, counts


def _draws(
    contributed: NDArray[np.bool_], rng: np.random.Generator
) -> NDArray[np.float64]:
    """Return how often each participant is drawn, shape (draws, participants)."""
    weights = np.zeros((RESAMPLES, len(contributed)))
    _, group = np.unique(contributed, axis=0, return_inverse=True)
    for number in range(int(group.max()) + 1):
        members = np.flatnonzero(group == number)
        share = np.full(len(members), 1 / len(members))
        weights[:, members] = rng.multinomial(len(members), share, size=RESAMPLES)
    return weights
