from collections.abc import Callable
from pathlib import Path
from typing import Any

Memorymaze = Callable[..., Any]


def test_two_agents_are_compared_on_what_both_did(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    for agent in ("stop", "oracle"):
        command = ["evaluate", "--agent", agent, *tiny_files, "--limit", "4"]
        out = tmp_path / agent
        assert memorymaze(*command, "--workers", "1", "--out", out).code == 0
    said = memorymaze("compare", tmp_path / "stop", tmp_path / "oracle")
    assert said.code == 0
    assert "arrived: 0 / 0 / 1 / 0" in said.out
    assert "NOT ONLY THE AGENT DIFFERS" not in said.out


def test_runs_are_compared_at_equal_metres_on_texts_with_errors(
    memorymaze: Memorymaze, write: Callable[..., Path], result: Callable[..., Any]
) -> None:
    wrong = {"error_kinds": ("missing_turn",), "way_m": 40.0}
    folders = [
        write(name, [result(f"{one}-1", path_length=metres, **wrong) for one in "ab"])
        for name, metres in {"explorer": 100.0, "guide": 45.0, "mine": 70.0}.items()
    ]
    said = memorymaze("compare", *folders, "--equal-metres", "--format", "csv")
    assert said.code == 0
    rows = [line.split(",") for line in said.out.splitlines()]
    assert [row[0] for row in rows] == ["run", *["guide"] * 4, *["mine"] * 4]


def test_a_folder_that_is_no_run_gives_code_1(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    said = memorymaze("compare", tmp_path, tmp_path)
    assert said.code == 1
    assert "expected a run folder" in said.err
