import math
import subprocess
import sys

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles.settings import ObstacleSettings
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.world.sites import Site


def test_the_robot_takes_pictures_from_where_it_is(scenes: dict[str, Scene]) -> None:
    robot = SimulatedRobot(scenes["corridor"], Pose(2.0, 0.0, 0.0))
    before = robot.camera_frame(96, 64)
    moved = robot.move_forward(3.0).distance
    after = robot.camera_frame(96, 64)
    # The end of the corridor has come nearer by what the robot moved.
    nearer = float(before.depth[32, 48] - after.depth[32, 48])
    assert nearer == pytest.approx(moved, abs=0.05)


def test_nothing_that_draws_is_loaded_before_a_robot_looks() -> None:
    program = """
import sys
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.world.sites import load_site

site = load_site("museum_5f")
robot = SimulatedRobot(build_scene(site), site.find_route("R1").start)
robot.move_forward(1)
drawing = "memorymaze.world.looks.", "memorymaze.world.cameras", "OpenGL"
names = "memorymaze.world.looks.kinds_of_looks"
print([each for each in sys.modules if each.startswith(drawing) and each != names])
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


def test_looking_is_no_call_of_the_control_api(scenes: dict[str, Scene]) -> None:
    robot = SimulatedRobot(scenes["corridor"], Pose(2.0, 0.0, 0.0))
    robot.camera_frame(32, 32)
    robot.camera_frame(48, 32, math.radians(60))
    assert robot.calls == 0
    assert robot.time == 0.0


def test_things_of_a_run_stand_where_the_physics_has_them(corridor_site: Site) -> None:
    scene = build_scene(
        corridor_site,
        ObstacleSettings(things_per_100m=20, people_per_100m2=0, people=0),
    )
    robot = SimulatedRobot(scene, Pose(1.0, 0.0, 0.0))
    frame = robot.camera_frame(320, 240)
    shown = {
        frame.objects[number].record.id
        for number in np.unique(frame.instances[frame.instances >= 0])
        if frame.objects[number].kind == "thing"
    }
    assert shown, "no thing is in the picture"
    surroundings = robot.surroundings
    assert surroundings is not None
    assert shown <= {each.record.id for each in surroundings.things}
