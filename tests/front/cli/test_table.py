import csv
import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.runs.tables import TABLES

Memorymaze = Callable[..., Any]


@pytest.fixture
def run(memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path) -> Path:
    """A finished run of three episodes, one of them on a development text."""
    out = tmp_path / "stop"
    command = ["evaluate", "--agent", "stop", *tiny_files, "--limit", "3"]
    assert memorymaze(*command, "--workers", "1", "--out", out).code == 0
    return out


def test_every_format_is_written_to_stdout(memorymaze: Memorymaze, run: Path) -> None:
    assert memorymaze("table", run).out.startswith("Table II: ")
    assert memorymaze("table", run, "--format", "md").out.startswith("### Table II")
    text = memorymaze("table", run, "--format", "csv", "--table", "both").out
    assert {row["table"] for row in csv.DictReader(io.StringIO(text))} == {"II", "III"}


def test_a_table_is_not_written_over_the_results_it_is_made_of(
    memorymaze: Memorymaze, run: Path
) -> None:
    results = run / "episodes.jsonl"
    before = results.read_bytes()
    said = memorymaze("table", run, "--out", results)
    assert said.code == 2
    assert "is read here, and would be lost" in said.err
    assert results.read_bytes() == before


def test_development_texts_are_left_out_on_demand(
    memorymaze: Memorymaze, run: Path
) -> None:
    said = memorymaze("table", run).out
    assert "3 episodes" in said
    assert "with 1 episode on development texts (split dev)" in said
    said = memorymaze("table", run, "--exclude-dev").out
    assert "2 episodes" in said
    assert "without 1 episode on development texts" in said


def test_a_folder_that_is_no_run_gives_code_1(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    said = memorymaze("table", tmp_path)
    assert (said.code, said.out) == (1, "")
    assert "expected a run folder" in said.err


def test_parquet_goes_to_a_file(
    memorymaze: Memorymaze, run: Path, tmp_path: Path
) -> None:
    said = memorymaze("table", run, "--format", "parquet")
    assert said.code == 2
    assert "name the file to write with --out" in said.err
    out = tmp_path / "table.parquet"
    assert memorymaze("table", run, "--format", "parquet", "--out", out).code == 0
    assert out.read_bytes().startswith(b"PAR1")


def test_parquet_without_the_extra_for_tables_says_what_to_install(
    memorymaze: Memorymaze, run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    out = tmp_path / "table.parquet"
    said = memorymaze("table", run, "--format", "parquet", "--out", out)
    assert said.code == 2
    assert "Parquet: the package pyarrow is not installed; type: " in said.err
    assert "[tables], or take CSV" in said.err.replace("'", "")
    assert not out.exists()


def test_the_help_tells_every_table_that_can_be_chosen(memorymaze: Memorymaze) -> None:
    said = " ".join(memorymaze("table", "--help").out.split())
    for name, question in TABLES.items():
        assert f"{name}: {question.shows}" in said
