"""Made-up instructions from the command line."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_a_new_building_has_a_test_set_at_once(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    out = tmp_path / "made.jsonl"
    said = memorymaze(
        *("instructions", "generate", "--sites", tiny_sites_folder, "--site", "loop"),
        *("--per-cell", "3", "--errors", "failure=1", "--paired", "--out", out),
    )
    assert said.code == 0
    assert "24 instructions, 12 with errors" in said.out
    assert "not by people" in said.out
    checked = memorymaze("instructions", "check", out, "--sites", tiny_sites_folder)
    assert checked.code == 0, checked.out


def test_a_run_on_made_pairs_shows_what_errors_cost(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    out, run = tmp_path / "pairs.jsonl", tmp_path / "run"
    made = memorymaze(
        *("instructions", "generate", "--sites", tiny_sites_folder, "--site"),
        *("crossing", "--per-cell", "1", "--errors", "failure=1", "--paired"),
        *("--out", out),
    )
    assert "8 instructions, 4 with errors" in made.out
    said = memorymaze(
        *("evaluate", "--agent", "stop", "--sites", tiny_sites_folder),
        *("--instructions", out, "--workers", "1", "--out", run),
    )
    assert said.code == 0, said.err
    table = memorymaze("table", run, "--table", "errors")
    assert table.code == 0
    assert "SR without it" in table.out


def test_the_same_seed_makes_the_same_file(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    files = [tmp_path / name for name in ("one.jsonl", "two.jsonl", "other.jsonl")]
    for file, seed in zip(files, ("1", "1", "2"), strict=True):
        memorymaze(
            *(
                "instructions",
                "generate",
                "--sites",
                tiny_sites_folder,
                "--site",
                "crossing",
            ),
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
    memorymaze: Memorymaze,
    tiny_sites_folder: Path,
    tmp_path: Path,
    options: list[str],
    said: str,
) -> None:
    out = tmp_path / "made.jsonl"
    told = memorymaze(
        "instructions", "generate", "--sites", tiny_sites_folder, *options, "--out", out
    )
    assert told.code == 2
    assert said in told.err
    assert not out.exists()


def test_texts_are_not_written_over_those_they_are_made_of(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    texts = tmp_path / "mine.jsonl"
    texts.write_bytes(Path(tiny_files[1]).read_bytes())
    before = texts.read_bytes()
    told = memorymaze("instructions", "generate", "--from", texts, "--out", texts)
    assert told.code == 2
    assert "is read here, and would be lost" in told.err
    assert texts.read_bytes() == before


def test_of_each_text_of_a_file_one_is_made(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    out = tmp_path / "made.jsonl"
    told = memorymaze(
        *("instructions", "generate", "--from", tiny_files[1], "--per-cell", "3"),
        *("--out", out),
    )
    assert told.code == 2
    assert "--per-cell: with --from one text is made of each" in told.err
    assert not out.exists()
