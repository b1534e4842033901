import json
from pathlib import Path

import pytest

from memorymaze.front.cli.main import run_command_line


def test_a_perfect_follower_finds_every_goal_and_people_stand_beside_it(
    small_folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = str(tmp_path / "run")
    arguments = ["evaluate", "--instructions", str(small_folder), "--workers", "1"]
    assert run_command_line([*arguments, "--agent", "oracle", "--out", run]) == 0
    capsys.readouterr()
    assert run_command_line(["table", run, "--format", "csv"]) == 0
    head, *rows = capsys.readouterr().out.splitlines()
    table = [dict(zip(head.split(","), row.split(","), strict=True)) for row in rows]
    by_kind = {row["paragraphs"]: row for row in table}
    assert by_kind["all"]["episodes"] == "8"
    assert by_kind["all"]["success"] == "1.0"
    assert by_kind["all"]["people"] == "0.5"
    assert by_kind["usable"]["texts"] == "1"
    assert by_kind["usable"]["people"] == "0.75"


def test_the_guide_finds_its_way_from_any_heading(
    small_folder: Path, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    arguments = ["evaluate", "--instructions", str(small_folder), "--workers", "1"]
    assert run_command_line([*arguments, "--agent", "guide", "--out", str(run)]) == 0
    lines = (run / "episodes.jsonl").read_text().splitlines()
    results = [json.loads(line) for line in lines]
    missed = [each["episode_id"] for each in results if not each["success"]]
    assert missed == []
    settings = json.loads((run / "run.json").read_text())["settings"]
    assert settings["agent"]["options"] == [["start_heading", "unknown"]]
    assert settings["success_distance"] == 2.0
    assert settings["simulation"]["detection_range"] == 40.0


def test_sail_brings_its_own_sites(
    small_folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["evaluate", "--agent", "stop", "--instructions", str(small_folder)]
    assert run_command_line([*arguments, "--sites", "elsewhere"]) == 2
    assert "leave out the sites" in capsys.readouterr().err
