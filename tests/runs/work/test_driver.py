"""Runs that are broken off, in every way a process can end."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import (
    MemoryMazeError,
    RunFolderError,
    RunFolderWarning,
    SettingsError,
)
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.trace import read_trace, trace_path
from memorymaze.runs.episodes.trace_entries import EndEntry, OpeningEntry
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_run

Plan = Callable[..., RunPlan]

# Walks, but first does what a file beside it named after the text's last word says:
# ends this process or its parent. The file is used up, unless it says "always".
TROUBLED_AGENT = """
import multiprocessing, os, pathlib, signal, threading

HERE = pathlib.Path(__file__).parent

class Troubled:
    name = "troubled"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(3 + 8 * rng.random())
        order = HERE / instruction.split()[-1].strip(".")
        if order.exists():
            what = order.read_text()
            if "always" not in what:
                order.unlink()
            if "child" in what and os.fork() == 0:
                signal.alarm(20)
                signal.pause()
            if "hang" in what:
                threading.Event().wait()
            if "parent" in what:
                parent = multiprocessing.parent_process().pid
                os.kill(parent, getattr(signal, what.split()[1]))
                threading.Event().wait()
            os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.fixture
def troubled(tmp_path: Path) -> str:
    """Name of an agent that obeys files named `door`, `junction`, …."""
    (tmp_path / "agent").mkdir()
    path = tmp_path / "agent" / "troubled.py"
    path.write_text(TROUBLED_AGENT, encoding="utf-8")
    return f"{path}:Troubled"


def order(tmp_path: Path, word: str, what: str) -> None:
    (tmp_path / "agent" / word).write_text(what, encoding="utf-8")


def timeless(results: Sequence[EpisodeResult]) -> list[EpisodeResult]:
    return [replace(result, wall_s=0.0) for result in results]


