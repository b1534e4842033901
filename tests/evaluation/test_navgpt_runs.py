import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.agent_catalogue import (
    agent_names,
    agent_needs,
    build_agent,
)
from memorymaze.evaluation.episode_worker import EpisodeDone, EpisodeTask, EpisodeWorker
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.language.answers import RecordingModel
from memorymaze.language.model import CompletionRequest
from memorymaze.language.scripted_model import ScriptedLanguageModel


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
    assert [name for name in agent_names() if "graph" in agent_needs(name)] == [
        "navgpt"
    ]


def test_a_recorded_run_gives_the_same_results_without_a_model(
    tiny_plan: Callable[..., RunPlan], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replies = tmp_path / "replies.sqlite"
    model = RecordingModel(ScriptedLanguageModel(first_listed, name="m"), replies)
    monkeypatch.setattr(
        "memorymaze.evaluation.navgpt_runs.build_language_model", lambda _: model
    )
    plan = tiny_plan("stop", limit=4)
    settings = AgentSettings("navgpt", model="m")
    asked = replace(plan, settings=replace(plan.settings, agent=settings))
    agent = build_agent(settings)(plan.episodes[0])
    assert agent.name == "navgpt[m]+fair"
    recorded = _results(asked, tmp_path / "recorded")
    monkeypatch.undo()
    again = replace(settings, model=None, replay=str(replies))
    replayed = _results(
        replace(plan, settings=replace(plan.settings, agent=again)),
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
            AgentSettings("navgpt", model="m", options=(("captions", "blip"),)),
            "--set captions: expected templates or vision, got 'blip'",
        ),
        (
            AgentSettings(
                "navgpt",
                model="m",
                base_url="http://127.0.0.1:9/v1",
                options=(("captions", "vision"), ("caption_file", "/no/such/f")),
            ),
            "/no/such/f: expected a place for a file of captions",
        ),
    ],
)
def test_settings_that_cannot_be_used_are_refused_before_the_run(
    settings: AgentSettings, message: str
) -> None:
    with pytest.raises(SettingsError, match=message):
        build_agent(settings)
