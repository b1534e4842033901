"""What a route's page shows: walks, where they leave the way, and their decisions."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from shapely import get_coordinates

from memorymaze.runs.report.episode_page import WalkOfRun
from memorymaze.runs.report.sources import ReportRun
from memorymaze.runs.story.following import (
    DecisionCount,
    FollowedTo,
    count_decisions,
    decisions_of,
    first_wrong,
)
from memorymaze.world.drawing.svg import ViewBox, plan_frame
from memorymaze.world.sites import Route, Site

CELL = 2.0
"""Side of a cell of the heat map, metres."""
SHADES = 5
PAPER = 3.0
"""Metres of plan round what is drawn."""


@dataclass(frozen=True, slots=True)
class HeatCell:
    """A square of the plan in which walks left the way described."""

    x: float
    """West side, coordinates of the SVG."""
    y: float
    count: int
    shade: int
    """1 to `SHADES`."""


@dataclass(frozen=True, slots=True)
class WayCounts:
    """What a run's walks did on one way described."""

    route: Route
    walks: int
    how: dict[FollowedTo, int]
    decisions: tuple[DecisionCount, ...]
    before: int
    """Walks that left the way before its first turning point."""
    turns: tuple[int, ...]
    """Walks by the number of turns taken in order, from none to all."""


@dataclass(frozen=True, slots=True)
class RunOnRoute:
    """A run on a route."""

    run: ReportRun
    walks: tuple[WalkOfRun, ...]
    outcomes: dict[str, int]
    """Numbers of walks by the key of their outcome."""
    cells: tuple[HeatCell, ...]
    left: int
    """Walks that left the way described."""
    returned: int
    """Of these those that arrived all the same."""
    ways: tuple[WayCounts, ...]


def picture_frame(
    site: Site, routes: Sequence[Route], walks: Sequence[WalkOfRun]
) -> ViewBox:
    """Return the part of a plan that holds ways and walks, with some paper round it."""
    points = np.concatenate(
        [get_coordinates(route.line) for route in routes]
        + [walk.line for walk in walks]
    )
    whole = plan_frame(site)
    west = max(float(points[:, 0].min()) - PAPER, whole.x)
    north = max(-float(points[:, 1].max()) - PAPER, whole.y)
    east = min(float(points[:, 0].max()) + PAPER, whole.x + whole.width)
    south = min(-float(points[:, 1].min()) + PAPER, whole.y + whole.height)
    return ViewBox(west, north, east - west, south - north)


def run_on_route(run: ReportRun, site: Site, walks: Sequence[WalkOfRun]) -> RunOnRoute:
    """Count and prepare the walks of a run on a route, on all ways described."""
    off = [each for each in walks if each.following.how in {"left", "turned_back"}]
    by_way: dict[str, list[WalkOfRun]] = {}
    for walk in walks:
        by_way.setdefault(walk.result.reference_route, []).append(walk)
    return RunOnRoute(
        run=run,
        # Rare outcomes on top: what fails must not hide beneath what arrives.
        walks=tuple(sorted(walks, key=lambda each: each.outcome.key)),
        outcomes=dict(Counter(each.outcome.key for each in walks)),
        cells=tuple(_cells(off)),
        left=len(off),
        returned=sum(each.result.success for each in off),
        ways=tuple(
            _way_counts(site, way, by_way[way])
            for way in sorted(by_way, key=lambda way: (-len(by_way[way]), way))
        ),
    )


def _way_counts(site: Site, way: str, walks: Sequence[WalkOfRun]) -> WayCounts:
    route = site.find_route(way)
    decisions = decisions_of(site, route)
    followed = [walk.following for walk in walks]
    wanted = len(route.turns)
    turns = [0] * (wanted + 1)
    for walk in walks:
        turns[round(walk.result.turns_in_order * wanted)] += 1
    return WayCounts(
        route=route,
        walks=len(walks),
        how=dict(Counter(each.how for each in followed)),
        decisions=tuple(count_decisions(decisions, route, followed)),
        before=sum(
            each.how in {"left", "turned_back"} and first_wrong(decisions, each) is None
            for each in followed
        ),
        turns=tuple(turns),
    )


def _cells(walks: Sequence[WalkOfRun]) -> list[HeatCell]:
    counts = Counter(
        (int(x // CELL), int(-y // CELL))
        for x, y in (walk.following.place for walk in walks)
    )
    most = max(counts.values(), default=0)
    return [
        HeatCell(
            x=column * CELL,
            y=row * CELL,
            count=count,
            shade=1 + (count * SHADES - 1) // most if count < most else SHADES,
        )
        for (column, row), count in sorted(counts.items())
    ]
