"""How many turns of the path described the agent took, in the order described."""

import math
from bisect import bisect_left
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.errors import UndefinedMetricError
from memorymaze.geometry import polyline
from memorymaze.geometry.pose import heading_to, turn_between

__all__ = ["ReferenceTurn", "TurnsTaken", "turns_along", "turns_taken"]

FloatArray = NDArray[np.float64]

LEAST_ANGLE = math.pi / 12
"""Radians; a path that bends less goes straight on."""

REACH = 3.0
"""Metres around a turn within which the agent can take it."""

SLACK = math.pi / 4
"""Radians an agent's way in or out may differ from the reference's."""

SAMPLE = 0.1
"""Metres between the places at which an agent's path is looked at."""

SHORTEST_WAY = 0.3
"""Metres; a shorter displacement shows no direction."""


class ReferenceTurn(NamedTuple):
    """A change of direction that the reference path makes."""

    x: float
    """East, metres."""
    y: float
    """North, metres."""
    heading_in: float
    """Direction of walking before it, radians in (-pi, pi]."""
    heading_out: float
    """Direction of walking after it, radians in (-pi, pi]."""


class TurnsTaken(NamedTuple):
    """How far an agent took the turns of a reference path."""

    taken: int
    """Turns taken in order."""
    total: int
    """Turns there are."""


def turns_along(
    points: ArrayLike, least_angle: float = LEAST_ANGLE
) -> tuple[ReferenceTurn, ...]:
    """Return the turns of a path: its vertices with at least this change of heading.

    >>> [(turn.x, turn.y) for turn in turns_along([(0, 0), (5, 0), (5, 5), (5, 9)])]
    [(5.0, 0.0)]

    Args:
        points: Vertices, metres, shape (N, 2).
        least_angle: Radians.
    """
    vertices = np.asarray(points, dtype=np.float64)
    distinct = vertices[np.append(True, np.diff(polyline.arc_lengths(vertices)) > 0)]
    ways = [heading_to(a, b) for a, b in pairwise(distinct)]
    turns = [
        ReferenceTurn(float(x), float(y), before, after)
        for (x, y), before, after in zip(
            distinct[1:-1], ways[:-1], ways[1:], strict=True
        )
        if abs(turn_between(before, after)) >= least_angle
    ]
    return tuple(turns)


def turns_taken(
    reference_turns: Sequence[ReferenceTurn],
    points: ArrayLike,
    reach: float = REACH,
    slack: float = SLACK,
) -> TurnsTaken:
    """Count the turns of a reference that a path takes in the reference's order.

    A path takes a turn when it comes within `reach` of it, arrives in its direction
    in and leaves in its direction out, both within `slack`. Directions are those from
    where the path enters the circle to where it is nearest to the turn, and from there
    to where it leaves the circle. Turns closer together than twice `reach` have circles
    of half their distance. The count is that of the longest subsequence in order: a
    turn left out does not void those after it. (Of this project; no paper defines it.)

    >>> corner = turns_along([(0, 0), (9, 0), (9, 9)])
    >>> turns_taken(corner, [(0, 0), (9, 0), (9, 5)])
    TurnsTaken(taken=1, total=1)
    >>> turns_taken(corner, [(0, 0), (9, 0), (9, -5)])
    TurnsTaken(taken=0, total=1)

    Args:
        reference_turns: In the order of the reference path.
        points: The agent's path, metres, shape (M, 2).
        reach: Metres, > 0.
        slack: Radians.

    Raises:
        UndefinedMetricError: The path is empty or not finite, or `reach` not positive.
    """
    if not reach > 0:
        raise UndefinedMetricError(f"expected a reach > 0 m, got {reach}")
    path = np.asarray(points, dtype=np.float64)
    if len(path) == 0 or not np.isfinite(path).all():
        raise UndefinedMetricError("expected a path of at least one finite point")
    samples = polyline.resample(path, SAMPLE)
    met: list[tuple[int, int]] = []
    for number, turn in enumerate(reference_turns):
        gaps = [
            math.dist(turn[:2], other[:2])
            for other in reference_turns[max(0, number - 1) : number + 2]
            if other is not turn
        ]
        radius = min([reach, *(gap / 2 for gap in gaps if gap > 0)])
        met.extend((when, number) for when in _takings(turn, samples, radius, slack))
    return TurnsTaken(
        _longest_rise([number for _, number in sorted(met)]), len(reference_turns)
    )


def _takings(
    turn: ReferenceTurn, samples: FloatArray, radius: float, slack: float
) -> list[int]:
    """Return the samples at which a path takes a turn."""
    distances = np.hypot(samples[:, 0] - turn.x, samples[:, 1] - turn.y)
    inside = np.concatenate([[False], distances <= radius, [False]])
    edges = np.flatnonzero(np.diff(inside.astype(np.int8)))
    takings: list[int] = []
    for enters, leaves in zip(edges[::2], edges[1::2] - 1, strict=True):
        nearest = int(enters + np.argmin(distances[enters : leaves + 1]))
        ways = (
            (samples[enters], samples[nearest], turn.heading_in),
            (samples[nearest], samples[leaves], turn.heading_out),
        )
        if all(_leads(start, end, heading, slack) for start, end, heading in ways):
            takings.append(nearest)
    return takings


def _leads(start: FloatArray, end: FloatArray, heading: float, slack: float) -> bool:
    if np.hypot(*(end - start)) < SHORTEST_WAY:
        return False
    return abs(turn_between(heading, heading_to(tuple(start), tuple(end)))) <= slack


def _longest_rise(numbers: Sequence[int]) -> int:
    """Return the length of the longest strictly increasing subsequence."""
    lowest_ends: list[int] = []
    for number in numbers:
        place = bisect_left(lowest_ends, number)
        lowest_ends[place : place + 1] = [number]
    return len(lowest_ends)
