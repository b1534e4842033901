"""Agents that ask a language model: on a server of our own, and on what it said."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.notes import ModelReplyNote
from memorymaze.basics.errors import SettingsError, SpendingLimitReached
from memorymaze.language.models.answers import RecordingModel
from memorymaze.language.models.model import CompletionRequest
from memorymaze.language.models.model_settings import (
    InferenceTime,
    ModelSettings,
)
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.models.spending import TokenPrice
from memorymaze.runs.episodes.agent_catalogue import (
    agent_names,
    choose_agent,
)
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.open_requests import open_requests
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import NoteEntry
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.episode_worker import EpisodeDone, EpisodeTask, EpisodeWorker
from memorymaze.runs.work.run_folder import read_run
from memorymaze.texts.corpus import load_corpus

UNPARSED = (("parser", "false"),)
TINY_INSTRUCTIONS = Path(__file__).parents[2] / "tiny_instructions.jsonl"

PROGRAM = """```python
say("I follow.")
move_forward(14)
stop()
```"""


@pytest.fixture
def server(chat_server: Callable[..., tuple[str, Any]]) -> str:
    """Address of a server whose model answers every request with the same program."""
    return chat_server(lambda _: PROGRAM, model="fake-1", tokens=(100, 20))[0]


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
    replies = str(tmp_path / "replies.jsonl")
    asking = AgentSettings(
        "code_generation",
        options=UNPARSED,
        language_model=ModelSettings(model="fake", base_url=server, record=replies),
    )
    asked = run_plan(plan(asking, 3), tmp_path / "asked", workers=1)
    assert [(one.model_calls, one.tokens) for one in asked] == [(1, 120)] * 3
    assert {one.stopped_by for one in asked} == {"agent"}
    assert any(one.success for one in asked)
    notes = [
        entry.about
        for entry in read_trace(tmp_path / "asked", asked[0].episode_id)
        if isinstance(entry, NoteEntry)
    ]
    assert {"model_reply", "program"} <= set(notes)
    model = ModelSettings(model="fake", replay=replies)
    replaying = replace(asking, language_model=model)
    replayed = run_plan(plan(replaying, 3), tmp_path / "replayed", workers=1)
    assert [replace(one, wall_s=0) for one in replayed] == [
        replace(one, wall_s=0) for one in asked
    ]
    parsing = replace(replaying, options=(("parser", "true"),))
    other = run_plan(plan(parsing, 3), tmp_path / "other", workers=1)
    assert {one.stopped_by for one in other} == {"model_error"}
    assert all("no reply of fake is recorded" in str(one.error) for one in other)


def _asking(server: str | None, **changes: Any) -> AgentSettings:
    model = ModelSettings(model="fake", base_url=server, **changes)
    return AgentSettings("code_generation", options=UNPARSED, language_model=model)


def _first(plan: RunPlan) -> EpisodeResult:
    """Run the first episode of a plan in this process."""
    episode = plan.episodes[0]
    arena = Arena(plan.sites[episode.instruction.site])
    agent = plan.ready.in_episode(episode)
    return run_episode(agent, episode, arena, plan.settings).result


def test_the_user_stands_as_long_as_the_recorded_model_thought(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    replies = tmp_path / "replies.jsonl"
    asked = run_plan(
        plan(_asking(server, record=str(replies))), tmp_path / "asked", workers=1
    )
    assert all(one.inference_s > 0 for one in asked)
    lines = replies.read_text(encoding="utf-8").splitlines()
    kept = [json.loads(line) | {"latency_s": 3.21} for line in lines]
    replies.write_text("\n".join(map(json.dumps, kept)), encoding="utf-8")
    replaying = _asking(None, replay=str(replies))
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
    entries = (each for each in traces[0] if isinstance(each, NoteEntry))
    [entry] = [each for each in entries if isinstance(each.note, ModelReplyNote)]
    note = entry.details
    assert (entry.time, note["standing_s"], note["latency"]) == (3.21, 3.21, 3.21)


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
    limits: dict[str, Any] = {"price": TokenPrice(1000, 2000), "max_cost": 0.3}
    with pytest.raises(
        SpendingLimitReached,
        match=r"0\.4200 USD are spent, of 0\.3 .* 3 of 12 episodes",
    ):
        run_plan(plan(_asking(server, **limits), 12), run, workers=1)
    _, finished = read_run(run)
    assert [one.cost_usd for one in finished] == pytest.approx([0.14] * 3)
    with pytest.raises(SpendingLimitReached, match=r"\b3 of 12 episodes"):
        run_plan(plan(_asking(server, **limits), 12), run, workers=1, resume=True)
    limits["max_cost"] = 0.8
    with pytest.raises(SpendingLimitReached, match="episodes are finished and kept"):
        run_plan(plan(_asking(server, **limits), 12), run, workers=2, resume=True)
    _, later = read_run(run)
    assert {one.episode_id for one in finished} < {one.episode_id for one in later}
    # Two workers pass the limit by one reply each at most.
    assert 6 <= len(later) <= 7
    limits |= {"max_cost": None, "max_tokens_total": 10_000, "max_requests": 1}
    everything = run_plan(
        plan(_asking(server, **limits), 12), run, workers=2, resume=True
    )
    assert len(everything) == 12
    assert {one.stopped_by for one in everything} <= {"agent", "budget", "stuck"}


def test_a_limit_holds_for_what_was_spent_before_it_was_given(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    priced: dict[str, Any] = {"price": TokenPrice(1000, 2000)}
    run_plan(plan(_asking(server, **priced), 2), tmp_path / "run", workers=1)
    results = tmp_path / "run" / "episodes.jsonl"
    first = results.read_text(encoding="utf-8").splitlines(keepends=True)[0]
    results.write_text(first, encoding="utf-8")
    limited = plan(_asking(server, **priced, max_cost=0.28), 2)
    with pytest.raises(SpendingLimitReached, match=r"0\.2800 USD .* 1 of 2 episodes"):
        run_plan(limited, tmp_path / "run", workers=1, resume=True)


def test_a_run_ends_too_when_its_money_goes_for_answers_without_text(
    chat_server: Callable[..., tuple[str, Any]],
    plan: Callable[..., RunPlan],
    tmp_path: Path,
) -> None:
    server, requests = chat_server(lambda _: " ", model="m", tokens=(1000, 4096))
    agent = _asking(server, price=TokenPrice(1, 10), max_cost=0.05)
    with pytest.raises(SpendingLimitReached, match=r"0\.0839 .* 2 of 12 episodes"):
        run_plan(plan(agent, 12), tmp_path / "run", workers=1)
    assert len(requests) == 2


def test_tokens_are_limited_without_a_price(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    agent = _asking(server, max_tokens_total=200)
    with pytest.raises(SpendingLimitReached, match="240 tokens are used, of 200"):
        run_plan(plan(agent, 4), tmp_path / "run", workers=1)


def test_a_replay_is_paid_for_at_another_price(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    replies = str(tmp_path / "replies.jsonl")
    assert _first(plan(_asking(server, record=replies))).cost_usd == 0
    agent = _asking(None, replay=replies, price=TokenPrice(10_000, 0))
    assert _first(plan(agent)).cost_usd == 1.0


def test_what_is_kept_counts_at_the_price_of_the_run_that_takes_it(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    replies = str(tmp_path / "replies.jsonl")
    costs = [
        _first(plan(_asking(server, record=replies, price=price))).cost_usd
        for price in (None, TokenPrice(10_000, 0), TokenPrice(20_000, 0))
    ]
    assert costs == [0.0, 1.0, 2.0]


OWN = """
from memorymaze.language.models.model import CompletionRequest, Message, ModelQuestion

