"""Files of programs are read, checked and run."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.errors import ProgramFileError, SettingsError
from memorymaze.evaluation.asking import AskingSettings
from memorymaze.evaluation.driver import run_plan
from memorymaze.evaluation.plan import RunPlan, plan_run
from memorymaze.evaluation.program_checking import check_programs
from memorymaze.evaluation.program_files import (
    ProgramRecord,
    ProgramReply,
    load_programs,
    program_lines,
    read_programs,
)
from memorymaze.evaluation.settings import AgentSettings, differences
from memorymaze.instructions import load_corpus
from memorymaze.instructions.files import load_instructions
from memorymaze.language.spending import TokenPrice

TINY_INSTRUCTIONS = Path(__file__).parents[1] / "tiny_instructions.jsonl"

SOUND = {"instruction_id": "a", "model": "m", "program": "stop()"}
FULL = ProgramRecord(
    instruction_id="b",
    model="m",
    program=None,
    error="no program in it",
    method="mine",
    parser=True,
    steps=("Go.", "Stop."),
    replies=(ProgramReply("parse", "…", 10, 5, 0.5, 1.5),),
)


@pytest.fixture
def file(tmp_path: Path) -> Callable[..., Path]:
    """Write records to a file."""

    def write(*records: Any) -> Path:
        path = tmp_path / "programs.jsonl"
        lines = [r if isinstance(r, str) else json.dumps(r) for r in records]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    return write


@pytest.fixture
def for_all(file: Callable[..., Path]) -> Callable[..., Path]:
    """Write the same program for each tiny instruction."""

    def write(**changes: Any) -> Path:
        ids = [each.id for each in load_instructions([TINY_INSTRUCTIONS])]
        return file(*({**SOUND, "instruction_id": each, **changes} for each in ids))

    return write


@pytest.fixture
def plan(tiny_sites_folder: Path) -> Callable[..., RunPlan]:
    """Plan a run of programs on the tiny instructions."""

    def make(programs: Path, **changes: Any) -> RunPlan:
        agent = AgentSettings("code_generation", programs=str(programs))
        return plan_run(
            replace(agent, **changes),
            load_corpus([TINY_INSTRUCTIONS], sites=tiny_sites_folder),
        )

    return make


def test_what_is_written_can_be_read(tmp_path: Path) -> None:
    path = tmp_path / "programs.jsonl"
    path.write_bytes(program_lines([FULL]))
    assert load_programs(path).records == {"b": FULL}


def test_three_fields_are_enough(file: Callable[..., Path]) -> None:
    record = load_programs(file(SOUND)).records["a"]
    assert record == ProgramRecord("a", "m", "stop()")
    assert record.agent == "programs[m]"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        pytest.param(["{"], "not JSON", id="no json"),
        pytest.param([{**SOUND, "model": ""}], "'model' is wrong", id="empty"),
        pytest.param(
            [{"model": "m", "program": ""}], "'instruction_id' is missing", id="id"
        ),
        pytest.param([{**SOUND, "error": "no"}], "got both", id="both"),
        pytest.param(
            [{"instruction_id": "a", "model": "m"}], "got neither", id="neither"
        ),
        pytest.param(
            [{**SOUND, "methode": "x"}], "did you mean 'method'", id="misspelt"
        ),
        pytest.param([{**SOUND, "program": 3}], "'program' is wrong", id="type"),
        pytest.param(
            [SOUND, SOUND], r":2: .*a second one for 'a', which .*:1", id="twice"
        ),
        pytest.param(
            [SOUND, {**SOUND, "instruction_id": "b", "model": "n"}],
            ":2: expected model 'm' as in the first record, got 'n'",
            id="two models",
        ),
        pytest.param(
            [{**SOUND, "replies": [{"stage": "parse", "text": "", "latency_s": -1}]}],
            r"'replies\.0\.latency_s' is wrong",
            id="inner",
        ),
    ],
)
def test_what_is_wrong_is_told_with_its_line(
    file: Callable[..., Path], lines: list[Any], said: str
) -> None:
    with pytest.raises(ProgramFileError, match=said):
        load_programs(file(*lines))


def test_what_is_sound_is_read_beside_what_is_not(file: Callable[..., Path]) -> None:
    found = read_programs(file("{", SOUND, SOUND))
    assert set(found.records) == {"a"}
    assert len(found.problems) == 2


def test_a_check_names_everything_and_runs_nothing(file: Callable[..., Path]) -> None:
    instructions = load_instructions([TINY_INSTRUCTIONS])
    first, second, third, fourth, *others = (each.id for each in instructions)
    path = file(
        {**SOUND, "instruction_id": first},
        {**SOUND, "instruction_id": second, "program": "\nwalk()"},
        {**SOUND, "instruction_id": third, "program": "import os\nimport numpy"},
        {"instruction_id": fourth, "model": "m", "error": "It refused."},
        {**SOUND, "instruction_id": "somebody", "colour": "red"},
        "[]",
    )
    checked = check_programs(path, instructions)
    said = [
        (remark.kind, remark.text.removeprefix(str(path))) for remark in checked.remarks
    ]
    assert not checked.usable
    assert checked.agent == "programs[m]"
    assert ("problem", ":6: expected one JSON record {…}, got '[]'") in said
    [_, missing] = [text for kind, text in said if kind == "problem"]
    assert missing == f": no program for 8 of 12 instructions: {', '.join(others)}"
    assert [text for kind, text in said if kind == "crash"] == [
        f":2: {second}: line 2: Name `walk` used when not defined [unresolved-reference]"
    ]
    [outside] = [text for kind, text in said if kind == "unsafe"]
    assert outside.startswith(f":3: {third}: line 2: Cannot resolve")
    assert ("model_error", f":4: {fourth}: no program: It refused.") in said
    assert ("note", ":5: 'somebody' is the id of no instruction; not used") in said
    assert ("note", ": fields that are not used: 'colour'") in said


def test_programs_are_run_by_the_id_of_their_instruction(
    for_all: Callable[..., Path], plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    path = for_all(program="move_forward(3)\nstop()", method="mine", parser=False)
    planned = plan(path)
    assert planned.settings.agent.parser is False
    assert planned.settings.programs is not None
    results = run_plan(planned, tmp_path / "run", workers=1)
    assert {(one.agent, one.stopped_by, one.model_calls) for one in results} == {
        ("mine", "agent", 0)
    }
    assert all(2 < one.path_length < 4 for one in results)


def test_replies_of_a_record_are_counted_at_the_prices_given(
    for_all: Callable[..., Path], plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    reply = {"stage": "program", "text": "…", "prompt_tokens": 100, "latency_s": 2.0}
    path = for_all(replies=[reply])
    asking = AskingSettings(price=TokenPrice(1.0, 2.0))
    [one, *_] = run_plan(plan(path, asking=asking), tmp_path / "run", workers=1)
    assert (one.model_calls, one.tokens, one.inference_s) == (1, 100, 2.0)
    assert one.cost_usd == pytest.approx(100 / 1e6)
    assert one.standing_s == pytest.approx(2.0, abs=0.1)


def test_an_episode_without_a_program_is_told_before_the_run(
    file: Callable[..., Path], plan: Callable[..., RunPlan]
) -> None:
    with pytest.raises(ProgramFileError, match=r"none for 12: p1-1, .* and 2 more"):
        plan(file(SOUND))


def test_changed_programs_are_another_run(
    for_all: Callable[..., Path], plan: Callable[..., RunPlan]
) -> None:
    before = plan(for_all()).settings
    after = plan(for_all(program="")).settings
    assert [line.split(":")[0] for line in differences(before, after)] == [
        "programs.sha256"
    ]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"model": "m"}, "--programs and --model"),
        ({"replay": "x"}, "--programs and --replay"),
        ({"options": (("stages", "single"),)}, "--programs and --set stages"),
        ({"parser": False}, "--programs and --no-parser"),
        ({"name": "rules"}, "'rules' runs no programs"),
    ],
)
def test_programs_beside_a_model_are_refused(
    for_all: Callable[..., Path],
    plan: Callable[..., RunPlan],
    changes: dict[str, Any],
    said: str,
) -> None:
    with pytest.raises(SettingsError, match=said):
        plan(for_all(), **changes)


TEXTS = st.text(
    st.characters(exclude_categories=["Cs"]), min_size=1, max_size=30
).filter(str.strip)


@given(st.lists(st.builds(ProgramRecord, TEXTS, st.just("m"), TEXTS), min_size=1))
def test_any_text_in_any_field_survives_a_file(records: list[ProgramRecord]) -> None:
    once = {record.instruction_id: record for record in records}
    with TemporaryDirectory() as folder:
        path = Path(folder) / "programs.jsonl"
        path.write_bytes(program_lines(list(once.values())))
        assert load_programs(path).records == once
