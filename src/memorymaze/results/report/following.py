"""How far a walk followed the way described, and where it left it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.geometry import polyline

STEP = 0.25
"""Metres between the places on the way that a walk is compared with."""
STRIDE = 0.4
"""Metres between the places of a walk that are looked at."""

FollowedTo = Literal["end", "passed", "left", "turned_back", "stopped"]
"""`end`: to the goal's surroundings; `passed`: through them and away; `left`: went off;
`turned_back`: went back along the way; `stopped`: ended on the way, too early."""


@dataclass(frozen=True, slots=True)
class Following:
    """Where a walk and the way described part."""

    how: FollowedTo
    along: float
    """Metres along the way where it was followed last."""
    place: tuple[float, float]
    """That place on the way, metres; where it was followed to its end or a stop, the
    walk's last place."""
    away: tuple[float, float] | None
    """Where it was seen to be off the way; None where it never was."""
    furthest: float
    """Metres along the way that were followed at most."""


def follow(
    way: Sequence[tuple[float, float]] | ArrayLike, walk: ArrayLike, tolerance: float
) -> Following:
    """Follow a walk along a way until it leaves it.

    A walk has left the way when it is farther from the part it could have got to than
    the tolerance, or has gone back by more than that. A walk that has come within the
    tolerance of the way's end has followed it; whether it also ends there is the
    difference between `end` and `passed`.

    Args:
        way: Vertices of the way described, metres, shape (N, 2).
        walk: Places of the walk, metres, shape (M, 2) with M >= 1.
        tolerance: Metres, > 0; the report takes the success distance.
    """
    places = polyline.resample(way, STEP)
    length = polyline.length(way)
    spacing = length / max(1, len(places) - 1)
    steps = _thinned(np.asarray(walk, dtype=np.float64))
    here, furthest, last = 0, 0, steps[0]
    for point in steps:
        moved = float(np.hypot(*(point - last)))
        back = int(moved / STEP) + 2
        ahead = int((moved + tolerance) / STEP) + 2
        first = max(0, here - back)
        near = places[first : here + ahead]
        distances = np.hypot(near[:, 0] - point[0], near[:, 1] - point[1])
        index = int(distances.argmin())
        off = float(distances[index]) > tolerance
        if off or (furthest - first - index) * spacing > tolerance:
            reached = here if off else furthest
            how: FollowedTo = "left" if off else "turned_back"
            if (len(places) - 1 - furthest) * spacing <= tolerance:
                how = "end" if _near(places[-1], steps[-1], tolerance) else "passed"
            return Following(
                how=how,
                along=reached * spacing,
                place=_pair(places[reached]),
                away=None if how == "end" else _pair(point),
                furthest=furthest * spacing,
            )
        here, last = first + index, point
        furthest = max(furthest, here)
    return Following(
        how="end" if _near(places[-1], steps[-1], tolerance) else "stopped",
        along=here * spacing,
        place=_pair(steps[-1]),
        away=None,
        furthest=furthest * spacing,
    )


def _near(
    one: NDArray[np.float64], other: NDArray[np.float64], tolerance: float
) -> bool:
    return float(np.hypot(*(one - other))) <= tolerance


def _thinned(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the first and last point, and some at least a stride apart between."""
    kept: list[tuple[float, float]] = []
    for x, y in points.tolist():
        if not kept or math.hypot(x - kept[-1][0], y - kept[-1][1]) >= STRIDE:
            kept.append((x, y))
    return np.array([*kept, points[-1]])


def _pair(point: NDArray[np.float64]) -> tuple[float, float]:
    return float(point[0]), float(point[1])
