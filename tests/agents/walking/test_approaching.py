"""Coming close to what was seen, and into the place that it leads to."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from memorymaze.agents.walking.approaching import walk_up_to
from memorymaze.agents.walking.walker import Walker
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.world.sites import load_site


def test_a_sign_on_a_wall_leads_to_the_door_beside_it(
    changed: Callable[..., Path],
) -> None:
    sign = {
        "geometry.coordinates": [9.6, 1.35],
        "properties.category": "sign",
        "properties.text": "Library",
        "properties.heading_deg": 270,
        "properties.mount": "wall",
        "properties.size_m": [0.6, 0.1, 0.4],
    }
    plan = json.loads(changed("corridor", "bench", sign).read_text("utf-8"))
    [door] = [each for each in plan["features"] if each["id"] == "door_3"]
    door["properties"]["label"] = "Library"
    path = changed("corridor", "-", {"features": plan["features"]})
    robot = SimulatedRobot(
        build_scene(load_site(path)),
        Pose(6.5, 0.0, 0.0),
        SimulationSettings(),
        np.random.default_rng(0),
    )
    walker = Walker(robot)
    [seen] = walker.look(["sign that says Library"])
    walk_up_to(walker, seen)
    assert math.dist((robot.pose.x, robot.pose.y), (12.0, 1.5)) < 2.0
