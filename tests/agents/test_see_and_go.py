"""The agent that sees: what it shows a model, what it does, and how it ends."""

import base64
import io
import json
import math
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from memorymaze.agents import see_and_go
from memorymaze.agents.agent import Journal
from memorymaze.agents.see_and_go import SeeAndGoAgent, SeeAndGoOptions
from memorymaze.basics.errors import EpisodeOver, LanguageModelError, SettingsError
from memorymaze.language.models.answers import AboutInstruction
from memorymaze.language.models.model import CompletionRequest
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.budgets import fair_limits
from memorymaze.runs.episodes.episode import EpisodeRun
from memorymaze.runs.episodes.navigation import navigate
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.episodes.trace_entries import NoteEntry
from memorymaze.world.sites import Site

AHEAD = '{"reason": "The way is free.", "action": "forward", "amount": 100}'
LEFT = '{"reason": "It goes on there.", "action": "left", "amount": 90}'
BACK = '{"reason": "It was behind me.", "action": "left", "amount": 180}'
STOP = '{"reason": "There it is.", "action": "stop"}'

Walk = Callable[..., tuple[str, list[dict[str, Any]]]]


@pytest.fixture
def blind_robot(corridor_site: Site) -> SimulatedRobot:
    """A robot in the corridor that takes black pictures, at once."""
    settings = SimulationSettings(time_budget=600.0)
    start = corridor_site.routes[0].start
    robot = SimulatedRobot(build_scene(corridor_site), start, settings)
    black = SimpleNamespace(rgb=np.zeros((480, 640, 3), np.uint8))
    robot.camera_picture = lambda *_: black  # type: ignore[method-assign]
    return robot


@pytest.fixture
def follow(blind_robot: SimulatedRobot) -> Callable[..., str]:
    """Follow with a scripted model, on the site's budget; return what ended it."""

    def walk(model: ScriptedLanguageModel, **options: Any) -> str:
        agent = SeeAndGoAgent(SeeAndGoOptions(**options), model)
        journal = Journal(limits=fair_limits(blind_robot.scene.site.routes))
        with pytest.raises(EpisodeOver) as over:
            agent.follow("To the door.", blind_robot, journal, np.random.default_rng(0))
        return over.value.stopped_by

    return walk


def task(request: CompletionRequest) -> str:
    """What the model was told about its task."""
    return request.messages[1].content


def test_the_model_is_told_what_came_of_its_moves(
    follow: Callable[..., str], blind_robot: SimulatedRobot
) -> None:
    model = ScriptedLanguageModel([AHEAD, LEFT, AHEAD, AHEAD, STOP])
    assert follow(model) == "agent"
    assert '"""\nTo the door.\n"""' in task(model.requests[0])
    assert "the oldest first:\n(none)" in task(model.requests[0])
    assert [len(request.messages[1].pictures) for request in model.requests] == [1] * 5
    told = [line for line in task(model.requests[4]).splitlines() if line[:1] == "-"]
    assert told[0] == f"- {AHEAD} The robot went 100 cm."
    assert told[1] == f"- {LEFT} The robot turned left by 90 degrees."
    assert told[3].endswith("cm, where something is in the way.")
    assert blind_robot.pose.heading == pytest.approx(math.pi / 2, abs=0.1)


def test_only_the_last_moves_are_told(follow: Callable[..., str]) -> None:
    model = ScriptedLanguageModel([AHEAD, LEFT, LEFT, STOP])
    follow(model, memory=2)
    assert "went 100 cm" in task(model.requests[2])
    assert "went 100 cm" not in task(model.requests[3])


def test_a_reply_that_is_no_move_is_asked_for_once_more(
    follow: Callable[..., str],
) -> None:
    model = ScriptedLanguageModel(["Straight on, I think.", STOP])
    assert follow(model) == "agent"
    assert [message.role for message in model.requests[1].messages][2:] == [
        "assistant",
        "user",
    ]
    assert "no command with an amount" in model.requests[1].messages[-1].content


def test_two_replies_that_are_no_moves_are_an_error_with_its_name(
    follow: Callable[..., str],
) -> None:
    model = ScriptedLanguageModel(["Hm.", "Forward!"], name="small-vlm")
    with pytest.raises(
        LanguageModelError, match="small-vlm: no move in 2 replies: the"
    ):
        follow(model)
    assert len(model.requests) == 2


def test_the_budget_is_that_of_navgpt_on_the_site(follow: Callable[..., str]) -> None:
    model = ScriptedLanguageModel([AHEAD, BACK] * 50)
    assert follow(model) == "budget"
    # Two for each of the 8 viewpoints along the 14.5 m of the longest route.
    assert len(model.requests) == 16


def test_a_second_question_counts_against_the_budget(
    follow: Callable[..., str],
) -> None:
    model = ScriptedLanguageModel(["Hm.", AHEAD, "Hm.", AHEAD])
    assert follow(model, requests=3) == "budget"
    assert len(model.requests) == 3


