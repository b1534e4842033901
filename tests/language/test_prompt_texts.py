"""The prompts hold what they promise, and nothing of the benchmark's buildings."""

import re
from collections.abc import Callable

import pytest

from memorymaze.agents.code_generation.replies import read_program, read_steps
from memorymaze.errors import EpisodeOver
from memorymaze.instructions.files import load_instructions
from memorymaze.language.prompt_texts import load_prompt
from memorymaze.language.sandbox import run_program
from memorymaze.robot.specification import api_specification
from memorymaze.sites import load_sites

PARSING = load_prompt("parse_instruction", answer=load_prompt("answer_steps"))
WRITING = load_prompt(
    "write_program",
    api_specification=api_specification(),
    answer=load_prompt("answer_program"),
)


def programs() -> list[str]:
    """The programs of the examples: first and refined ones."""
    return re.findall(r"program:\n```python\n(.*?)```", WRITING, re.S)


def test_the_prompt_for_programs_quotes_the_whole_api():
    assert api_specification() in WRITING


def test_an_unfilled_slot_and_a_missing_prompt_are_errors():
    with pytest.raises(KeyError, match="api_specification"):
        load_prompt("write_program", answer="")
    with pytest.raises(FileNotFoundError):
        load_prompt("write_poem")


def test_the_examples_are_in_the_format_they_ask_for():
    steps = read_steps(PARSING)
    assert [step.split()[0] for step in steps] == ["Follow", "Go", "Go", "Turn", "Go"]
    assert read_program(WRITING) == programs()[-1]
    assert len(programs()) == 4


@pytest.mark.parametrize("number", range(4))
def test_each_example_program_runs_and_stops_by_itself(
    number: int, make_robot: Callable
):
    robot = make_robot(call_budget=2000)
    doubts: list[dict[str, object]] = []

    with pytest.raises(EpisodeOver) as over:
        run_program(programs()[number], robot, on_event=doubts.append)

    assert over.value.stopped_by == "agent"
    assert robot.names[-1] == "stop"
    assert doubts == []


def test_no_words_of_the_benchmarks_buildings_are_in_the_prompts():
    prompts = f"{PARSING}\n{WRITING.replace(api_specification(), '')}".lower()
    names = {
        name.lower()
        for site in load_sites().values()
        for thing in (*site.rooms, *site.corridors, *site.areas, *site.landmarks)
        for name in (thing.name,)
        if name and len(name) > 3
    }
    names |= {
        route.goal.lower() for site in load_sites().values() for route in site.routes
    }

    assert len(names) > 100
    assert {
        name for name in names if re.search(rf"\b{re.escape(name)}\b", prompts)
    } == set()


def test_the_prompts_take_nothing_from_texts_that_are_evaluated():
    prompts = words(PARSING + WRITING)
    for told in load_instructions():
        text = words(told.text).split()
        runs = (" ".join(text[at : at + 8]) for at in range(len(text) - 7))
        assert told.split == "dev" or not any(run in prompts for run in runs), told.id


def words(text: str) -> str:
    return " ".join(re.findall(r"[a-z0-9]+", text.lower()))
