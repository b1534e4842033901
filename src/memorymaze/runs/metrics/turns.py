"""Which turns of the way described an agent took, in the order described.

Of this project; no paper defines it. A turn has a place, such as a turning point of a
site plan, and a side.
"""

from collections.abc import Iterable, Sequence
from typing import Literal, NamedTuple

import numpy as np
import shapely
from shapely import Polygon

from memorymaze.basics.geometry.pose import turn_between
from memorymaze.basics.geometry.trajectory import Trajectory

LEAST_TURN = np.deg2rad(10)
"""Changes of heading within a place from which on they are a turn."""

GREATEST_TURN = np.deg2rad(155)
"""Beyond this, one went back the way one came."""


class TurnAtPlace(NamedTuple):
    """A change of direction at a place."""

    at: str
    """Id of the place."""
    side: Literal["left", "right"]


def turns_taken(
    places: Iterable[tuple[str, Polygon]], walk: Trajectory
) -> list[TurnAtPlace]:
    """Return the turns of a walk: changes of heading from entering to leaving a place.

    Each stay in a place gives at most one. Turning back gives none.

    >>> from memorymaze.basics.geometry.trajectory import TimedPose
    >>> poses = [(0, 0, 0, 0), (1, 4, 0, 0), (2, 4, 0, 1.57), (3, 4, 4, 1.57)]
    >>> walk = Trajectory(TimedPose(*pose) for pose in poses)
    >>> turns_taken([("corner", shapely.box(3, -1, 5, 1))], walk)
    [TurnAtPlace(at='corner', side='left')]

    Args:
        places: Ids and areas in which one can turn, metres.
        walk: Poses close enough together that none passes a place unseen.
    """
    points, poses = walk.points, walk.poses
    turns: list[tuple[int, TurnAtPlace]] = []
    for name, area in places:
        inside = shapely.contains_xy(area, points[:, 0], points[:, 1])
        edges = np.flatnonzero(np.diff(inside.astype(int), prepend=0, append=0))
        for first, after in edges.reshape(-1, 2):
            angle = turn_between(poses[first].heading, poses[after - 1].heading)
            if LEAST_TURN <= abs(angle) <= GREATEST_TURN:
                turns.append((
                    int(after),
                    TurnAtPlace(name, "left" if angle > 0 else "right"),
                ))
    return [turn for _, turn in sorted(turns)]


def turns_in_order(
    wanted: Sequence[TurnAtPlace], taken: Sequence[TurnAtPlace]
) -> float:
    """Return the share of turns taken in order: |LCS(wanted, taken)| / |wanted|.

    LCS is the longest common subsequence: a turn left out, or one too many, does not
    void those after it.

    >>> left, right = TurnAtPlace("hall", "left"), TurnAtPlace("stairs", "right")
    >>> turns_in_order([left, right], [right]), turns_in_order([left, right], [])
    (0.5, 0.0)

    Args:
        wanted: Turns of the way described.
        taken: Turns of the agent.

    Returns:
        A number from 0 to 1; 1 where no turn is wanted.
    """
    if not wanted:
        return 1.0
    longest = [0] * (len(taken) + 1)
    for one in wanted:
        before = longest.copy()
        for index, other in enumerate(taken):
            longest[index + 1] = (
                before[index] + 1
                if one == other
                else max(before[index + 1], longest[index])
            )
    return longest[-1] / len(wanted)
