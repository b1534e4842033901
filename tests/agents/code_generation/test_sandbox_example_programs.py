"""The control API is enough: for each route there is a program that walks it."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import EpisodeOver
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.world.sites import Site, load_sites

PROGRAMS = Path(__file__).parents[3] / "examples" / "programs"
SUCCESS_DISTANCE = 3.0


@cache
def sites() -> dict[str, Site]:
    return load_sites()


@cache
def scene(site: str) -> Scene:
    return build_scene(sites()[site])


@cache
def grid(site: str) -> FloorGrid:
    return FloorGrid.from_polygon(sites()[site].walkable_floor)


def test_there_is_a_program_for_every_route_and_no_other():
    routes = {
        f"{site.name}__{route.id}.py"
        for site in sites().values()
        for route in site.routes
    }

    assert {path.name for path in PROGRAMS.iterdir()} == routes
    assert len(routes) == 13


@pytest.mark.proof
@pytest.mark.parametrize("path", sorted(PROGRAMS.glob("*.py")), ids=lambda p: p.stem)
def test_a_program_reaches_its_goal_and_stops_there(path: Path):
    site, route_id = path.stem.split("__")
    route = sites()[site].find_route(route_id)
    robot = SimulatedRobot(scene(site), route.start, rng=np.random.default_rng(7))
    events: list[dict[str, object]] = []

    with pytest.raises(EpisodeOver) as over:
        run_program(path.read_text(encoding="utf-8"), robot, on_event=events.append)

    assert over.value.stopped_by == "agent"
    x, y, _ = robot.pose
    goal = route.line.coords[-1]
    assert grid(site).distance((x, y), goal) < SUCCESS_DISTANCE
    assert len(robot.collisions) == 0
    assert events == []
    assert robot.trajectory().length < 1.1 * route.length
