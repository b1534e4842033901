import csv
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from memorymaze.basics.errors import MemoryMazeError, SettingsError, SitePlanError
from memorymaze.texts.corpus import Instruction, load_instructions
from memorymaze.texts.datasets import DatasetRequest, buildings, make_dataset
from memorymaze.texts.datasets.splits import PlannedBuilding
from memorymaze.texts.exchange.vln_ce import read_vln_ce
from memorymaze.texts.writing import parse_rates
from memorymaze.world.sites import load_sites

SPLITS = ("train", "val_seen", "val_unseen", "test")


def texts_of(made: Path, split: str) -> list[Instruction]:
    return load_instructions([made / f"{split}.jsonl"])


def files_of(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_train_val_unseen_and_test_share_no_building(made: Path) -> None:
    buildings_of = [
        {each.site for each in texts_of(made, split)}
        for split in ("train", "val_unseen", "test")
    ]
    assert all(buildings_of)
    assert sum(map(len, buildings_of)) == len(set.union(*buildings_of))


def test_val_seen_has_other_routes_of_buildings_in_train(made: Path) -> None:
    train, seen = (
        {(each.site, each.route) for each in texts_of(made, split)}
        for split in ("train", "val_seen")
    )
    assert {site for site, _ in seen} <= {site for site, _ in train}
    assert not seen & train


def test_every_route_has_as_many_texts_as_asked_for(made: Path) -> None:
    texts = [each for split in SPLITS for each in texts_of(made, split)]
    assert len({each.id for each in texts}) == len(texts)
    for route in {(each.site, each.route) for each in texts}:
        members = [each for each in texts if (each.site, each.route) == route]
        assert len(members) == 4
        assert {each.study for each in members} == {"online", "onsite"}


def test_texts_say_that_a_program_wrote_them_and_what_is_wrong_in_them(
    made: Path,
) -> None:
    texts = [each for split in SPLITS for each in texts_of(made, split)]
    assert {each.source for each in texts} == {"synthetic"}
    wrong = [each for each in texts if each.failures]
    assert 0 < len(wrong) < len(texts)
    for each in wrong:
        kinds = {failure.kind for failure in each.failures}
        assert kinds <= {span.kind for span in each.spans}


def test_each_text_is_of_the_split_of_its_file(made: Path) -> None:
    for split in SPLITS:
        assert {each.split for each in texts_of(made, split)} == {split}


def test_vln_ce_files_have_the_same_texts_along_the_same_routes(made: Path) -> None:
    sites = load_sites(made / "sites")
    for split in SPLITS:
        read = read_vln_ce([made / f"vln_ce/{split}/{split}.json.gz"], sites)
        assert read == texts_of(made, split)
        assert (made / f"vln_ce/{split}/{split}_gt.json.gz").is_file()


def test_the_statistics_count_what_is_in_the_files(made: Path) -> None:
    with (made / "statistics.csv").open(encoding="utf-8") as file:
        rows = {row["split"]: row for row in csv.DictReader(file)}
    for split in SPLITS:
        texts = texts_of(made, split)
        assert int(rows[split]["texts"]) == len(texts)
        assert int(rows[split]["buildings"]) == len({each.site for each in texts})
        wrong = sum(bool(each.failures) for each in texts) / len(texts)
        assert float(rows[split]["wrong"]) == pytest.approx(wrong)
    assert int(rows["all"]["buildings"]) == 3


@pytest.mark.proof
def test_the_page_says_who_made_it_and_with_which_command(made: Path) -> None:
    page = (made / "README.md").read_text(encoding="utf-8")
    assert "not by people" in page
    assert "--buildings 3 --per-route 4 --errors failure=0.5 --seed 0" in page


def test_the_same_seed_makes_the_same_files_in_any_process(
    made: Path, tmp_path: Path
) -> None:
    program = (
        "import sys\n"
        "from memorymaze.texts.datasets import DatasetRequest, make_dataset\n"
        "request = DatasetRequest(3, 4, errors='failure=0.5')\n"
        "make_dataset(request, sys.argv[1], workers=2)\n"
    )
    other_hashes = {**os.environ, "PYTHONHASHSEED": str(hash("x") % 1000)}
    out = tmp_path / "made"
    subprocess.run(
        [sys.executable, "-c", program, str(out)], env=other_hashes, check=True
    )
    assert files_of(out) == files_of(made)


def test_a_building_with_a_route_that_cannot_be_told_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    known = buildings.cells_of
    refused: list[str] = []

    def cells_of(site):
        if not refused:
            refused.append(site.name)
            raise SitePlanError("no cue leads to a turn")
        return known(site)

    monkeypatch.setattr(buildings, "cells_of", cells_of)
    planned = PlannedBuilding("office", 3, "train", None)
    task = buildings.BuildingTask(
        planned, tmp_path, 1, parse_rates("none"), 0, walked=False
    )
    made = buildings.finish_building(task)
    assert made.instructions
    assert [path.stem for path in tmp_path.iterdir()] == [made.site.name]
    assert made.site.name not in refused
    assert made.planned.seed != planned.seed


def test_a_folder_with_something_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(SettingsError, match="exists already"):
        make_dataset(DatasetRequest(3, 1), tmp_path, overwrite=True, workers=1)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


@pytest.mark.proof
def test_a_dataset_is_replaced_only_when_asked_for_and_another_seed_makes_others(
    made: Path, tmp_path: Path
) -> None:
    out = tmp_path / "made"
    shutil.copytree(made, out)
    with pytest.raises(SettingsError, match="exists already"):
        make_dataset(DatasetRequest(3, 1, seed=1), out, workers=1)
    make_dataset(DatasetRequest(3, 1, seed=1), out, overwrite=True, workers=1)
    assert json.loads((out / "dataset.json").read_bytes())["seed"] == 1
    names = {path.name for path in (made / "sites").iterdir()}
    assert not names & {path.name for path in (out / "sites").iterdir()}


def test_a_dataset_that_cannot_be_finished_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_texts(*_: object) -> None:
        raise MemoryMazeError("no words")

    monkeypatch.setattr(buildings, "cells_of", no_texts)
    with pytest.raises(MemoryMazeError, match="no words"):
        make_dataset(DatasetRequest(3, 1), tmp_path / "made", workers=1)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"buildings": 2}, "--buildings"),
        ({"buildings": 10_001}, "--buildings: expected at most 10000"),
        ({"per_route": 0}, "--per-route"),
        ({"errors": "sometimes"}, "--errors"),
        ({"seed": -1}, "--seed"),
        ({"frame_size": (641, 480)}, "--frame-size"),
        ({"frame_size": (32, 32)}, "--frame-size"),
    ],
)
def test_requests_without_meaning_are_refused(wrong: dict[str, int], said: str) -> None:
    with pytest.raises(SettingsError, match=said):
        DatasetRequest(**wrong)  # pyright: ignore[reportArgumentType]
