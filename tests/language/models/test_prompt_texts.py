"""The prompts hold what they promise, and nothing of the benchmark's buildings."""

import re
from collections.abc import Callable

import pytest

from memorymaze.agents.code_generation.replies import read_program, read_steps
from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import EpisodeOver, ProgramError
from memorymaze.language.models.prompt_texts import load_prompt
from memorymaze.language.plans import SECOND_METRES, STEP_METRES
from memorymaze.robot.api.specification import api_specification
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.world.sites import load_sites

SLOTS = {"forward": "", "turn": ""}
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
    number: int, make_paper_robot: Callable
):
    robot = make_paper_robot(call_budget=2000)
    doubts: list[dict[str, object]] = []

    with pytest.raises(EpisodeOver) as over:
        run_program(programs()[number], robot, on_event=doubts.append)

    assert over.value.stopped_by == "agent"
    assert robot.names[-1] == "stop"
    assert doubts == []


RUNS = {
    "global": "n = 0\ndef count():\n    global n\n    n += 1\ncount()\nanswer = n",
    "lambda": "answer = (lambda x: x + 1)(0)",
    "try": "try:\n    answer = 1 / 0\nexcept ZeroDivisionError:\n    answer = 1",
    "len": "answer = len([7])",
    "range": "answer = list(range(2))[1]",
    "min": "answer = min([3, 1, 2], key=lambda x: x)",
    "max": "answer = max(x for x in (0, 1))",
    "sum": "answer = sum(x for x in (0, 1))",
    "any": "answer = any(x > 1 for x in (1, 2)) + 0",
    "all": "answer = all([True]) + 0",
    "sorted": "answer = sorted([2, 1])[0]",
    "abs": "answer = abs(-1)",
    "round": "answer = round(1.2)",
    "enumerate": "answer = [i for i, _ in enumerate('ab')][1]",
    "zip": "answer = dict(zip('a', [1]))['a']",
    "math": "import math\nanswer = round(math.cos(0))",
    "re": "import re\nanswer = int(re.findall('[0-9]', 'a1')[0])",
}
FAILS = {
    "next": "next(x for x in [1])",
    "yield": "def each():\n    yield 1\neach()",
    "del": "a = [1]\ndel a[0]",
    "key=": "max([1, 2], key=lambda x: distance_travelled())",
}
FAILS_UNNAMED = [
    pytest.param("class A:\n    pass\nclass B(A):\n    pass", id="class inheritance"),
    pytest.param("open('map')", id="files"),
    pytest.param("input()", id="user input"),
]


def test_the_prompt_names_the_python_that_there_is():
    (line,) = re.findall(r"^- Use plain Python:.*$", WRITING, re.M)
    assert set(re.findall(r"`(\S+)`", line)) == RUNS.keys() | FAILS.keys()
    assert all(words in line for words in ("class inheritance", "Files", "user input"))


@pytest.mark.parametrize("program", RUNS.values(), ids=RUNS)
def test_python_that_the_prompt_names_runs(program: str, make_paper_robot: Callable):
    robot = make_paper_robot()
    run_program(f"{program}\nsay(str(answer))", robot)
    assert robot.calls == [("say", "1")]


@pytest.mark.parametrize(
    "program", [*(pytest.param(FAILS[name], id=name) for name in FAILS), *FAILS_UNNAMED]
)
def test_python_that_the_prompt_says_is_missing_fails(
    program: str, make_paper_robot: Callable
):
    with pytest.raises(ProgramError):
        run_program(program, make_paper_robot())


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        (
            PARSING,
            r"a pace is ([\d.]+) m, a second about ([\d.]+) m, a minute about ([\d.]+) m",
        ),
        (
            load_prompt("read_plan"),
            r"A step is ([\d.]+) m, a second ([\d.]+) m, a minute ([\d.]+) m",
        ),
    ],
    ids=["steps", "plan"],
)
def test_times_and_paces_are_as_long_as_the_project_reads_them(prompt: str, told: str):
    found = re.search(told, prompt)
    assert found is not None
    assert [float(each) for each in found.groups()] == pytest.approx(
        [STEP_METRES, SECOND_METRES, 60 * SECOND_METRES], rel=0.1
    )


@pytest.mark.parametrize("number", range(4))
def test_no_example_drives_away_before_it_has_looked(
    number: int, make_paper_robot: Callable
):
    robot = make_paper_robot(call_budget=2000)
    with pytest.raises(EpisodeOver):
        run_program(programs()[number], robot)
    moved = robot.names.index("move_forward")
    assert "detect_turning_point" in robot.names[:moved]


def test_no_words_of_the_benchmarks_buildings_are_in_the_prompts():
    seeing = (load_prompt(f"navid_protocol{kind}", **SLOTS) for kind in ("", "_blind"))
    writing = WRITING.replace(api_specification(), "")
    prompts = "\n".join([PARSING, writing, *seeing]).lower()
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
