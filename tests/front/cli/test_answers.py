"""The way without a network: requests, replies, store, run, table."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.code_generation import (
    CodeGenerationOptions,
    CodeGenerationRequests,
)
from memorymaze.agents.code_generation.replies import read_steps
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.answers import RecordingModel
from memorymaze.language.models.model import CompletionRequest, Message
from memorymaze.language.models.prompt_texts import numbered
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.runs.work.run_folder import read_run
from memorymaze.texts.corpus.files import load_instructions

Memorymaze = Callable[..., Any]

WALK = "Refined program:\n```python\nmove_forward(14)\nstop()\n```"
LEFT = """Refined program:
```python
while not detect_turning_point():
    if move_forward(0.5).reason != "done":
        break
turn("left")
move_forward(12)
stop()
```"""


PROGRAMS = {
    "fourth door": WALK,
    "the junction": LEFT,
    "At the end": LEFT.replace("stop()", "no_such_call()"),
    "the corner": WALK.replace("stop()", "1 / 0"),
    "the long way": WALK.replace("move_forward(14)", "open('/etc/passwd')"),
    "Turn back": "I cannot write programs.",
    "the bench": WALK,
}


def answer(request: CompletionRequest) -> str:
    """Say what depends on the text alone; some of it is of no use."""
    task = request.messages[-1].content
    if task.startswith("Description:"):
        if "the bench" in task:
            return "I would rather not say."
        return f"Refined steps:\n1. {task.splitlines()[2]}\n2. Stop."
    return next(said for words, said in PROGRAMS.items() if words in task)


def batch_replies(requests: Path, replies: Path) -> None:
    """Answer a batch file as OpenAI's service and vLLM do."""
    lines: list[str] = []
    for line in requests.read_text(encoding="utf-8").splitlines():
        asked = json.loads(line)
        body = asked["body"]
        request = CompletionRequest(
            tuple(Message(**turn) for turn in body["messages"]),
            body["temperature"],
            body["max_tokens"],
        )
        model = ScriptedLanguageModel(answer, name=body["model"])
        said = model.complete(request)
        reply = {
            "id": "batch_req_1",
            "custom_id": asked["custom_id"],
            "response": {
                "status_code": 200,
                "body": {
                    "model": said.model,
                    "choices": [
                        {
                            "index": 0,
                            "message": {"role": "assistant", "content": said.text},
                            "finish_reason": "stop",
                        }
                    ],
                    "usage": {
                        "prompt_tokens": said.usage.prompt_tokens,
                        "completion_tokens": said.usage.completion_tokens,
                    },
                },
            },
            "error": None,
        }
        lines.append(json.dumps(reply) + "\n")
    # Batch services answer in any order.
    replies.write_text("".join(reversed(lines)), encoding="utf-8")


def results(folder: Path) -> list[Any]:
    return [replace(each, wall_s=0.0) for each in read_run(folder)[1]]


def record_replies(path: Path, instructions: Path, *, parser: bool) -> None:
    """Keep what the same model says when it is asked while a run goes on."""
    model = RecordingModel(ScriptedLanguageModel(answer, name="scripted"), path)
    requests = CodeGenerationRequests(CodeGenerationOptions(parser=parser))
    for each in load_instructions([instructions]):
        way = each.text
        if parser:
            said = model.complete(requests.parse(way)).text
            if said.startswith("I would"):
                continue
            way = numbered(read_steps(said))
        model.complete(requests.program(way))


@pytest.mark.proof
@pytest.mark.parametrize("parser", [True, False], ids=["parser", "no parser"])
def test_the_way_through_files_gives_the_tables_of_the_way_with_a_model(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path, parser: bool
) -> None:
    variant = [] if parser else ["--set", "parser=false"]
    agent = ["--agent", "code_generation", *variant]
    run = ["--workers", "1", *tiny_files]

    record_replies(tmp_path / "kept.jsonl", Path(tiny_files[1]), parser=parser)
    online = tmp_path / "online" / "run"
    replay = ["--replay", tmp_path / "kept.jsonl"]
    said = memorymaze("evaluate", *agent, *replay, *run, "--out", online)
    assert said.code == 0, said.err

    store = tmp_path / "answers.jsonl"
    ask = ["answers", "requests", *agent, "--model", "scripted", "--store", store]
    for stage in ("parse", "program") if parser else ("program",):
        asked, got = tmp_path / f"{stage}.jsonl", tmp_path / f"{stage}_replies.jsonl"
        said = memorymaze(*ask, *tiny_files, "--out", asked)
        assert said.code == 0, said.err
        batch_replies(asked, got)
        said = memorymaze("answers", "import", got, "--store", store)
        assert said.code == 0, said.err
    said = memorymaze(*ask, *tiny_files, "--out", tmp_path / "nothing.jsonl")
    assert "nothing is open" in said.out
    said = memorymaze("answers", "check", store, *variant, *tiny_files)
    assert said.code == 1  # some answers cannot be used
    assert "12 episodes; answers given before the run, from answers.jsonl" in said.out

    offline = tmp_path / "offline" / "run"
    said = memorymaze("evaluate", *agent, "--replay", store, *run, "--out", offline)
    assert said.code == 0, said.err
    assert results(offline) == results(online)
    endings = {each.stopped_by for each in results(online)}
    assert endings == {"agent", "crash", "unsafe", "model_error"}
    assert any(each.success for each in results(online))
    said = memorymaze("table", offline, "--format", "text")
    assert "answers given before the run, from answers.jsonl" in said.out


