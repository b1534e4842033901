"""Datasets from the command line."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


@pytest.mark.proof
def test_an_agent_runs_on_what_was_made_as_it_is(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    made = tmp_path / "made"
    said = memorymaze(
        *("dataset", "make", "--buildings", "3", "--per-route", "1"),
        *("--workers", "1", "--out", made),
    )
    assert said.code == 0, said.err
    assert "not by people" in said.out
    assert "val_unseen" in said.out
    run = memorymaze(
        *("evaluate", "--agent", "oracle", "--limit", "1", "--workers", "1"),
        *("--sites", made / "sites", "--instructions", made / "val_unseen.jsonl"),
        *("--out", tmp_path / "run"),
    )
    assert run.code == 0, run.err
    assert "success 1.000" in run.out


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--buildings", "2"], "--buildings"),
        (["--errors", "sometimes"], "--errors: expected"),
        (["--frame-size", "320x240"], "--frame-size: there are no frames"),
        (["--frames", "--frame-size", "big"], "expected WIDTHxHEIGHT"),
        (["--workers", "-1"], "--workers"),
    ],
)
def test_wrong_usage_is_explained(
    memorymaze: Memorymaze, tmp_path: Path, options: list[str], said: str
) -> None:
    out = tmp_path / "made"
    result = memorymaze("dataset", "make", *options, "--out", out)
    assert result.code == 2
    assert said in result.err
    assert not out.exists()
