"""Runs on answers that were given before, and what they leave open."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.agent import prompt_versions
from memorymaze.agents.code_generation import (
    CodeGenerationOptions,
    CodeGenerationRequests,
)
from memorymaze.agents.plan_readers import ReaderOptions
from memorymaze.basics.errors import AnswerFileError, SettingsError
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.answers import AboutInstruction, RecordingModel
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.models.spending import TokenPrice
from memorymaze.runs.episodes.agent_catalogue import agent_names, choose_agent
from memorymaze.runs.episodes.open_requests import open_requests, remarks_on
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.settings import AgentSettings, differences
from memorymaze.runs.work.driver import run_plan
from memorymaze.texts.corpus import load_corpus
from memorymaze.texts.corpus.files import load_instructions

TINY_INSTRUCTIONS = Path(__file__).parents[2] / "tiny_instructions.jsonl"
IDS = [each.id for each in load_instructions([TINY_INSTRUCTIONS])]
UNPARSED = CodeGenerationOptions(parser=False)
PARSED = (("parser", "true"),)
BY_HAND = {"stage": "program", "reply": "move_forward(3)\nstop()"}


@pytest.fixture
def file(tmp_path: Path) -> Callable[..., Path]:
    """Write a record for each tiny instruction, changed for some."""

    def write(changed: dict[str, dict[str, Any]] | None = None, **fields: Any) -> Path:
        path = tmp_path / "answers.jsonl"
        records = [
            {
                "instruction_id": each,
                **BY_HAND,
                **fields,
                **(changed or {}).get(each, {}),
            }
            for each in IDS
        ]
        path.write_text("\n".join(map(json.dumps, records)), encoding="utf-8")
        return path

    return write


@pytest.fixture
def plan(tiny_sites_folder: Path) -> Callable[..., RunPlan]:
    """Plan a run on the tiny instructions that takes answers."""

    def make(
        answers: Path,
        name: str = "code_generation",
        options: tuple[tuple[str, str], ...] = (),
        model: str | None = None,
        **changes: Any,
    ) -> RunPlan:
        asked = ModelSettings(model=model, replay=str(answers), **changes)
        return plan_run(
            AgentSettings(name, options=options, language_model=asked),
            load_corpus([TINY_INSTRUCTIONS], sites=tiny_sites_folder),
        )

    return make


def test_programs_by_hand_run_without_a_parser_and_without_an_inference(
    file: Callable[..., Path], plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    planned = plan(file())
    assert dict(planned.settings.option_values)["parser"] == "false"
    results = run_plan(planned, tmp_path / "run", workers=1)
    assert {(one.agent, one.stopped_by, one.model_calls) for one in results} == {
        ("code_generation[answers]", "agent", 0)
    }
    assert all(2 < one.path_length < 4 for one in results)


def test_replies_are_counted_at_the_prices_given(
    file: Callable[..., Path], plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    said = {"model": "m", "prompt_tokens": 100, "latency_s": 2.0}
    planned = plan(file(**said), price=TokenPrice(1.0, 2.0))
    [one, *_] = run_plan(planned, tmp_path / "run", workers=1)
    assert (one.model_calls, one.tokens, one.inference_s) == (1, 100, 2.0)
    assert one.cost_usd == pytest.approx(100 / 1e6)
    assert one.standing_s == pytest.approx(2.0, abs=0.1)


def test_the_run_says_to_which_prompt_answers_were_given(
    file: Callable[..., Path], plan: Callable[..., RunPlan]
) -> None:
    now = prompt_versions([CodeGenerationRequests(UNPARSED).program("")])["program"]
    answers = {"reply": "```\nstop()\n```", "prompt": now}
    older = {IDS[0]: {"prompt": "0123456789ab"}, IDS[1]: {"prompt": None}}
    taken = plan(file(**answers)).settings.answers
    assert taken is not None
    assert (taken.other_prompt, taken.unknown_prompt) == (0, 0)
    taken = plan(file(older, **answers)).settings.answers
    assert taken is not None
    assert (taken.other_prompt, taken.unknown_prompt) == (1, 1)
    assert "those to 1 instruction were given to ANOTHER VERSION" in str(taken)
    assert "1 instruction do not say to which version" in str(taken)


def test_an_instruction_without_an_answer_is_told_before_the_run(
    file: Callable[..., Path], plan: Callable[..., RunPlan]
) -> None:
    path = file()
    path.write_text(path.read_text(encoding="utf-8").splitlines()[0], encoding="utf-8")
    with pytest.raises(AnswerFileError, match=r"none for 11: p2-1, .*, …;"):
        plan(path)


def test_changed_answers_are_another_run(
    file: Callable[..., Path], plan: Callable[..., RunPlan]
) -> None:
    before = plan(file()).settings
    after = plan(file(reply="stop()")).settings
    assert [each.name for each in differences(before, after)] == ["answers.sha256"]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"record": "x"}, "--replay and --record"),
        ({"base_url": "http://localhost:1/v1"}, "--replay and --base-url"),
        ({"name": "guide"}, "'guide' asks no language model"),
    ],
)
def test_answers_beside_what_asks_are_refused(
    file: Callable[..., Path],
    plan: Callable[..., RunPlan],
    changes: dict[str, Any],
    said: str,
) -> None:
    with pytest.raises(SettingsError, match=said):
        plan(file(), **changes)


def test_what_is_known_of_programs_before_they_run_is_told(
    file: Callable[..., Path], plan: Callable[..., RunPlan]
) -> None:
    path = file({
        IDS[1]: {"reply": "turns = turn('left')\nwalk()"},
        IDS[2]: {"reply": "stop()\nimport numpy"},
        IDS[3]: {"reply": None, "error": "It refused."},
    })
    with path.open("a", encoding="utf-8") as lines:
        lines.write("\n" + json.dumps({"instruction_id": "x", **BY_HAND, "hue": "red"}))
    said = [
        (each.kind, each.text.removeprefix(str(path)))
        for each in remarks_on(plan(path))
    ]
    assert (
        "crash",
        f":2: {IDS[1]}: line 2: Name `walk` used when not defined "
        "[unresolved-reference]",
    ) in said
    [outside] = [text for kind, text in said if kind == "unsafe"]
    assert outside.startswith(f":3: {IDS[2]}: line 2: Cannot resolve")
    assert ("model_error", f":4: {IDS[3]}: It refused.") in said
    assert ("note", ":13: 'x' is the id of no instruction; not used") in said
    assert ("note", ": fields that are not used: 'hue'") in said


def test_the_next_request_of_each_episode_is_open(
    plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    path = tmp_path / "answers.jsonl"
    AnswerFile(path, make=True)
    asked = list(open_requests(plan(path, options=PARSED, model="m")))
    stages = [each.question and each.question.stage for each in asked]
    assert stages == ["parse+parser"] * 12

    model = RecordingModel(ScriptedLanguageModel(lambda _: "1. Go.", name="m"), path)
    about = AboutInstruction(model, IDS[0])
    about.complete(asked[0])
    planned = plan(path, options=PARSED, model="m")
    assert planned.settings.answers is not None
    assert planned.settings.answers.missing == 11
    stages = [e.question and e.question.stage for e in open_requests(planned)]
    same = [request.messages == asked[0].messages for request in asked]
    assert stages == ["program+parser" if each else "parse+parser" for each in same]


READING = (("reader", "model"),)
ASKING_BEFOREHAND = [
    *(
        pytest.param(name, {"options": READING}, "plan", id=name)
        for name in agent_names()
        if isinstance(choose_agent(name).recipe.options, ReaderOptions)
    ),
    pytest.param("code_generation", {"options": PARSED}, "parse", id="steps first"),
    pytest.param(
        "code_generation", {"options": (("parser", "false"),)}, "program", id="programs"
    ),
]


@pytest.mark.parametrize(("name", "settings", "stage"), ASKING_BEFOREHAND)
def test_every_agent_that_asks_beforehand_has_a_request_open_for_each_instruction(
    plan: Callable[..., RunPlan],
    tmp_path: Path,
    name: str,
    settings: dict[str, Any],
    stage: str,
) -> None:
    """Of an agent with several stages the first: the next rests on its answer."""
    path = tmp_path / "answers.jsonl"
    AnswerFile(path, make=True)
    asked = [
        each.question for each in open_requests(plan(path, name, model="m", **settings))
    ]
    assert [each and each.instruction for each in asked] == IDS
    assert {each and each.stage.partition("+")[0] for each in asked} == {stage}


def test_an_agent_that_asks_on_the_way_is_followed_to_its_open_request(
    plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    path = tmp_path / "answers.jsonl"
    AnswerFile(path, make=True)
    planned = plan(path, "navgpt", model="m")
    planned = replace(planned, episodes=planned.episodes[:1])
    [first] = open_requests(planned)
    viewpoint = next(
        each[:32]
        for each in first.messages[-1].content.split("Viewpoints: ")[1:]
        if not each.startswith("none")
    )
    reply = f"Action: go_to_viewpoint\nAction Input: {viewpoint}"
    model = RecordingModel(ScriptedLanguageModel([reply], name="m"), path)
    AboutInstruction(model, planned.episodes[0].instruction.id).complete(first)

    planned = replace(plan(path, "navgpt"), episodes=planned.episodes)
    [second] = open_requests(planned)
    assert second.question is not None
    assert (second.question.stage, second.question.number) == ("step", 2)
