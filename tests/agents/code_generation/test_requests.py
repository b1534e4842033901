"""What is asked belongs to a version of the prompt, and older answers still count."""

import json
from pathlib import Path

import pytest

from memorymaze.agents.agent import TOLD_AGAIN, prompt_versions
from memorymaze.agents.code_generation import (
    CodeGenerationAgent,
    CodeGenerationOptions,
    CodeGenerationRequests,
)
from memorymaze.language.models.answers import AboutInstruction, ReplayingModel
from memorymaze.language.models.model import CompletionRequest
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

OLDER = {"parse+parser": "91495d0fcebb", "program+parser": "9452669bba95"}
"""Versions of the prompts before the control API had `turn_by`."""


def requests() -> list[CompletionRequest]:
    asking = CodeGenerationRequests()
    return [asking.parse("Go left."), asking.program("1. Turn left.")]


def test_the_prompts_have_another_version_than_before() -> None:
    now = prompt_versions(requests())
    assert now.keys() == OLDER.keys()
    assert not set(now.values()) & set(OLDER.values())


@pytest.mark.parametrize("told", [True, False], ids=["told", "not told"])
def test_answers_in_a_file_to_an_older_prompt_are_found(
    tmp_path: Path, told: bool
) -> None:
    file = tmp_path / "answers.jsonl"
    with file.open("w", encoding="utf-8") as lines:
        for stage, version in OLDER.items():
            answer = {"instruction_id": "a", "stage": stage, "reply": f"To {stage}."}
            lines.write(json.dumps(answer | ({"prompt": version} if told else {})))
            lines.write("\n")
    model = AboutInstruction(ReplayingModel(file), "a")

    for request, stage in zip(requests(), OLDER, strict=True):
        assert model.complete(request).text == f"To {stage}."


def test_two_tellings_are_quoted_one_by_one_and_told_to_be_two() -> None:
    request = CodeGenerationRequests().parse(f"Go left.{TOLD_AGAIN}Go right.")
    system, task = request.messages
    assert system == CodeGenerationRequests().parse("Go left.").messages[0]
    assert 'First telling:\n"""\nGo left.\n"""\nSecond telling:\n' in task.content
    assert "after hearing what the robot can do" in task.content
    assert TOLD_AGAIN.strip() not in task.content


def test_one_telling_is_asked_about_as_ever() -> None:
    request = CodeGenerationRequests().parse("Go left.")
    assert request.messages[1].content == 'Description:\n"""\nGo left.\n"""'
    assert request.question is not None
    assert request.question.prompt == prompt_versions(requests())["parse+parser"]


def test_answers_to_one_telling_are_of_another_prompt_than_those_to_two() -> None:
    agent = CodeGenerationAgent(CodeGenerationOptions(), ScriptedLanguageModel([]))
    once, twice = (
        agent.asking(text, None).prompts for text in ("Go.", f"Go.{TOLD_AGAIN}Go.")
    )
    assert once["parse+parser"] != twice["parse+parser"]
    # A program is written from the steps, of which there is one list.
    assert once["program+parser"] == twice["program+parser"]
