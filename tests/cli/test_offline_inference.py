"""The way without a network: prompts, replies, programs, run, table."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.code_generation import CodeGenerationRequests
from memorymaze.evaluation.run_folder import read_run
from memorymaze.instructions.corpus import load_instructions
from memorymaze.language.model import CompletionRequest, Message
from memorymaze.language.recorded_replies import RecordingModel
from memorymaze.language.reply_reading import read_steps
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
    tables = [
        memorymaze("table", each, "--table", "both") for each in (online, offline)
    ]
    assert tables[0].out == tables[1].out
    assert tables[0].code == tables[1].code == 0
