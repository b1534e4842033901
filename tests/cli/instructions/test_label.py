import csv
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_two_annotators_label_and_agree(
    memorymaze: Memorymaze,
    tiny_files: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    _, file, *sites = tiny_files
    label = ("instructions", "label", file, *sites, "--annotator")
    for name, stops_after in (("ada", 11), ("bob", 12)):
        typed = "1\nyes\n" * stops_after + "q\n"
        monkeypatch.setattr("sys.stdin", io.StringIO(typed))
        said = memorymaze(*label, name, "--out", tmp_path / f"{name}.jsonl")
        assert (said.code, f"{name}: 0 texts labelled, 12 to go" in said.err) == (
            0,
            True,
        )
    monkeypatch.setattr("sys.stdin", io.StringIO("1\nno\n0\nat the start\n\n\n"))
    said = memorymaze(*label, "ada", "--out", tmp_path / "ada.jsonl")
    assert "ada: 11 texts labelled, 1 to go" in said.err
    assert "p6-2" in said.out
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
    with sheet.open(encoding="utf-8-sig", newline="") as opened:
        rows = list(csv.DictReader(opened))
    rows[0] |= {"way": "1", "arrives": "yes"}
    with sheet.open("w", encoding="utf-8", newline="") as opened:
        writer = csv.DictWriter(opened, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    assert "1 label added, 11 texts to go" in memorymaze(*label).err
    assert "0 labels added, 11 texts to go" in memorymaze(*label).err


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        pytest.param(["label", "--annotator", " "], 2, "expected a name", id="name"),
        pytest.param(
            ["label", "--annotator", "a", "--csv", "s", "--pictures", "p"],
            2,
            "without --csv",
            id="pictures in a sheet",
        ),
        pytest.param(["agreement"], 1, "none.jsonl: cannot be read", id="no labels"),
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
