"""Made-up instructions from the command line, and runs on them."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]
SITES = Path(__file__).parents[1] / "tiny_sites"


def test_a_new_building_has_a_test_set_at_once(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    out = tmp_path / "made.jsonl"
    said = memorymaze(
        *("instructions", "generate", "--sites", SITES, "--site", "loop"),
        *("--per-cell", "3", "--errors", "failure=1", "--paired", "--out", out),
    )
    assert said.code == 0
    assert "24 instructions, 12 with errors" in said.out
    assert "not by people" in said.out
    checked = memorymaze("instructions", "check", out, "--sites", SITES)
    assert checked.code == 0, checked.out


def test_the_same_seed_makes_the_same_file(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    files = [tmp_path / name for name in ("one.jsonl", "two.jsonl", "other.jsonl")]
    for file, seed in zip(files, ("1", "1", "2"), strict=True):
        memorymaze(
            *("instructions", "generate", "--sites", SITES, "--site", "crossing"),
            *("--seed", seed, "--out", file),
        )
    one, two, other = (file.read_bytes() for file in files)
    assert one == two != other


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--errors", "sometimes"], "--errors: expected"),
        (["--site", "lop"], "--site: expected"),
        (["--per-cell", "0"], "--per-cell: expected"),
        (["--record", "x"], "--record: the grammar asks no model"),
        (["--engine", "gguf:/no/such.gguf"], "gguf"),
    ],
)
def test_wrong_usage_is_explained(
    memorymaze: Memorymaze, tmp_path: Path, options: list[str], said: str
) -> None:
    out = tmp_path / "made.jsonl"
    told = memorymaze(
        "instructions", "generate", "--sites", SITES, *options, "--out", out
    )
    assert told.code == 2
    assert said in told.err
    assert not out.exists()


def test_a_run_makes_its_texts_keeps_them_and_shows_what_errors_cost(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    sites = tmp_path / "sites"
    sites.mkdir()
    plan = (SITES / "crossing.geojson").read_bytes()
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