class Asker:
    needs = frozenset({"language_model"})

    def __init__(self, model):
        self.model = model
        self.name = f"asker[{model.name}]"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(1)
        told = (Message("user", instruction),)
        request = CompletionRequest(told, question=ModelQuestion("word", "1"))
        if "I follow" in journal.ask(self.model, request, "word"):
            robot.move_forward(2)
"""


def test_an_agent_of_ones_own_is_recorded_replayed_and_priced_like_ours(
    server: str, plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    own, replies = tmp_path / "own.py", str(tmp_path / "replies.jsonl")
    own.write_text(OWN, encoding="utf-8")
    price = TokenPrice(1000, 2000)
    model = ModelSettings(model="fake", base_url=server, record=replies, price=price)
    agent = AgentSettings(f"{own}:Asker", language_model=model)
    asked = run_plan(plan(agent), tmp_path / "asked", workers=2)
    assert {one.agent for one in asked} == {"asker[fake]"}
    assert [one.cost_usd for one in asked] == pytest.approx([0.14] * 2)
    assert {one.stopped_by for one in asked} == {"agent"}

    model = ModelSettings(replay=replies, price=price)
    replaying = plan(replace(agent, language_model=model))
    again = run_plan(replaying, tmp_path / "replayed", workers=2)
    untimed = {"wall_s": 0.0}
    assert [replace(one, **untimed) for one in again] == [
        replace(one, **untimed) for one in asked
    ]

    # Of four episodes the two that were not asked about are open.
    left = plan(replace(agent, language_model=model), 4)
    assert left.settings.answers is not None
    assert left.settings.answers.missing == 2
    questions = [request.question for request in open_requests(left)]
    known = {one.instruction_id for one in asked}
    wanted = {each.instruction.id for each in left.episodes} - known
    assert {each.instruction for each in questions if each} == wanted


def first_listed(request: CompletionRequest) -> str:
    """Always goes to the first viewpoint that is listed; arrives on the fourth place."""
    told = request.messages[-1].content
    if told.count("Action Input") >= 3:
        return "Final Answer: arrived"
    last = told[told.rindex("You are at viewpoint") :]
    listed = last.partition("Viewpoints: ")[2].split("Viewpoints: ")
    first = next(each for each in listed if not each.startswith("none"))
    return f"Action: go_to_viewpoint\nAction Input: {first[:32]}"


def test_navgpt_is_the_only_agent_with_a_graph() -> None:
    assert [name for name in agent_names() if "graph" in choose_agent(name).needs] == [
        "navgpt"
    ]


def test_a_recorded_run_gives_the_same_results_without_a_model(
    tiny_plan: Callable[..., RunPlan], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replies = tmp_path / "replies.jsonl"
    model = RecordingModel(ScriptedLanguageModel(first_listed, name="m"), replies)
    monkeypatch.setattr(
        "memorymaze.runs.episodes.agent_catalogue.build_language_model", lambda _: model
    )
    plan = tiny_plan("stop", limit=4)
    settings = AgentSettings("navgpt", language_model=ModelSettings(model="m"))
    needs = ("graph", "language_model")
    asked = replace(plan, settings=replace(plan.settings, agent=settings, needs=needs))
    assert choose_agent(settings).make().agent.name == "navgpt[m]+fair"
    recorded = _results(asked, tmp_path / "recorded")
    monkeypatch.undo()
    again = replace(settings, language_model=ModelSettings(replay=str(replies)))
    replayed = _results(
        replace(asked, settings=replace(asked.settings, agent=again)),
        tmp_path / "replayed",
    )
    assert recorded == replayed
    assert {result["stopped_by"] for result in recorded} == {"agent"}
    assert {result["model_calls"] for result in recorded} == {4}


def _results(plan: RunPlan, folder: Path) -> list[dict[str, Any]]:
    """Results in this process, so that a model put in for a server's is asked."""
    follow = EpisodeWorker(plan.settings, plan.sites)()
    done = [follow(EpisodeTask(episode)) for episode in plan.episodes]
    results = [each.result for each in done if isinstance(each, EpisodeDone)]
    return [json.loads(json.dumps({**_fields(each), "wall_s": 0})) for each in results]


def _fields(result: Any) -> dict[str, Any]:
    return {name: getattr(result, name) for name in type(result).__slots__}


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (AgentSettings("navgpt"), "name a language model with --model"),
        (
            AgentSettings(
                "navgpt",
                options=(("captions", "blip"),),
                language_model=ModelSettings(model="m"),
            ),
            "--set captions: expected templates or vision, got 'blip'",
        ),
        (
            AgentSettings(
                "navgpt",
                language_model=ModelSettings(
                    model="m", base_url="http://127.0.0.1:9/v1", record="/no/such/f"
                ),
            ),
            "/no/such/f: expected a place for a file of answers",
        ),
    ],
)
def test_settings_that_cannot_be_used_are_refused_before_the_run(
    settings: AgentSettings, message: str
) -> None:
    with pytest.raises(SettingsError, match=message):
        choose_agent(settings).make()
