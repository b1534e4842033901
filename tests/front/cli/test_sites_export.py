from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_export_names_the_file_after_the_site_and_prints_it(
    memorymaze: Memorymaze,
    tiny_sites_folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
):
    monkeypatch.chdir(tmp_path)
    plan = tiny_sites_folder / "corridor.geojson"
    said = memorymaze("sites", "export", plan, "--to", "gltf")
    assert (said.code, said.out) == (0, "corridor.glb\n")
    assert (tmp_path / "corridor.glb").read_bytes()[:4] == b"glTF"


def test_export_refuses_what_is_there(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
):
    there = tmp_path / "mine.glb"
    there.write_text("mine", encoding="utf-8")
    plan = tiny_sites_folder / "corridor.geojson"
    said = memorymaze("sites", "export", plan, "--to", "gltf", "--out", there)
    assert said.code == 2
    assert "exists already; choose another name" in said.err
    assert there.read_text(encoding="utf-8") == "mine"


def test_a_folder_that_is_there_is_refused_before_anything_is_made(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "file").touch()
    plan = tiny_sites_folder / "corridor.geojson"
    said = memorymaze(
        "sites", "export", plan, "--to", "ros_map", "--out", tmp_path / "mine"
    )
    assert said.code == 2
    assert "exists already; choose another name" in said.err
    assert [each.name for each in tmp_path.iterdir()] == ["mine"]


def test_formats_that_nobody_knows_are_refused(
    memorymaze: Memorymaze, tiny_sites_folder: Path
):
    plan = tiny_sites_folder / "corridor.geojson"
    said = memorymaze("sites", "export", plan, "--to", "gltff")
    assert said.code == 2
    assert "'gltf', 'usd', 'mjcf', 'ros_map', 'habitat'" in said.err