def test_who_only_turns_is_stuck(follow: Callable[..., str]) -> None:
    model = ScriptedLanguageModel([AHEAD] + [LEFT] * 50)
    assert follow(model, failures=4) == "stuck"
    assert len(model.requests) == 5


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"requests": 0}, "requests: expected a whole number of at least 1, got 0"),
        ({"failures": 0}, "failures: expected a whole number of at least 1"),
        ({"memory": -1}, "memory: expected a whole number of at least 0, got -1"),
        (
            {"temperature": math.nan},
            "temperature: expected a number of at least 0, got nan",
        ),
    ],
)
def test_options_without_meaning_are_refused(
    options: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        SeeAndGoOptions(**options)


def test_a_model_that_sees_nothing_is_refused_before_the_run() -> None:
    model = ScriptedLanguageModel([])
    blind = SimpleNamespace(name="m", complete=model.complete, takes_pictures=False)
    with pytest.raises(SettingsError, match=r"see no pictures; .* \(--base-url\)$"):
        SeeAndGoAgent(SeeAndGoOptions(), AboutInstruction(blind, "a"))


def looks_and_says(request: dict[str, Any]) -> str:
    """Stop before much red; turn left where something is in the way; else go on."""
    told, shown = request["messages"][1]["content"]
    data = shown["image_url"]["url"].partition("base64,")[2]
    picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))), float)
    red, green, blue = (picture[..., channel] for channel in range(3))
    if np.mean((red > 1.8 * green) & (red > 1.8 * blue) & (red > 60)) > 0.04:
        return STOP
    halted = told["text"].rpartition("\n- ")[2].count("something is in the way")
    return LEFT if halted else AHEAD.replace("100", "300")


@pytest.fixture
def vision_server(
    chat_server: Callable[..., tuple[str, list[dict[str, Any]]]],
) -> tuple[str, list[dict[str, Any]]]:
    """A server of a model that answers by what it sees, and what it was asked."""
    return chat_server(looks_and_says, model="sees-red", tokens=(9, 1))


def test_a_model_on_a_server_sees_its_way_and_a_replay_needs_no_server(
    l_site: Site, vision_server: tuple[str, list[dict[str, Any]]], tmp_path: Path
) -> None:
    address, requests = vision_server
    text, store = "To the red vending machine.", str(tmp_path / "replies.jsonl")
    asking = ModelSettings(model="sees-red", base_url=address, record=store)

    run = navigate(
        l_site,
        l_site.routes[0],
        text,
        AgentSettings("see_and_go", language_model=asking),
    )

    assert (run.result.agent, run.result.stopped_by) == (
        "see_and_go[sees-red]",
        "agent",
    )
    assert run.result.success
    assert run.result.model_calls == len(requests)
    moves = [
        entry.details["done"]
        for entry in run.trace
        if isinstance(entry, NoteEntry) and entry.about == "move"
    ]
    assert "The robot turned left by 90 degrees." in moves

    asked = len(requests)
    replaying = ModelSettings(model="sees-red", replay=store)
    again = navigate(
        l_site,
        l_site.routes[0],
        text,
        AgentSettings("see_and_go", language_model=replaying),
    )
    assert (again.trace, again.trajectory) == (run.trace, run.trajectory)
    assert len(requests) == asked


def test_its_file_alone_copied_out_of_the_package_is_an_agent_of_ones_own(
    l_site: Site, vision_server: tuple[str, list[dict[str, Any]]], tmp_path: Path
) -> None:
    address, requests = vision_server
    copy = shutil.copy(see_and_go.__file__, tmp_path / "my_agent.py")
    text, store = "To the red vending machine.", str(tmp_path / "replies.jsonl")
    asking = ModelSettings(model="sees-red", base_url=address, record=store)
    ours, mine = "see_and_go", f"{copy}:SeeAndGoAgent"
    options = (("memory", "5"),)

    def walk(name: str, model: ModelSettings) -> EpisodeRun:
        agent = AgentSettings(name, options=options, language_model=model)
        return navigate(l_site, l_site.routes[0], text, agent)

    recorded = walk(mine, asking)
    asked = len(requests)
    replaying = ModelSettings(model="sees-red", replay=store)
    replayed, shipped = walk(mine, replaying), walk(ours, replaying)
    assert recorded.result.success
    assert recorded.result.agent == "see_and_go[sees-red]+memory=5"
    assert recorded.result.model_calls == asked == len(requests)
    assert replayed.trace == shipped.trace == recorded.trace


def test_answers_in_a_file_are_found_by_their_numbers(
    l_site: Site, tmp_path: Path
) -> None:
    route, file = l_site.routes[0], tmp_path / "answers.jsonl"
    told = {"instruction_id": f"l_shape-{route.id}", "stage": "move"}
    answers = [{**told, "number": 2, "reply": STOP}, {**told, "reply": AHEAD}]
    file.write_text("\n".join(map(json.dumps, answers)), encoding="utf-8")
    replaying = ModelSettings(replay=str(file))

    run = navigate(
        l_site, route, "Go on.", AgentSettings("see_and_go", language_model=replaying)
    )

    assert run.result.agent == "see_and_go[answers]"
    assert (run.result.stopped_by, run.result.error) == ("agent", None)
    assert run.trajectory.length == pytest.approx(1.0, abs=0.05)
