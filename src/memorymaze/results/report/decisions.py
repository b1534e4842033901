"""What walks did at the turning points of the way described, one after the other."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString, Polygon, get_coordinates

from memorymaze.geometry import polyline
from memorymaze.geometry.pose import heading_to, turn_between
from memorymaze.results.report.following import Following
from memorymaze.sites import Route, Site, TurningPoint

WAYS = {
    "left": "turn left",
    "right": "turn right",
    "slight_left": "turn slightly left",
    "slight_right": "turn slightly right",
    "sharp_left": "turn sharply left",
    "sharp_right": "turn sharply right",
}
SAMPLE = 0.1
"""Metres between the places of a way that are looked at."""
DIRECTIONS = ("went straight on", "went left", "went back", "went right")


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
        way = WAYS.get(wanted.pop(0), "turn") if wanted else "go straight on"
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