def test_a_request_that_failed_stays_open(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    store, asked = tmp_path / "answers.jsonl", tmp_path / "asked.jsonl"
    ask = ["answers", "requests", "--agent", "code_generation"]
    ask += ["--set", "parser=false"]
    ask += ["--model", "m", "--store", str(store), *tiny_files]
    memorymaze(*ask, "--out", asked)
    ids = [json.loads(line)["custom_id"] for line in asked.read_text().splitlines()]
    lines = [{"custom_id": each, "reply": "```\nstop()\n```"} for each in ids[1:]]
    lines.append({"custom_id": ids[0], "error": {"message": "Too busy."}})
    replies = tmp_path / "replies.jsonl"
    replies.write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")

    said = memorymaze("answers", "import", replies, "--store", store)
    assert said.code == 0
    assert f"no answer: {ids[0]}: the language model failed: Too busy." in said.err
    assert f"{len(ids) - 1} answers" in said.out
    again = tmp_path / "again.jsonl"
    assert "1 request in" in memorymaze(*ask, "--out", again).out
    assert json.loads(again.read_text(encoding="utf-8"))["custom_id"] == ids[0]


def test_replies_to_what_was_not_asked_are_refused(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    store, replies = tmp_path / "answers.jsonl", tmp_path / "replies.jsonl"
    AnswerFile(store, make=True)
    replies.write_text(
        '{"custom_id": "program/x", "reply": "stop()"}', encoding="utf-8"
    )
    said = memorymaze("answers", "import", replies, "--store", store)
    assert said.code != 0
    assert f"{replies}:1: {store} has not asked 'program/x'" in said.err


def test_a_file_that_is_there_is_not_written_over(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    there = tmp_path / "requests.jsonl"
    there.write_text("mine", encoding="utf-8")
    ask = ["answers", "requests", "--agent", "code_generation", "--model", "m"]
    ask += ["--store", str(tmp_path / "answers.jsonl"), *tiny_files, "--out"]
    said = memorymaze(*ask, there)
    assert said.code == 2
    assert "exists already" in said.err
    assert there.read_text(encoding="utf-8") == "mine"
    assert not (tmp_path / "answers.jsonl").exists()


def test_a_command_that_cannot_be_done_leaves_no_store(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    store = tmp_path / "answers.jsonl"
    ask = ["answers", "requests", "--model", "m", "--store", store, *tiny_files]
    ask += ["--out", tmp_path / "requests.jsonl", "--agent"]
    for wrong in (["nobody"], ["stop"], ["code_generation", "--set", "parsr=false"]):
        said = memorymaze(*ask, *wrong)
        assert said.code != 0, wrong
        assert not store.exists(), said.err
    assert memorymaze(*ask, "code_generation").code == 0
    assert store.exists()


def test_a_file_with_problems_is_told_line_by_line(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    programs = tmp_path / "programs.jsonl"
    record = {"instruction_id": "p1-1", "stage": "program", "reply": "turn('left'"}
    programs.write_text(json.dumps(record) + "\n{\n", encoding="utf-8")
    said = memorymaze("answers", "check", programs, *tiny_files)
    assert (said.code, said.err) == (1, "")
    assert f"{programs}:2: expected JSON" in said.out
    run = ["evaluate", "--agent", "code_generation", "--replay", programs]
    said = memorymaze(*run, *tiny_files, "--out", tmp_path / "run")
    assert said.code == 1
    assert f"{programs}:2" in said.err
    assert not (tmp_path / "run").exists()


def test_a_check_of_programs_that_will_crash_fails(
    memorymaze: Memorymaze,
    tiny_files: list[str],
    tiny_instructions: Path,
    tmp_path: Path,
) -> None:
    programs = tmp_path / "programs.jsonl"
    broken = {"stage": "program", "reply": "turn('left'"}
    lines = [
        json.dumps({"instruction_id": json.loads(line)["id"], **broken})
        for line in tiny_instructions.read_text(encoding="utf-8").splitlines()
    ]
    programs.write_text("\n".join(lines) + "\n", encoding="utf-8")
    said = memorymaze("answers", "check", programs, *tiny_files)
    assert said.code == 1
    assert "12 will crash" in said.out


def test_answers_to_single_tellings_are_not_taken_for_both(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    store, out = tmp_path / "kept.jsonl", tmp_path / "open.jsonl"
    record_replies(store, Path(tiny_files[1]), parser=False)
    ask = ["answers", "requests", "--agent", "code_generation"]
    ask += ["--set", "parser=false"]
    ask += ["--model", "scripted", "--store", store, *tiny_files, "--out", out]
    assert "nothing is open" in memorymaze(*ask).out
    said = memorymaze(*ask, "--second-telling")
    assert "6 requests" in said.out, said.err
    for line in out.read_text(encoding="utf-8").splitlines():
        assert "Second telling:" in json.loads(line)["body"]["messages"][-1]["content"]
