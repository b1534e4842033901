"""Models of one's own, from a GLB file to a thing."""

from pathlib import Path

import numpy as np
import pytest
from tests.world.looks.conftest import CORNERS, GlbFile

from memorymaze.basics.errors import SettingsError
from memorymaze.world.looks.assembly import ObjectModel
from memorymaze.world.looks.catalogue import check_looks, model_of

RED = {"pbrMetallicRoughness": {"baseColorFactor": [1.0, 0.0, 0.0, 1.0]}}
"""Pure red is the same in shares of light and on screens."""


def colour_of(model: ObjectModel) -> tuple[float, ...]:
    return tuple(round(each, 2) for each in model.parts[0].material.rgba)


def test_a_plain_model_is_scaled_to_the_box_of_its_thing(glb_file: GlbFile):
    looks = str(glb_file([{"name": "bench", "translation": [7, 3, 2]}], [RED]))
    model = model_of("bench", (1.6, 0.45, 0.4), colour_words="blue", looks=looks)
    assert np.allclose(model.bounds(), [(-0.225, -0.8, 0), (0.225, 0.8, 0.4)])
    assert model.triangle_count == 12
    assert colour_of(model) == (1, 0, 0, 1), "no name of its material asks for paint"


def test_things_without_a_model_in_the_file_look_as_our_own(glb_file: GlbFile):
    looks = str(glb_file([{"name": "bench"}]))
    ours = model_of("chair", (0.5, 0.5, 0.9))
    shown = model_of("chair", (0.5, 0.5, 0.9), looks=looks)
    assert shown.triangle_count == ours.triangle_count


@pytest.mark.parametrize("name", ["Couch.001", "sofa", "SOFA.2"])
def test_nodes_may_be_called_as_any_name_of_a_kind(glb_file: GlbFile, name: str):
    looks = str(glb_file([{"name": name}]))
    assert model_of("sofa", (1.9, 0.8, 0.8), looks=looks).triangle_count == 12


def test_the_front_of_a_file_is_the_front_of_the_thing(glb_file: GlbFile):
    slanted = CORNERS * np.where(CORNERS[:, 2:] > 0, (1, 0.5, 1), 1)
    looks = str(glb_file([{"name": "desk"}], corners=slanted))
    [part] = model_of("desk", (1.0, 1.0, 1.0), looks=looks).parts
    front = part.vertices[part.vertices[:, 0] > 0.49]
    assert front[:, 2].max() == pytest.approx(0.5)


def test_a_turned_node_stands_as_it_is_turned(glb_file: GlbFile):
    quarter = [0.0, 0.7071068, 0.0, 0.7071068]
    looks = str(glb_file([{"name": "desk", "rotation": quarter, "scale": [2, 2, 2]}]))
    other = str(glb_file([{"name": "desk"}]))
    for each in (looks, other):
        model = model_of("desk", (2.0, 1.0, 1.0), looks=each)
        low, high = model.bounds()
        assert np.allclose(high - low, (1.0, 2.0, 1.0))


def test_a_body_is_painted_as_the_plan_says(glb_file: GlbFile):
    body = {"name": "body.001", "extras": {"shade": 0.5}, **RED}
    looks = str(glb_file([{"name": "bench"}], [body]))
    size = (1.6, 0.45, 0.4)
    assert colour_of(model_of("bench", size, looks=looks)) == (1, 0, 0, 1)
    blue = model_of("bench", size, colour_words="blue", looks=looks)
    assert colour_of(blue)[2] == pytest.approx(0.75 / 2, abs=0.01)
    oak = model_of("bench", size, colour_words="oak", looks=looks)
    assert oak.parts[0].material.texture is not None


def test_words_of_the_plan_stand_on_surfaces_called_words(glb_file: GlbFile):
    board = {"mesh": 0, "name": "board"}
    nodes = [{"name": "kiosk", "children": [1], "mesh": 1}, board]
    path = glb_file(nodes, [{"name": "words"}, RED], scenes=[{"nodes": [0]}])
    size = (0.7, 0.5, 1.5)
    plain = model_of("kiosk", size, looks=str(path))
    worded = model_of("kiosk", size, text="Tickets", looks=str(path))
    assert [part.material.texture is None for part in plain.parts] == [True]
    assert sorted(part.material.texture is None for part in worded.parts) == [
        False,
        True,
    ]


def test_parts_of_a_thing_may_be_called_as_they_like(glb_file: GlbFile):
    nodes = [
        {"name": "Collection", "children": [1]},
        {"name": "table", "children": [2]},
        {"name": "table.001", "translation": [0, 1, 0]},
    ]
    looks = str(glb_file(nodes, scenes=[{"nodes": [0]}]))
    model = model_of("table", (1.2, 0.8, 0.7), looks=looks)
    assert model.triangle_count == 24


