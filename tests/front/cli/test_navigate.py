import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_a_walk_leaves_trajectory_trace_and_picture(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    plan = tiny_sites_folder / "loop.geojson"
    said = memorymaze(
        "navigate",
        plan,
        "route_r1_alternative",
        "Take the long way round.",
        "--agent",
        "oracle",
        "--out",
        tmp_path,
    )
    assert said.code == 0
    assert said.out.startswith("arrived; stopped by agent\nSPD 0.0")
    walk = json.loads((tmp_path / "trajectory.json").read_text(encoding="utf-8"))
    assert walk["columns"] == ["time", "x", "y", "heading"]
    assert len(walk["poses"]) > 100
    assert walk["instruction"] == "Take the long way round."
    assert walk["result"]["success"] is True
    lines = (tmp_path / "trace.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line)["kind"] for line in lines][-1] == "end"
    assert (tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        pytest.param(["nowhere", "R1", "Go."], 2, "university", id="site"),
        pytest.param(
            ["universty", "R1", "Go."], 2, "did you mean 'university'?", id="misspelt"
        ),
        pytest.param(["", "R1", "Go."], 2, "got ''", id="no site"),
        pytest.param(["none.geojson", "R1", "Go."], 2, "none.geojson", id="file"),
        pytest.param(["university", "R9", "Go."], 2, "R1 (route_r1_", id="route"),
        pytest.param(
            ["university", "r1", "Go."], 2, "did you mean 'R1'?", id="small letter"
        ),
        pytest.param(
            ["university", "R1", " "], 2, "expected an instruction", id="text"
        ),
        pytest.param(["university", "R1"], 2, "TEXT", id="no text"),
    ],
)
def test_wrong_input_gives_one_message_and_nothing_else(
    memorymaze: Memorymaze,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    code: int,
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = memorymaze("navigate", *arguments, "--agent", "stop")
    assert (done.code, done.out) == (code, "")
    assert said in done.err
    assert "Traceback" not in done.err
    assert not any(tmp_path.iterdir())


def test_a_folder_that_cannot_be_written_is_refused_before_the_walk(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    agent = tmp_path / "proud.py"
    agent.write_text("raise RuntimeError('I was asked')", encoding="utf-8")
    plan = tiny_sites_folder / "loop.geojson"
    done = memorymaze(
        *("navigate", plan, "R1", "Go."),
        *("--agent", f"{agent}:Proud", "--out", agent / "walk"),
    )
    assert (done.code, done.out) == (1, "")
    assert f"expected a folder to write to, got a file at {agent}" in done.err


def test_a_folder_with_a_walk_is_not_written_over(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    plan = tiny_sites_folder / "loop.geojson"
    walk = "navigate", plan, "R1", "Go.", "--agent", "stop", "--out", tmp_path / "walk"
    assert memorymaze(*walk).code == 0
    kept = (tmp_path / "walk" / "trace.jsonl").read_bytes()
    done = memorymaze(*walk)
    assert (done.code, done.out) == (1, "")
    assert f"{tmp_path / 'walk'}: has a walk already" in done.err
    assert (tmp_path / "walk" / "trace.jsonl").read_bytes() == kept


def test_what_an_agent_prints_is_no_result(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    agent = tmp_path / "loud.py"
    agent.write_text(
        "from memorymaze.agents.stop import StopAgent\n"
        "print('HELLO')\n"
        "class Loud(StopAgent):\n"
        "    def follow(self, *told):\n"
        "        print('HERE I AM')\n",
        encoding="utf-8",
    )
    plan = tiny_sites_folder / "loop.geojson"
    done = memorymaze(
        *("navigate", plan, "R1", "Go."),
        *("--agent", f"{agent}:Loud", "--out", tmp_path / "walk"),
    )
    assert done.code == 0
    assert done.out.startswith("did not arrive; stopped by agent")
    assert done.err == "HELLO\nHERE I AM\n"


def test_the_folder_made_by_default_lies_in_runs_whatever_a_plan_is_called(
    memorymaze: Memorymaze,
    tiny_sites_folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    text = (tiny_sites_folder / "loop.geojson").read_text(encoding="utf-8")
    plan = tmp_path / "odd"
    odd = text.replace('"name": "loop"', f'"name": "../../{"x" * 300}"')
    plan.write_text(odd, encoding="utf-8")
    done = memorymaze("navigate", "odd", "R1", "Go.", "--agent", "stop")
    assert done.code == 0
    assert {path.name for path in tmp_path.iterdir()} == {"odd", "runs"}
    assert len(list((tmp_path / "runs").iterdir())) == 1


@pytest.fixture
def walk(tiny_sites_folder: Path, tmp_path: Path) -> list[str | Path]:
    """Arguments of a walk on the T."""
    plan = tiny_sites_folder / "t_junction.geojson"
    return [
        "navigate",
        plan,
        "R1",
        "Turn left at the T and go to the end.",
        "--out",
        tmp_path,
    ]


def test_the_calls_are_told_as_lines_while_it_drives(
    memorymaze: Memorymaze, walk: list[str | Path], tmp_path: Path
) -> None:
    said = memorymaze(*walk, "--watch")
    assert said.code == 0, said.err
    assert "turn(left) → turned" in said.err
    assert said.out.splitlines()[0] == "arrived; stopped by agent"
    assert "turn(left)" not in said.out
    assert (tmp_path / "trace.jsonl").exists()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        pytest.param(["--pace", "1"], "with --watch", id="pace alone"),
        pytest.param(["--watch", "--pace", "0"], "--pace: expected", id="no pace"),
        pytest.param(["--watch", "--pace", "x"], "--pace", id="no number"),
        pytest.param(["--watch", "window"], "window", id="view"),
        pytest.param(["--with", "passers_by=wrong"], "add ask", id="nobody asks"),
    ],
)
def test_wrong_usage_runs_nothing(
    memorymaze: Memorymaze,
    walk: list[str | Path],
    tmp_path: Path,
    options: list[str],
    said: str,
) -> None:
    done = memorymaze(*walk, *options)
    assert (done.code, done.out) == (2, "")
    assert said in done.err
    assert not any(tmp_path.iterdir())
