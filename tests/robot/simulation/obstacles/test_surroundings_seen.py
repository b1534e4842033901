"""Things and people are seen where they are, and hide what is behind them."""

import math

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.obstacles.movables import left_standing
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene


def test_a_person_is_seen_where_they_are(wide, crowded, person_of):
    robot = crowded(wide)
    person_of(robot, 5, 0.5, stands_until=math.inf)
    robot.move_forward(0.1)

    [found] = robot.detect_from_RGB_image("person")

    assert found.label == "person"
    assert found.distance == pytest.approx(2.6, abs=0.15)
    assert 5 < found.bearing_deg < 16


def test_a_person_behind_the_robot_is_not_seen(wide, crowded, person_of):
    robot = crowded(wide)
    person_of(robot, 0.7, 1.5, stands_until=math.inf)
    robot.move_forward(0.1)

    assert robot.detect_from_RGB_image("person") == []


def test_people_hide_what_is_behind_them(plans, crowded, person_of):
    vase = plans.thing("vase", 5.5, 0, size=(0.3, 0.3, 1.2))
    site = plans.site(plans.corridor("c", 0, -2, 24, 2), vase)
    robot = crowded(site)
    person = person_of(robot, 2, 1.7, stands_until=math.inf)
    robot.move_forward(0.1)
    before = robot.detect_from_RGB_image("box")
    person.x, person.y = 4.0, 0.0
    robot.move_forward(0.1)

    assert len(before) == 1
    assert robot.detect_from_RGB_image("box") == []


@pytest.mark.parametrize("kind", left_standing())
def test_things_are_called_what_they_are(wide, kind: str):
    obstacles = ObstacleSettings(things_per_100m=12, people=0, kinds=(kind,))
    scene = build_scene(wide, obstacles)
    robot = SimulatedRobot(scene, Pose(2, 0, 0), obstacles_rng=np.random.default_rng(1))
    thing = robot.surroundings.things[0].pose
    back = -1.0 if thing.x > 12 else 1.0
    robot = SimulatedRobot(
        scene,
        Pose(thing.x + 3 * back, 0, 0.0 if back < 0 else math.pi),
        obstacles_rng=np.random.default_rng(1),
    )

    seen = robot.detect_from_RGB_image(kind.replace("_", " "))

    assert len(robot.surroundings.things) > 0
    assert all(each.label == kind.replace("_", " ") for each in seen)
