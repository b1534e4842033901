"""`runs check` and `runs leaderboard`, on a run of the tiny corpus."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


@pytest.fixture
def submitted(memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path) -> Path:
    """A folder with a run by committed code, and one by edited code."""
    folder = tmp_path / "submitted"
    for name, commit in (("stop", "0123456789"), ("edited", "0123456789+")):
        out = folder / name
        command = ["evaluate", "--agent", "stop", *tiny_files, "--workers", "1"]
        assert memorymaze(*command, "--out", out).code == 0
        record = json.loads((out / "run.json").read_text(encoding="utf-8"))
        record["code"]["commit"] = commit
        (out / "run.json").write_text(json.dumps(record), encoding="utf-8")
    return folder


def test_a_run_is_ready_or_its_problems_are_counted(
    memorymaze: Memorymaze, tiny_files: list[str], submitted: Path
) -> None:
    said = memorymaze("runs", "check", submitted / "stop", *tiny_files)
    assert (said.code, "ready, track default" in said.err) == (0, True)
    said = memorymaze("runs", "check", submitted / "edited", *tiny_files)
    assert said.code == 1
    assert "expected a run by committed code" in said.out
    assert "1 problem; it cannot stand on a leaderboard" in said.err


def test_a_leaderboard_names_what_it_refuses_and_ranks_the_rest(
    memorymaze: Memorymaze, tiny_files: list[str], submitted: Path, tmp_path: Path
) -> None:
    command = [
        "runs",
        "leaderboard",
        submitted,
        *tiny_files,
        "--out",
        tmp_path / "board",
    ]
    said = memorymaze(*command)
    assert (said.code, said.out) == (0, f"{tmp_path / 'board'}/index.html\n")
    assert "edited: refused: code: expected a run by committed code" in said.err
    assert (tmp_path / "board" / "runs" / "stop.html").exists()
    assert memorymaze(*command).code == 2
    (submitted / "stop").rename(submitted / "renamed")
    assert memorymaze(*command, "--overwrite").code == 0
    pages = [page.name for page in (tmp_path / "board" / "runs").iterdir()]
    assert pages == ["renamed.html"]
    rows = (tmp_path / "board" / "leaderboard.csv").read_text(encoding="utf-8")
    assert "default,online,1,stop,renamed," in rows


def test_what_is_no_leaderboard_is_not_overwritten(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    notes = tmp_path / "notes" / "index.html"
    notes.parent.mkdir()
    notes.write_text("mine", encoding="utf-8")
    said = memorymaze(
        "runs", "leaderboard", tmp_path, "--out", notes.parent, "--overwrite"
    )
    assert (said.code, notes.read_text(encoding="utf-8")) == (2, "mine")


def test_a_folder_that_is_taken_is_refused_before_the_traces_are_read(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    (tmp_path / "board").mkdir()
    (tmp_path / "board" / "notes").write_text("mine", encoding="utf-8")
    said = memorymaze(
        "runs", "leaderboard", tmp_path / "none", "--out", tmp_path / "board"
    )
    assert said.code == 2
    assert "exists already; choose another name" in said.err
