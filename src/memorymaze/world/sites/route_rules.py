"""Rules of routes: their lengths, their turns, and the room around them."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from shapely import LineString, Point, Polygon

from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.sites.problems import SiteProblem
from memorymaze.world.sites.records import Route, Site

LENGTH_SLACK = 0.005
"""Metres between `length_m` and the length of the line."""
CLEARANCE = 0.45
"""Metres from a route to walls, holes and obstacles."""
ROUNDING = 0.01
"""Metres forgiven in clearances and touching."""
GOAL_NEAR = 4.0
"""Metres from the end of a route to what it leads to."""
START_TURN = math.radians(30)
"""How far the start heading may differ from the first leg."""
STRAIGHT_ON = math.radians(15)
"""A route that bends less than this at a turning point makes no turn there."""


def route_findings(site: Site, floor: Polygon) -> Iterator[SiteProblem]:
    """Find what is wrong with routes on an exact floor; ids may be unknown."""
    blocked = [thing.footprint for thing in site.landmarks if thing.obstacle]
    goals = {
        **{thing.id: thing.position for thing in site.landmarks},
        **{door.id: door.line for door in site.doors},
        **{room.id: room.polygon for room in site.rooms},
    }
    turning_points = {point.id: point.polygon for point in site.turning_points}
    for route in site.routes:
        yield from _length(route)
        yield from _clearance(route, floor, blocked)
        if route.goal_landmark in goals:
            yield from _goal(route, goals[route.goal_landmark])
        yield from _start(route)
        yield from _turns(route, turning_points)


def _length(route: Route) -> Iterator[SiteProblem]:
    measured = route.line.length
    if abs(measured - route.length) > LENGTH_SLACK + 1e-9:
        yield SiteProblem(
            route.id,
            "route-length",
            f"expected length_m to be the length of the line, {measured:.3f} m, got "
            f"{route.length:.3f} m",
        )


def _clearance(
    route: Route, floor: Polygon, blocked: list[Polygon]
) -> Iterator[SiteProblem]:
    wall = floor.boundary.distance(route.line)
    obstacle = min(
        (footprint.distance(route.line) for footprint in blocked), default=math.inf
    )
    kept = min(wall, obstacle) if floor.contains(route.line) else 0.0
    if kept < CLEARANCE - ROUNDING:
        what = "an obstacle" if obstacle < wall else "a wall"
        yield SiteProblem(
            route.id,
            "route-clearance",
            f"expected {CLEARANCE} m from every wall and obstacle, got {kept:.2f} m from "
            f"{what}",
        )


def _goal(route: Route, goal: Point | LineString | Polygon) -> Iterator[SiteProblem]:
    gap = goal.distance(Point(route.line.coords[-1]))
    if gap > GOAL_NEAR:
        yield SiteProblem(
            route.id,
            "route-goal",
            f"expected the goal {route.goal_landmark!r} within {GOAL_NEAR} m of the "
            f"route's end, got {gap:.1f} m",
        )


def _start(route: Route) -> Iterator[SiteProblem]:
    first_leg = heading_to(*_legs(route)[0])
    if abs(turn_between(route.start_heading, first_leg)) > START_TURN:
        yield SiteProblem(
            route.id,
            "route-start-heading",
            "expected a start heading along the first leg, at "
            f"{math.degrees(first_leg) % 360:.0f} degrees, got "
            f"{math.degrees(route.start_heading) % 360:.0f} degrees",
            "warning",
        )


def _turns(route: Route, turning_points: dict[str, Polygon]) -> Iterator[SiteProblem]:
    bends = _bends(route)
    reached = -math.inf
    for turn in route.turns:
        if turn.at not in turning_points:
            continue
        polygon = turning_points[turn.at]
        gap = polygon.distance(route.line)
        if gap > ROUNDING:
            yield SiteProblem(
                route.id,
                "turn-on-route",
                f"expected turns at places on the route, got {turn.at!r}, {gap:.2f} m "
                "away from it",
            )
            continue
        here = [
            bend
            for bend in bends
            if bend.at > reached and polygon.distance(bend.corner) <= ROUNDING
        ]
        visit = [bend for bend in here if bend.at - here[0].at <= polygon.length / 2]
        if not visit:
            yield SiteProblem(
                route.id,
                "turn-bends",
                f"expected the line to bend in {turn.at!r} after the turn before it, "
                "got no bend there",
                "warning",
            )
            continue
        reached = visit[0].at
        angle = math.degrees(sum(bend.angle for bend in visit))
        if (angle > 0) != turn.direction.endswith("left"):
            yield SiteProblem(
                route.id,
                "turn-direction",
                f"expected {'left' if angle > 0 else 'right'} at {turn.at!r}, where the "
                f"line turns by {angle:.0f} degrees, got {turn.direction!r}",
            )


class _Bend(NamedTuple):
    at: float
    """Metres along the route."""
    corner: Point
    angle: float
    """Radians, left positive."""


def _bends(route: Route) -> list[_Bend]:
    bends: list[_Bend] = []
    at = 0.0
    for before, after in pairwise(_legs(route)):
        at += math.dist(*before)
        angle = turn_between(heading_to(*before), heading_to(*after))
        if abs(angle) > STRAIGHT_ON:
            bends.append(_Bend(at, Point(after[0]), angle))
    return bends


def _legs(route: Route) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    return list(pairwise((x, y) for x, y, *_ in route.line.coords))
