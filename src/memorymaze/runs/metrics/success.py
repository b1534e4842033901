"""Whether the agent ended, or ever was, near the goal: NE (SPD), SR and OSR.

All take the shortest distances from the places of the agent's path to the goal, in the
order walked, metres, shape (n,). Whether the agent itself stopped is for the caller to
add. A path that is empty or not joined to the goal, or a threshold that is not positive,
is an `UndefinedMetricError`.
"""

from numpy.typing import ArrayLike

from memorymaze.runs.metrics.checks import checked_distances, checked_success_distance

SUCCESS_DISTANCE = 3.0
"""Metres; nearer than this to the goal is success (Anderson et al. 2018b)."""


def navigation_error(goal_distances: ArrayLike) -> float:
    """Return the distance left to the goal: NE = d(p_n, goal).

    Called SPD, the shortest path distance, in the Memory-Maze paper. Source: Anderson
    et al. 2018b, "Vision-and-Language Navigation: Interpreting visually-grounded
    navigation instructions in real environments", definition of navigation error.

    >>> navigation_error([9.0, 2.0, 4.5])
    4.5
    """
    return float(checked_distances(goal_distances, 1)[-1])


def success(
    goal_distances: ArrayLike, success_distance: float = SUCCESS_DISTANCE
) -> float:
    """Return 1 when the path ends near the goal, else 0: SR = [NE < th].

    Strict: ending at the threshold itself is no success. Source: Anderson et al. 2018b,
    definition of success rate.

    >>> success([9.0, 4.5, 2.9]), success([9.0, 4.5, 3.0])
    (1.0, 0.0)
    """
    near = checked_success_distance(success_distance)
    return float(navigation_error(goal_distances) < near)


def oracle_success(
    goal_distances: ArrayLike, success_distance: float = SUCCESS_DISTANCE
) -> float:
    """Return 1 when the path ever is near the goal: OSR = [min_i d(p_i, goal) < th].

    Strict as `success`, which it is never below. Source: Anderson et al. 2018b,
    definition of oracle success rate.

    >>> oracle_success([9.0, 2.9, 4.5]), oracle_success([9.0, 3.0, 4.5])
    (1.0, 0.0)
    """
    near = checked_success_distance(success_distance)
    return float(checked_distances(goal_distances, 1).min() < near)


def success_within(
    distance_left: float, success_distance: float, *, is_stopped: bool
) -> float:
    """Return 1 for an agent that stopped itself nearer to the goal than a distance.

    >>> success_within(2.0, 3.0, is_stopped=True), success_within(2.0, 1.5, is_stopped=True)
    (1.0, 0.0)

    Args:
        distance_left: Navigation error, metres.
        success_distance: Metres.
        is_stopped: Whether the agent itself ended the walk.
    """
    return float(is_stopped and distance_left < success_distance)


def success_within_way(
    path_length: float,
    way: float,
    times: float,
    success_distance: float = SUCCESS_DISTANCE,
    *,
    is_success: bool,
) -> float:
    """Return 1 for a success whose path was at most so many times the way described.

    The success distance comes on top, since a goal is asked for no more exactly: else
    hardly a real walk, which swings out at corners, would take the way once.

    >>> success_within_way(42.0, 40.0, 1.0, is_success=True)
    1.0
    >>> success_within_way(70.0, 40.0, 1.5, is_success=True)
    0.0

    Args:
        path_length: Metres driven.
        way: Length of the way described, metres.
        times: How many times that way.
        success_distance: Metres.
        is_success: Whether the walk is a success at all.
    """
    return float(is_success and path_length <= times * way + success_distance)
