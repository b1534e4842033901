import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import memorymaze as package
from memorymaze.front.cli import table

Memorymaze = Callable[..., Any]

VERBS = ("navigate", "evaluate", "table", "score", "instructions", "sites")


def test_the_version_is_told(memorymaze: Memorymaze) -> None:
    said = memorymaze("--version")
    assert (said.code, said.out) == (0, f"memorymaze {package.__version__}\n")


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_a_verb_shows_an_example(memorymaze: Memorymaze, verb: str) -> None:
    said = memorymaze(verb, "--help")
    assert said.code == 0
    assert f"example: memorymaze {verb}" in " ".join(said.out.split())


@pytest.mark.parametrize("columns", ["80", "100"])
@pytest.mark.parametrize("verb", ["evaluate", "navigate", "try"])
def test_the_help_of_what_everybody_uses_fits_a_screen(
    memorymaze: Memorymaze, monkeypatch: pytest.MonkeyPatch, verb: str, columns: str
) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    lines = memorymaze(verb, "--help").out.splitlines()
    assert len(lines) <= 45
    assert max(map(len, lines)) <= int(columns)
    assert len([line for line in lines if line.startswith("  --")]) <= 24


@pytest.mark.parametrize(
    "command",
    [
        pytest.param("evaluate --agent stop --out=", id="out"),
        pytest.param("evaluate --agent stop --instructions=", id="texts"),
        pytest.param("evaluate --agent stop --sites=", id="sites"),
        pytest.param("sites list --sites=", id="sites list"),
        pytest.param("sites new annex --out=", id="new plan"),
        pytest.param("navigate university R1 Left. --out=", id="navigate"),
    ],
)
def test_an_empty_path_is_none(
    memorymaze: Memorymaze,
    command: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    said = memorymaze(*command.split())
    assert said.code == 2
    assert "expected a path, got an empty one" in said.err
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize(
    "arguments",
    [
        pytest.param([], id="no verb"),
        pytest.param(["walk"], id="unknown verb"),
        pytest.param(["evaluate"], id="no agent"),
        pytest.param(["evaluate", "--agent", "a", "--workers", "x"], id="no number"),
        pytest.param(["table"], id="no run"),
        pytest.param(["table", "x", "--table", "IV"], id="no such table"),
    ],
)
def test_wrong_usage_gives_code_2_and_the_usage(
    memorymaze: Memorymaze, arguments: list[str]
) -> None:
    said = memorymaze(*arguments)
    assert said.code == 2
    assert said.out == ""
    assert "usage: memorymaze" in said.err


@pytest.mark.parametrize(
    "command",
    [
        "agents none.py:Mine",
        "answers check none.jsonl",
        "answers import none.jsonl --store none.jsonl",
        "compare none others",
        "evaluate --agent none.py:Mine --out new",
        "evaluate --agent stop --instructions none.jsonl --out new",
        "evaluate --agent stop --settings none.toml --out new",
        "evaluate --agent stop --sites none --out new",
        "evaluate --suite none.toml --out new",
        "instructions agreement none.jsonl --instructions none.jsonl",
        "instructions check none.jsonl",
        "instructions export none.jsonl --format vln_ce --out new",
        "instructions import none.json --format vln_ce --out new",
        "instructions label none.jsonl --annotator me --csv new.csv --out new.jsonl",
        "instructions stats none.jsonl",
        "navigate none.geojson R1 go",
        "replay none some-episode",
        "report none --out new",
        "runs check none",
        "runs leaderboard none --out new",
        "score --cases none.json",
        "settings --of none",
        "sites check none.geojson",
        "sites draw none.geojson --out new.png",
        "sites draw university --out none/new.png",
        "sites export none.geojson --to gltf --out new.glb",
        "sites import none.osm --from osm --out new.geojson",
        "sites list --sites none",
        "study export none.toml --out new.jsonl",
        "study serve none.toml",
        "study withdraw none.toml p1",
        "table none",
    ],
)
def test_a_file_or_folder_that_is_not_there_is_wrong_usage(
    memorymaze: Memorymaze,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    command: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    said = memorymaze(*command.split())
    assert (said.code, said.out) == (2, "")
    assert "usage:" not in said.err
    assert "none" in said.err
    assert not any(tmp_path.iterdir())


HELP_OF_MANY = """
import sys
from memorymaze.front.cli.main import run_command_line

HEAVY = {
    "jinja2", "matplotlib", "memorymaze.agents.guide", "mujoco", "networkx", "openai",
    "scipy", "shapely", "starlette",
}
for verbs, heavy in [
    ([], HEAVY | {"numpy", "pydantic"}),
    (["study"], HEAVY | {"numpy"}),
    (["sites", "export"], HEAVY),
    (["navigate"], HEAVY),
    (["try"], HEAVY),
    (["evaluate"], HEAVY),
]:
    try:
        run_command_line([*verbs, "--help"])
    except SystemExit:
        print("loaded:", *verbs, *heavy & {*sys.modules}, file=sys.stderr)
"""


def test_help_needs_no_heavy_library() -> None:
    """Those take longer to import than anyone waits for a help text."""
    done = subprocess.run(
        [sys.executable, "-c", HELP_OF_MANY], capture_output=True, text=True, check=True
    )
    assert done.stderr.splitlines() == [
        "loaded:",
        "loaded: study",
        "loaded: sites export",
        "loaded: navigate",
        "loaded: try",
        "loaded: evaluate",
    ]


def test_python_dash_m_is_the_same_command() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "memorymaze", "--version"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == f"memorymaze {package.__version__}\n"


def test_a_fault_of_the_program_is_one_line_unless_one_debugs(
    memorymaze: Memorymaze, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(options: object) -> int:
        raise ZeroDivisionError("by nothing")

    monkeypatch.setattr(table, "_run", fail)
    said = memorymaze("table", "x")
    assert said.code == 1
    assert said.err.splitlines()[0] == "memorymaze: ZeroDivisionError: by nothing"
    assert "Traceback" not in said.err
    assert "Traceback" in memorymaze("--debug", "table", "x").err


@pytest.mark.parametrize(
    ("error", "said"),
    [
        pytest.param(
            OSError(28, "No space left on device", "x.png"),
            "x.png: cannot be read or written (No space left on device)",
            id="file",
        ),
        pytest.param(OSError("odd"), "OSError: odd", id="no file"),
        pytest.param(MemoryError(), "not enough memory: no more", id="memory"),
    ],
)
def test_what_the_machine_refuses_is_no_fault_of_the_program(
    memorymaze: Memorymaze, monkeypatch: pytest.MonkeyPatch, error: Exception, said: str
) -> None:
    def fail(options: object) -> int:
        raise error

    monkeypatch.setattr(table, "_run", fail)
    done = memorymaze("table", "x")
    assert done.code == 1
    assert done.err.startswith(f"memorymaze: {said}")
    assert "fault" not in done.err


def test_a_reader_that_leaves_early_is_no_fault() -> None:
    command = f"{sys.executable} -m memorymaze agents | true; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (1, "")
