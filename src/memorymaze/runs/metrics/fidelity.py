"""How well the agent kept to the path described: coverage, CLS, DTW, nDTW and SDTW.

All take the matrix of shortest distances d(r, p) between the places r of the reference
path (rows) and p of the agent's path (columns), metres. Repeated places count. All but
DTW, in metres, go from 0 to 1. A path that is empty, two that are not joined, or a
threshold that is not positive, is an `UndefinedMetricError`.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.checks import (
    checked_distances,
    checked_metres,
    checked_success_distance,
)
from memorymaze.runs.metrics.success import SUCCESS_DISTANCE


def coverage(distances: ArrayLike, success_distance: float = SUCCESS_DISTANCE) -> float:
    """Return path coverage: PC = mean over r of exp(-min_p d(r, p) / th).

    Source: Jain et al. 2019, "Stay on the Path: Instruction Fidelity in
    Vision-and-Language Navigation", equation of PC.

    >>> round(coverage([[0.0, 5.0], [3.0, 6.0]]), 4)  # (1 + 1/e) / 2
    0.6839
    """
    near = checked_success_distance(success_distance)
    nearest = checked_distances(distances, 2).min(axis=1)
    return float(np.exp(-nearest / near).mean())


def cls(
    distances: ArrayLike,
    reference_length: float,
    path_length: float,
    success_distance: float = SUCCESS_DISTANCE,
) -> float:
    """Return coverage weighted by length score: CLS = PC * EPL / (EPL + |EPL - PL|).

    EPL = PC * len(R) is the length expected of a path with this coverage. Source: Jain
    et al. 2019, equations of CLS, LS and EPL. It is 1 where EPL = 0 and PL = 0. The
    order in which the reference is visited does not matter.

    >>> round(cls([[0.0, 5.0], [3.0, 6.0]], 4.0, 4.0), 4)  # PC 0.6839, EPL 2.7358
    0.4678
    """
    covered = coverage(distances, success_distance)
    expected = covered * checked_metres("the reference length", reference_length)
    walked = checked_metres("the path length", path_length)
    if expected == 0 and walked == 0:
        return 1.0
    return covered * expected / (expected + abs(expected - walked))


def dtw(distances: ArrayLike) -> float:
    """Return the cost of dynamic time warping between the two paths, metres.

    DTW(i, j) = d(i, j) + min(DTW(i-1, j), DTW(i, j-1), DTW(i-1, j-1)), without a band.
    Source: Ilharco et al. 2019, "General Evaluation for Instruction Conditioned
    Navigation using Dynamic Time Warping", equation of DTW.

    >>> dtw([[0.0, 1.0, 2.0], [1.0, 0.0, 1.0]])
    1.0
    """
    costs = checked_distances(distances, 2)
    if min(costs.shape) == 1:
        return float(costs.sum())
    return _warped(np.ascontiguousarray(costs))


def ndtw(distances: ArrayLike, success_distance: float = SUCCESS_DISTANCE) -> float:
    """Return normalised dynamic time warping: nDTW = exp(-DTW / (th * |R|)).

    |R| is the number of places of the reference. Source: Ilharco et al. 2019,
    equation of nDTW.

    >>> round(ndtw([[0.0, 1.0, 2.0], [1.0, 0.0, 1.0]]), 4)  # exp(-1 / 6)
    0.8465
    """
    near = checked_success_distance(success_distance)
    return float(np.exp(-dtw(distances) / (near * np.shape(distances)[0])))


def sdtw(success: float, ndtw: float) -> float:
    """Return success weighted by nDTW: SDTW = SR * nDTW.

    Source: Ilharco et al. 2019, equation of SDTW.

    >>> sdtw(1.0, 0.8), sdtw(0.0, 0.8)
    (0.8, 0.0)
    """
    if success not in {0.0, 1.0} or not 0 <= ndtw <= 1:
        raise UndefinedMetricError(
            f"expected a success of 0 or 1 and an nDTW from 0 to 1, got {success} and "
            f"{ndtw}"
        )
    return success * ndtw


def _warped(costs: NDArray[np.float64]) -> float:
    """Fill the table of warped costs one anti-diagonal at a time; both sides >= 2.

    The cells (i, k - i) of diagonal k need only diagonals k - 1 and k - 2, so each is
    one vector operation. Slot i + 1 of a line holds row i; slot 0 and the slots not
    yet reached stay infinite.
    """
    rows, columns = costs.shape
    flat = costs.reshape(-1)
    before, last, line = (np.full(rows + 1, np.inf) for _ in range(3))
    last[1] = flat[0]
    for k in range(1, rows + columns - 1):
        low, high = max(0, k - columns + 1), min(rows - 1, k)
        here = line[low + 1 : high + 2]
        np.minimum(last[low : high + 1], last[low + 1 : high + 2], out=here)
        np.minimum(here, before[low : high + 1], out=here)
        first = k + low * (columns - 1)
        here += flat[first : k + high * (columns - 1) + 1 : columns - 1]
        before, last, line = last, line, before
    return float(last[rows])
