import math

import numpy as np
import pytest
from shapely import Polygon
from tests.robot.simulation.conftest import Plans, PutRobot

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.simulation.body import base_for
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.world.sites import Site

EXACT = SimulationSettings(motion="kinematic", wheel_noise=0.0)


def test_it_goes_along_the_arc_that_its_speeds_describe(scenes: dict[str, Scene]):
    base = base_for(scenes["corridor"], Pose(10, 0, 0), EXACT, np.random.default_rng(0))
    for _ in range(20):
        base.drive(0.5, 1.0, 5)
    assert base.time == pytest.approx(1.0)
    assert base.pose == pytest.approx((
        10 + 0.5 * math.sin(1.0),
        0.5 * (1 - math.cos(1.0)),
        1.0,
    ))
    assert base.speed == pytest.approx(0.5, rel=1e-3)
    assert not base.touched_geoms()


def test_its_wheels_err_as_those_of_the_physics(scenes: dict[str, Scene]):
    with_physics, without = (
        base_for(
            scenes["corridor"],
            Pose(3, 0, 0),
            SimulationSettings(motion=motion, wheel_noise=0.05),
            np.random.default_rng(1),
        )
        for motion in ("physics", "kinematic")
    )
    for base in (with_physics, without):
        for _ in range(100):
            base.drive(0.5, 0.0, 5)
    assert abs(without.pose.heading) > 0.02
    assert without.pose.heading == pytest.approx(with_physics.pose.heading, abs=0.015)


def test_it_stops_at_a_wall_which_is_a_collision(put_robot: PutRobot):
    robot = put_robot("corridor", 10, 0, 90, motion="kinematic")
    assert robot.step_forward(3.0) == pytest.approx(1.5 - ROBOT_RADIUS, abs=0.01)
    assert [each.kind for each in robot.collisions] == ["wall"]


def test_what_stands_in_the_way_is_touched_by_its_name(plans: Plans):
    site = plans.site(
        plans.corridor("hall", 0, -1.5, 10, 1.5), plans.thing("crate", 5, 0)
    )
    robot = SimulatedRobot(build_scene(site), Pose(2, 0, 0), EXACT)
    assert robot.step_forward(5.0) == pytest.approx(2.75 - ROBOT_RADIUS, abs=0.01)
    assert [each.object_id for each in robot.collisions] == ["crate"]


def test_it_slides_along_a_wall_and_stops_in_the_corner(scenes: dict[str, Scene]):
    base = base_for(
        scenes["corridor"],
        Pose(17, 0, math.radians(45)),
        EXACT,
        np.random.default_rng(0),
    )
    for _ in range(60):
        base.drive(1.0, 0.0, 5)
    assert base.pose.y == pytest.approx(1.5 - ROBOT_RADIUS, abs=1e-6)
    assert base.pose.x > 18.5
    for _ in range(60):
        base.drive(1.0, 0.0, 5)
    assert base.pose.x == pytest.approx(20 - ROBOT_RADIUS, abs=1e-6)
    assert base.speed == 0
    assert len(set(base.touched_geoms())) == 2


@pytest.mark.parametrize("period", [1, 5, 100])
def test_it_never_comes_nearer_than_its_radius(plans: Plans, period: int):
    slanted = Polygon([(0, 0), (6, 0), (7, 3), (3, 5), (1, 2.5)])
    thing = plans.thing("crate", 3.5, 1.8, degrees=30)
    scene = build_scene(plans.site(plans.area("yard", slanted), thing))
    base = base_for(scene, Pose(1.2, 0.8, 0.3), EXACT, np.random.default_rng(0))
    rng = np.random.default_rng(2)
    touched: set[int] = set()
    speed = turn_rate = 0.0
    for step in range(6000 // period):
        if step * period % 200 == 0:
            speed, turn_rate = rng.uniform(-0.3, 1.0), rng.uniform(-1.0, 1.0)
        base.drive(speed, turn_rate, period)
        touched.update(base.touched_geoms())
        [room] = scene.clearance.to_anything(np.array([base.pose[:2]]))
        assert room > ROBOT_RADIUS - 1e-4
    assert {scene.objects[geom].kind for geom in touched} <= {"wall", "landmark"}
    assert touched


def test_things_and_people_are_for_physics_alone(corridor_site: Site):
    scene = build_scene(corridor_site, ObstacleSettings())
    with pytest.raises(SettingsError, match="give motion=physics, or leave obstacles"):
        SimulatedRobot(scene, Pose(2, 0, 0), EXACT)
    for track in ({"obstacles": "light"}, {"ask": "2"}):
        with pytest.raises(SettingsError, match="kinematic expects a building as in"):
            with_choices(RunSettings(), {"motion": "kinematic", **track})
