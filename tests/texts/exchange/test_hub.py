from pathlib import Path

import pandas
import pyarrow.parquet
import pytest
import yaml

from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.spreadsheets import read_spreadsheet
from memorymaze.texts.exchange import write_hub_folder
from memorymaze.world.sites import load_sites


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder for a hub."""
    folder = tmp_path_factory.mktemp("hub")
    written = write_hub_folder(folder)
    assert {*written} == {each for each in folder.rglob("*") if each.is_file()}
    return folder


def test_every_configuration_of_the_card_loads_and_all_texts_are_in_one(
    folder: Path,
) -> None:
    _, front, _ = (folder / "README.md").read_text(encoding="utf-8").split("---\n", 2)
    card = yaml.safe_load(front)
    paths = {
        (one["config_name"], each["split"]): folder / each["path"]
        for one in card["configs"]
        for each in one["data_files"]
    }
    assert {*paths.values()} == {*folder.rglob("*.parquet")}
    frames = {key: pandas.read_parquet(path) for key, path in paths.items()}
    for (study, split), frame in frames.items():
        assert {*frame["study"]} == {study}
        assert {*frame["split"]} == {split}
    assert sum(map(len, frames.values())) == 564
    assert sum(len(one) > 0 for each in frames.values() for one in each.failures) == 108
    schemas = [pyarrow.parquet.read_schema(path) for path in paths.values()]
    assert all(each == schemas[0] for each in schemas)


def test_texts_and_plans_of_a_hub_are_the_shipped_ones(folder: Path) -> None:
    read = [
        each
        for path in sorted(folder.rglob("*.parquet"))
        for each in read_spreadsheet(path, "parquet")
    ]
    assert {each.id: each for each in read} == {
        each.id: each for each in load_instructions()
    }
    assert load_sites(folder / "sites").keys() == load_sites().keys()


def test_the_card_says_first_who_wrote_the_texts_and_names_every_column(
    folder: Path,
) -> None:
    card = (folder / "README.md").read_text(encoding="utf-8")
    _, _, body = card.split("---\n", 2)
    title, first, *_ = [line for line in body.splitlines() if line]
    assert title.startswith("# ")
    assert first.startswith("> **Written by a language model.**")
    frame = pandas.read_parquet(folder / "onsite/test.parquet")
    assert [name for name in frame.columns if f"`{name}`" not in body] == []
    assert f"| `onsite` | `test` | {len(frame)} |" in body
