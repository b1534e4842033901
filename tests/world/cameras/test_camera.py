import math
import os
import subprocess
import sys
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest

from memorymaze.basics.errors import RenderingError, SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.robot_size import CAMERA_HEIGHT
from memorymaze.robot.simulation.motion.wheeled_base import ROBOT_GROUP
from memorymaze.robot.simulation.obstacles.movables import people
from memorymaze.robot.simulation.scene import Scene
from memorymaze.world.cameras import (
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.world.sites import Site

POSES = [
    pytest.param(Pose(2.0, 0.0, 0.0), id="along the corridor"),
    pytest.param(Pose(3.0, 0.0, math.pi / 2), id="before a door"),
    pytest.param(Pose(10.0, 0.8, -math.pi / 2), id="at the bench"),
    pytest.param(Pose(14.0, -0.5, 2.6), id="askew"),
]


def ray_hits(scene: Scene, pose: Pose, camera: RenderedCamera, *pixel: int) -> Any:
    """Cast the ray of a pixel in the physics: (depth along the axis, geom)."""
    row, column = pixel
    focal = camera.width / 2 / math.tan(camera.horizontal_fov / 2)
    right = (column + 0.5 - camera.width / 2) / focal
    up = (camera.height / 2 - row - 0.5) / focal
    ahead = np.array([math.cos(pose.heading), math.sin(pose.heading), 0.0])
    side = np.array([math.sin(pose.heading), -math.cos(pose.heading), 0.0])
    direction = ahead + right * side + up * np.array([0.0, 0.0, 1.0])
    length = float(np.linalg.norm(direction))
    data = mujoco.MjData(scene.model)
    mujoco.mj_forward(scene.model, data)
    groups = np.ones(6, dtype=np.uint8)
    groups[ROBOT_GROUP] = 0
    geom = np.zeros(1, dtype=np.int32)
    distance = mujoco.mj_ray(
        scene.model,
        data,
        np.array([pose.x, pose.y, CAMERA_HEIGHT]),
        direction / length,
        groups,
        True,
        -1,
        geom,
    )
    return distance / length, int(geom[0])


@pytest.mark.parametrize("pose", POSES)
def test_depth_agrees_with_rays_in_the_physics(
    pose: Pose, corridor_camera: RenderedCamera, scenes: dict[str, Scene]
) -> None:
    frame = corridor_camera.frame(pose)
    scene = scenes["corridor"]
    errors: list[float] = []
    for row in range(4, 120, 8):
        for column in range(4, 160, 8):
            depth, geom = ray_hits(scene, pose, corridor_camera, row, column)
            # The shapes of things differ from their boxes; the building must not.
            if scene.objects[geom].kind in {"wall", "floor", "ceiling"}:
                shown = frame.object_at(row, column)
                if shown is not None and shown.kind in {"wall", "floor"}:
                    errors.append(abs(float(frame.depth[row, column]) - depth))
    assert len(errors) > 100
    # Skirting stands out by 1 cm; a pixel on an edge may fall to either side.
    assert np.quantile(errors, 0.97) < 0.02


@pytest.mark.parametrize("pose", POSES)
def test_the_pixel_in_the_middle_shows_what_a_ray_hits(
    pose: Pose, corridor_camera: RenderedCamera, scenes: dict[str, Scene]
) -> None:
    frame = corridor_camera.frame(pose)
    scene = scenes["corridor"]
    depth, geom = ray_hits(scene, pose, corridor_camera, 60, 80)
    shown = frame.object_at(60, 80)
    assert shown is not None
    assert shown == scene.objects[geom]
    assert float(frame.depth[60, 80]) == pytest.approx(depth, abs=0.03)


def test_the_field_is_90_degrees_wide(
    corridor_camera: RenderedCamera, corridor_site: Site
) -> None:
    # A wall 1.5 m ahead fills 3 m of picture: 160 pixels, 80 / 1.5 of them a metre.
    frame = corridor_camera.frame(Pose(4.2, 0.0, math.pi / 2))
    door = corridor_site.doors[0]
    west, _, east, _ = door.line.bounds
    number = [each.record for each in frame.objects].index(door)
    columns = np.flatnonzero((frame.instances[70:100] == number).any(axis=0))
    expected = [80 + (x - 4.2) * 80 / 1.5 for x in (west - 0.07, east + 0.07)]
    assert columns.min() == pytest.approx(max(expected[0], 0), abs=2)
    assert columns.max() == pytest.approx(expected[1], abs=2)


def test_frames_are_deterministic(corridor_looks: VisualScene) -> None:
    pose = Pose(5.0, 0.3, 0.4)
    frames = []
    for _ in range(2):
        with RenderedCamera(corridor_looks, 96, 64) as camera:
            camera.frame(Pose(9.0, 0.0, 3.0))
            frames.append(camera.frame(pose))
    first, second = frames
    np.testing.assert_array_equal(first.rgb, second.rgb)
    np.testing.assert_array_equal(first.depth, second.depth)
    np.testing.assert_array_equal(first.instances, second.instances)


def test_the_picture_alone_is_the_frames_picture(
    corridor_camera: RenderedCamera,
) -> None:
    pose = Pose(5.0, 0.3, 0.4)
    frame = corridor_camera.frame(pose)
    np.testing.assert_array_equal(corridor_camera.picture(pose), frame.rgb)


def test_leaving_out_the_unseen_changes_nothing(
    l_looks: VisualScene, l_camera: RenderedCamera, monkeypatch: pytest.MonkeyPatch
) -> None:
    poses = [Pose(1.0, 0.2, 0.1), Pose(10.5, 0.0, 1.2), Pose(11.0, 5.0, -1.8)]
    culled = [l_camera.frame(pose) for pose in poses]
    everything = np.ones(len(l_looks.geom_objects), dtype=bool)
    monkeypatch.setattr(
        RenderedCamera, "_may_be_seen", lambda *_: everything, raising=True
    )
    for pose, frame in zip(poses, culled, strict=True):
        whole = l_camera.frame(pose)
        np.testing.assert_array_equal(frame.instances, whole.instances)
        np.testing.assert_array_equal(frame.depth, whole.depth)


def test_the_sky_of_a_far_sighted_camera_is_that_of_a_short_sighted_one(
    two_rooms: Site,
) -> None:
    """One is a dome, the other the engine's own: they must look alike everywhere."""
    areas = tuple(replace(area, open_air=True) for area in two_rooms.areas)
    scene = build_visual_scene(replace(two_rooms, areas=areas))
    with (
        RenderedCamera(scene, 120, 90, far=100.0) as dome,
        RenderedCamera(scene, 120, 90, far=90.0) as engine,
    ):
        for heading, pitch in ((0.0, 0.0), (2.1, 0.9), (4.0, 1.2), (5.5, 0.4)):
            views: list[np.ndarray] = []
            for camera in (dome, engine):
                frame = camera.frame(Pose(3.0, 3.0, heading), pitch=pitch)
                views.append(frame.rgb.astype(float))
                sky = frame.instances == -1
                assert np.isinf(frame.depth[sky]).all()
            assert sky.mean() > 0.1
            assert views[0][sky].mean() > 60
            assert np.abs(views[0] - views[1]).mean() < 2


def test_smooth_edges_leave_depth_and_ids_sharp(corridor_looks: VisualScene) -> None:
    pose = Pose(2.0, 0.3, 0.1)
    with RenderedCamera(corridor_looks, 96, 64, multisamples=4) as camera:
        smooth = camera.frame(pose)
    with RenderedCamera(corridor_looks, 96, 64) as camera:
        sharp = camera.frame(pose)
    assert (smooth.rgb != sharp.rgb).any()
    agreeing = smooth.instances == sharp.instances
    assert agreeing.mean() > 0.98
    assert set(np.unique(smooth.instances)) <= set(range(-1, len(sharp.objects)))


def test_people_are_drawn_where_they_are_put(corridor_site: Site) -> None:
    looks = build_visual_scene(corridor_site, people(2))
    number = len(looks.objects) - 2
    with RenderedCamera(looks, 96, 96) as camera:
        empty = camera.frame(Pose(2.0, 0.0, 0.0))
        looks.place({"person-0": Pose(6.0, 0.0, math.pi)})
        full = camera.frame(Pose(2.0, 0.0, 0.0))
    assert not (empty.instances >= number).any()
    shown = full.objects[number]
    assert shown.kind == "person"
    seen = full.instances == number
    assert seen.any()
    assert np.median(full.depth[seen]) == pytest.approx(4.0, abs=0.3)
    assert not (full.instances == number + 1).any()


@pytest.mark.parametrize(
    "settings",
    [
        pytest.param({"width": 0}, id="no width"),
        pytest.param({"width": 640.5}, id="half a pixel"),
        pytest.param({"height": 100_000}, id="too high"),
        pytest.param({"horizontal_fov": math.pi}, id="half a turn"),
        pytest.param({"near": 2.0, "far": 1.0}, id="near behind far"),
        pytest.param({"multisamples": -1}, id="negative samples"),
    ],
)
def test_settings_without_meaning_are_refused(
    settings: dict[str, Any], corridor_looks: VisualScene
) -> None:
    with pytest.raises(SettingsError, match=r"camera \w+: expected"):
        RenderedCamera(corridor_looks, **settings)


def test_a_closed_camera_says_so(corridor_looks: VisualScene) -> None:
    camera = RenderedCamera(corridor_looks, 32, 32)
    camera.close()
    with pytest.raises(RenderingError, match="closed"):
        camera.frame(Pose(2.0, 0.0, 0.0))


def test_the_default_benchmark_loads_neither_opengl_nor_looks() -> None:
    code = (
        "import sys, memorymaze.robot.simulation, memorymaze.runs.episodes\n"
        "loaded = [m for m in sys.modules if m.split('.')[0] in ('OpenGL', 'PIL')\n"
        "          or '.rendering' in m and m.startswith('memorymaze')\n"
        "          or '.looks' in m and m.startswith('memorymaze')]\n"
        "print(loaded)"
    )
    # MuJoCo itself loads OpenGL at import where this asks it to.
    environment = {
        key: value for key, value in os.environ.items() if key != "MUJOCO_GL"
    }
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env=environment,
    )
    assert done.stdout.strip() == "[]"
