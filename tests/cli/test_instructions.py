import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Memorymaze = Callable[..., Any]


def test_the_statistics_stand_beside_the_published_ones(memorymaze: Memorymaze) -> None:
    said = memorymaze("instructions", "stats")
    assert said.code == 0
    assert "564 written by a LANGUAGE MODEL, not by people." in said.out
    line = next(
        x for x in said.out.splitlines() if x.startswith("University R2      2")
    )
    assert "(98.3)" in line
    assert "3.0 % (3.0 %)" in line
    assert max(map(len, said.out.splitlines())) <= 110


def test_statistics_of_ones_own_files_need_ones_own_sites(
    memorymaze: Memorymaze, tiny_files: list[str]
) -> None:
    _, file, *sites = tiny_files
    said = memorymaze("instructions", "stats", file, *sites)
    assert "12 written by people." in said.out
    assert "Loop R1" in said.out
    without = memorymaze("instructions", "stats", file)
    assert without.code == 1
    assert f"{file}:1: field 'site'" in without.err


def test_a_good_file_is_called_good(
    memorymaze: Memorymaze, tiny_files: list[str]
) -> None:
    _, file, *sites = tiny_files
    said = memorymaze("instructions", "check", file, *sites)
    assert (said.code, said.out) == (0, "")
    assert said.err == "12 good instructions, no problems\n"


def test_every_problem_of_every_file_is_listed(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    _, file, *sites = tiny_files
    good = json.loads(Path(file).read_text(encoding="utf-8").splitlines()[0])
    bad = tmp_path / "bad.jsonl"
    lines = [good | {"id": "x", "study": "lab"}, good | {"id": "y", "site": "nowhere"}]
    lines += [good, good | {"id": "z", "mood": "glad"}]
    bad.write_text("\n".join(json.dumps(line) for line in lines), encoding="utf-8")
    missing = tmp_path / "missing.jsonl"
    assert memorymaze("instructions", "check", missing, *sites).err == (
        "0 good instructions, 1 problem\n"
    )
    said = memorymaze("instructions", "check", file, bad, missing, *sites)
    assert said.code == 1
    places = [line.partition(" ")[0] for line in said.out.splitlines()]
    assert places == [f"{bad}:1:", f"{missing}:", f"{bad}:3:", f"{bad}:2:"]
    assert "13 good instructions, 4 problems" in said.err
    assert f"note: {bad}:4: field 'mood' is not part of the format" in said.err
