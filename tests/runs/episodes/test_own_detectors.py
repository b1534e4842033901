"""Runs whose detector is a finder of a user's own."""

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.front.cli.main import run_command_line
from memorymaze.robot.api.control import Detection
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import CallEntry
from memorymaze.runs.work.episode_worker import EpisodeDone, EpisodeTask, EpisodeWorker
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder, read_run

FINDER = """
import os, pathlib
from dataclasses import dataclass

from memorymaze.robot.perception import FoundBox

@dataclass(frozen=True)
class Options:
    score: float = 0.5
    \"\"\"How sure it is.\"\"\"

class Middle:
    Options = Options

    def __init__(self, options):
        self.options = options
        with open(pathlib.Path(__file__).with_name("made.txt"), "a") as made:
            made.write(f"{os.getpid()}\\n")

    def find(self, rgb, query):
        if query == "gpu":
            raise RuntimeError("out of memory")
        return [FoundBox((200, 100, 400, 300), query, self.options.score)]
"""

LOOKER = """
class Looker:
    name = "looker"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(9)
        robot.detect_from_RGB_image("poster")
        if WORD:
            robot.detect_from_RGB_image(WORD)
"""


@pytest.fixture
def finder(tmp_path: Path) -> str:
    path = tmp_path / "my_finder.py"
    path.write_text(FINDER, encoding="utf-8")
    return f"{path}:Middle"


def looker(folder: Path, word: str = "") -> str:
    path = folder / "looker.py"
    path.write_text(f"WORD = {word!r}\n{LOOKER}", encoding="utf-8")
    return f"{path}:Looker"


def test_it_looks_in_all_workers_and_is_kept_and_named(
    tmp_path: Path,
    finder: str,
    tiny_files: list[str],
    capsys: pytest.CaptureFixture[str],
) -> None:
    run = tmp_path / "run"
    command = ["evaluate", "--agent", looker(tmp_path), "--workers", "2", *tiny_files]
    command += ["--limit", "4", "--with", f"detector={finder},score=0.75"]
    assert run_command_line([*command, "--out", str(run)]) == 0

    record, results = read_run(run)
    assert [stamp.name for stamp in record.settings.detector_files] == ["my_finder.py"]
    assert str(record.settings.detector) == f"{finder},score=0.75"
    made = Counter((tmp_path / "made.txt").read_text().split())
    assert len(made) <= 3, "in this process and in two workers"
    assert set(made.values()) == {1}
    found = [
        each
        for result in results
        for entry in read_trace(run, result.episode_id)
        if isinstance(entry, CallEntry)
        for each in entry.found(Detection)
    ]
    assert found
    assert {(each.label, each.score) for each in found} == {("poster", 0.75)}

    capsys.readouterr()
    assert run_command_line(["table", str(run)]) == 0
    told = capsys.readouterr().out
    assert "looker, detector my_finder.py:Middle" in told
    assert f"DETECTOR {finder},score=0.75" in told


def test_what_it_raises_is_not_the_agents_crash(
    tmp_path: Path, finder: str, tiny_plan: Callable[..., RunPlan]
) -> None:
    plan = tiny_plan(looker(tmp_path, "gpu"), detector=finder)
    outcome = EpisodeWorker.of(plan)()(EpisodeTask(plan.episodes[0]))
    assert isinstance(outcome, EpisodeDone)
    assert outcome.result.stopped_by == "model_error"
    assert "out of memory (my_finder.py, line" in (outcome.result.error or "")


def test_a_run_is_not_resumed_with_an_edited_finder(
    tmp_path: Path, finder: str, record: RunRecord, tiny_plan: Callable[..., RunPlan]
) -> None:
    begun = replace(record, settings=tiny_plan("stop", detector=finder).settings)
    with open_run_folder(tmp_path / "run", begun, resume=False):
        pass
    (tmp_path / "my_finder.py").write_text(f"{FINDER}\n# better", encoding="utf-8")
    edited = replace(record, settings=tiny_plan("stop", detector=finder).settings)
    with (
        pytest.raises(RunFolderError, match=r"detector\.file my_finder\.py: '"),
        open_run_folder(tmp_path / "run", edited, resume=True),
    ):
        pass
