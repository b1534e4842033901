from collections.abc import Callable
from pathlib import Path
from typing import Any

Memorymaze = Callable[..., Any]


def test_statistics_of_ones_own_files_need_ones_own_sites(
    memorymaze: Memorymaze, tiny_files: list[str]
) -> None:
    _, file, *sites = tiny_files
    said = memorymaze("instructions", "stats", file, *sites)
    assert "12 texts written by people." in said.out
    assert "Loop R1" in said.out
    without = memorymaze("instructions", "stats", file)
    assert without.code == 1
    assert f"{file}:1: field 'site'" in without.err


def test_statistics_are_written_to_a_file(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    _, file, *sites = tiny_files
    out = tmp_path / "new" / "stats.csv"
    said = memorymaze(
        "instructions", "stats", file, *sites, "--format", "csv", "--out", out
    )
    assert (said.code, said.out) == (0, f"{out}\n")
    assert "12 texts written by people" in out.read_text(encoding="utf-8")


def test_a_page_needs_a_file_to_go_to(memorymaze: Memorymaze, tmp_path: Path) -> None:
    page = ("instructions", "stats", "--format", "html")
    said = memorymaze(*page)
    assert said.code == 2
    assert "expected --out FILE" in said.err
    said = memorymaze(*page, "--out", tmp_path)
    assert said.code == 2
    assert "expected a file, got a folder" in said.err
