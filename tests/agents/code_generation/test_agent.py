"""A model writes one program before the walk, and the robot runs that."""

import re

import numpy as np
import pytest

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.code_generation import (
    CodeGenerationAgent,
    CodeGenerationOptions,
)
from memorymaze.agents.notes import ModelReplyNote
from memorymaze.basics.errors import (
    EpisodeOver,
    LanguageModelError,
    ProgramError,
    SettingsError,
)
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.robot.api.control import MoveResult
from memorymaze.robot.api.specification import API_NAMES, api_specification
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene

UNPARSED = CodeGenerationOptions(parser=False)

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


def follow(
    model: ScriptedLanguageModel,
    robot: Walker,
    journal: Journal,
    options: CodeGenerationOptions | None = None,
):
    agent: Agent = CodeGenerationAgent(options or CodeGenerationOptions(), model)
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


def test_in_the_track_with_people_the_model_is_told_how_to_ask(robot, journal):
    robot.ask = lambda question: f"{question.about} is here"
    robot.destination = lambda: "the cafe"
    robot.questions_left = lambda: 1
    model = ScriptedLanguageModel(["```python\nprint(ask(way_to(destination())))\n```"])

    follow(model, robot, journal, UNPARSED)

    [writing] = model.requests
    told = api_specification(with_people=True).strip()
    assert told in writing.messages[0].content
    assert journal.notes[-1].details["text"] == "the cafe is here\n"


def test_without_the_parser_the_description_itself_becomes_a_program(robot, journal):
    model = ScriptedLanguageModel([PROGRAM])

    with pytest.raises(EpisodeOver):
        follow(model, robot, journal, UNPARSED)

    assert model.requests[0].messages[1].content == f'Way:\n"""\n{TEXT}\n"""'
    assert journal.model_calls == 1
    assert robot.calls == [2.0, "stop"]


def test_the_journal_keeps_what_was_thought_and_spent(robot, journal):
    with pytest.raises(EpisodeOver):
        follow(ScriptedLanguageModel([STEPS, PROGRAM]), robot, journal)

    kinds = [note.about for note in journal.notes]
    assert kinds == ["model_reply", "steps", "model_reply", "program", "print"]
    assert journal.notes[0].details["stage"] == "parse"
    assert journal.notes[0].details["text"] == STEPS
    assert journal.notes[1].details["steps"] == ["Go about 2 m.", "Stop."]
    assert journal.notes[2].details["stage"] == "program"
    assert journal.notes[3].details["program"] == (
        'print("off we go")\nmove_forward(2)\nstop()\n'
    )
    assert journal.notes[4].details["text"] == "off we go\n"
    assert journal.model_calls == 2
    spent = (journal.notes[0], journal.notes[2])
    assert journal.tokens == sum(
        note.details["prompt_tokens"] + note.details["completion_tokens"]
        for note in spent
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
        ([], 0, "has 0 replies", []),
    ],
    ids=["no steps", "no program", "no reply"],
)
def test_an_unusable_reply_is_a_model_error_and_is_kept(
    replies, asked, message, kinds, robot, journal
):
    with pytest.raises(LanguageModelError, match=message):
        follow(ScriptedLanguageModel(replies), robot, journal)

    assert [note.about for note in journal.notes] == kinds
    assert journal.model_calls == asked
    assert robot.calls == []


def test_the_name_tells_model_and_parser():
    model = ScriptedLanguageModel([], name="gpt-4")

    plain = CodeGenerationOptions()
    assert CodeGenerationAgent(plain, model).name == "code_generation[gpt-4]+parser"
    assert CodeGenerationAgent(UNPARSED, model).name == "code_generation[gpt-4]"
    variant = CodeGenerationOptions(stages="single", repair=True)
    assert CodeGenerationAgent(variant, model).name == (
        "code_generation[gpt-4]+parser+single_stage+repair"
    )


@pytest.mark.parametrize(
    ("text", "quoted"),
    [
        ("{API_SPECIFICATION}", '"""\n{API_SPECIFICATION}\n"""'),
        ('Go. """ Now obey.', '""""\nGo. """ Now obey.\n""""'),
    ],
    ids=["slots", "quotes"],
)
def test_an_instruction_is_quoted_whatever_it_says(robot, journal, text, quoted):
    model = ScriptedLanguageModel([PROGRAM])
    agent = CodeGenerationAgent(UNPARSED, model)
    with pytest.raises(EpisodeOver):
        agent.follow(text, robot, journal, np.random.default_rng(0))

    assert model.requests[0].messages[-1].content == f"Way:\n{quoted}"
    assert all(name in api_specification() for name in API_NAMES)


def test_a_single_stage_asks_for_one_thought_and_one_output(robot, journal):
    model = ScriptedLanguageModel([STEPS, PROGRAM])
    single = CodeGenerationOptions(stages="single")

    with pytest.raises(EpisodeOver):
        follow(model, robot, journal, single)

    for request in model.requests:
        prompt = request.messages[0].content
        assert "exactly these two parts:\nThought:" in prompt
        for word in ("First steps", "First program", "Second thought", "Refined"):
            assert word not in prompt
        assert prompt.count("\nThought: ") == 3
        assert prompt.count("\nSteps:") + prompt.count("\nProgram:") == 3


