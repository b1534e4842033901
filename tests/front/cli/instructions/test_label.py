import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def fill(sheet: Path, *answers: dict[str, str]) -> None:
    """Fill in the first rows of a sheet."""
    with sheet.open(encoding="utf-8-sig", newline="") as opened:
        rows = list(csv.DictReader(opened))
    for row, answer in zip(rows, answers, strict=False):
        row |= answer
    with sheet.open("w", encoding="utf-8", newline="") as opened:
        writer = csv.DictWriter(opened, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def test_two_annotators_label_and_agree(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    _, file, *sites = tiny_files
    right = {"way": "1", "arrives": "yes"}
    wrong = {"way": "1", "arrives": "no", "kind_1": "0", "where_1": "at the start"}
    for name, last in (("ada", wrong), ("bob", right)):
        sheet = tmp_path / f"{name}.csv"
        label = ("instructions", "label", file, *sites, "--annotator", name)
        label = (*label, "--csv", sheet, "--out", tmp_path / f"{name}.jsonl")
        assert "12 rows to fill in" in memorymaze(*label).err
        fill(sheet, *[right] * 11, last)
        assert "12 labels added, 0 texts to go" in memorymaze(*label).err
    out = tmp_path / "agreed.jsonl"
    said = memorymaze(
        "instructions",
        "agreement",
        tmp_path / "ada.jsonl",
        tmp_path / "bob.jsonl",
        *("--instructions", file, *sites, "--out", out),
    )
    assert said.code == 0
    [row] = [line for line in said.out.splitlines() if line.startswith("has a failure")]
    assert "91.7 %" in row
    assert "p6-2: no consensus on has a failure: yes (1), no (1)" in said.out
    assert f"{out}: consensus on 11 of 12 texts" in said.err
    assert memorymaze("instructions", "check", out, *sites).code == 0


def test_a_sheet_is_written_first_and_read_back_then(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    _, file, *sites = tiny_files
    sheet = tmp_path / "sheet.csv"
    label = ("instructions", "label", file, *sites, "--annotator", "ada")
    label = (*label, "--out", tmp_path / "ada.jsonl", "--csv", sheet)
    assert "12 rows to fill in" in memorymaze(*label).err
    fill(sheet, {"way": "1", "arrives": "yes"})
    assert "1 label added, 11 texts to go" in memorymaze(*label).err
    assert "0 labels added, 11 texts to go" in memorymaze(*label).err


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        pytest.param(
            ["label", "--annotator", " ", "--csv", "s"], 2, "expected a name", id="name"
        ),
        pytest.param(["label", "--annotator", "a"], 2, "--csv", id="no sheet"),
        pytest.param(["agreement"], 2, "none.jsonl: cannot be read", id="no labels"),
    ],
)
def test_wrong_usage_of_labelling_is_told(
    memorymaze: Memorymaze,
    tiny_files: list[str],
    tmp_path: Path,
    arguments: list[str],
    code: int,
    said: str,
) -> None:
    _, file, *sites = tiny_files
    verb, *rest = arguments
    labels = tmp_path / "none.jsonl"
    files = (
        [file, "--out", labels] if verb == "label" else [labels, "--instructions", file]
    )
    answer = memorymaze("instructions", verb, *files, *rest, *sites)
    assert answer.code == code
    assert said in answer.err
