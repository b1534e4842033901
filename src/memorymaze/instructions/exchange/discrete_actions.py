"""The steps and turns with which a discrete agent walks along a line."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.geometry.polyline import length, point_at, project
from memorymaze.geometry.pose import Pose, bearing_to, wrap_angle

STOP, FORWARD, LEFT, RIGHT = 0, 1, 2, 3
"""Numbers of the actions in VLN-CE."""
LOOK_AHEAD = 0.75
"""Metres along the line from where the agent is to where it heads for."""


class DiscreteWalk(NamedTuple):
    """A walk of single actions."""

    actions: tuple[int, ...]
    """Ends with `STOP`."""
    places: tuple[tuple[float, float], ...]
    """Where the agent stands before each action, metres."""


def walk_along(
    line: ArrayLike, start: Pose, *, step: float = 0.25, turn: float = math.radians(15)
) -> DiscreteWalk:
    """Walk along a line with steps of one length and turns of one angle.

    The agent heads for a point a little ahead on the line, turns as often as brings it
    nearest to that direction, and steps; it stops where another step would not bring
    it nearer to the end. It never strays farther from the line than about a step.

    Args:
        line: Vertices, metres, shape (N, 2).
        start: Where the walk begins; on the line's first vertex.
        step: Metres of `FORWARD`.
        turn: Radians of `LEFT` and `RIGHT`.
    """
    total = length(line)
    end = tuple(point_at(line, total).tolist())
    x, y, heading = start
    along = 0.0
    actions: list[int] = []
    places: list[tuple[float, float]] = []
    while True:
        along = max(along, _progress(line, along, (x, y)))
        ahead = point_at(line, min(along + LOOK_AHEAD, total))
        aim = (float(ahead[0]), float(ahead[1]))
        turns = 0
        if math.dist((x, y), aim) > 1e-9:
            turns = round(bearing_to(Pose(x, y, heading), aim) / turn)
        ahead_heading = wrap_angle(heading + turns * turn)
        there = (
            x + step * math.cos(ahead_heading),
            y + step * math.sin(ahead_heading),
        )
        near_end = total - along < LOOK_AHEAD
        if near_end and math.dist(there, end) >= math.dist((x, y), end):
            break
        actions += [LEFT if turns > 0 else RIGHT] * abs(turns) + [FORWARD]
        places += [(x, y)] * (abs(turns) + 1)
        (x, y), heading = there, ahead_heading
    return DiscreteWalk((*actions, STOP), (*places, (x, y)))


def _progress(line: ArrayLike, along: float, place: tuple[float, float]) -> float:
    """Return the arc length of the nearest place on the next metre of the line."""
    total = length(line)
    stations = np.linspace(along, min(along + 1.0, total), 21)
    stretch = np.array([point_at(line, s) for s in stations])
    return along + project(stretch, place).s