def test_targets_show_a_thing_one_metre_longer(glb_file: GlbFile):
    """Its left half goes to the left; the right half keeps its shape."""
    longer = np.zeros_like(CORNERS)
    longer[CORNERS[:, 0] > 0, 0] = 1.0
    post = np.concatenate([CORNERS[:7], [[1.0, 1.0, 0.0]]])
    looks = str(glb_file([{"name": "bench"}], targets={"length": longer}, corners=post))
    model = model_of("bench", (3.0, 1.0, 1.0), looks=looks)
    low, high = model.bounds()
    assert np.allclose(high - low, (1.0, 3.0, 1.0))


def test_modules_stand_there_as_often_as_the_thing_is_long(glb_file: GlbFile):
    door = {"name": "door", "extras": {"repeat": [2.0, 0, 0], "size": [2, 1, 1]}}
    nodes = [{"name": "lockers", "children": [1], "extras": {"size": [2, 1, 1]}}, door]
    looks = str(glb_file(nodes, scenes=[{"nodes": [0]}]))
    counts = {
        length: model_of("lockers", (length, 1.0, 1.0), looks=looks).triangle_count
        // 12
        for length in (2.0, 4.0, 8.2)
    }
    assert counts == {2.0: 2, 4.0: 3, 8.2: 5}, "the frame, and a door for each 2 m"


def test_of_several_models_the_nearest_in_size_is_taken(glb_file: GlbFile):
    nodes = [
        {"name": "bench.1"},
        {"name": "bench.2", "scale": [4.0, 1.0, 1.0], "mesh": 1},
    ]
    blue = {"pbrMetallicRoughness": {"baseColorFactor": [0.0, 0.0, 1.0, 1.0]}}
    looks = str(glb_file(nodes, [RED, blue]))
    assert colour_of(model_of("bench", (2.0, 1.0, 1.0), looks=looks)) == (1, 0, 0, 1)
    assert colour_of(model_of("bench", (7.0, 1.0, 1.0), looks=looks)) == (0, 0, 1, 1)


def test_looks_that_are_no_file_are_refused():
    with pytest.raises(
        SettingsError, match=r"expected own, mesh, or the path.*'models'"
    ):
        check_looks("models")
    assert check_looks("own") == "own"
    assert check_looks("mesh") == "mesh"


def test_a_file_of_another_format_is_refused(tmp_path: Path):
    path = tmp_path / "my_things.glb"
    path.write_text("solid bench", encoding="utf-8")
    with pytest.raises(SettingsError, match=r"my_things\.glb: expected a GLB file"):
        check_looks(str(path))


def test_a_file_without_kinds_says_which_nodes_it_has(glb_file: GlbFile):
    path = glb_file([{"name": "Cube"}, {"name": "Plane.001"}])
    with pytest.raises(
        SettingsError, match=r"got 'Cube', 'Plane\.001'; .*lists the kinds"
    ):
        check_looks(str(path))


def test_a_kind_without_triangles_is_refused(glb_file: GlbFile):
    path = glb_file([{"name": "bench", "children": []}])
    content = path.read_bytes().replace(b'"mesh": 0, ', b"           ")
    path.write_bytes(content)
    with pytest.raises(
        SettingsError, match="node 'bench': expected a mesh of triangles"
    ):
        check_looks(str(path))


def test_a_kind_without_size_is_refused(glb_file: GlbFile):
    path = glb_file(
        [{"name": "bench", "scale": [1.0, 1.0, 1e-12]}], corners=CORNERS * (1, 1, 0)
    )
    with pytest.raises(SettingsError, match=r"node 'bench': expected a length, depth"):
        check_looks(str(path))


def test_compressed_and_scattered_files_are_refused(glb_file: GlbFile):
    packed = "KHR_draco_mesh_compression"
    path = glb_file([{"name": "bench"}], extensionsRequired=[packed])
    with pytest.raises(SettingsError, match=f"got the extension {packed}; export"):
        check_looks(str(path))
    textured = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
    path = glb_file(
        [{"name": "bench"}],
        [textured],
        textures=[{"source": 0}],
        images=[{"uri": "wood.png"}],
    )
    with pytest.raises(
        SettingsError, match=r"pictures inside of the file, got wood\.png"
    ):
        check_looks(str(path))


def test_a_damaged_file_is_refused(glb_file: GlbFile):
    path = glb_file([{"name": "bench"}])
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(
        SettingsError, match=r"expected glTF 2\.0 in a GLB file, got a damaged"
    ):
        check_looks(str(path))
    path = glb_file([{"name": "bench", "mesh": 9}])
    with pytest.raises(SettingsError, match="got a damaged one"):
        check_looks(str(path))


def test_a_module_without_size_is_refused(glb_file: GlbFile):
    door = {"name": "door", "extras": {"repeat": [0.4, 0, 0]}}
    nodes = [{"name": "lockers", "children": [1]}, door]
    path = glb_file(nodes, scenes=[{"nodes": [0]}])
    with pytest.raises(
        SettingsError, match="node 'door': expected as custom properties"
    ):
        check_looks(str(path))
