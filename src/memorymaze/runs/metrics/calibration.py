"""Whether an agent knows when it is right: Brier score, calibration, risk and coverage.

All take confidences, the probabilities of success that an agent told, and outcomes, 1 for
a success and 0 for none, both of shape (n,). No episode, a confidence outside 0 to 1 or
an outcome that is neither 0 nor 1 is an `UndefinedMetricError`.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import UndefinedMetricError

BINS = 10
"""Of equal width, in which confidence is held against success."""


@dataclass(frozen=True, slots=True)
class ReliabilityBin:
    """Episodes that were about as confident."""

    low: float
    """Confidence above which they are; 0 itself is in the first bin."""
    high: float
    """Confidence up to which they are."""
    count: int
    confidence: float
    """Their mean."""
    success: float
    """Share of successes among them."""


def brier_score(confidences: ArrayLike, outcomes: ArrayLike) -> float:
    """Return the mean squared error of confidences: BS = mean (c_i - o_i)^2, 0 to 1.

    Half of the score in Brier 1950, "Verification of forecasts expressed in terms of
    probability", which counts success and failure each.

    >>> brier_score([1.0, 0.5, 0.0], [1, 1, 1])
    0.4166666666666667
    """
    told, came = _checked(confidences, outcomes)
    return float(np.mean((told - came) ** 2))


def brier_reference(outcomes: ArrayLike) -> float:
    """Return the Brier score of always telling the mean: BS_ref = o (1 - o).

    What an agent must stay below to know anything of its single episodes. The term
    "uncertainty" in Murphy 1973, "A new vector partition of the probability score".

    >>> brier_reference([1, 1, 1, 0])
    0.1875
    """
    came = np.asarray(outcomes, dtype=np.float64)
    return brier_score(np.full(came.shape, came.mean() if came.size else 0.0), came)


def reliability(confidences: ArrayLike, outcomes: ArrayLike) -> list[ReliabilityBin]:
    """Return success beside confidence, for each of `BINS` bins that is not empty.

    >>> reliability([0.9, 0.95, 0.2], [1, 0, 0])[-1]
    ReliabilityBin(low=0.9, high=1.0, count=1, confidence=0.95, success=0.0)
    """
    told, came = _checked(confidences, outcomes)
    edges = [number / BINS for number in range(1, BINS)]
    places = np.digitize(told, edges, right=True)
    return [
        ReliabilityBin(
            low=place / BINS,
            high=(place + 1) / BINS,
            count=int(inside.sum()),
            confidence=float(told[inside].mean()),
            success=float(came[inside].mean()),
        )
        for place in range(BINS)
        if (inside := places == place).any()
    ]


def expected_calibration_error(confidences: ArrayLike, outcomes: ArrayLike) -> float:
    """Return how far confidence is from success: ECE = sum_b n_b / n |o_b - c_b|.

    Source: Guo et al. 2017, "On calibration of modern neural networks", eq. 3, with
    `BINS` bins of equal width.

    >>> expected_calibration_error([0.75, 0.75, 0.75, 0.75], [1, 1, 0, 0])
    0.25
    """
    bins = reliability(confidences, outcomes)
    apart = sum(each.count * abs(each.success - each.confidence) for each in bins)
    return apart / sum(each.count for each in bins)


def risk_coverage(confidences: ArrayLike, outcomes: ArrayLike) -> NDArray[np.float64]:
    """Return the share of failures among the k most confident episodes, k = 1 … n.

    Equally confident episodes count as taken in random order: each as their mean.
    Source: Geifman and El-Yaniv 2017, "Selective classification for deep neural
    networks", selective risk at coverage k / n.

    >>> risk_coverage([0.9, 0.8, 0.1], [1, 0, 1]).tolist()
    [0.0, 0.5, 0.3333333333333333]
    """
    told, came = _checked(confidences, outcomes)
    _, group, sizes = np.unique(-told, return_inverse=True, return_counts=True)
    means = np.bincount(group.reshape(-1), weights=1 - came) / sizes
    return np.cumsum(np.repeat(means, sizes)) / np.arange(1, len(told) + 1)


def risk_coverage_area(confidences: ArrayLike, outcomes: ArrayLike) -> float:
    """Return the mean risk over all coverages: AURC = mean over k of risk(k / n).

    Confidences that know nothing have 1 - SR. Source: Geifman et al. 2019,
    "Bias-reduced uncertainty estimation for deep neural classifiers".

    >>> risk_coverage_area([0.5, 0.5], [1, 0])
    0.5
    """
    return float(risk_coverage(confidences, outcomes).mean())


def success_at_coverage(
    confidences: ArrayLike, outcomes: ArrayLike, coverage: float
) -> float:
    """Return the share of successes among the most confident part of the episodes.

    >>> success_at_coverage([0.9, 0.8, 0.1], [1, 0, 1], 0.5)
    0.5

    Args:
        confidences: Of the episodes, shape (n,).
        outcomes: Of the episodes, shape (n,).
        coverage: Which part, above 0 and up to 1; rounded up to whole episodes.
    """
    risks = risk_coverage(confidences, outcomes)
    return float(1 - risks[math.ceil(coverage * len(risks) - 1e-9) - 1])


def _checked(
    confidences: ArrayLike, outcomes: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    told = np.asarray(confidences, dtype=np.float64)
    came = np.asarray(outcomes, dtype=np.float64)
    if told.ndim != 1 or told.shape != came.shape or told.size == 0:
        raise UndefinedMetricError(
            "expected a confidence and an outcome of at least one episode, got arrays of "
            f"shape {told.shape} and {came.shape}"
        )
    if not ((told >= 0) & (told <= 1)).all():
        wrong = told[~((told >= 0) & (told <= 1))][0]
        raise UndefinedMetricError(f"expected confidences from 0 to 1, got {wrong}")
    if not np.isin(came, (0.0, 1.0)).all():
        raise UndefinedMetricError("expected outcomes that are 0 or 1, got others")
    return told, came
