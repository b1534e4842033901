"""Whether two agents that followed the same instructions really differ."""

from collections.abc import Hashable, Sequence
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.aggregate import tallies

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
    the other sign. The test flips the signs of whole participants, because the texts of
    one person resemble each other, and counts how often the mean is at least as far from
    zero as the one seen. Where there are no more patterns of signs than draws (of 10,000:
    up to 13 participants whose differences are not all 0), each is counted once and the
    value is exact; otherwise they are drawn at random, with the one seen counted in
    (Phipson and Smyth 2010). Source: Good 2005, "Permutation, Parametric and Bootstrap
    Tests of Hypotheses", matched pairs.

    >>> rng = np.random.default_rng(0)
    >>> sign_flip_test([[1.0], [2.0], [3.0]], ["a", "b", "c"], rng)
    [0.25]

    Args:
        differences: One row per episode, one column per metric, shape (n, m).
        participants: Who gave each episode's instruction, n ids.
        rng: Source of chance where patterns are drawn; the same seed gives the same values.
        cells: Which cell each episode belongs to; the mean is that of the cells' means.
            None for a single cell.
        draws: Most sign patterns that are looked at, >= 1.

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
    # Who shows no difference at all changes nothing, whatever the sign.
    parts = parts[(parts != 0).any(axis=1)]
    is_exact = 2 ** len(parts) <= draws
    if is_exact:
        signs = np.array(list(product([-1.0, 1.0], repeat=len(parts))))
    else:
        signs = rng.choice([-1.0, 1.0], size=(draws, len(parts)))
    extreme = (np.abs(signs @ parts) >= seen - ROUNDING).sum(axis=0)
    shares = extreme / len(signs) if is_exact else (extreme + 1) / (draws + 1)
    return shares.tolist()
