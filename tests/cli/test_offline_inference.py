"""The way without a network: prompts, replies, programs, run, table."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.code_generation import CodeGenerationRequests
from memorymaze.agents.code_generation.replies import read_steps
from memorymaze.evaluation.run_folder import read_run
from memorymaze.instructions.files import load_instructions
from memorymaze.language.model import CompletionRequest, Message
from memorymaze.language.recorded_replies import RecordingModel
from memorymaze.language.scripted_model import ScriptedLanguageModel

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


def record_replies(path: Path, instructions: Path, *, parser: bool) -> None:
    """Keep what the same model says when it is asked while a run goes on."""
    model = RecordingModel(ScriptedLanguageModel(answer, name="scripted"), path)
    requests = CodeGenerationRequests(parser=parser)
    for each in load_instructions([instructions]):
        way = each.text
        if parser:
            said = model.complete(requests.parse(way)).text
            if said.startswith("I would"):
                continue
            way = requests.numbered(read_steps(said))
        model.complete(requests.program(way))


@pytest.mark.parametrize("parser", [True, False], ids=["parser", "no parser"])
def test_the_way_through_files_gives_the_tables_of_the_way_with_a_model(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path, parser: bool
) -> None:
    instructions = tiny_files[:2]
    variant = [] if parser else ["--no-parser"]
    agent = ["--agent", "code_generation"]

    record_replies(tmp_path / "kept.sqlite", Path(tiny_files[1]), parser=parser)
    online = tmp_path / "online" / "run"
    replay = ["--replay", tmp_path / "kept.sqlite", *variant]
    run = ["--workers", "1", *tiny_files]
    said = memorymaze("evaluate", *agent, *replay, *run, "--out", online)
    assert said.code == 0, said.err

    prompts = ["prompts", *agent, "--model", "scripted", *instructions, *variant]
    steps: list[str | Path] = []
    if parser:
        asked, got = tmp_path / "parse.jsonl", tmp_path / "parsed.jsonl"
        said = memorymaze(*prompts, "--out", asked)
        assert "12 requests for steps" in said.out
        batch_replies(asked, got)
        steps = ["--steps", got]
    asked, got = tmp_path / "program.jsonl", tmp_path / "programs_replies.jsonl"
    said = memorymaze(*prompts, *steps, "--out", asked)
    assert said.code == 0
    assert "requests for programs" in said.out
    batch_replies(asked, got)
    programs = tmp_path / "programs.jsonl"
    said = memorymaze("programs", "read", got, *steps, "--out", programs)
    assert said.code == 0, said.err
    said = memorymaze("programs", "check", programs, *instructions)
    assert said.code == 0, said.out
    assert "12 records for 12 instructions, by code_generation[scripted]" in said.out

    offline = tmp_path / "offline" / "run"
    said = memorymaze(
        "evaluate", *agent, "--programs", programs, *run, "--out", offline
    )
    assert said.code == 0, said.err

    def results(folder: Path) -> list[Any]:
        return [replace(each, wall_s=0.0) for each in read_run(folder)[1]]

    assert results(offline) == results(online)
    endings = {each.stopped_by for each in results(online)}
    assert endings == {"agent", "crash", "unsafe", "model_error"}
    assert any(each.success for each in results(online))
    for given in (["--table", "both", "--format", "csv"], ["--format", "text"]):
        asked, written = (
            memorymaze("table", each, *given).out for each in (online, offline)
        )
        assert "scripted" in asked
        # Above the key a text names the file of programs.
        begin = asked.find("SR success rate") + 1
        assert asked[begin:] == written[written.find("SR success rate") + 1 :]
    assert "programs written before the run, from programs.jsonl" in written


def test_a_file_that_is_there_is_not_written_over(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    replies = tmp_path / "replies.jsonl"
    replies.write_text('{"custom_id": "program/p1-1", "text": "```\\nstop()\\n```"}\n')
    before = replies.read_bytes()
    command = ["programs", "read", replies, "--model", "m", "--out"]
    said = memorymaze(*command, replies)
    assert said.code == 2
    assert "exists already" in said.err
    assert replies.read_bytes() == before
    said = memorymaze(*command, tmp_path / "no folder" / "x")
    assert said.code == 2
    assert "cannot be written" in said.err


def test_a_file_with_problems_is_told_line_by_line(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    programs = tmp_path / "programs.jsonl"
    record = {"instruction_id": "p1-1", "model": "m", "program": "turn('left'"}
    programs.write_text(json.dumps(record) + "\n{\n", encoding="utf-8")
    said = memorymaze("programs", "check", programs, *tiny_files[:2])
    assert (said.code, said.err) == (1, "")
    assert f"problem: {programs}:2: expected one JSON record" in said.out
    assert f"crash: {programs}:1: p1-1: line 1: " in said.out
    assert "no program for 11 of 12 instructions" in said.out
    run = ["evaluate", "--agent", "code_generation", "--programs", programs]
    said = memorymaze(*run, *tiny_files, "--out", tmp_path / "run")
    assert said.code == 1
    assert f"{programs}:2" in said.err
    assert not (tmp_path / "run").exists()


def test_a_missing_reply_gives_code_1_and_its_instruction(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    parsed, written = tmp_path / "parsed.jsonl", tmp_path / "written.jsonl"
    lines = [
        json.dumps({"custom_id": f"parse+parser/{each}", "text": "1. Go."}) + "\n"
        for each in ("a", "b")
    ]
    parsed.write_text("".join(lines), encoding="utf-8")
    reply = {"custom_id": "program+parser/a", "text": "```\nstop()\n```"}
    written.write_text(json.dumps(reply), encoding="utf-8")
    said = memorymaze(
        *("programs", "read", written, "--steps", parsed, "--model", "m"),
        *("--out", tmp_path / "programs.jsonl"),
    )
    assert said.code == 1
    assert "a reply is missing: b" in said.err
    assert "1 program, 0 without one (model_error), 1 missing" in said.out
