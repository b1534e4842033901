import json
import re
import subprocess
import sys
import threading
from collections.abc import Generator
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

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


@pytest.fixture
def model_server() -> Generator[tuple[str, list[str]]]:
    """A server of a model that says `forward`, and what it was asked."""
    asked: list[str] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            asked.append(json.loads(body)["messages"][-1]["content"])
            content = {
                "model": "my-model",
                "choices": [{"message": {"role": "assistant", "content": "forward"}}],
                "usage": {"prompt_tokens": 100, "completion_tokens": 2},
            }
            answer = json.dumps(content).encode()
            self.send_response(200)
            self.send_header("content-type", "application/json")
            self.send_header("content-length", str(len(answer)))
            self.end_headers()
            self.wfile.write(answer)

        def log_message(self, format: str, *args: object) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as http:
        thread = threading.Thread(target=http.serve_forever, args=(0.01,))
        thread.start()
        yield f"http://127.0.0.1:{http.server_port}/v1", asked
        http.shutdown()
        thread.join()


def test_the_python_blocks_of_the_page_on_python_run(
    tmp_path: Path, model_server: tuple[str, list[str]]
) -> None:
    """Its agent that asks a model is recorded, replayed and priced."""
    address, asked = model_server
    page = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
    program = "\n".join(re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL))
    assert "http://localhost:8000/v1" in program
    said = _run(program.replace("http://localhost:8000/v1", address), tmp_path)
    assert "right_hand, 6 episodes" in said
    assert "B - A" in said
    assert "Say one word of ['" in asked[0]
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
