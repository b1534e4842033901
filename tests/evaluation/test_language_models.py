"""`code_generation` against a server of our own, and against what it said."""

import json
import sqlite3
import threading
from collections.abc import Callable, Generator
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

from memorymaze.errors import SettingsError, SpendingLimitReached
from memorymaze.evaluation.agent_catalogue import build_agent
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.asking import AskingSettings
from memorymaze.evaluation.driver import run_plan
from memorymaze.evaluation.episode import run_episode
from memorymaze.evaluation.inference_time import InferenceTime
from memorymaze.evaluation.language_models import build_language_model
from memorymaze.evaluation.plan import RunPlan, plan_run
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import read_run
from memorymaze.evaluation.settings import AgentSettings, RunSettings
from memorymaze.evaluation.trace import read_trace
from memorymaze.instructions import load_corpus
from memorymaze.language.spending import TokenPrice

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
def plan(tiny_sites_folder: Path) -> Callable[..., RunPlan]:
    """Plan two episodes of an agent, or some other number."""

    def some(agent: AgentSettings, limit: int = 2) -> RunPlan:
        return plan_run(
            agent,
            load_corpus([TINY_INSTRUCTIONS], sites=tiny_sites_folder),
            RunSettings(limit=limit),
        )

    return some


def test_a_recorded_run_is_replayed_without_a_server(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    replies = str(tmp_path / "replies.sqlite")
    asking = AgentSettings(
        "code_generation", model="fake", parser=False, base_url=server, record=replies
    )
    asked = run_plan(plan(asking, 3), tmp_path / "asked", workers=1)
    assert [(one.model_calls, one.tokens) for one in asked] == [(1, 120)] * 3
    assert {one.stopped_by for one in asked} == {"agent"}
    assert any(one.success for one in asked)
    notes = [
        entry["about"]
        for entry in read_trace(tmp_path / "asked", asked[0].episode_id)
        if entry["kind"] == "note"
    ]
    assert {"model_reply", "program"} <= set(notes)
    replaying = replace(asking, base_url=None, record=None, replay=replies)
    replayed = run_plan(plan(replaying, 3), tmp_path / "replayed", workers=1)
    assert [replace(one, wall_s=0) for one in replayed] == [
        replace(one, wall_s=0) for one in asked
    ]
    parsing = replace(replaying, parser=True)
    other = run_plan(plan(parsing, 3), tmp_path / "other", workers=1)
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


def _asking(server: str, **changes: Any) -> AgentSettings:
    agent = AgentSettings("code_generation", model="fake", parser=False)
    return replace(agent, base_url=server, **changes)


def _first(plan: RunPlan) -> EpisodeResult:
    """Run the first episode of a plan in this process."""
    episode = plan.episodes[0]
    arena = Arena(plan.sites[episode.instruction.site])
    agent = build_agent(plan.settings.agent)(episode)
    return run_episode(agent, episode, arena, plan.settings).result


def test_the_user_stands_as_long_as_the_recorded_model_thought(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    replies = tmp_path / "replies.sqlite"
    asked = run_plan(
        plan(_asking(server, record=str(replies))), tmp_path / "asked", workers=1
    )
    assert all(one.inference_s > 0 for one in asked)
    with sqlite3.connect(replies) as database:
        database.execute(
            "UPDATE replies SET completion = json_set(completion, '$.latency', 3.21)"
        )
    database.close()
    replaying = _asking(server, replay=str(replies))
    replaying = replace(replaying, base_url=None)
    replays = [
        run_plan(plan(replaying), tmp_path / name, workers=1) for name in ("1", "2")
    ]
    untimed = {"wall_s": 0.0}
    assert [[replace(one, **untimed) for one in each] for each in replays] == 2 * [
        [
            replace(
                one,
                inference_s=3.21,
                standing_s=3.21,
                duration_s=new.duration_s,
                **untimed,
            )
            for one, new in zip(asked, replays[0], strict=True)
        ]
    ]
    for old, new in zip(asked, replays[0], strict=True):
        walked = old.duration_s - old.standing_s
        assert new.duration_s - new.standing_s == pytest.approx(walked)
    traces = [
        list(read_trace(tmp_path / name, asked[0].episode_id)) for name in ("1", "2")
    ]
    assert traces[0] == traces[1]
    [note] = [each for each in traces[0] if each.get("about") == "model_reply"]
    assert (note["time"], note["standing_s"], note["latency"]) == (3.21, 3.21, 3.21)


@pytest.mark.parametrize(
    ("setting", "seconds"),
    [
        (InferenceTime(measured=False), 0.0),
        (InferenceTime(measured=False, start_s=2.5), 2.5),
        (InferenceTime(False, 1.0, prompt_rate=50, reply_rate=10), 5.0),
    ],
    ids=["none", "seconds", "profile"],
)
def test_models_can_be_compared_on_an_equal_footing(
    server: str, plan: Callable[..., RunPlan], setting: InferenceTime, seconds: float
) -> None:
    one = _first(plan(_asking(server, inference_time=setting)))
    assert one.standing_s == pytest.approx(seconds)
    assert one.duration_s > seconds
    assert 0 < one.inference_s != one.standing_s


def test_a_run_ends_when_its_money_is_spent_and_goes_on_with_more(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    run = tmp_path / "run"
    # 100 tokens read and 20 written are 0.14 dollars.
    asking = AskingSettings(price=TokenPrice(1000, 2000), max_cost=0.3)
    with pytest.raises(
        SpendingLimitReached,
        match=r"0\.4200 USD are spent, of 0\.3 .* 3 of 12 episodes",
    ):
        run_plan(plan(_asking(server, asking=asking), 12), run, workers=1)
    _, finished = read_run(run)
    assert [one.cost_usd for one in finished] == pytest.approx([0.14] * 3)
    with pytest.raises(SpendingLimitReached, match=r"\b3 of 12 episodes"):
        run_plan(plan(_asking(server, asking=asking), 12), run, workers=1, resume=True)
    more = replace(asking, max_cost=0.8)
    with pytest.raises(SpendingLimitReached, match="episodes are finished and kept"):
        run_plan(plan(_asking(server, asking=more), 12), run, workers=2, resume=True)
    _, later = read_run(run)
    assert {one.episode_id for one in finished} < {one.episode_id for one in later}
    # Two workers pass the limit by one reply each at most.
    assert 6 <= len(later) <= 7
    enough = replace(asking, max_cost=None, max_tokens_total=10_000, max_requests=1)
    everything = run_plan(
        plan(_asking(server, asking=enough), 12), run, workers=2, resume=True
    )
    assert len(everything) == 12
    assert {one.stopped_by for one in everything} <= {"agent", "budget", "stuck"}


def test_tokens_are_limited_without_a_price(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    agent = _asking(server, asking=AskingSettings(max_tokens_total=200))
    with pytest.raises(SpendingLimitReached, match="240 tokens are used, of 200"):
        run_plan(plan(agent, 4), tmp_path / "run", workers=1)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"max_cost": 1.0}, "--max-cost: what replies cost is not known"),
        ({"timeout": 0.0}, "--request-timeout: expected at least"),
        ({"retries": -1}, "--retries: expected at least 0"),
        ({"max_requests": 0}, "--max-requests: expected at least 1"),
        ({"max_tokens_total": 0}, "--max-tokens-total: expected at least 1"),
    ],
)
def test_limits_without_meaning_are_explained(
    options: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        AskingSettings(**options)


def test_a_replay_is_paid_for_at_another_price(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    replies = str(tmp_path / "replies.sqlite")
    assert _first(plan(_asking(server, record=replies))).cost_usd == 0
    asking = AskingSettings(price=TokenPrice(10_000, 0))
    agent = replace(_asking(server, replay=replies, asking=asking), base_url=None)
    assert _first(plan(agent)).cost_usd == 1.0
