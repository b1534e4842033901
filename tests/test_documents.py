import ast
import json
import re
import runpy
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from memorymaze.runs.work.run_folder import read_run

PROJECT = Path(__file__).parents[1]
NOTEBOOK = PROJECT / "examples" / "first_steps.ipynb"


@pytest.fixture
def run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[str], str]:
    """Run a script in a folder of its own, with one worker; say what it printed."""
    for room in ("work.local_workers", "films.drawing"):
        name = f"memorymaze.runs.{room}.available_cores"
        monkeypatch.setattr(name, lambda: 1)

    def script(program: str) -> str:
        monkeypatch.chdir(tmp_path)
        path = tmp_path / "page.py"
        path.write_text(program, encoding="utf-8")
        runpy.run_path(str(path), run_name="__main__")
        return capsys.readouterr().out

    return script


class Page(NamedTuple):
    """A page's blocks of Python, in order."""

    run: str
    """Those that are run, with what readers do not see in comments `<!-- run too: … -->`."""
    left_out: tuple[tuple[str, str], ...]
    """Why, and the block: those below a comment `<!-- not run: … -->`."""


def page_of(path: Path) -> Page:
    run: list[str] = []
    left_out: list[tuple[str, str]] = []
    for hidden, reason, block in PYTHON.findall(path.read_text(encoding="utf-8")):
        if reason:
            left_out.append((reason, block))
        else:
            run.append(hidden or block)
    return Page("\n".join(run), tuple(left_out))


PYTHON = re.compile(
    r"^<!-- run too:\n((?:(?!-->).*\n)*)-->$"
    r"|^(?:<!-- not run:(.*)-->\n)?```python\n((?:(?!```).*\n)*)```$",
    flags=re.MULTILINE,
)
PATHS = (PROJECT / "README.md", *sorted((PROJECT / "docs").glob("*.md")))
PAGES = {path.name: page_of(path) for path in PATHS}
SMALLER = {"README.md": ('"guide", limit=60', '"stop", limit=2')}
"""What takes minutes, and what is run instead."""


@pytest.mark.parametrize(
    "name", [name for name, page in PAGES.items() if page.run and name != "python.md"]
)
def test_the_python_blocks_of_a_page_run(
    name: str,
    run: Callable[[str], str],
    tmp_path: Path,
    tiny_sites_folder: Path,
    tiny_instructions: Path,
) -> None:
    """Where they are, there are a plan, `my_building.geojson`, and texts of it."""
    shutil.copy(
        tiny_sites_folder / "corridor.geojson", tmp_path / "my_building.geojson"
    )
    shutil.copy(tiny_instructions, tmp_path / "texts.jsonl")
    program = PAGES[name].run
    if name in SMALLER:
        assert SMALLER[name][0] in program
        program = program.replace(*SMALLER[name])
    run(program)


def test_blocks_that_are_not_run_are_python_and_say_why() -> None:
    left_out = [each for page in PAGES.values() for each in page.left_out]
    for reason, block in left_out:
        assert reason.strip()
        ast.parse(block)
    assert len(left_out) < 10


def test_python_stands_in_python_blocks() -> None:
    """So that it is run: not indented, and in no block of another kind."""
    for path in PATHS:
        text = path.read_text(encoding="utf-8")
        found = PYTHON.findall(text)
        for number, mark in enumerate(("<!-- run too:", "<!-- not run:", "```python")):
            assert sum(bool(each[number]) for each in found) == text.count(
                f"\n{mark}"
            ), path
        assert not re.findall(r"^    (?:from \w+.* )?import \w+", text, re.MULTILINE)


def test_the_python_blocks_of_the_page_on_python_run(
    run: Callable[[str], str],
    tmp_path: Path,
    chat_server: Callable[..., tuple[str, list[dict[str, Any]]]],
) -> None:
    """Its agent that asks a model is recorded, replayed and priced."""
    address, asked = chat_server(lambda _: "forward", "my-model", (100, 2))
    program = PAGES["python.md"].run
    assert "http://localhost:8000/v1" in program
    said = run(program.replace("http://localhost:8000/v1", address))
    assert "right_hand, 6 episodes" in said
    assert "B - A" in said
    assert "Say one word of ['" in asked[0]["messages"][-1]["content"]
    _, recorded = read_run(tmp_path / "runs" / "asked")
    _, replayed = read_run(tmp_path / "runs" / "replayed")
    calls = sum(one.model_calls for one in recorded)
    # What is asked in the same words, of another text of the route, is asked once.
    assert 0 < len(asked) <= calls
    assert sum(one.cost_usd for one in recorded) == pytest.approx(calls * 16.2e-6)
    untimed = {"wall_s": 0.0}
    assert [replace(one, **untimed) for one in replayed] == [
        replace(one, **untimed) for one in recorded
    ]


def test_the_notebook_scores_an_agent_of_ones_own_in_under_25_lines(
    run: Callable[[str], str],
) -> None:
    cells = json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]
    programs = ["".join(c["source"]) for c in cells if c["cell_type"] == "code"]
    lines = [line for each in programs for line in each.splitlines() if line.strip()]
    assert len(lines) < 25
    said = run("\n".join([*programs, "print(run)"]))
    assert "right_hand, 6 episodes" in said
