"""The quality mode: what it says where it cannot draw, and pictures where it can."""

import ctypes
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from memorymaze.errors import RenderingError, SettingsError
from memorymaze.geometry.pose import Pose
from memorymaze.pictures import robot_cameras
from memorymaze.pictures.films import WalkthroughSettings
from memorymaze.pictures.rendering import RenderedCamera, VisualScene
from memorymaze.pictures.rendering.filament import FilamentCamera
from memorymaze.pictures.rendering.filament_engine import check_vulkan
from memorymaze.pictures.rendering.renderers import wanted_renderer
from memorymaze.simulation import Scene, SimulatedRobot


def nothing_loads(name: str) -> None:
    raise OSError(f"{name}: cannot open shared object file")


class VulkanWithoutDrivers:
    """A loader that finds nothing to load."""

    def __init__(self, name: str) -> None:
        assert "vulkan" in name

    def vkCreateInstance(self, *_: object) -> int:
        return -9  # VK_ERROR_INCOMPATIBLE_DRIVER


@pytest.mark.parametrize("loader", [nothing_loads, VulkanWithoutDrivers])
def test_without_vulkan_the_error_says_what_to_type(
    loader: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ctypes, "CDLL", loader)
    with pytest.raises(
        RenderingError, match="apt-get install mesa-vulkan-drivers libvulkan1"
    ):
        check_vulkan()


def test_the_robots_renderer_is_the_classic_one_unless_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv("MEMORYMAZE_RENDERER", raising=False)
    assert wanted_renderer() == "classic"
    monkeypatch.setenv("MEMORYMAZE_RENDERER", "Filament")
    assert wanted_renderer() == "filament"
    monkeypatch.setenv("MEMORYMAZE_RENDERER", "povray")
    with pytest.raises(SettingsError, match=r"classic, filament.*'povray'"):
        wanted_renderer()


def test_a_robot_asked_for_filament_says_so_where_there_is_none(
    scenes: dict[str, Scene], monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> None:
        raise RenderingError("no Vulkan here")

    engine = "memorymaze.pictures.rendering.filament_engine"
    monkeypatch.setattr(f"{engine}.check_vulkan", missing)
    monkeypatch.setattr(
        f"{engine}._started_engine", sys.modules[engine]._started_engine.__wrapped__
    )
    monkeypatch.setenv("MEMORYMAZE_RENDERER", "filament")
    robot = SimulatedRobot(
        scenes["corridor"], Pose(2.0, 0.0, 0.0), cameras=robot_cameras
    )
    with pytest.raises(RenderingError, match="no Vulkan here"):
        robot.camera_frame(40, 32)


def test_filament_makes_no_panoramas() -> None:
    with pytest.raises(SettingsError, match="classic renderer for a panorama"):
        WalkthroughSettings(panorama=True, renderer="filament")


@pytest.mark.filament
def test_filament_sees_what_the_classic_renderer_sees(
    corridor_looks: VisualScene,
) -> None:
    with (
        RenderedCamera(corridor_looks, 160, 120) as classic,
        FilamentCamera(corridor_looks, 160, 120) as camera,
    ):
        for pose in (Pose(2.0, 0.0, 0.0), Pose(8.0, 0.3, math.pi - 0.4)):
            expected, frame = classic.frame(pose), camera.frame(pose)
            likeness = np.corrcoef(frame.rgb.ravel(), expected.rgb.ravel())[0, 1]
            assert likeness > 0.9
            assert not np.array_equal(frame.rgb, expected.rgb)
            np.testing.assert_array_equal(frame.depth, expected.depth)
            np.testing.assert_array_equal(frame.instances, expected.instances)
    with pytest.raises(RenderingError, match="closed"):
        camera.picture(Pose(2.0, 0.0, 0.0))


@pytest.mark.filament
def test_a_film_by_filament_ends_well_and_prints_only_its_result(
    tiny_sites_folder: Path, tmp_path: Path
) -> None:
    plan = next(tiny_sites_folder.glob("corridor*"))
    command = [sys.executable, "-m", "memorymaze", "walkthrough", str(plan), "R1"]
    command += ["--renderer", "filament", "--size", "64x48", "--fps", "1"]
    done = subprocess.run(
        [*command, "--speed", "10", "--out", str(tmp_path / "film.mp4")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("\n") == 1
    assert "frames" in done.stdout
    assert "FEngine" not in done.stderr
    assert (tmp_path / "film.mp4").stat().st_size > 0


@pytest.mark.filament
def test_a_robot_that_drew_with_filament_leaves_the_process_in_peace(
    tiny_sites_folder: Path,
) -> None:
    program = f"""
from memorymaze.geometry.pose import Pose
from memorymaze.simulation import SimulatedRobot, build_scene
from memorymaze.sites import load_site

site = load_site({str(next(tiny_sites_folder.glob("corridor*")))!r})
robot = SimulatedRobot(build_scene(site), Pose(2.0, 0.0, 0.0))
print(robot.camera_frame(48, 32).rgb.shape)
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        env={**os.environ, "MEMORYMAZE_RENDERER": "filament"},
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "(32, 48, 3)\n"
