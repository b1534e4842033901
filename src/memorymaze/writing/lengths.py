"""How long texts become: lengths with a wanted mean and standard deviation."""

import math

import numpy as np
from numpy.typing import NDArray

LONGEST = 3.5
"""Standard deviations above the mean; longer ones are drawn again."""
STEEPEST = 1.4
"""Greatest deviation as a multiple of the mean above the least length; beyond it no
log-normal with a cut tail has these moments, and the least length gives way."""


def stratified(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return numbers spread evenly over [0, 1), in random order, shape (count,).

    One lies in each of `count` equal parts, so that shares of any event drawn with them
    are right to one part: a cell of 1,000 texts has its failure rate, not one near it.
    """
    return (rng.permutation(count) + rng.random(count)) / count


def wanted_lengths(
    mean: float, deviation: float, least: float, count: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Draw word counts with a mean and standard deviation, shape (count,).

    Log-normal above `least`, as spoken lengths are: many short ones, a few very long.
    The tail is cut; parameters are moved so that the moments still hold.

    Args:
        mean: Words.
        deviation: Words.
        least: Words that no text goes below; less than the mean.
        count: How many.
        rng: Source of chance.
    """
    least = min(least, mean - deviation / STEEPEST)
    spread = np.log1p((deviation / (mean - least)) ** 2)
    levels = stratified(count, rng)
    top = mean + LONGEST * deviation
    grid = (np.arange(4000) + 0.5) / 4000
    drift, width = math.log(mean - least) - spread / 2, math.sqrt(spread)
    for _ in range(40):
        values = _cut(grid, drift, width, least, top)
        width *= deviation / max(values.std(), 1e-9)
        values = _cut(grid, drift, width, least, top)
        drift += math.log((mean - least) / (values.mean() - least))
    return _cut(levels, drift, width, least, top)


def _cut(
    levels: NDArray[np.float64], drift: float, width: float, least: float, top: float
) -> NDArray[np.float64]:
    """Return quantiles of the log-normal that is cut off at the top."""
    from scipy.special import ndtr, ndtri

    share = ndtr((math.log(top - least) - drift) / width)
    return least + np.exp(drift + width * ndtri(levels * share))