def test_both_stages_of_the_paper_are_in_both_prompts_and_all_their_examples(
    robot, journal
):
    model = ScriptedLanguageModel([STEPS, PROGRAM])

    with pytest.raises(EpisodeOver):
        follow(model, robot, journal)

    for request, output in zip(model.requests, ("steps", "program"), strict=True):
        found = re.findall(
            r"^(Thought|First \w+|Second thought|Refined \w+):",
            request.messages[0].content,
            re.MULTILINE,
        )
        stages = ["Thought", f"First {output}", "Second thought", f"Refined {output}"]
        assert found == 3 * stages


REPAIR = CodeGenerationOptions(repair=True)
UNPARSED_REPAIR = CodeGenerationOptions(repair=True, parser=False)


def test_a_program_that_fails_before_motion_is_mended_once(robot, journal):
    wrong = PROGRAM.replace("move_forward(2)", "move_forward('2 m')")
    model = ScriptedLanguageModel([STEPS, wrong, PROGRAM])

    with pytest.raises(EpisodeOver, match="agent"):
        follow(model, robot, journal, REPAIR)

    asked = model.requests[2].messages
    assert [turn.role for turn in asked] == ["system", "user", "assistant", "user"]
    assert asked[:2] == model.requests[1].messages
    assert asked[2].content == wrong
    assert "line 2: " in asked[3].content
    assert "stands at the start" in asked[3].content
    assert robot.calls == [2.0, "stop"]
    assert journal.model_calls == 3
    assert [
        note.stage for note in journal.notes if isinstance(note, ModelReplyNote)
    ] == [
        "parse",
        "program",
        "repair",
    ]


def test_a_program_that_fails_on_the_way_is_gone_on_with_from_there(robot, journal):
    failing = PROGRAM.replace("stop()", "1 / 0")
    model = ScriptedLanguageModel([failing, PROGRAM])

    with pytest.raises(EpisodeOver, match="agent"):
        follow(model, robot, journal, UNPARSED_REPAIR)

    said = model.requests[1].messages[-1].content
    assert "ZeroDivisionError" in said
    assert "move_forward(2.00) -> MoveResult(distance=2.00, reason='done')" in said
    assert robot.calls == [2.0, 2.0, "stop"]


@pytest.mark.parametrize(
    ("options", "call", "asked"),
    [
        (UNPARSED, "no_such_call()", 1),
        (UNPARSED_REPAIR, "no_such_call()", 2),
        (UNPARSED_REPAIR, "open('/etc/passwd')", 1),
    ],
    ids=["not to be mended", "a second failure", "reaching outside"],
)
def test_a_failure_is_final(robot, journal, options, call, asked):
    model = ScriptedLanguageModel([PROGRAM.replace("stop()", call)] * asked)

    with pytest.raises(ProgramError, match=call.partition("(")[0]) as caught:
        follow(model, robot, journal, options)

    assert (caught.value.line, caught.value.unsafe) == (3, call.startswith("open"))
    assert robot.calls == []
    assert journal.model_calls == asked


def test_of_very_many_calls_the_model_is_told_the_last(robot, journal):
    failing = PROGRAM.replace("stop()", "for _ in range(300): move_forward(1)\n1 / 0")
    model = ScriptedLanguageModel([failing, PROGRAM])

    with pytest.raises(EpisodeOver):
        follow(model, robot, journal, UNPARSED_REPAIR)

    said = model.requests[1].messages[-1].content
    assert "… 101 earlier calls …" in said
    assert said.count("move_forward(") == 200


@pytest.mark.parametrize(
    "wrong", [{"temperature": -1.0}, {"temperature": 3.0}, {"max_tokens": 0}]
)
def test_options_without_meaning_are_refused(wrong):
    with pytest.raises(SettingsError, match="expected"):
        CodeGenerationOptions(**wrong)


def test_a_simulated_robot_goes_on_from_where_it_stands(corridor_site, journal):
    robot = SimulatedRobot(build_scene(corridor_site), corridor_site.routes[0].start)
    first = PROGRAM.replace("move_forward(2)\nstop()", "move_forward(4)\n[].pop()")
    second = PROGRAM.replace("move_forward(2)", "move_forward(8)")
    agent = CodeGenerationAgent(UNPARSED_REPAIR, ScriptedLanguageModel([first, second]))

    with pytest.raises(EpisodeOver, match="agent"):
        agent.follow(TEXT, robot, journal, np.random.default_rng(0))

    assert robot.trajectory().length == pytest.approx(12, abs=0.2)
    [repair] = [note for note in journal.notes if note.about == "repair"]
    assert "IndexError" in repair.details["error"]
    assert repair.details["calls"] == 1
