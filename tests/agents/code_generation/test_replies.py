"""Steps and programs are found in replies; grammars hold replies to them."""

import random

import pytest
from tests.said_by_grammar import Sentences

from memorymaze.agents.code_generation.replies import (
    program_grammar,
    read_program,
    read_steps,
    steps_grammar,
)
from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import EpisodeOver, LanguageModelError
from memorymaze.robot.api.specification import API_NAMES

GOOD_STEPS = """Thought: left, then 2. maybe right.
First steps:
1. Go straight.
2. Turn right.
Second thought: it is left.
Refined steps:
1. Go straight.
2. Turn left.
3. Stop.
"""


@pytest.mark.parametrize(
    ("reply", "steps"),
    [
        pytest.param(
            GOOD_STEPS, ["Go straight.", "Turn left.", "Stop."], id="as asked"
        ),
        pytest.param(
            GOOD_STEPS.replace("\n", "\r\n"),
            ["Go straight.", "Turn left.", "Stop."],
            id="other line ends",
        ),
        pytest.param("1) Go.\n2) Stop.", ["Go.", "Stop."], id="only a list"),
        pytest.param(
            "Thought: first\n1. or 2. left?\n**Steps:**\n1. Go.",
            ["Go."],
            id="a single stage",
        ),
        pytest.param(
            "**Refined Steps:**\n\n**1.** Go.\n\n**2.** Stop.\n\nGood luck!",
            ["Go.", "Stop."],
            id="in bold, with gaps and a wish",
        ),
        pytest.param(
            "### Refined steps\n1. Go to the end,\n   past the desk.\n2. Stop.",
            ["Go to the end, past the desk.", "Stop."],
            id="over two lines",
        ),
        pytest.param(
            "Refined steps:\n1. Go.\n   1. slowly\n   - past a desk\n2. Stop.",
            ["Go. 1. slowly - past a desk", "Stop."],
            id="with points below",
        ),
        pytest.param(
            "First steps:\n1. A.\n2. B.\nRefined output:\n1. C.",
            ["C."],
            id="other heading",
        ),
        pytest.param(
            "First list\n1. A.\n2. B.\n\nBetter list\n1. C.\n2. D.",
            ["C.", "D."],
            id="no heading",
        ),
        pytest.param(
            "1. Go 3.\n5 m on.\n2. Stop", ["Go 3. 5 m on.", "Stop"], id="numbers"
        ),
    ],
)
def test_the_last_list_of_steps_counts(reply: str, steps: list[str]):
    assert read_steps(reply) == steps


@pytest.mark.parametrize(
    "reply",
    [
        "I am sorry, I can't help.",
        "- Go\n- Stop",
        "2. Go",
        "Refined steps:\n",
        "\n" * 10**5,
    ],
    ids=["a refusal", "bullets", "no beginning", "nothing after", "emptiness"],
)
def test_a_reply_without_steps_is_a_model_error(reply: str):
    with pytest.raises(LanguageModelError, match="no numbered list of steps"):
        read_steps(reply)


GOOD_PROGRAM = """Thought: short.
First program:
```python
move_forward(1)
```
Second thought: too short.
Refined program:
```python
move_forward(2)
stop()
```
"""


@pytest.mark.parametrize(
    ("reply", "program"),
    [
        pytest.param(GOOD_PROGRAM, "move_forward(2)\nstop()\n", id="as asked"),
        pytest.param(
            GOOD_PROGRAM.replace("\n", "\r\n"),
            "move_forward(2)\nstop()\n",
            id="other line ends",
        ),
        pytest.param("```\nstop()\n```", "stop()\n", id="no language"),
        pytest.param("~~~py\nstop()\n~~~", "stop()\n", id="tildes"),
        pytest.param("```Python title=a.py\nstop()\n```", "stop()\n", id="a title"),
        pytest.param("```python\nstop()", "stop()\n", id="not closed"),
        pytest.param(
            "```python\nturn('left')\nstop()```\nGood luck!",
            "turn('left')\nstop()\n",
            id="closed on a line of code",
        ),
        pytest.param(
            "1. Here:\n   ```python\n   if True:\n       stop()\n   ```\n",
            "if True:\n    stop()\n",
            id="indented",
        ),
        pytest.param(
            "```python\nstop()\n```\nOutput:\n```text\nThe robot stops.\n```\n"
            "```bash\nrm -r .\n```\n```python\n\n```",
            "stop()\n",
            id="other blocks after it",
        ),
        pytest.param("stop()", "stop()\n", id="nothing but a call"),
        pytest.param(
            "# Go.\nfor i in range(3):\n    move_forward(1)\n",
            "# Go.\nfor i in range(3):\n    move_forward(1)\n",
            id="nothing but a program",
        ),
        pytest.param(
            "Thought: x\nRefined program:\ndef go():\n    move_forward(1)\ngo()",
            "def go():\n    move_forward(1)\ngo()\n",
            id="under its heading without a fence",
        ),
    ],
)
def test_the_last_program_counts(reply: str, program: str):
    assert read_program(reply) == program


@pytest.mark.parametrize(
    "reply",
    [
        "I cannot write programs.",
        "```python\n```",
        "```json\n{}\n```",
        "You would call\nmove_forward(1)\nand then stop.",
        "Refined program:\nnone, sorry",
        "~" * 10**5,
        "``` " * 10**4,
    ],
    ids=["a refusal", "empty", "data", "prose", "no program", "tildes", "ticks"],
)
def test_a_reply_without_a_program_is_a_model_error(reply: str):
    with pytest.raises(LanguageModelError, match="no program in it: '"):
        read_program(reply)


@pytest.mark.parametrize("seed", range(25))
def test_every_program_of_the_grammar_runs_to_its_stop(make_paper_robot, seed: int):
    reply = Sentences(program_grammar(), random.Random(seed)).say()
    robot = make_paper_robot(call_budget=10**6)
    with pytest.raises(EpisodeOver, match="agent"):
        run_program(read_program(reply), robot)


@pytest.mark.parametrize("seed", range(25))
def test_every_reply_of_the_grammar_is_a_list_of_steps(seed: int):
    reply = Sentences(steps_grammar(), random.Random(seed)).say()
    steps = read_steps(reply)
    assert 1 <= len(steps) <= 12
    assert len(steps) == len(reply.splitlines())


def test_the_grammar_knows_the_whole_control_api():
    grammar = program_grammar()
    assert [name for name in API_NAMES if f'"{name}(' not in grammar] == []


def test_no_program_is_longer_than_a_reply_may_be():
    longest = max(
        len(Sentences(program_grammar(), random.Random(seed)).say())
        for seed in range(300)
    )
    assert longest < 4096 * 3