def evaluate(
    agent: str, files: list[str], out: Path, *more: str
) -> subprocess.CompletedProcess[str]:
    options = [*files, "--out", str(out), "--workers", "1", *more]
    command = ["memorymaze", "evaluate", "--agent", agent, *options]
    return subprocess.run(
        [sys.executable, "-m", *command],
        capture_output=True,
        text=True,
        check=False,
        # Tests in the background of a shell inherit that Ctrl-C is ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


@pytest.mark.proof
def test_a_run_killed_again_and_again_ends_as_an_unbroken_one(
    tmp_path: Path, troubled: str, tiny_plan: Plan, tiny_files: list[str]
) -> None:
    whole = run_plan(tiny_plan(troubled), tmp_path / "whole", workers=2)
    out = tmp_path / "broken"
    for word in ("door", "goes"):
        order(tmp_path, word, "parent SIGKILL")
        done = evaluate(troubled, tiny_files, out, "--resume")
        assert done.returncode == -signal.SIGKILL
        before = (out / "episodes.jsonl").read_bytes()
        (out / "episodes.jsonl").write_bytes(before[: -len(before) // 40])
        assert 0 < before.count(b"\n") < len(whole)
    again = run_plan(tiny_plan(troubled), out, workers=2, resume=True)
    assert timeless(again) == timeless(whole)
    assert timeless(read_run(out)[1]) == timeless(whole)
    for result in whole:
        traces = [
            trace_path(tmp_path / name, result.episode_id)
            for name in ("whole", "broken")
        ]
        assert traces[0].read_bytes() == traces[1].read_bytes()
    assert {path.suffix for path in out.rglob("*")} <= {"", ".json", ".jsonl", ".gz"}


def test_ctrl_c_ends_a_run_cleanly_and_says_how_to_go_on(
    tmp_path: Path, troubled: str, tiny_files: list[str]
) -> None:
    order(tmp_path, "door", "parent SIGINT")
    out = tmp_path / "run"
    done = evaluate(troubled, tiny_files, out)
    assert done.returncode == 1
    assert f"--out {out}" in done.stderr
    assert "--resume" in done.stderr
    assert "Traceback" not in done.stderr
    assert (out / "run.json").exists()


def test_an_episode_whose_worker_is_killed_is_tried_once_more(
    tmp_path: Path, troubled: str, tiny_plan: Plan
) -> None:
    order(tmp_path, "door", "once")
    order(tmp_path, "block", "always, and leave a child")
    plan = tiny_plan(troubled)
    results = {
        one.episode_id: one for one in run_plan(plan, tmp_path / "run", workers=1)
    }
    assert len(results) == 12
    lost = results["p6-1"]
    assert lost.stopped_by == "crash"
    assert lost.error == "WorkerLost: the worker process was killed by SIGKILL"
    assert (lost.success, lost.path_length) == (False, 0.0)
    assert {one.stopped_by for name, one in results.items() if name != "p6-1"} == {
        "agent"
    }
    *_, end = read_trace(tmp_path / "run", "p6-1")
    assert isinstance(end, EndEntry)
    assert end.stopped_by == "crash"


def test_an_episode_that_hangs_is_given_up_and_the_run_goes_on(
    tmp_path: Path, troubled: str, tiny_plan: Plan
) -> None:
    order(tmp_path, "on", "hang always")
    plan = tiny_plan(troubled, limit=4, wall_limit=1.0)
    results = run_plan(plan, tmp_path / "run", workers=1)
    hung = [one for one in results if one.stopped_by == "crash"]
    assert [one.error for one in hung] == [
        "WorkerLost: the worker process took longer than the 1 s a task may"
    ]
    assert len(results) == 4


BAD_GUEST = """
import os

class BadGuest:
    name = "bad guest"

    def follow(self, instruction, robot, journal, rng):
        print("I am here")
        os.write(1, b"and here")
        os.chdir("/")
        raise KeyboardInterrupt
"""


def test_what_an_agent_does_to_its_process_stays_there(
    tmp_path: Path,
    tiny_plan: Plan,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bad_guest.py").write_text(BAD_GUEST, encoding="utf-8")
    plan = tiny_plan("bad_guest.py:BadGuest", limit=2)
    results = run_plan(plan, "run", workers=1)
    assert [one.error for one in results] == [
        "WorkerLost: KeyboardInterrupt: no message (bad_guest.py, line 11)"
    ] * 2
    assert len(list(Path("run/traces").iterdir())) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert "I am here" in err
    assert "and here" in err
    assert "Traceback" not in err


RENAMED = """
class Renamed:
    name = "first"

    def follow(self, instruction, robot, journal, rng):
        self.name = 5
"""


def test_an_agent_keeps_in_a_run_the_name_it_was_made_with(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    file = tmp_path / "renamed.py"
    file.write_text(RENAMED, encoding="utf-8")
    run_plan(tiny_plan(f"{file}:Renamed", limit=2), tmp_path / "run", workers=1)
    _, results = read_run(tmp_path / "run")
    assert [one.agent for one in results] == ["first"] * 2
    assert [one.stopped_by for one in results] == ["agent"] * 2
    opening, *_ = read_trace(tmp_path / "run", results[1].episode_id)
    assert isinstance(opening, OpeningEntry)
    assert opening.agent == "first"


def test_results_depend_on_neither_workers_nor_order(
    tmp_path: Path, troubled: str, tiny_plan: Plan
) -> None:
    plan = tiny_plan(troubled, seed=5)
    reverse = replace(plan, episodes=plan.episodes[::-1])
    one = run_plan(plan, tmp_path / "one", workers=1)
    three = run_plan(reverse, tmp_path / "three", workers=3)
    assert timeless(one) == timeless(three)
    assert len({result.path_length for result in one}) > 6


def test_a_finished_run_is_resumed_without_doing_anything(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    plan = tiny_plan("stop", limit=2)
    first = run_plan(plan, tmp_path, workers=1)
    lines = (tmp_path / "episodes.jsonl").read_bytes()
    assert run_plan(plan, tmp_path, workers=1, resume=True) == first
    assert (tmp_path / "episodes.jsonl").read_bytes() == lines
    with pytest.raises(RunFolderError, match="holds a run already"):
        run_plan(plan, tmp_path)


def test_a_run_whose_traces_are_gone_says_so_when_it_is_resumed(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    plan = tiny_plan("stop", limit=2)
    first = run_plan(plan, tmp_path, workers=1)
    for file in (tmp_path / "traces").iterdir():
        file.unlink()
    with pytest.warns(RunFolderWarning, match=r"got none of 2 of 2, such as .*delete"):
        assert run_plan(plan, tmp_path, workers=1, resume=True) == first
    # As the message says.
    (tmp_path / "episodes.jsonl").write_text("", encoding="utf-8")
    run_plan(plan, tmp_path, workers=1, resume=True)
    assert trace_path(tmp_path, first[0].episode_id).exists()


@pytest.mark.parametrize("workers", [-1, True, "2", 1.5])
def test_what_is_no_number_of_workers_is_refused_before_there_is_a_folder(
    tmp_path: Path, tiny_plan: Plan, workers: Any
) -> None:
    with pytest.raises(SettingsError, match="workers: expected a whole number"):
        run_plan(tiny_plan("stop", limit=1), tmp_path / "run", workers=workers)
    assert not (tmp_path / "run").exists()


def test_an_agent_that_cannot_be_made_in_a_worker_ends_the_run_with_its_reason(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    file = tmp_path / "shy.py"
    file.write_text(
        "import os\n"
        f"if os.getpid() != {os.getpid()}:\n"
        "    raise RuntimeError('only in the parent')\n"
        "from memorymaze.agents.stop import StopAgent\n",
        encoding="utf-8",
    )
    with pytest.raises(MemoryMazeError, match="only in the parent"):
        run_plan(tiny_plan(f"{file}:StopAgent"), tmp_path / "run", workers=1)


@pytest.mark.proof
def test_workers_that_die_before_they_start_end_the_run(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    file = tmp_path / "deadly.py"
    file.write_text(
        "import os\n"
        f"if os.getpid() != {os.getpid()}:\n"
        "    os._exit(7)\n"
        "from memorymaze.agents.stop import StopAgent\n",
        encoding="utf-8",
    )
    with pytest.raises(MemoryMazeError, match=r"do not start.* ended with exit code 7"):
        run_plan(tiny_plan(f"{file}:StopAgent"), tmp_path / "run", workers=1)
