import math
import shutil
from pathlib import Path

import numpy as np
import pytest
import trimesh

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.cameras import RenderedCamera, build_visual_scene
from memorymaze.world.exporting import export_site
from memorymaze.world.looks.mesh_looks import mesh_building
from memorymaze.world.sites import Site, load_site

POSE = Pose(2.0, 0.2, 0.3)


@pytest.fixture(scope="module")
def beside(
    tmp_path_factory: pytest.TempPathFactory, two_rooms: Site
) -> tuple[Site, Site]:
    """The same plan without and with its mesh beside it."""
    folder = tmp_path_factory.mktemp("mesh")
    plan = folder / "two_rooms.geojson"
    shutil.copy(two_rooms.source, plan)
    export_site(two_rooms, "gltf", plan.with_suffix(".glb"))
    return two_rooms, load_site(plan)


def test_a_mesh_of_ours_looks_as_we_do(beside: tuple[Site, Site]) -> None:
    frames = []
    for site, looks in zip(beside, ("own", "mesh"), strict=True):
        scene = build_visual_scene(site, looks=looks)
        with RenderedCamera(scene, 160, 120, math.radians(80)) as camera:
            frames.append(camera.frame(POSE))

    own, mesh = frames
    assert np.abs(own.rgb.astype(int) - mesh.rgb).mean() < 4
    solid = np.isfinite(own.depth) & np.isfinite(mesh.depth)
    assert solid.mean() > 0.99
    assert np.median(np.abs(own.depth - mesh.depth)[solid]) < 0.01
    assert _kinds(own) == _kinds(mesh)


def _kinds(frame) -> set[str]:
    return {frame.objects[number].kind for number in np.unique(frame.instances)}


def test_doors_and_things_of_the_plan_are_those_of_the_mesh(
    beside: tuple[Site, Site],
) -> None:
    site = beside[1]

    building = mesh_building(site)

    things = [mesh for mesh in building if mesh.thing is not None]
    ids = [each.owner for each in things]
    assert ids == [each.id for each in (*site.doors, *site.landmarks)]
    assert all(each.placed.parts for each in things)
    assert {mesh.kind for mesh in building} >= {"floor", "wall"}


def test_a_plain_mesh_has_the_colours_of_its_materials(
    tmp_path: Path, beside: tuple[Site, Site]
) -> None:
    plan = tmp_path / "plain.geojson"
    shutil.copy(beside[0].source, plan)
    room = trimesh.creation.box((30, 2.6, 30))
    room.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.PBRMaterial(baseColorFactor=[55, 0, 0, 255])
    )
    trimesh.Scene({"room": room}).export(plan.with_suffix(".glb"))

    (seen,) = [mesh for mesh in mesh_building(load_site(plan)) if mesh.thing is None]

    red, green, blue, alpha = seen.placed.parts[0].material.rgba
    assert (green, blue, alpha) == (0, 0, 1)
    assert red == pytest.approx(0.5, abs=0.02)  # 55/255 of the light


def test_a_missing_mesh_is_asked_for_by_name(two_rooms: Site) -> None:
    with pytest.raises(SettingsError, match=r"beside its plan, .*two_rooms\.glb"):
        build_visual_scene(two_rooms, looks="mesh")
