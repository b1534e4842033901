"""What every building must offer that episodes take place in."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from memorymaze.basics.errors import EpisodeOver
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.budgets import perfect_time
from memorymaze.runs.episodes.results import route_turns_in_order
from memorymaze.runs.metrics.score import score_walk
from memorymaze.testing.expectation import expect
from memorymaze.world.sites import Route, load_site
from memorymaze.world.sites import find_site_problems as find_problems

COVERAGE = 0.9
"""CLS of a perfect follower, at least."""

PATIENCE = 1.5
"""Multiples of a route's perfect time that a perfect follower may take."""


def check_site(plan: str | Path) -> None:
    """Check that a plan keeps the format and that all its routes can be driven.

    On every route, alternatives too, the oracle drives from start to goal: it must
    arrive, cover the route (CLS >= 0.9), take its turns, and touch nothing.

    Args:
        plan: A file in the format of `docs/buildings.md`.

    Raises:
        AssertionError: The plan has errors, or names a route that cannot be driven.
    """
    wrong = [each.line() for each in find_problems(plan) if each.severity == "error"]
    expect(not wrong, "a plan without errors", wrong)
    arena = Arena(load_site(plan))
    for route in arena.site.routes:
        _check_route(arena, route)


def _check_route(arena: Arena, route: Route) -> None:
    abilities = SimulationSettings()
    time = perfect_time(route, abilities)
    settings = replace(abilities, time_budget=PATIENCE * time)
    rng = np.random.default_rng(0)
    robot = SimulatedRobot(arena.scene, route.start, settings, rng)
    way = [(x, y) for x, y, *_ in route.line.coords]
    name = f"route {route.id}: the oracle"
    try:
        robot.follow(way)
        robot.stop()
    except EpisodeOver as over:
        spent = f"{name} to arrive within {PATIENCE:g} times {time:.1f} s"
        expect(over.stopped_by == "agent", spent, f"stopped by {over.stopped_by}")
    walk = robot.trajectory()
    values = score_walk(arena.grid, way, walk.points)
    expect(values.success == 1.0, f"{name} at the goal", f"{values.ne:.2f} m from it")
    expect(values.cls >= COVERAGE, f"{name} with a CLS >= {COVERAGE}", values.cls)
    expect(not robot.collisions, f"{name} without collisions", robot.collisions)
    share = route_turns_in_order(arena.site, route, walk)
    expect(share == 1.0, f"{name} to take all turns in their order", f"{share:.2f}")
