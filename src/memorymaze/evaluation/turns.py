"""Which of a route's turns a walk took, in their order."""

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
import shapely

from memorymaze.geometry.pose import turn_between
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.sites import Route, Site

__all__ = ["TurnTaken", "turns_in_order", "turns_taken"]

LEAST_TURN = np.deg2rad(10)
"""Changes of heading within a turning point from which on they are a turn."""

GREATEST_TURN = np.deg2rad(155)
"""Beyond this, one went back the way one came."""


class TurnTaken(NamedTuple):
    """A change of direction within a turning point."""

    at: str
    """Turning point id."""
    side: Literal["left", "right"]


def turns_taken(site: Site, walk: Trajectory) -> list[TurnTaken]:
    """Return the turns of a walk: changes of heading from entering to leaving.

    Each stay in a turning point gives at most one. Turning back gives none.
    """
    points, poses = walk.points, walk.poses
    turns: list[tuple[int, TurnTaken]] = []
    for place in site.turning_points:
        inside = shapely.contains_xy(place.polygon, points[:, 0], points[:, 1])
        edges = np.flatnonzero(np.diff(inside.astype(int), prepend=0, append=0))
        for first, after in edges.reshape(-1, 2):
            angle = turn_between(poses[first].heading, poses[after - 1].heading)
            if LEAST_TURN <= abs(angle) <= GREATEST_TURN:
                side = "left" if angle > 0 else "right"
                turns.append((int(after), TurnTaken(place.id, side)))
    return [turn for _, turn in sorted(turns)]


def turns_in_order(site: Site, route: Route, walk: Trajectory) -> float:
    """Return the share of a route's turns that a walk took, in their order.

    The longest common subsequence of the two lists of turns over the length of the
    route's; slight and sharp turns count as left or right. 1 for a route without turns.
    """
    wanted = [
        TurnTaken(turn.at, "left" if turn.direction.endswith("left") else "right")
        for turn in route.turns
    ]
    if not wanted:
        return 1.0
    return _common(wanted, turns_taken(site, walk)) / len(wanted)


def _common(wanted: Sequence[TurnTaken], taken: Sequence[TurnTaken]) -> int:
    """Return the length of the longest common subsequence."""
    best = [0] * (len(taken) + 1)
    for one in wanted:
        before = best.copy()
        for index, other in enumerate(taken):
            best[index + 1] = (
                before[index] + 1
                if one == other
                else max(before[index + 1], best[index])
            )
    return best[-1]
