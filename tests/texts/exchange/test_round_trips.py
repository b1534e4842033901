import gzip
import json
from collections.abc import Callable, Mapping
from operator import attrgetter
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.exchange import (
    Unlabelled,
    read_r2r,
    read_vln_ce,
    write_r2r,
    write_vln_ce,
)
from memorymaze.texts.exchange.foreign_files import OWN_FIELD
from memorymaze.world.sites import Site

Sites = Mapping[str, Site]


FORMATS = {"r2r": (write_r2r, read_r2r), "vln_ce": (write_vln_ce, read_vln_ce)}


def assert_come_back(
    name: str, texts: list[Instruction], sites: Sites, folder: Path
) -> None:
    write, read = FORMATS[name]
    files = [
        each
        for each in write(folder, texts, sites)
        if each.parent.name != "connectivity" and not each.stem.endswith("_gt.json")
    ]
    by_id = attrgetter("id")
    assert sorted(read(files, sites), key=by_id) == sorted(texts, key=by_id)


@pytest.mark.parametrize("name", FORMATS)
def test_texts_come_back_as_they_went(
    name: str, tmp_path: Path, tiny_sites: Sites, told: list[Instruction]
) -> None:
    assert_come_back(name, told, tiny_sites, tmp_path)


@pytest.mark.proof
@pytest.mark.parametrize("name", FORMATS)
def test_the_shipped_corpus_comes_back_as_it_went(
    name: str, tmp_path: Path, builtin_sites: Sites
) -> None:
    assert_come_back(name, load_instructions(), builtin_sites, tmp_path)


def test_r2r_paths_run_along_the_routes_on_the_graph(
    tmp_path: Path, tiny_sites: Sites, told: list[Instruction]
) -> None:
    write_r2r(tmp_path, told, tiny_sites)
    graph = json.loads((tmp_path / "connectivity/loop_connectivity.json").read_text())
    place = {node["image_id"]: node["pose"][3:8:4] for node in graph}
    order = [node["image_id"] for node in graph]
    [item] = [
        each
        for each in json.loads((tmp_path / "R2R_test.json").read_text())
        if each["scan"] == "loop"
    ]
    route = tiny_sites["loop"].find_route("route_r1_reference")
    assert item["instructions"] == [told[0].text, told[1].text]
    assert item["distance"] == pytest.approx(route.length, rel=0.15)
    for here, there in zip(item["path"], item["path"][1:], strict=False):
        assert graph[order.index(here)]["unobstructed"][order.index(there)]
    for end, mark in ((route.line.coords[0], 0), (route.line.coords[-1], -1)):
        assert place[item["path"][mark]] == pytest.approx(end[:2], abs=1.6)


def test_the_ground_truth_walks_the_route(tmp_path: Path, builtin_sites: Sites) -> None:
    corpus = [each for each in load_instructions() if each.split == "dev"]
    write_vln_ce(tmp_path, corpus, builtin_sites)
    with gzip.open(tmp_path / "dev/dev.json.gz") as file:
        episodes = json.load(file)["episodes"]
    with gzip.open(tmp_path / "dev/dev_gt.json.gz") as file:
        truth = json.load(file)
    for episode in episodes:
        walk = truth[str(episode["episode_id"])]
        goal, last = episode["goals"][0]["position"], walk["locations"][-1]
        assert abs(goal[0] - last[0]) + abs(goal[2] - last[2]) < 0.5
        assert walk["actions"][-1] == 0
        assert walk["actions"].count(1) == walk["forward_steps"]
        assert 0.25 * walk["forward_steps"] == pytest.approx(
            episode["info"]["geodesic_distance"], rel=0.06
        )
        assert len(walk["locations"]) == len(walk["actions"])


def test_files_of_others_are_read_when_it_is_said_how_they_came_to_be(
    tmp_path: Path, tiny_sites: Sites, told: list[Instruction]
) -> None:
    write_r2r(tmp_path, told, tiny_sites)
    path = tmp_path / "R2R_test.json"
    items = json.loads(path.read_text())
    for item in items:
        del item[OWN_FIELD]
    path.write_text(json.dumps(items))
    with pytest.raises(InstructionFileError, match=r"path_id 1, .*give --study"):
        read_r2r([path], tiny_sites)
    read = read_r2r([path], tiny_sites, Unlabelled("online", "human"))
    assert [each.id for each in read] == ["1_0", "1_1", "2_0"]
    assert [each.text for each in read] == [told[0].text, told[1].text, told[3].text]
    assert read[0].reference_route == "route_r1_reference"


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda item: item["path"].pop(), "expected the path of a route of loop"),
        (lambda item: item.update(scan="mars"), "got 'mars'"),
        (lambda item: item["instructions"].pop(), "expected 1 records"),
        (lambda item: item["instructions"].__setitem__(0, "Go!"), "was edited"),
        (
            lambda item: item.pop("path"),
            r"R2R items: \[0\]\.path: expected this member",
        ),
    ],
)
def test_what_is_wrong_in_an_r2r_file_is_named(
    tmp_path: Path,
    tiny_sites: Sites,
    told: list[Instruction],
    spoil: Callable[[dict[str, Any]], object],
    message: str,
) -> None:
    write_r2r(tmp_path, told, tiny_sites)
    path = tmp_path / "R2R_test.json"
    items = json.loads(path.read_text())
    spoil(items[0])
    path.write_text(json.dumps(items))
    with pytest.raises(InstructionFileError, match=message):
        read_r2r([path], tiny_sites)


def test_an_episode_off_its_route_is_refused(
    tmp_path: Path, tiny_sites: Sites, told: list[Instruction]
) -> None:
    path, _ = write_vln_ce(tmp_path, told[:1], tiny_sites)
    with gzip.open(path) as file:
        content = json.load(file)
    content["episodes"][0]["reference_path"][0][0] += 1.0
    path.write_bytes(gzip.compress(json.dumps(content).encode()))
    with pytest.raises(InstructionFileError, match="episode_id 1: expected start and"):
        read_vln_ce([path], tiny_sites)
    path.write_bytes(gzip.compress(b"[]"))
    message = r"expected VLN-CE episodes: the whole: expected a record {…}, got \[\]"
    with pytest.raises(InstructionFileError, match=message):
        read_vln_ce([path], tiny_sites)
    path.write_bytes(b"not packed")
    with pytest.raises(InstructionFileError, match="cannot be read"):
        read_vln_ce([path], tiny_sites)
