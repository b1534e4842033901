import math
import os
import subprocess
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from shapely import Polygon, box

from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.world.sites import Site


def test_every_door_and_landmark_is_one_geom_of_its_own(
    builtin_sites: dict[str, Site],
) -> None:
    for site in builtin_sites.values():
        scene = build_scene(site)
        records = [*site.doors, *site.landmarks]
        assert set(scene.geom_ids) == {record.id for record in records}
        for record in records:
            assert scene.objects[scene.geom_ids[record.id]].record is record


def test_the_scene_of_a_site_is_kept_and_that_of_a_changed_one_is_another(
    corridor_site: Site,
) -> None:
    scene = build_scene(corridor_site)
    assert build_scene(corridor_site) is scene
    assert build_scene(replace(corridor_site)).site is not scene.site
    assert build_scene(corridor_site, ObstacleSettings()).movables != scene.movables


def test_landmarks_have_their_true_size_place_and_heading(plans: Any) -> None:
    desk = plans.thing("desk", 4, 0.3, size=(1.2, 0.4, 0.8), degrees=30)
    scene = build_scene(plans.site(plans.corridor("way", 0, -2, 10, 2), desk))
    geom = scene.geom_ids["desk"]
    assert scene.model.geom_size[geom] == pytest.approx([0.2, 0.6, 0.4])
    assert scene.model.geom_pos[geom] == pytest.approx([4, 0.3, 0.4])
    half = math.radians(15)
    assert scene.model.geom_quat[geom] == pytest.approx([
        math.cos(half),
        0,
        0,
        math.sin(half),
    ])


def test_only_walls_and_obstacles_touch_the_robot(scenes: dict[str, Scene]) -> None:
    scene = scenes["t_junction"]
    solid = {
        each.kind if each.record is None else each.record.id
        for geom, each in enumerate(scene.objects)
        if scene.model.geom_contype[geom] == 2
    }
    assert solid == {"wall", "chair"}


def test_a_balustrade_stands_round_a_hole_with_something_above(plans: Any) -> None:
    floor = Polygon(
        box(0, 0, 12, 12).exterior.coords, [box(4, 4, 8, 8).exterior.coords]
    )
    globe = plans.thing("globe", 6, 6, mount="ceiling", obstacle=False)
    heights = []
    for things in ((), (globe,)):
        scene = build_scene(plans.site(plans.area("hall", floor), *things))
        walls = [i for i, each in enumerate(scene.objects) if each.kind == "wall"]
        sizes = 2 * scene.model.geom_size[walls][:, 2]
        heights.append(sorted(np.unique(sizes.round(3)).tolist()))
    assert heights == [[3.0], [1.1, 3.0]]


def test_scenes_need_no_opengl() -> None:
    program = (
        "import sys; from memorymaze.robot.simulation.robot import SimulatedRobot;"
        "from memorymaze.robot.simulation.scene import build_scene;"
        "from memorymaze.world.sites import load_site; site = load_site('museum_7f');"
        "robot = SimulatedRobot(build_scene(site), site.routes[0].start);"
        "robot.move_forward(1); robot.detect_from_RGB_image('door');"
        "assert not [m for m in sys.modules if m.startswith(('OpenGL', 'glfw'))]"
    )
    environment = {**os.environ, "MUJOCO_GL": "disable"}
    subprocess.run([sys.executable, "-c", program], check=True, env=environment)
