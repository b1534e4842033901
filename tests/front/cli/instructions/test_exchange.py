from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_a_folder_for_hubs_is_of_the_shipped_texts_alone(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    command = ("instructions", "export", "--format", "hub", "--out", tmp_path / "hub")
    said = memorymaze(*command)
    assert said.code == 0
    assert f"{tmp_path / 'hub' / 'README.md'}\n" in said.out
    said = memorymaze(*command, tmp_path / "mine.jsonl")
    assert said.code == 2
    assert "write yours with --format parquet" in said.err


@pytest.mark.parametrize("action", ["import", "export"])
def test_a_file_is_not_written_over_by_what_it_becomes(
    memorymaze: Memorymaze, tmp_path: Path, action: str
) -> None:
    mine = tmp_path / "mine.csv"
    mine.write_text("kept", encoding="utf-8")
    command = "instructions", action, mine, "--format", "csv", "--out", mine
    said = memorymaze(*command)
    assert said.code == 2
    assert f"--out {mine}: is read here" in said.err
    assert mine.read_text(encoding="utf-8") == "kept"


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_how_rows_of_a_table_came_to_be_is_said_by_their_columns(
    memorymaze: Memorymaze, tmp_path: Path, kind: str
) -> None:
    mine = tmp_path / "mine"
    mine.write_text("site,route,text\nmuseum_5f,R1,Go left.\n", encoding="utf-8")
    command = ("instructions", "import", mine, "--format", kind)
    labels = ("--study", "onsite", "--source", "llm", "--out", tmp_path / "out.jsonl")
    said = memorymaze(*command, *labels)
    assert said.code == 2
    assert "--study and --source: expected with --format r2r or vln_ce" in said.err
    assert f"got --format {kind}, whose columns" in said.err
    assert not (tmp_path / "out.jsonl").exists()
