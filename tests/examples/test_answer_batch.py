"""The stand-in for a language model answers what `memorymaze answers requests` asks."""

import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.code_generation import CodeGenerationRequests
from memorymaze.agents.code_generation.replies import read_program, read_steps
from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import EpisodeOver
from memorymaze.language.models.batch_files import read_replies, request_line

EXAMPLE = Path(__file__).parents[2] / "examples/answer_batch.py"


def test_the_stand_in_writes_steps_and_programs(
    tmp_path: Path, make_paper_robot: Callable[..., Any]
) -> None:
    requests = CodeGenerationRequests()
    asked, got = tmp_path / "asked.jsonl", tmp_path / "got.jsonl"
    lines = [
        request_line("steps", "m", requests.parse("Go on. Then left.\nThere it is!")),
        request_line("program", "m", requests.program("1. Left.\n2. Right.")),
    ]
    asked.write_text("\n".join(lines) + "\n", encoding="utf-8")

    runpy.run_path(str(EXAMPLE))["main"](asked, got)

    replies = {name: reply.completion for name, reply in read_replies([got]).items()}
    assert replies["steps"] is not None
    assert read_steps(replies["steps"].text) == ["Go on", "Then left", "There it is!"]
    assert replies["program"] is not None
    program = read_program(replies["program"].text)
    assert "['left', 'right']" in program
    with pytest.raises(EpisodeOver, match="agent"):
        run_program(program, make_paper_robot())
