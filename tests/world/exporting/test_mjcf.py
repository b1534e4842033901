import json
import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.world.cameras import RenderedCamera, build_visual_scene
from memorymaze.world.cameras.open_gl import open_context
from memorymaze.world.exporting import export_site
from memorymaze.world.sites import Site
from memorymaze.world.sites.plan import site_plan

GROUP_OF_SOLIDS = 3


def exported(site: Site, out: Path) -> mujoco.MjModel:
    files = export_site(site, "mjcf", out)
    assert sorted(files) == sorted(each for each in out.rglob("*") if each.is_file())
    return mujoco.MjModel.from_xml_path(str(files[0]))


@pytest.fixture(scope="module")
def corridor_model(
    corridor_site: Site, tmp_path_factory: pytest.TempPathFactory
) -> mujoco.MjModel:
    return exported(corridor_site, tmp_path_factory.mktemp("mjcf") / "exported")


def text_of(model: mujoco.MjModel, name: str) -> str:
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, name)
    start, size = model.text_adr[number], model.text_size[number]
    return bytes(model.text_data[start : start + size - 1]).decode()


def distances(
    model: mujoco.MjModel, at: tuple[float, float], group: int
) -> list[float]:
    """How far one sees at 0.4 m over the floor, all round, of a geom group."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    groups = np.zeros(6, dtype=np.uint8)
    groups[group] = 1
    return [
        mujoco.mj_ray(
            model,
            data,
            np.array([*at, 0.4]),
            np.array([math.cos(angle), math.sin(angle), 0.0]),
            groups,
            1,
            -1,
            np.zeros(1, dtype=np.int32),
            None,
        )
        for angle in np.linspace(0, 2 * math.pi, 48, endpoint=False)
    ]


def test_every_feature_is_a_body_with_a_text_that_says_what_it_is(
    corridor_model: mujoco.MjModel, corridor_site: Site
):
    for feature in site_plan(corridor_site)["features"]:
        if feature["properties"]["kind"] == "route":
            continue
        assert corridor_model.body(feature["id"]).id > 0
        told = json.loads(text_of(corridor_model, feature["id"]))
        assert told["kind"] == feature["properties"]["kind"]
        assert told["geometry"] == feature["geometry"]


def test_what_one_drives_against_is_where_our_own_scene_has_it(
    two_rooms: Site, tmp_path: Path
):
    model = exported(two_rooms, tmp_path / "exported")
    ours = build_scene(two_rooms)
    start = two_rooms.routes[0].start
    walls = distances(ours.model, (start.x, start.y), 1)
    things = distances(ours.model, (start.x, start.y), 3)
    nearest = [
        min((each for each in pair if each >= 0), default=-1.0)
        for pair in zip(walls, things, strict=True)
    ]
    found = distances(model, (start.x, start.y), GROUP_OF_SOLIDS)
    assert found == pytest.approx(nearest, abs=1e-4)


def test_a_ball_comes_to_rest_on_the_floor(corridor_site: Site, tmp_path: Path):
    files = export_site(corridor_site, "mjcf", tmp_path / "exported")
    spec = mujoco.MjSpec.from_file(str(files[0]))
    ball = spec.worldbody.add_body(name="ball", pos=[5.0, 0.0, 0.5])
    ball.add_freejoint()
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0, 0])
    model = spec.compile()
    data = mujoco.MjData(model)
    while data.time < 2:
        mujoco.mj_step(model, data)
    assert data.body("ball").xpos == pytest.approx([5.0, 0.0, 0.1], abs=0.01)


@pytest.mark.proof
def test_mujoco_loads_large_buildings(builtin_sites: dict[str, Site], tmp_path: Path):
    for site in builtin_sites.values():
        model = exported(site, tmp_path / site.name)
        assert {each.id for each in site.landmarks} <= {
            model.body(number).name for number in range(model.nbody)
        }


def drawn(model: mujoco.MjModel, pose: Pose, fov: float) -> np.ndarray:
    """What MuJoCo shows of it from a pose, 160 by 120 pixels."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    model.vis.global_.offwidth, model.vis.global_.offheight = 160, 120
    context = open_context(160, 120)
    context.make_current()
    buffers = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
    mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, buffers)
    scene = mujoco.MjvScene(model, maxgeom=model.ngeom + 8)
    mujoco.mjv_updateScene(
        model,
        data,
        mujoco.MjvOption(),
        mujoco.MjvPerturb(),
        mujoco.MjvCamera(),
        mujoco.mjtCatBit.mjCAT_ALL.value,
        scene,
    )
    top = 0.05 * math.tan(fov / 2) * 120 / 160
    for eye in scene.camera:
        eye.pos = (pose.x, pose.y, 1.25)
        eye.forward = (math.cos(pose.heading), math.sin(pose.heading), 0.0)
        eye.up = (0.0, 0.0, 1.0)
        eye.frustum_center, eye.frustum_width = 0.0, 0.0
        eye.frustum_bottom, eye.frustum_top = -top, top
        eye.frustum_near, eye.frustum_far = 0.05, 100.0
    pixels = np.empty((120, 160, 3), dtype=np.uint8)
    rect = mujoco.MjrRect(0, 0, 160, 120)
    mujoco.mjr_render(rect, scene, buffers)
    mujoco.mjr_readPixels(pixels, None, rect, buffers)
    buffers.free()
    context.free()
    return pixels[::-1]


def test_it_looks_like_our_own_pictures(
    corridor_model: mujoco.MjModel, corridor_site: Site
):
    fov = math.radians(80)
    door = corridor_site.doors[1].line.centroid
    with RenderedCamera(
        build_visual_scene(corridor_site, looks="own"), 160, 120, fov
    ) as camera:
        for pose in (corridor_site.routes[0].start, Pose(door.x, 0.0, math.pi / 2)):
            ours = camera.picture(pose, 1.25).astype(float)
            theirs = drawn(corridor_model, pose, fov).astype(float)
            assert ours.std() > 20
            assert np.abs(ours - theirs).mean() < 2
