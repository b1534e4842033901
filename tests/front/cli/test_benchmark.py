from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze import __version__
from memorymaze.runs.work.run_folder import read_run

Memorymaze = Callable[..., Any]


def test_the_benchmark_is_one_command_that_goes_on_when_called_again(
    memorymaze: Memorymaze, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    said = memorymaze("benchmark", "--limit", "1", "--workers", "1")
    assert said.code == 0
    assert "Table II: " in said.out
    run = Path(f"runs/guide-{__version__}-1")
    record, [result] = read_run(run)
    assert record.settings.agent.name == "guide"
    again = memorymaze("benchmark", "--limit", "1", "--workers", "1")
    assert again.out == said.out
    assert read_run(run)[1] == [result]


def test_a_wrong_option_of_the_benchmark_is_told_like_that_of_evaluate(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    said = memorymaze("benchmark", "--workers", "-1", "--out", tmp_path)
    assert said.code == 2
    assert "--workers: expected 0 (one per core) or more, got -1" in said.err
