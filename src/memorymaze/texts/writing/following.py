"""Follow a plan on the turning points of a site: does its description arrive?

The walker knows the plan alone: it goes straight on, follows corners that leave no
choice, turns where a cue comes true, and looks for the destination on the last stretch.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from memorymaze.basics.geometry.polyline import point_at, project
from memorymaze.texts.writing.steps import Step, StepPlan, ToldEnding
from memorymaze.texts.writing.turning_point_graph import GraphWay, TurningPointGraph
from memorymaze.world.sites.records import Route

ARRIVED = 3.0
"""Metres from the goal within which a description ends right."""
SEEN = 6.0
"""Metres from the last stretch within which a destination is seen."""
MOST_POINTS = 60


@dataclass(frozen=True, slots=True)
class Followed:
    """What comes of walking a plan."""

    arrived: bool
    end: tuple[float, float] | None
    """Where it ends, metres; None where the walker is lost."""
    lost: str
    """Why no step could be done; empty where the walk ends by itself."""
    turned: tuple[str, ...]
    """Turning points where the told turns were made."""


def follow_steps(
    graph: TurningPointGraph,
    route: Route,
    plan: StepPlan,
    *,
    corners_counted: bool = False,
) -> Followed:
    """Follow a plan from the route's start; tell where it ends.

    `corners_counted` says whether "the first left" may be a corner without a choice.
    """
    way = graph.first_way(route, around=plan.around)
    turned: list[str] = []
    lost = ""
    for turn in plan.turns:
        if not turn.told:
            continue
        there = _place_of(graph, way, turn, corners_counted=corners_counted)
        if there is None:
            told = turn.cue.words or f"{turn.cue.kind} {turn.cue.ordinal}"
            lost = f"nowhere to turn {turn.side} ({told}) before the way ends"
            break
        point, heading = there
        onward = graph.leaving(point, heading, turn.side)
        if onward is None:
            lost = f"no way lies {turn.side} at {point}"
            break
        turned.append(point)
        way = onward
    end = None if lost else _destination(graph, way, plan.ending)
    if end is None:
        lost = lost or "the destination is not on the last stretch"
        return Followed(False, None, lost, tuple(turned))
    x, y = route.line.coords[-1][:2]
    return Followed(math.dist(end, (x, y)) <= ARRIVED, end, "", tuple(turned))


def _ahead(
    graph: TurningPointGraph, way: GraphWay
) -> Iterator[tuple[str, float, GraphWay | None]]:
    """Yield turning points ahead, the heading there, and the way straight on.

    Corners without a choice are followed.
    """
    for _ in range(MOST_POINTS):
        if way.end is None:
            return
        onward = graph.leaving(way.end, way.heading, None)
        yield way.end, way.heading, onward
        onward = onward or graph.only_way(way.end, way.heading)
        if onward is None:
            return
        way = onward


def _place_of(
    graph: TurningPointGraph, way: GraphWay, turn: Step, *, corners_counted: bool
) -> tuple[str, float] | None:
    """Return where a turn is to be made, if its cue comes true before the way ends."""
    cue, seen = turn.cue, 0
    for point, heading, onward in _ahead(graph, way):
        only = graph.only_way(point, heading)
        forced = onward is None and only is not None
        here = graph.leaving(point, heading, turn.side)
        if cue.kind == "forced":
            if forced:
                return point, heading
        elif cue.kind == "end":
            if onward is None and not (forced and here is None):
                return point, heading
        elif here is not None and cue.kind == "thing":
            if cue.words in graph.marks[point]:
                return point, heading
        elif (
            here is not None
            and cue.kind == "ordinal"
            and (corners_counted or not forced)
        ):
            seen += 1
            if seen == cue.ordinal:
                return point, heading
    return None


def _destination(
    graph: TurningPointGraph, way: GraphWay, ending: ToldEnding
) -> tuple[float, float] | None:
    """Return the place on the last stretch that is nearest to the destination."""
    lines = [way.line]
    lines += [
        onward.line
        for point, heading, straight in _ahead(graph, way)
        if (onward := straight or graph.only_way(point, heading)) is not None
    ]
    spots = [point_at(line, project(line, ending.place).s) for line in lines]
    near = [(x, y) for x, y in spots if math.dist((x, y), ending.place) <= SEEN]
    return min(near, key=lambda spot: math.dist(spot, ending.place), default=None)
