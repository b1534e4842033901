"""The recorded answers answer what they say, and give the table they are kept for."""

import csv
import io
import subprocess
import sys
from pathlib import Path

import pytest

from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.runs.tables import OVERVIEW, load_runs, paired_table
from memorymaze.texts.corpus import load_corpus

COMMAND = (sys.executable, "-m", "memorymaze")
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


@pytest.mark.proof
def test_table_two_is_made_again_without_a_key(tmp_path: Path) -> None:
    suite = PROJECT / "examples" / "suites" / "table_two.toml"
    made = subprocess.run(
        [*COMMAND, "evaluate", "--suite", suite, "--out", tmp_path],
        check=True,
        capture_output=True,
        text=True,
    )
    assert "navid (not recorded)" in made.stdout
    runs = tmp_path
    names = [
        "guide_plain",
        "code_generation",
        "code_generation_parser",
        "navgpt",
        "oracle",
    ]
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
