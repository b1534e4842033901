"""How far walks followed the way described, and what they did at its turning points."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from shapely import LineString, Polygon, get_coordinates

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.sites import Route, Site, TurningPoint

STEP = 0.25
"""Metres between the places on the way that a walk is compared with."""
STRIDE = 0.4
"""Metres between the places of a walk that are looked at."""
WAYS = {
    "left": "turn left",
    "right": "turn right",
    "slight_left": "turn slightly left",
    "slight_right": "turn slightly right",
}
SAMPLE = 0.1
"""Metres between the places of a way that are looked at."""
DIRECTIONS = ("went straight on", "went left", "went back", "went right")

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


def followed_along(
    way: Sequence[tuple[float, float]] | ArrayLike, walk: ArrayLike, tolerance: float
) -> Following:
    """Follow a walk along a way until it leaves it.

    A walk has left the way when it is farther from the part it could have got to than
    the tolerance, or has gone back by more than that. A walk that has come within the
    tolerance of the way's end has followed it; whether it also ends there is the
    difference between `end` and `passed`. Way and walk are in metres, shape (N, 2).
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


@dataclass(frozen=True, slots=True)
class Decision:
    """A turning point that the way described passes, and what is right there."""

    number: int
    """From 1, along the way."""
    id: str
    title: str
    way: str
    """`turn left`, `go straight on`, …"""
    enter: float
    """Metres along the way where it begins."""
    leave: float
    """Metres along the way where it ends."""


@dataclass(frozen=True, slots=True)
class DecisionCount:
    """What walks did at a decision."""

    decision: Decision
    reached: int
    right: int
    """Walks that followed the way past it."""
    wrong: int
    """Walks whose first wrong decision it was."""
    ended: int
    """Walks that ended inside it, with nothing wrong so far."""
    instead: tuple[tuple[str, int], ...]
    """What those did that went wrong: `went left`, …; the commonest first."""


def decisions_of(site: Site, route: Route) -> list[Decision]:
    """Return the turning points that a route passes, in its order."""
    turns: dict[str, list[str]] = {}
    for turn in route.turns:
        turns.setdefault(turn.at, []).append(turn.direction)
    passed = sorted(
        (
            (span, place)
            for place in site.turning_points
            for span in _spans(route.line, place.polygon)
        ),
        key=lambda each: each[0],
    )
    decisions: list[Decision] = []
    for number, ((enter, leave), place) in enumerate(passed, start=1):
        wanted = turns.get(place.id)
        way = WAYS[wanted.pop(0)] if wanted else "go straight on"
        decisions.append(Decision(number, place.id, _title(place), way, enter, leave))
    return decisions


def first_wrong(decisions: Sequence[Decision], following: Following) -> Decision | None:
    """Return the decision at which a walk first went wrong; None where at none.

    That is the last one reached before the walk left the way; one that leaves it before
    the first turning point has none, nor has one that only ended too early.
    """
    if following.how not in {"left", "turned_back"}:
        return None
    reached = [each for each in decisions if each.enter <= following.along + 0.5]
    return reached[-1] if reached else None


def count_decisions(
    decisions: Sequence[Decision], route: Route, followed: Iterable[Following]
) -> list[DecisionCount]:
    """Count what walks did at each decision up to their first wrong one."""
    walks = [(each, first_wrong(decisions, each)) for each in followed]
    counts: list[DecisionCount] = []
    for decision in decisions:
        reached = right = ended = 0
        instead: Counter[str] = Counter()
        for following, wrong in walks:
            if following.how in {"end", "passed"}:
                reached += 1
                right += 1
            elif wrong is decision:
                reached += 1
                instead[_instead(route, decision, following)] += 1
            elif following.furthest >= decision.enter - 0.25:
                reached += 1
                past = following.furthest > decision.leave
                right += past
                ended += not past
        counts.append(
            DecisionCount(
                decision=decision,
                reached=reached,
                right=right,
                wrong=instead.total(),
                ended=ended,
                instead=tuple(sorted(instead.items(), key=lambda kv: (-kv[1], kv[0]))),
            )
        )
    return counts


def _instead(route: Route, decision: Decision, following: Following) -> str:
    """Say which way a walk went that should have gone another one."""
    if following.how == "turned_back" or following.away is None:
        return "turned back later"
    if following.along > decision.leave + 3.0:
        return "left the way farther on"
    before = max(0.0, decision.enter - 0.5)
    behind = route.line.interpolate(before)
    ahead = route.line.interpolate(before + 0.25)
    came = heading_to((behind.x, behind.y), (ahead.x, ahead.y))
    middle = route.line.interpolate((decision.enter + decision.leave) / 2)
    went = heading_to((middle.x, middle.y), following.away)
    return DIRECTIONS[round(turn_between(came, went) / (math.pi / 2)) % 4]


def _spans(line: LineString, area: Polygon) -> list[tuple[float, float]]:
    """Return where a line is inside an area, metres along it."""
    vertices = get_coordinates(line)
    points = polyline.resample(vertices, SAMPLE)
    spacing = polyline.length(vertices) / max(1, len(points) - 1)
    inside = shapely.contains_xy(area, points[:, 0], points[:, 1])
    edges = np.flatnonzero(np.diff(inside.astype(int), prepend=0, append=0))
    return [
        (float(first) * spacing, float(after - 1) * spacing)
        for first, after in edges.reshape(-1, 2)
    ]


def _title(place: TurningPoint) -> str:
    if place.name:
        return f"{place.name} ({place.id})"
    return f"{place.shape.replace('_', ' ')} {place.id}"
