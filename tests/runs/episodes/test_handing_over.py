"""NavGPT in runs: on the graphs of tiny sites and of the university."""

import json
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from memorymaze.agents.navgpt import NavGPTAgent, NavGPTOptions
from memorymaze.language.models.model import CompletionRequest, Picture
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.runs.episodes.agent_catalogue import choose_agent
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.budgets import fair_limits
from memorymaze.runs.episodes.episode import EpisodeRun, run_episode
from memorymaze.runs.episodes.guarded_robot import graph_of
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunDefinition
from memorymaze.runs.episodes.trace_entries import NoteEntry
from memorymaze.runs.episodes.vision_captions import VisionCaptions
from memorymaze.texts.corpus.records import Episode
from memorymaze.world.sites.navigation_graph import NavigationGraph

HERE = re.compile(r"(?:at|still at) viewpoint ([0-9a-f]{32})")


def next_viewpoints(
    graph: NavigationGraph, goal: tuple[float, float]
) -> Mapping[str, str]:
    """The viewpoint to go to from each one, in short steps, for whoever knows the goal."""
    places = np.array([each[1:] for each in graph.viewpoints])
    pairs = np.array(sorted(graph.edges))
    # Longer steps cost more than they gain, so that each viewpoint is gone to.
    steps = np.hypot(*(places[pairs[:, 0]] - places[pairs[:, 1]]).T) ** 1.5
    size = len(places)
    _, before = dijkstra(
        csr_array((steps, tuple(pairs.T)), shape=(size, size)),
        directed=False,
        indices=graph.viewpoints.index(graph.nearest(*goal)),
        return_predecessors=True,
    )
    return {
        each.id: graph.viewpoints[link].id
        for each, link in zip(graph.viewpoints, before.tolist(), strict=True)
        if link >= 0
    }


def model_that_knows(
    graph: NavigationGraph, goal: tuple[float, float]
) -> ScriptedLanguageModel:
    """A stand-in for a model that always takes the way an oracle would."""
    onward = next_viewpoints(graph, goal)

    def reply(request: CompletionRequest) -> str:
        here = HERE.findall(request.messages[-1].content)[-1]
        if here not in onward:
            return "Thought: There.\nFinal Answer: arrived"
        return f'Thought: On.\nAction: go_to_viewpoint\nAction Input: "{onward[here]}"'

    return ScriptedLanguageModel(reply, name="oracle")


def on_graph(settings: RunDefinition) -> RunDefinition:
    return replace(settings, needs=("graph", "language_model"))


def run(episode: Episode, plan: RunPlan, **options: Any) -> EpisodeRun:
    arena = Arena(plan.sites[episode.instruction.site])
    model = model_that_knows(graph_of(arena.scene), episode.goal)
    agent = NavGPTAgent(NavGPTOptions(**options), model)
    return run_episode(agent, episode, arena, on_graph(plan.settings))


def notes(done: EpisodeRun, about: str) -> list[Mapping[str, Any]]:
    return [
        entry.details
        for entry in done.trace
        if isinstance(entry, NoteEntry) and entry.about == about
    ]


def test_it_follows_the_graphs_of_tiny_sites_to_their_goals(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    plan = tiny_plan("oracle")
    for episode in plan.episodes:
        done = run(episode, plan)
        result = done.result
        assert (result.stopped_by, result.success) == ("agent", True)
        assert result.collisions == 0
        assert result.agent == "navgpt[oracle]+fair"
        [counts] = notes(done, "navgpt")
        assert counts["moves"] == len(notes(done, "move")) == result.model_calls - 1
        assert len(notes(done, "observation")) == result.model_calls


def test_the_same_seed_gives_the_same_walk(tiny_plan: Callable[..., RunPlan]) -> None:
    plan = tiny_plan("oracle")
    once, again = (run(plan.episodes[0], plan) for _ in range(2))
    assert once.trajectory.poses == again.trajectory.poses
    assert once.trace == again.trace


@pytest.fixture(scope="module")
def long_route() -> tuple[RunPlan, Episode]:
    """Route R2 of the university, 156.68 m."""
    plan = plan_run(AgentSettings("oracle"))
    episode = next(
        each
        for each in plan.episodes
        if (each.instruction.site, each.instruction.reference_route)
        == ("university", "route_r2_reference")
    )
    return plan, episode


def test_the_fair_budget_lets_university_r2_be_finished(
    long_route: tuple[RunPlan, Episode],
) -> None:
    plan, episode = long_route
    done = run(episode, plan)
    assert (done.result.stopped_by, done.result.success) == ("agent", True)
    [counts] = notes(done, "navgpt")
    assert 65 <= counts["requests"] <= 80
    assert counts["iterations"] == 144


def test_the_released_budget_does_not(long_route: tuple[RunPlan, Episode]) -> None:
    plan, episode = long_route
    done = run(episode, plan, budget="released")
    assert (done.result.stopped_by, done.result.success) == ("budget", False)
    assert done.result.model_calls == 10
    assert done.result.spd > 100


def test_the_budget_is_the_same_for_every_route_of_a_site(
    builtin_sites: dict[str, Any],
) -> None:
    site = builtin_sites["university"]
    limits = fair_limits(site.routes)
    assert limits.requests == 2 * (math.ceil(159.5 / 2.25) + 1)
    assert len({route.length for route in site.routes}) > 1


def test_a_vision_model_describes_what_an_agent_on_a_graph_sees(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    plan = tiny_plan("oracle")
    episode = plan.episodes[0]
    arena = Arena(plan.sites[episode.instruction.site])
    said = json.dumps({"views": ["A wall."] * 8, "summary": "A hall."})
    captions = VisionCaptions(
        ScriptedLanguageModel(lambda _: said, name="eyes"),
        lambda *_: (Picture(b"\xff\xd8\xff", "image/jpeg"),) * 8,
    )
    agent = NavGPTAgent(
        NavGPTOptions(captions="vision"),
        model_that_knows(graph_of(arena.scene), episode.goal),
    )
    settings = on_graph(plan.settings)
    done = run_episode(agent, episode, arena, settings, captions=captions)
    assert done.result.success
    assert {each["described_by"] for each in notes(done, "observation")} == {"eyes"}


@pytest.mark.parametrize("captions", ["templates", "vision"])
def test_options_of_an_agent_say_who_describes(captions: str) -> None:
    model = ModelSettings(model="m", base_url="http://127.0.0.1:9/v1")
    agent = AgentSettings("navgpt", options=(("captions", captions),))
    ready = choose_agent(agent, model).make()
    assert (ready.captions is None) == (captions == "templates")


def test_nothing_that_the_model_is_told_gives_the_answers_away(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    plan = tiny_plan("oracle")
    episode = plan.episodes[0]
    arena = Arena(plan.sites[episode.instruction.site])
    model = model_that_knows(graph_of(arena.scene), episode.goal)
    settings = replace(on_graph(plan.settings), seed=3)
    run_episode(NavGPTAgent(NavGPTOptions(), model), episode, arena, settings)
    told = "\n".join(
        message.content for request in model.requests for message in request.messages
    )
    assert episode.instruction.text in told
    for answer in (episode.instruction.reference_route, episode.id, "goal"):
        assert answer not in told
