from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture
def run(memorymaze: Callable[..., Any], tiny_files: list[str], tmp_path: Path) -> Path:
    """A run of an agent that stops at once."""
    out = tmp_path / "stop"
    memorymaze(
        "evaluate", "--agent", "stop", *tiny_files, "--workers", "1", "--out", out
    )
    return out


def test_report_names_the_page_to_open(
    memorymaze: Callable[..., Any], run: Path, tmp_path: Path
) -> None:
    said = memorymaze("report", run, "--out", tmp_path / "out")
    assert (said.code, said.out) == (0, f"{tmp_path / 'out'}/index.html\n")
    assert (tmp_path / "out" / "index.html").is_file()
    again = memorymaze("report", run, "--out", tmp_path / "out")
    assert again.code == 2
    assert "exists already" in again.err
    again = memorymaze("report", run, "--out", tmp_path / "out", "--overwrite")
    assert again.code == 0


def test_leaderboard_says_who_was_refused_and_why(
    memorymaze: Callable[..., Any], tiny_files: list[str], run: Path, tmp_path: Path
) -> None:
    (run.parent / "runs").mkdir()
    run.rename(run.parent / "runs" / "mine")
    (run.parent / "runs" / "other").mkdir()
    said = memorymaze(
        "runs",
        "leaderboard",
        run.parent / "runs",
        "--out",
        tmp_path / "out",
        *tiny_files,
    )
    assert said.code == 0
    assert "other: refused: " in said.err
    assert (tmp_path / "out" / "index.html").is_file()


@pytest.mark.parametrize(
    "arguments",
    [
        pytest.param(["report"], id="no run"),
        pytest.param(["report", "x"], id="nowhere to write"),
        pytest.param(
            ["runs", "leaderboard", "x"], id="nowhere to write the leaderboard"
        ),
        pytest.param(
            ["runs", "leaderboard", "/nowhere", "--out", "y"], id="no such folder"
        ),
    ],
)
def test_wrong_usage_is_told_without_a_traceback(
    memorymaze: Callable[..., Any], arguments: list[str]
) -> None:
    said = memorymaze(*arguments)
    assert said.code == 2
    assert "Traceback" not in said.err
