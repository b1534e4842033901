"""Whether two agents that followed the same instructions really differ."""

from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.errors import UndefinedMetricError
from memorymaze.metrics.aggregate import tallies

ROUNDING = 1e-12


def sign_flip_test(
    differences: ArrayLike,
    participants: Sequence[str],
    rng: np.random.Generator,
    *,
    cells: Sequence[Hashable] | None = None,
    draws: int = 10_000,
) -> list[float]:
    """Return how often chance alone gives mean differences as great as these.

    If both agents were equally good, each participant's differences could as well have
    the other sign. The test flips the signs of whole participants at random, because
    the texts of one person resemble each other, and counts how often the mean is at
    least as far from zero as the one seen. Source: Good 2005, "Permutation, Parametric
    and Bootstrap Tests of Hypotheses", matched pairs; p-values with the draw seen
    counted in (Phipson and Smyth 2010).

    >>> rng = np.random.default_rng(0)
    >>> sign_flip_test([[0.0], [0.0]], ["a", "b"], rng)
    [1.0]

    Args:
        differences: One row per episode, one column per metric, shape (n, m).
        participants: Who gave each episode's instruction, n ids.
        rng: Source of chance; the same seed gives the same values.
        cells: Which cell each episode belongs to; the mean is that of the cells' means.
            None for a single cell.
        draws: Number of random sign patterns, >= 1.

    Returns:
        One two-sided p-value per column, in (0, 1].

    Raises:
        UndefinedMetricError: There is no episode, or a value is not finite.
    """
    table = np.asarray(differences, dtype=np.float64)
    if table.ndim != 2 or table.size == 0 or not np.isfinite(table).all():
        raise UndefinedMetricError(
            "expected finite differences of at least one episode, shape (n, m), got "
            f"shape {table.shape}"
        )
    labels = [None] * len(table) if cells is None else list(cells)
    sums, counts = tallies(table, participants, labels)
    # What each participant adds to the mean over cells, shape (participants, metrics).
    parts = (sums / counts.sum(axis=0)[None, :, None]).mean(axis=1)
    seen = np.abs(parts.sum(axis=0))
    signs = rng.choice([-1.0, 1.0], size=(draws, len(parts)))
    extreme = np.abs(signs @ parts) >= seen - ROUNDING
    return [float(p) for p in (extreme.sum(axis=0) + 1) / (draws + 1)]
