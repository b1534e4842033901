"""The recorded answers answer what they say, and give the table they are kept for."""

import csv
import io
import json
import subprocess
import sys
from pathlib import Path

import pytest

from memorymaze.instructions import load_corpus
from memorymaze.language.answer_files import AnswerFile
from memorymaze.results.tables import OVERVIEW, load_runs, paired_table

PROJECT = Path(__file__).parents[2]
RECORDED = PROJECT / "examples" / "recorded"


@pytest.mark.parametrize(
    ("name", "texts", "stages"),
    [
        ("programs_without_parser", 72, {"program"}),
        ("programs_with_parser", 72, {"parse", "program"}),
        ("navgpt", 12, {"step"}),
        ("plans", 564, {"plan"}),
    ],
)
def test_every_answer_is_to_a_shipped_text(
    name: str, texts: int, stages: set[str]
) -> None:
    file = AnswerFile(RECORDED / f"{name}.jsonl")
    shipped = {each.instruction.id for each in load_corpus().episodes}
    answered = {each.instruction_id for each in file.answers}
    assert not file.problems
    assert not file.unused
    assert file.models == ["recorded-llm"]
    assert answered <= shipped
    assert len(answered) == texts
    assert {each.stage for each in file.answers} == stages


def test_the_texts_of_the_table_are_those_that_are_answered(tmp_path: Path) -> None:
    out = tmp_path / "texts.jsonl"
    script = PROJECT / "scripts" / "texts_answered.py"
    file = RECORDED / "navgpt.jsonl"
    subprocess.run([sys.executable, script, file, out], check=True)
    written = [json.loads(line) for line in out.read_text("utf-8").splitlines()]
    asked = {each.instruction_id for each in AnswerFile(file).answers}
    assert {each["id"] for each in written} == asked
    assert len({(e["study"], e["site"], e["route"]) for e in written}) == 12


@pytest.mark.proof
def test_table_two_is_made_again_without_a_key(tmp_path: Path) -> None:
    command = ["bash", "scripts/table_two.sh", Path(sys.executable).parent, "", "12"]
    made = subprocess.run(
        [*command, tmp_path], cwd=PROJECT, check=True, capture_output=True, text=True
    )
    assert "navid (not recorded)" in made.stdout
    runs = tmp_path / "recorded"
    names = ["rules", "code_generation", "code_generation_parser", "navgpt", "oracle"]
    first, *others = load_runs([runs / name for name in names])
    rows = csv.DictReader(io.StringIO(paired_table([first, *others], OVERVIEW).csv()))
    found = {(row["study"], row["run"]): round(float(row["b"]), 2) for row in rows}
    # What the model's answers reached when they were given, in docs and README.
    assert found["online", "code_generation"] == 0.75
    assert found["onsite", "code_generation"] == 0.5
    assert found["online", "code_generation_parser"] == 0.58
    assert found["onsite", "code_generation_parser"] == 0.44
    assert (found["online", "navgpt"], found["onsite", "navgpt"]) == (1.0, 0.83)
    assert (found["online", "oracle"], found["onsite", "oracle"]) == (1.0, 1.0)
