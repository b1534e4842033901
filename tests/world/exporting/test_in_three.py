"""The exported glTF, drawn by three.js in Chromium, against our own cameras."""

import json
import math
import struct
from collections.abc import Callable, Collection, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scripts.exported_in_three import FOV, ThreePicture, opened

from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.cameras import (
    CameraFrame,
    RenderedCamera,
    build_visual_scene,
)
from memorymaze.world.exporting import export_site
from memorymaze.world.looks.doors import is_seen_through
from memorymaze.world.looks.windows import is_window
from memorymaze.world.sites import Site

pytestmark = pytest.mark.proof

WIDTH, HEIGHT = 320, 240
LENS = 1.25
SKY, UNNAMED = "sky", ("floor", "ceiling", "wall")
# Of 255. What is dark and smooth, such as a screen, reflects more of three.js's lamps.
MOST_OFF = 24


def poses_of(site: Site) -> Iterator[Pose]:
    """Starts of routes, and four ways to look from the middle of the longest."""
    for route in site.routes:
        yield route.start
    line = max((route.line for route in site.routes), key=lambda line: line.length)
    middle = line.interpolate(0.5, normalized=True)
    for quarter in range(4):
        yield Pose(middle.x, middle.y, 0.3 + quarter * math.pi / 2)


def our_names(frame: CameraFrame) -> np.ndarray:
    names = [
        each.kind if each.record is None else each.record.id for each in frame.objects
    ]
    return np.array([*names, SKY])[frame.instances]


def their_names(picture: ThreePicture) -> np.ndarray:
    def name(identity: str, kind: str) -> str:
        if kind in ("corridor", "area", "turning_point"):
            return "floor"
        if kind in ("wall", "beyond"):
            return "wall"
        return kind if kind == "ceiling" else identity

    names = [name(identity, kind) for identity, kind in picture.names]
    return np.array([*names, SKY])[picture.meshes]


def shows_the_sky(site: Site) -> set[str]:
    """What one sees through: the sky beyond is no part of an export."""
    doors = {each.id for each in site.doors if is_seen_through(each)}
    return doors | {each.id for each in site.landmarks if is_window(each)}


def differences(
    frame: CameraFrame, picture: ThreePicture, clear: Collection[str]
) -> list[str]:
    """What tells two pictures apart: what is seen where, how far, and in what colours."""
    found: list[str] = []
    ours, theirs = our_names(frame), their_names(picture)
    same = ours == theirs
    if same.mean() < 0.99:
        found.append(f"the same is seen in {same.mean():.2f} of the picture")
    seen = same & np.isfinite(frame.depth) & np.isfinite(picture.depth)
    wrong = (np.abs(frame.depth - picture.depth) > 0.03) & seen
    if wrong.sum() > 0.02 * seen.sum():
        found.append(f"distances differ in {wrong.mean():.2f} of it")
    for name in np.unique(ours):
        part = seen & (ours == name)
        if part.sum() < 400 or name in clear:
            continue
        mean_ours = frame.rgb[part].mean(axis=0)
        mean_theirs = picture.rgb[part].mean(axis=0)
        if np.abs(mean_ours - mean_theirs).max() > MOST_OFF:
            found.append(f"colours of {name}: {mean_ours} and {mean_theirs}")
        grey_ours, grey_theirs = (
            each[part].mean(axis=1) for each in (frame.rgb, picture.rgb)
        )
        # What is written or painted on it has to lie in the same places.
        if name not in UNNAMED and grey_ours.std() > 25:
            alike = np.corrcoef(grey_ours, grey_theirs)[0, 1]
            if alike < 0.8:
                found.append(f"the picture on {name} is alike only to {alike:.2f}")
    return found


def changed(glb: Path, out: Path, change: Callable[[dict[str, Any]], None]) -> Path:
    """Write a GLB with another JSON part."""
    content = glb.read_bytes()
    (length,) = struct.unpack_from("<I", content, 12)
    document = json.loads(content[20 : 20 + length])
    change(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = content[20 + length :]
    total = 20 + len(text) + len(rest)
    head = content[:8] + struct.pack("<II", total, len(text)) + content[16:20]
    out.write_bytes(head + text + rest)
    return out


def all_differences(
    site: Site, glb: Path, node_modules: Path, frames: dict[Pose, CameraFrame]
) -> list[str]:
    clear = shows_the_sky(site)
    with opened(glb, node_modules, WIDTH, HEIGHT) as building:
        return [
            f"{site.name} {pose}: {each}"
            for pose, frame in frames.items()
            for each in differences(frame, building.picture(pose, LENS), clear)
        ]


def our_frames(site: Site) -> dict[Pose, CameraFrame]:
    scene = build_visual_scene(site, looks="own")
    with RenderedCamera(scene, WIDTH, HEIGHT, FOV) as camera:
        return {pose: camera.frame(pose, LENS) for pose in poses_of(site)}


@pytest.fixture(scope="module")
def hall_site(builtin_sites: dict[str, Site]) -> Site:
    """A floor with things of all kinds."""
    return builtin_sites["museum_5f"]


@pytest.fixture(scope="module")
def hall_frames(hall_site: Site) -> dict[Pose, CameraFrame]:
    return our_frames(hall_site)


@pytest.fixture(scope="module")
def hall_glb(hall_site: Site, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("three") / "exported.glb"
    return export_site(hall_site, "gltf", out)[0]


@pytest.mark.parametrize("name", ["university", "museum_5f", "museum_7f"])
def test_three_shows_what_our_cameras_show(
    builtin_sites: dict[str, Site], name: str, node_modules: Path, tmp_path: Path
):
    site = builtin_sites[name]
    (glb,) = export_site(site, "gltf", tmp_path / "exported.glb")
    assert all_differences(site, glb, node_modules, our_frames(site)) == []


def rotated(document: dict[str, Any]) -> None:
    document["nodes"][0]["rotation"] = [0, math.sin(0.02), 0, math.cos(0.02)]


def other_pictures(document: dict[str, Any]) -> None:
    textures = document["textures"]
    for number, texture in enumerate(textures):
        texture["source"] = len(textures) - 1 - number


def colours_not_linear(document: dict[str, Any]) -> None:
    for each in document["materials"]:
        surface = each["pbrMetallicRoughness"]
        surface["baseColorFactor"][:3] = [
            part ** (1 / 2.2) for part in surface["baseColorFactor"][:3]
        ]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        pytest.param(rotated, "distances differ|the same is seen", id="rotated 2 deg"),
        pytest.param(other_pictures, "colours of|the picture on", id="other pictures"),
        pytest.param(colours_not_linear, "colours of", id="colours not linear"),
    ],
)
def test_a_wrong_export_is_told_from_a_right_one(
    hall_site: Site,
    hall_frames: dict[Pose, CameraFrame],
    hall_glb: Path,
    node_modules: Path,
    tmp_path: Path,
    change: Callable[[dict[str, Any]], None],
    told: str,
):
    wrong = changed(hall_glb, tmp_path / "wrong.glb", change)
    found = "\n".join(all_differences(hall_site, wrong, node_modules, hall_frames))
    assert any(each in found for each in told.split("|")), found
