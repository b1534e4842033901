import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Memorymaze = Callable[..., Any]


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
    other = tmp_path / "other.jsonl"
    other.write_text("", encoding="utf-8")
    assert memorymaze("instructions", "check", other, *sites).err == (
        "0 good instructions, 1 problem\n"
    )
    said = memorymaze("instructions", "check", file, bad, other, *sites)
    assert said.code == 1
    errors = [line for line in said.out.splitlines() if " note: " not in line]
    places = [line.partition(" ")[0] for line in errors]
    assert places == [f"{bad}:1:", f"{other}:", f"{bad}:3:", f"{bad}:2:"]
    assert "13 good instructions, 4 problems, " in said.err
    assert f"note: {bad}:4: field 'mood' is not part of the format" in said.err
