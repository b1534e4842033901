"""Agreement beyond chance: Cohen's and Fleiss' kappa.

Both are (agreement - expected) / (1 - expected); they differ in what they expect of
annotators who answer by chance.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Kappa:
    """Agreement of annotators on one label."""

    agreement: float
    """Share of pairs of answers that are equal, 0 to 1."""
    expected: float
    """The same if everyone answered by chance, as often each answer as they do."""

    @property
    def value(self) -> float | None:
        """Kappa, up to 1; None where everyone always gives the same answer."""
        if self.expected >= 1.0:
            return None
        return (self.agreement - self.expected) / (1.0 - self.expected)


def cohens_kappa(table: ArrayLike) -> Kappa:
    """Return Cohen's kappa of two annotators.

    Source: Cohen 1960, "A Coefficient of Agreement for Nominal Scales", Educational and
    Psychological Measurement 20. Each annotator keeps their own shares of answers.

    >>> round(cohens_kappa([[20, 5], [10, 15]]).value, 6)
    0.4

    Args:
        table: How often the first gave answer i and the second answer j, (k, k), all
            >= 0; need not be whole.

    Raises:
        ValueError: The table has another shape, negative numbers, or nothing in it.
    """
    counts = _counts(table)
    if counts.shape[0] != counts.shape[1]:
        raise ValueError(f"expected a square table, got shape {counts.shape}")
    shares = counts / counts.sum()
    chance = float(shares.sum(axis=0) @ shares.sum(axis=1))
    return _kappa(float(np.trace(shares)), chance)


def fleiss_kappa(answers: ArrayLike) -> Kappa:
    """Return Fleiss' kappa of any number of annotators, the same number for each item.

    Source: Fleiss 1971, "Measuring Nominal Scale Agreement among Many Raters",
    Psychological Bulletin 76. All annotators share their shares of answers.

    >>> fleiss_kappa([[2, 0], [0, 2], [2, 0], [1, 1]]).agreement
    0.75

    Args:
        answers: How many annotators gave item i the answer j, (n, k).

    Raises:
        ValueError: The table has another shape, negative numbers, nothing in it, or
            items with different numbers of answers or fewer than two.
    """
    counts = _counts(answers)
    raters = counts.sum(axis=1)
    if raters.min() < 2 or np.ptp(raters) > 0:
        raise ValueError(
            "expected the same number of answers, two or more, for every item, got "
            f"{raters.min():g} to {raters.max():g}"
        )
    number = raters[0]
    pairs = (counts * (counts - 1)).sum(axis=1) / (number * (number - 1))
    shares = counts.sum(axis=0) / counts.sum()
    return _kappa(float(pairs.mean()), float(shares @ shares))


def _counts(table: ArrayLike) -> FloatArray:
    counts = np.asarray(table, dtype=np.float64)
    if counts.ndim != 2 or counts.size == 0:
        raise ValueError(f"expected a table of two dimensions, got {counts.shape}")
    if not np.isfinite(counts).all() or counts.min() < 0 or counts.sum() == 0:
        raise ValueError("expected numbers >= 0 that are not all 0")
    return counts


def _kappa(agreement: float, chance: float) -> Kappa:
    # Rounding must not make 0.9999999999999999 of an expectation that is 1.
    certain = np.isclose(chance, 1.0, rtol=0, atol=1e-12)
    return Kappa(agreement, 1.0 if certain else chance)
