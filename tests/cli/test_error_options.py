"""Runs on made-up instructions."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_a_run_makes_its_texts_keeps_them_and_shows_what_errors_cost(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    sites = tmp_path / "sites"
    sites.mkdir()
    plan = (tiny_sites_folder / "crossing.geojson").read_bytes()
    (sites / "crossing.geojson").write_bytes(plan)
    run = tmp_path / "run"
    options = [
        *("evaluate", "--agent", "stop", "--sites", sites, "--errors", "failure=1"),
        *("--paired", "--per-cell", "1", "--workers", "1", "--out", run),
    ]
    said = memorymaze(*options)
    assert said.code == 0, said.err
    made = (run / "generated.jsonl").read_text(encoding="utf-8").splitlines()
    assert len(made) == 8
    stamps = json.loads((run / "run.json").read_text(encoding="utf-8"))["settings"]
    assert [each["name"] for each in stamps["instructions"]] == ["generated.jsonl"]
    table = memorymaze("table", run, "--table", "errors")
    assert table.code == 0
    assert "SR without it" in table.out
    assert memorymaze(*options, "--resume").code == 0
    again = memorymaze(*options, "--resume", "--seed", "5")
    assert again.code == 1
    assert "choose another folder" in again.err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--paired"], "--paired: says how"),
        (["--per-cell", "2"], "--per-cell: says how"),
        (["--errors", "failure=1", "--paired", "--limit", "3"], "--limit: would part"),
        (["--errors", "none", "--split", "dev"], "leave out --split"),
    ],
)
def test_options_that_contradict_each_other_are_refused(
    memorymaze: Memorymaze, tmp_path: Path, options: list[str], said: str
) -> None:
    told = memorymaze(
        "evaluate", "--agent", "stop", *options, "--out", tmp_path / "run"
    )
    assert told.code == 2
    assert said in told.err
    assert not (tmp_path / "run").exists()
