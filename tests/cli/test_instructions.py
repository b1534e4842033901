import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_statistics_of_ones_own_files_need_ones_own_sites(
    memorymaze: Memorymaze, tiny_files: list[str]
) -> None:
    _, file, *sites = tiny_files
    said = memorymaze("instructions", "stats", file, *sites)
    assert "12 texts written by people." in said.out
    assert "Loop R1" in said.out
    without = memorymaze("instructions", "stats", file)
    assert without.code == 1
    assert f"{file}:1: field 'site'" in without.err


def test_statistics_are_written_to_a_file(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    _, file, *sites = tiny_files
    out = tmp_path / "new" / "stats.csv"
    said = memorymaze(
        "instructions", "stats", file, *sites, "--format", "csv", "--out", out
    )
    assert (said.code, said.out) == (0, f"{out}\n")
    assert "12 texts written by people" in out.read_text(encoding="utf-8")


def test_a_page_needs_a_file_to_go_to(memorymaze: Memorymaze, tmp_path: Path) -> None:
    page = ("instructions", "stats", "--format", "html")
    said = memorymaze(*page)
    assert said.code == 2
    assert "expected --out FILE" in said.err
    said = memorymaze(*page, "--out", tmp_path)
    assert said.code == 2
    assert "expected a file, got a folder" in said.err


def test_a_good_file_is_called_good(
    memorymaze: Memorymaze, tiny_files: list[str]
) -> None:
    _, file, *sites = tiny_files
    said = memorymaze("instructions", "check", file, *sites)
    assert said.code == 0
    assert said.err == "12 good instructions, no problems, 5 notes\n"
    notes = said.out.splitlines()
    assert notes[0] == f"{file}:6: note: 'p1-2' has the same text as 'p1-1' ({file}:1)"
    assert len(notes) == 5


def test_every_problem_of_every_file_is_listed(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    _, file, *sites = tiny_files
    good = json.loads(Path(file).read_text(encoding="utf-8").splitlines()[0])
    bad = tmp_path / "bad.jsonl"
    lines = [good | {"id": "x", "study": "lab"}, good | {"id": "y", "site": "nowhere"}]
    lines += [good, good | {"id": "z", "text": "To the end.", "mood": "glad"}]
    bad.write_text("\n".join(json.dumps(line) for line in lines), encoding="utf-8")
    missing = tmp_path / "missing.jsonl"
    assert memorymaze("instructions", "check", missing, *sites).err == (
        "0 good instructions, 1 problem\n"
    )
    said = memorymaze("instructions", "check", file, bad, missing, *sites)
    assert said.code == 1
    errors = [line for line in said.out.splitlines() if " note: " not in line]
    places = [line.partition(" ")[0] for line in errors]
    assert places == [f"{bad}:1:", f"{missing}:", f"{bad}:3:", f"{bad}:2:"]
    assert "13 good instructions, 4 problems, " in said.err
    assert f"note: {bad}:4: field 'mood' is not part of the format" in said.err


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
