"""The server in front of the NaVid checkpoint, with a stand-in in the checkpoint's place."""

import ast
import io
import json
import runpy
import sys
from collections.abc import Callable, Iterator
from operator import itemgetter
from pathlib import Path
from threading import Thread
from typing import Any

import httpx2
import pytest
from PIL import Image

from memorymaze.front.cli.main import run_command_line

EXAMPLE = Path(__file__).parents[2] / "examples" / "navid_server.py"
AHEAD = "The next action is move forward 75 cm."
LEFT = "The next action is turn left 90 degrees."


class StandIn:
    """Says the sentences of a script in turn for each instruction; keeps what it sees."""

    def __init__(self, *script: str) -> None:
        self.script = script
        self.seen: list[tuple[str, list[bytes], int]] = []

    def __call__(self, instruction: str, pictures: list[bytes], seed: int) -> str:
        said = sum(instruction == each for each, _, _ in self.seen)
        self.seen.append((instruction, pictures, seed))
        return self.script[min(said, len(self.script) - 1)]


@pytest.fixture
def serve() -> Iterator[Callable[[StandIn], str]]:
    """Start the server with a stand-in for the checkpoint; returns its address."""
    make_server = runpy.run_path(str(EXAMPLE))["make_server"]
    servers: list[Any] = []

    def start(model: StandIn) -> str:
        http = make_server(model)
        servers.append(http)
        Thread(target=http.serve_forever, args=(0.01,), daemon=True).start()
        return f"http://127.0.0.1:{http.server_address[1]}/v1"

    yield start
    for each in servers:
        each.shutdown()
        each.server_close()


def results(run: Path) -> list[dict[str, Any]]:
    lines = (run / "episodes.jsonl").read_text(encoding="utf-8").splitlines()
    read = sorted((json.loads(line) for line in lines), key=itemgetter("episode_id"))
    return [{**each, "wall_s": None} for each in read]


@pytest.mark.proof
def test_the_checkpoint_is_asked_recorded_and_replayed_like_any_model(
    serve: Callable[[StandIn], str],
    tiny_sites_folder: Path,
    tmp_path: Path,
) -> None:
    model = StandIn(AHEAD, AHEAD, LEFT, "stop.")
    texts = ["To the corner, then left.", 'Ahead, and at the "corner" left.']
    told = tmp_path / "told.jsonl"
    told.write_text(
        "".join(
            json.dumps({"site": "l_shape", "route": "R1", "text": text}) + "\n"
            for text in texts
        )
    )
    asked = ["evaluate", "--agent", "navid", "--instructions", str(told)]
    asked += ["--sites", str(tiny_sites_folder), "--set", "history=1000"]
    asked += ["--set", "faithful=true", "--model", "navid-7b", "--workers", "1"]
    store = str(tmp_path / "replies")

    served = ["--base-url", serve(model), "--record", store]
    assert run_command_line([*asked, *served, "--out", str(tmp_path / "served")]) == 0
    assert (
        run_command_line([*asked, "--replay", store, "--out", str(tmp_path / "again")])
        == 0
    )

    first = results(tmp_path / "served")
    assert [each["stopped_by"] for each in first] == ["agent", "agent"]
    assert [each["path_length"] for each in first] == [pytest.approx(1.5, abs=0.01)] * 2
    assert first[0]["agent"] == "NaVid protocol with navid-7b+fair+faithful"
    assert results(tmp_path / "again") == first
    # The instruction as it was told, with the whole video, and nothing else.
    assert {instruction for instruction, _, _ in model.seen} == set(texts)
    shown = [len(pictures) for _, pictures, _ in model.seen]
    assert sorted(shown) == [1, 1, 4, 4, 7, 7, 10, 10]
    *past, now = (Image.open(io.BytesIO(each)).size for each in model.seen[-1][1])
    assert (set(past), now) == ({(320, 240)}, (640, 480))


def test_the_server_says_what_it_expects(serve: Callable[[StandIn], str]) -> None:
    address = serve(StandIn("stop."))
    blind = {"messages": [{"role": "user", "content": '"""\nGo.\n"""'}]}

    for path, body, status, said in (
        ("/completions", {}, 404, "expected POST /v1/chat/completions"),
        ("/chat/completions", blind, 400, "and pictures as"),
        ("/chat/completions", [], 400, "expected a last message"),
    ):
        answer = httpx2.post(address + path, json=body)
        assert answer.status_code == status
        assert said in answer.json()["error"]["message"]


def test_a_model_that_fails_ends_the_request_with_its_reason(
    serve: Callable[[StandIn], str], capfd: pytest.CaptureFixture[str]
) -> None:
    part = {"type": "image_url", "image_url": {"url": "data:image/jpeg;base64,/9j/"}}
    text = {"type": "text", "text": '"""\nGo.\n"""'}
    body = {"messages": [{"role": "user", "content": [text, part]}]}

    answer = httpx2.post(f"{serve(StandIn())}/chat/completions", json=body)

    assert answer.status_code == 500
    assert "IndexError" in answer.json()["error"]["message"]
    assert "IndexError" in capfd.readouterr().err


def test_the_server_is_one_file_for_python_3_8() -> None:
    tree = ast.parse(EXAMPLE.read_text(encoding="utf-8"), feature_version=(3, 8))

    needed = {
        name.split(".")[0]
        for node in tree.body
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module or ""]
            if isinstance(node, ast.ImportFrom)
            else []
        )
    }
    assert needed <= sys.stdlib_module_names
