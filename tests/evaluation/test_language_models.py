"""`code_generation` against a server of our own, and against what it said."""

import json
import threading
from collections.abc import Callable, Generator
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.driver import run_plan
from memorymaze.evaluation.language_models import build_language_model
from memorymaze.evaluation.plan import RunPlan, plan_run
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.evaluation.trace import read_trace

TINY_INSTRUCTIONS = Path(__file__).parents[1] / "tiny_instructions.jsonl"

PROGRAM = """```python
say("I follow.")
move_forward(14)
stop()
```"""


class ProgramWriter(BaseHTTPRequestHandler):
    """Answers every request with the same program."""

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["content-length"]))
        content = {
            "model": "fake-1",
            "choices": [{"message": {"role": "assistant", "content": PROGRAM}}],
            "usage": {"prompt_tokens": 100, "completion_tokens": 20},
        }
        body = json.dumps(content).encode()
        self.send_response(200)
        self.send_header("content-type", "application/json")
        self.send_header("content-length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:
        pass


@pytest.fixture
def server() -> Generator[str]:
    """Address of a language-model server on this machine."""
    with ThreadingHTTPServer(("127.0.0.1", 0), ProgramWriter) as http:
        thread = threading.Thread(target=http.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{http.server_port}/v1"
        http.shutdown()
        thread.join()


@pytest.fixture
def plan(tiny_sites_folder: Path) -> Callable[[AgentSettings], RunPlan]:
    """Plan two episodes of an agent."""

    def two(agent: AgentSettings) -> RunPlan:
        return plan_run(
            agent,
            instruction_files=[TINY_INSTRUCTIONS],
            sites_folder=tiny_sites_folder,
            limit=2,
        )

    return two


def test_a_recorded_run_is_replayed_without_a_server(
    server: str, plan: Callable[[AgentSettings], RunPlan], tmp_path: Path
) -> None:
    replies = str(tmp_path / "replies.sqlite")
    asking = AgentSettings(
        "code_generation", model="fake", parser=False, base_url=server, record=replies
    )
    asked = run_plan(plan(asking), tmp_path / "asked", workers=1)
    assert [(one.model_calls, one.tokens) for one in asked] == [(1, 120), (1, 120)]
    assert {one.stopped_by for one in asked} == {"agent"}
    assert any(one.success for one in asked)
    notes = [
        entry["about"]
        for entry in read_trace(tmp_path / "asked", asked[0].episode_id)
        if entry["kind"] == "note"
    ]
    assert {"model_reply", "program"} <= set(notes)
    replaying = replace(asking, base_url=None, record=None, replay=replies)
    replayed = run_plan(plan(replaying), tmp_path / "replayed", workers=1)
    assert [replace(one, wall_s=0) for one in replayed] == [
        replace(one, wall_s=0) for one in asked
    ]
    parsing = replace(replaying, parser=True)
    other = run_plan(plan(parsing), tmp_path / "other", workers=1)
    assert {one.stopped_by for one in other} == {"model_error"}
    assert all("no reply of fake is recorded" in str(one.error) for one in other)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        pytest.param({}, "name a language model with --model", id="no model"),
        pytest.param(
            {"replay": "x", "record": "y"}, "--replay and --record", id="both"
        ),
        pytest.param({"replay": "none"}, "no recorded replies", id="no file"),
        pytest.param({"model": "m", "base_url": "x"}, "expected an address", id="url"),
    ],
)
def test_settings_that_make_no_model_are_explained(
    options: dict[str, str], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        build_language_model(AgentSettings("code_generation", **options))


def test_a_key_is_asked_for_only_by_openais_own_server(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for prefix in ("MEMORYMAZE", "OPENAI"):
        for name in ("API_KEY", "BASE_URL"):
            monkeypatch.delenv(f"{prefix}_{name}", raising=False)
    with pytest.raises(SettingsError, match="no key for the language model"):
        build_language_model(AgentSettings("code_generation", model="m"))
    address = "http://localhost:1/v1"
    model = build_language_model(
        AgentSettings("code_generation", model="m", base_url=address)
    )
    assert model.name == "m"
