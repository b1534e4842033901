import json
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.evaluation.run_folder import read_run

PROJECT = Path(__file__).parents[1]
NOTEBOOK = PROJECT / "examples" / "first_steps.ipynb"


def _run(program: str, folder: Path) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True,
        text=True,
        cwd=folder,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_python_blocks_of_the_page_on_python_run(
    tmp_path: Path, chat_server: Callable[..., tuple[str, list[dict[str, Any]]]]
) -> None:
    """Its agent that asks a model is recorded, replayed and priced."""
    address, asked = chat_server(lambda _: "forward", "my-model", (100, 2))
    page = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
    program = "\n".join(re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL))
    assert "http://localhost:8000/v1" in program
    said = _run(program.replace("http://localhost:8000/v1", address), tmp_path)
    assert "right_hand, 6 episodes" in said
    assert "B - A" in said
    assert "Say one word of ['" in asked[0]["messages"][-1]["content"]
    _, recorded = read_run(tmp_path / "runs" / "asked")
    _, replayed = read_run(tmp_path / "runs" / "replayed")
    calls = sum(one.model_calls for one in recorded)
    # What is asked in the same words, of another text of the route, is asked once.
    assert 0 < len(asked) <= calls
    assert sum(one.cost_usd for one in recorded) == pytest.approx(calls * 16.2e-6)
    untimed = {"wall_s": 0.0}
    assert [replace(one, **untimed) for one in replayed] == [
        replace(one, **untimed) for one in recorded
    ]


def test_the_notebook_scores_an_agent_of_ones_own_in_under_25_lines(
    tmp_path: Path,
) -> None:
    cells = json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]
    programs = ["".join(c["source"]) for c in cells if c["cell_type"] == "code"]
    lines = [line for each in programs for line in each.splitlines() if line.strip()]
    assert len(lines) < 25
    said = _run("\n".join([*programs, "print(run)"]), tmp_path)
    assert "right_hand, 6 episodes" in said
