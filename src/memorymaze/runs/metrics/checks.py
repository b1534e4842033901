"""What every metric demands of its inputs; anything else is undefined, never guessed: an `UndefinedMetricError`."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import UndefinedMetricError


def checked_distances(distances: ArrayLike, ndim: int) -> NDArray[np.float64]:
    """Return distances as a float array, metres."""
    metres = np.asarray(distances, dtype=np.float64)
    if metres.ndim != ndim:
        raise UndefinedMetricError(
            f"expected distances with {ndim} dimension(s), got shape {metres.shape}"
        )
    if metres.size == 0:
        raise UndefinedMetricError("expected a path of at least one node, got none")
    if not (np.isfinite(metres) & (metres >= 0)).all():
        wrong = metres[~(np.isfinite(metres) & (metres >= 0))][0]
        if wrong == np.inf:
            raise UndefinedMetricError("two of the places are not joined by any way")
        raise UndefinedMetricError(f"expected distances >= 0 m, got {wrong}")
    return metres


def checked_metres(name: str, metres: float) -> float:
    """Return a length, metres."""
    if not (math.isfinite(metres) and metres >= 0):
        raise UndefinedMetricError(f"expected {name} to be >= 0 m, got {metres}")
    return float(metres)


def checked_success_distance(success_distance: float) -> float:
    """Return the threshold of success, metres."""
    if not (math.isfinite(success_distance) and success_distance > 0):
        raise UndefinedMetricError(
            f"expected a threshold > 0 m, got {success_distance}"
        )
    return float(success_distance)
