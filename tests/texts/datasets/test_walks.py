import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from shapely import LineString

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.texts.datasets.walks import walk_by_steps
from memorymaze.texts.exchange.vln_ce import FORWARD, LEFT, RIGHT, STEP, STOP, TURN
from memorymaze.world.sites import load_site


@pytest.mark.parametrize("name", ["corridor", "l_shape", "slanted_crossing"])
def test_a_walk_by_steps_ends_at_the_goal(name: str, tiny_sites_folder: Path) -> None:
    site = load_site(tiny_sites_folder / f"{name}.geojson")
    route = site.find_route("R1")
    walk = walk_by_steps(build_scene(site), route)
    assert math.dist(walk.poses[-1, :2], route.line.coords[-1][:2]) < 0.2
    assert walk.actions.tolist().index(STOP) == len(walk) - 1


def test_each_action_leads_to_the_next_pose(tiny_sites_folder: Path) -> None:
    site = load_site(tiny_sites_folder / "l_shape.geojson")
    walk = walk_by_steps(build_scene(site), site.find_route("R1"))
    moved = np.diff(walk.poses, axis=0)
    metres = np.hypot(moved[:, 0], moved[:, 1])
    turned = np.remainder(moved[:, 2] + math.pi, math.tau) - math.pi
    expected = {FORWARD: (STEP, 0.0), LEFT: (0.0, TURN), RIGHT: (0.0, -TURN)}
    assert set(walk.actions[:-1].tolist()) >= {FORWARD}
    assert set(walk.actions[:-1].tolist()) & {LEFT, RIGHT}
    for action, (ahead, angle) in expected.items():
        chosen = walk.actions[:-1] == action
        assert np.allclose(metres[chosen], ahead, atol=0.005)
        assert np.allclose(turned[chosen], angle, atol=0.005)


def test_a_way_through_a_wall_is_no_walk(tiny_sites_folder: Path) -> None:
    site = load_site(tiny_sites_folder / "corridor.geojson")
    route = site.find_route("R1")
    x, y = route.line.coords[0][:2]
    aside = route.start_heading + math.pi / 2
    end = (x + 9 * math.cos(aside), y + 9 * math.sin(aside))
    wrong = replace(route, line=LineString([(x, y), end]))
    with pytest.raises(MemoryMazeError, match=r"corridor: route_r1.*stopped at \("):
        walk_by_steps(build_scene(site), wrong)
