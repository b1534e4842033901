"""Two tiny runs, one of them hostile, and the reports on them."""

import json
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.report import read_sources, write_report
from memorymaze.runs.work.driver import run_plan
from memorymaze.texts.corpus import load_corpus

TESTS = Path(__file__).parents[2]
TINY_SITES = TESTS / "tiny_sites"
TINY_INSTRUCTIONS = TESTS / "tiny_instructions.jsonl"

HOSTILE = (
    "</script><script>window.hacked = 1</script>\"'><img src=x onerror='hacked=1'> "
    "{{ 7 * 7 }} & \u202e\u2028\x00\x1b[31m <b>go left</b>"
)
"""What somebody might say who wants to take over a page."""

HOSTILE_ID = "a/../<b>&'\"x"

AGENT = """
HOSTILE = {hostile!r}


class Hostile:
    name = "</script><b>'{{{{ 1 }}}}"

    def follow(self, instruction, robot, journal, rng):
        journal.note("plan", steps=[HOSTILE, "2. go on"])
        robot.say(HOSTILE)
        robot.move_forward(1.0)
        journal.note(HOSTILE, text=HOSTILE, legs_done=1)
        journal.note("model_reply", stage=HOSTILE, model=HOSTILE, text=HOSTILE)
        robot.move_forward(1.0)
        raise RuntimeError(HOSTILE)
"""

PROGRAMMER = '''
PROGRAM = """\\
while detect_turning_point() == []:
    move_forward(0.5)
turn("left")
turn("right")
move_forward(3)
"""


class Programmer:
    name = "programmer"

    def follow(self, instruction, robot, journal, rng):
        journal.note("steps", steps=["go on", "turn"])
        journal.note("program", program=PROGRAM)
        journal.note("belief", at=0, legs=[0.9, 0.1, 0.0], doubt=0.05)
        robot.detect_turning_point()
        robot.move_forward(0.5)
        journal.note("belief", at=1, legs=[0.2, 0.3, 0.5], doubt=0.6)
        journal.note("doubt", score=0.6, leg=1, at=1)
        journal.note("repair", leg=1, at=0, reason="no such turn")
        robot.detect_from_RGB_image("door")
        robot.turn("right")
        robot.move_forward(3)
        journal.note("gave_up", reason="a wall", confidence=0.15)
'''


def make_run(folder: Path, agent: str, instructions: Path = TINY_INSTRUCTIONS) -> Path:
    """Run an agent over instructions on the tiny sites."""
    plan = plan_run(
        AgentSettings(agent),
        load_corpus([instructions], sites=TINY_SITES),
    )
    run_plan(plan, folder, workers=1)
    return folder


def make_report(out: Path, *runs: Path, **options: Any) -> list[str]:
    """Write the report on some runs."""
    return write_report(read_sources(runs), out, **options)


@pytest.fixture(scope="session")
def reported() -> Callable[..., list[str]]:
    """Write the report on some runs: `reported(out, *runs)`."""
    return make_report


@pytest.fixture(scope="session")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Runs of `guide`, of `stop`, and of one that writes a program and tells its beliefs."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "programmer.py").write_text(PROGRAMMER, encoding="utf-8")
    return {
        "guide": make_run(folder / "guide", "guide"),
        "stop": make_run(folder / "stop", "stop"),
        "programmer": make_run(
            folder / "programmer", f"{folder / 'programmer.py'}:Programmer"
        ),
    }


@pytest.fixture(scope="session")
def report(runs: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report on these runs."""
    out = tmp_path_factory.mktemp("report") / "out"
    assert make_report(out, *runs.values()) == []
    return out


@pytest.fixture(scope="session")
def hostile_report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report on a run in which ids, texts and the agent are hostile."""
    folder = tmp_path_factory.mktemp("hostile")
    first = json.loads(TINY_INSTRUCTIONS.read_text(encoding="utf-8").splitlines()[0])
    failure = {"kind": HOSTILE, "where": HOSTILE, "detail": HOSTILE}
    told = first | {
        "id": HOSTILE_ID,
        "text": HOSTILE,
        "participant": HOSTILE,
        "source": "llm",
        "failures": [failure],
    }
    instructions = folder / "hostile.jsonl"
    instructions.write_text(json.dumps(told) + "\n", encoding="utf-8")
    (folder / "agent.py").write_text(AGENT.format(hostile=HOSTILE), encoding="utf-8")
    run = make_run(folder / "run", f"{folder / 'agent.py'}:Hostile", instructions)
    make_report(folder / "out", run)
    return folder / "out"


@pytest.fixture
def opened(browser: Browser) -> Generator[Callable[..., Page]]:
    """Open a page from the disk; the test fails on any error or request elsewhere."""
    contexts: list[Any] = []
    complaints: list[str] = []

    def look(file: Path, **options: Any) -> Page:
        context = browser.new_context(**options)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on(
            "console",
            lambda message: (
                complaints.append(message.text) if message.type == "error" else None
            ),
        )
        page.on(
            "request",
            lambda request: (
                None
                if request.url.startswith(("file:", "data:"))
                else complaints.append(request.url)
            ),
        )
        page.goto(file.as_uri())
        return page

    yield look
    for context in contexts:
        context.close()
    assert complaints == []
