"""How far the agent walked, and how much of that was needed: path length and SPL."""

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.checks import checked_distances, checked_metres


def path_length(step_lengths: ArrayLike) -> float:
    """Return the length of a path: PL = sum_i d(p_i, p_i+1).

    Consecutive places need not be neighbours; a path of one place has length 0.

    >>> path_length([0.5, 0.5, 2.0]), path_length([])
    (3.0, 0.0)
    """
    if np.shape(step_lengths) == (0,):
        return 0.0
    return float(checked_distances(step_lengths, 1).sum())


def spl(success: float, shortest_distance: float, path_length: float) -> float:
    """Return success weighted by path length: SPL = SR * l / max(l, PL).

    One episode's term of the mean that defines SPL in Anderson et al. 2018a, "On
    Evaluation of Embodied Navigation Agents". It is 0 where l = 0, as in the field's
    reference code.

    >>> spl(1.0, 8.0, 10.0), spl(0.0, 8.0, 10.0), spl(1.0, 0.0, 0.0)
    (0.8, 0.0, 0.0)
    """
    if success not in {0.0, 1.0}:
        raise UndefinedMetricError(f"expected a success of 0 or 1, got {success}")
    shortest = checked_metres("the shortest distance", shortest_distance)
    walked = checked_metres("the path length", path_length)
    if shortest == 0:
        return 0.0
    return success * shortest / max(shortest, walked)
