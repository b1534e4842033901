"""A model writes one program before the walk, and the robot runs that."""

import numpy as np
import pytest

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.code_generation import CodeGenerationAgent
from memorymaze.errors import EpisodeOver, LanguageModelError, ProgramError
from memorymaze.language.model import CompletionRequest
from memorymaze.language.sandbox import ProgramLimits
from memorymaze.language.scripted_model import ScriptedLanguageModel
from memorymaze.robot.api import MoveResult
from memorymaze.robot.specification import API_NAMES, api_specification

TEXT = "Well, go on a bit, and then, hm, you are there."
STEPS = """Thought: a bit, then the goal.
First steps:
1. Go straight.
Second thought: the stop is missing.
Refined steps:
1. Go about 2 m.
2. Stop.
"""
PROGRAM = """Thought: 2 m.
First program:
```python
move_forward(1)
```
Second thought: it is 2 m.
Refined program:
```python
print("off we go")
move_forward(2)
stop()
```
"""


class Walker:
    """A robot with a long corridor in front of it."""

    def __init__(self) -> None:
        self.calls: list[object] = []

    def move_forward(self, distance: float) -> MoveResult:
        self.calls.append(distance)
        return MoveResult(distance, "done")

    def stop(self) -> None:
        self.calls.append("stop")
        raise EpisodeOver("agent")


@pytest.fixture
def robot() -> Walker:
    return Walker()


@pytest.fixture
def journal() -> Journal:
    return Journal()


def follow(model: ScriptedLanguageModel, robot: Walker, journal: Journal, **options):
    agent: Agent = CodeGenerationAgent(model, **options)
    agent.follow(TEXT, robot, journal, np.random.default_rng(0))


def test_a_description_becomes_steps_and_steps_a_program(robot, journal):
    model = ScriptedLanguageModel([STEPS, PROGRAM])

    with pytest.raises(EpisodeOver, match="agent"):
        follow(model, robot, journal)

    assert robot.calls == [2.0, "stop"]
    parsing, writing = model.requests
    assert [message.role for message in parsing.messages] == ["system", "user"]
    assert parsing.messages[1].content == f'Description:\n"""\n{TEXT}\n"""'
    assert writing.messages[1].content == 'Way:\n"""\n1. Go about 2 m.\n2. Stop.\n"""'
    assert api_specification().strip() in writing.messages[0].content
    assert (parsing.temperature, parsing.seed) == (0.0, None)


def test_without_the_parser_the_description_itself_becomes_a_program(robot, journal):
    model = ScriptedLanguageModel([PROGRAM])

    with pytest.raises(EpisodeOver):
        follow(model, robot, journal, parser=False)

    assert model.requests[0].messages[1].content == f'Way:\n"""\n{TEXT}\n"""'
    assert journal.model_calls == 1
    assert robot.calls == [2.0, "stop"]


def test_the_journal_keeps_what_was_thought_and_spent(robot, journal):
    with pytest.raises(EpisodeOver):
        follow(ScriptedLanguageModel([STEPS, PROGRAM]), robot, journal)

    kinds = [note["kind"] for note in journal.notes]
    assert kinds == ["model_reply", "steps", "model_reply", "program", "print"]
    assert journal.notes[0]["stage"] == "parse"
    assert journal.notes[0]["text"] == STEPS
    assert journal.notes[1]["steps"] == ["Go about 2 m.", "Stop."]
    assert journal.notes[2]["stage"] == "program"
    assert journal.notes[3]["program"] == (
        'print("off we go")\nmove_forward(2)\nstop()\n'
    )
    assert journal.notes[4]["text"] == "off we go\n"
    assert journal.model_calls == 2
    spent = (journal.notes[0], journal.notes[2])
    assert journal.tokens == sum(
        note["prompt_tokens"] + note["completion_tokens"] for note in spent
    )
    assert journal.tokens > 1000


def test_the_model_is_not_asked_once_the_robot_moves(robot, journal):
    model = ScriptedLanguageModel([STEPS, PROGRAM])
    asked_before_moving: list[int] = []
    robot.move_forward = lambda distance: (  # type: ignore[method-assign]
        asked_before_moving.append(len(model.requests)) or MoveResult(distance, "done")
    )

    with pytest.raises(EpisodeOver):
        follow(model, robot, journal)

    assert asked_before_moving == [2]
    assert len(model.requests) == 2


@pytest.mark.parametrize(
    ("replies", "asked", "message", "kinds"),
    [
        (["I can't."], 1, "no numbered list of steps", ["model_reply"]),
        (
            [STEPS, "Sure, I would turn left."],
            2,
            "no program in it",
            ["model_reply", "steps", "model_reply"],
        ),
        ([], 1, "has 0 replies", []),
    ],
    ids=["no steps", "no program", "no reply"],
)
def test_an_unusable_reply_is_a_model_error_and_is_kept(
    replies, asked, message, kinds, robot, journal
):
    with pytest.raises(LanguageModelError, match=message):
        follow(ScriptedLanguageModel(replies), robot, journal)

    assert [note["kind"] for note in journal.notes] == kinds
    assert journal.model_calls == asked
    assert robot.calls == []


def test_a_wrong_program_is_a_program_error_with_its_line(robot, journal):
    wrong = PROGRAM.replace("move_forward(2)", "move_forward('2 m')")

    with pytest.raises(ProgramError) as caught:
        follow(ScriptedLanguageModel([STEPS, wrong]), robot, journal)

    assert (caught.value.line, caught.value.unsafe) == (2, False)
    assert robot.calls == []


def test_limits_hold_for_the_program(robot, journal):
    endless = PROGRAM.replace("stop()", "while True: move_forward(1)")

    with pytest.raises(EpisodeOver, match="budget"):
        follow(
            ScriptedLanguageModel([STEPS, endless]),
            robot,
            journal,
            limits=ProgramLimits(calls=10),
        )

    assert len(robot.calls) == 10


def test_the_name_tells_model_and_parser():
    model = ScriptedLanguageModel([], name="gpt-4")

    assert CodeGenerationAgent(model).name == "code_generation[gpt-4]+parser"
    assert CodeGenerationAgent(model, parser=False).name == "code_generation[gpt-4]"


def test_an_instruction_cannot_fill_slots_of_the_prompt(robot, journal):
    seen: list[str] = []

    def answer(request: CompletionRequest) -> str:
        seen.append(request.messages[-1].content)
        return PROGRAM

    agent = CodeGenerationAgent(ScriptedLanguageModel(answer), parser=False)
    with pytest.raises(EpisodeOver):
        agent.follow("{API_SPECIFICATION}", robot, journal, np.random.default_rng(0))

    assert seen == ['Way:\n"""\n{API_SPECIFICATION}\n"""']
    assert all(name in api_specification() for name in API_NAMES)
