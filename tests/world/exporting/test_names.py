"""Names that no format likes are kept in every one."""

import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import pytest
from pxr import Usd

from memorymaze.world.exporting import FORMATS, export_site
from memorymaze.world.sites import Site, load_site

Plan = dict[str, Any]
ODD = '7/lm "größe" & <b>\'s, zwei'
TEXT = 'Größe "1", <b> &\nzwei'


@pytest.fixture
def odd_site(
    plan: Callable[[str], Plan], write_plan: Callable[..., Path], tmp_path: Path
) -> Site:
    content = plan("corridor")
    content["name"] = "../Gebäude 1/ä"
    content["features"] = [
        each for each in content["features"] if each["properties"]["kind"] != "route"
    ]
    for each in content["features"]:
        if each["id"] == "bench":
            each["id"] = ODD
            each["properties"] |= {"text": TEXT, "category": 'quux, "zorp"'}
    return load_site(write_plan(content, "odd"))


def gltf_told(folder: Path) -> Plan:
    content = folder.read_bytes()
    (length,) = struct.unpack_from("<I", content, 12)
    nodes = json.loads(content[20 : 20 + length])["nodes"]
    return next(node["extras"] for node in nodes if node["name"] == ODD)


def usd_told(folder: Path) -> Plan:
    stage = Usd.Stage.Open(str(folder / "_Gebäude_1_ä.usdc"))
    prims = {each.GetDisplayName(): each for each in stage.Traverse()}
    return {
        each.GetBaseName(): each.Get()
        for each in prims[ODD].GetAttributes()
        if each.GetNamespace() == "userProperties"
    }


def mjcf_told(folder: Path) -> Plan:
    model = mujoco.MjModel.from_xml_path(str(folder / "_Gebäude_1_ä.xml"))
    assert model.body(ODD).id > 0
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, ODD)
    start, size = model.text_adr[number], model.text_size[number]
    return json.loads(bytes(model.text_data[start : start + size - 1]).decode())


def ros_map_told(folder: Path) -> Plan:
    content = json.loads((folder / "semantics.geojson").read_text(encoding="utf-8"))
    return next(
        each["properties"]
        for each in content["features"]
        if each["properties"]["id"] == ODD
    )


def habitat_told(folder: Path) -> Plan:
    stages = folder / "stages"
    instances = (stages / "_Gebäude_1_ä.instances.json").read_text(encoding="utf-8")
    told = next(each for each in json.loads(instances) if each["id"] == ODD)
    lines = (stages / "_Gebäude_1_ä.semantic.txt").read_text(encoding="utf-8")
    colours = {line.split(",")[1]: line.split(",") for line in lines.splitlines()[1:]}
    # Commas part the members of a line.
    assert colours[told["colour"]][2:] == ['"quux  zorp"', "0"]
    return told


def carla_told(folder: Path) -> Plan:
    stem = folder / "_Gebäude_1_ä"
    props = Path(f"{stem}.props.json").read_text(encoding="utf-8")
    (told,) = (each for each in json.loads(props)["things"] if each["id"] == ODD)
    assert told["category"] == 'quux, "zorp"'
    assert told["blueprint"] is None
    return gltf_told(Path(f"{stem}.glb"))


@pytest.mark.parametrize(
    ("to", "told"),
    [
        ("gltf", gltf_told),
        ("usd", usd_told),
        ("mjcf", mjcf_told),
        ("ros_map", ros_map_told),
        ("habitat", habitat_told),
        ("carla", carla_told),
    ],
)
def test_odd_names_and_texts_are_kept(
    odd_site: Site, tmp_path: Path, to: str, told: Callable[[Path], Plan]
):
    assert to in FORMATS
    files = export_site(odd_site, to, tmp_path / "a" / "exported")
    assert all(each.is_relative_to(tmp_path / "a" / "exported") for each in files)
    found = told(tmp_path / "a" / "exported")
    assert (found["id"], found["text"], found["kind"]) == (ODD, TEXT, "landmark")
    assert found["category"] == 'quux, "zorp"'
