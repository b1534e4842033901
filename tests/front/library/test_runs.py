import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from threading import RLock

import pandas
import pytest

import memorymaze as mm
from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.front.cli.main import run_command_line
from memorymaze.runs.episodes.results import EpisodeResult

SCRIPT = """
import memorymaze as mm


class Ahead:
    name = "ahead"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(8.0)


corpus = mm.load_corpus({instructions!r}, sites={sites!r})
print(mm.evaluate(Ahead(), corpus, limit=3, out={out!r}, workers=2))
"""


@pytest.fixture
def corpus(tiny_instructions: Path, tiny_sites_folder: Path) -> mm.Corpus:
    return mm.load_corpus(tiny_instructions, sites=tiny_sites_folder)


def _without_time(folder: Path) -> list[dict[str, object]]:
    lines = (folder / "episodes.jsonl").read_text(encoding="utf-8").splitlines()
    results = [json.loads(line) for line in lines]
    for result in results:
        del result["wall_s"]
    return sorted(results, key=lambda result: result["episode_id"])


def test_a_run_from_python_equals_the_run_from_the_command_line(
    corpus: mm.Corpus, tiny_instructions: Path, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    run = mm.evaluate(
        "guide", corpus, limit=4, seed=3, out=tmp_path / "python", workers=1
    )
    code = run_command_line(
        f"evaluate --agent guide --limit 4 --seed 3 --workers 1 --sites "
        f"{tiny_sites_folder} --instructions {tiny_instructions} "
        f"--out {tmp_path / 'cli'}".split()
    )
    assert code == 0
    assert _without_time(run.folder) == _without_time(tmp_path / "cli")
    traces = sorted((run.folder / "traces").iterdir())
    for trace in traces:
        assert trace.read_bytes() == (tmp_path / "cli/traces" / trace.name).read_bytes()
    assert len(traces) == len(run) == 4
    assert run.record.settings == mm.load_run(tmp_path / "cli").record.settings


def test_a_script_without_a_main_guard_runs_an_agent_of_its_own(
    tiny_instructions: Path, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    script = tmp_path / "mine.py"
    script.write_text(
        SCRIPT.format(
            instructions=str(tiny_instructions),
            sites=str(tiny_sites_folder),
            out=str(tmp_path / "run"),
        ),
        encoding="utf-8",
    )
    done = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    assert "ahead, 3 episodes" in done.stdout
    [name] = {each.agent for each in mm.load_run(tmp_path / "run").results}
    assert name == "ahead"


def test_runs_show_themselves_as_table_frame_and_figure(
    corpus: mm.Corpus, tmp_path: Path
) -> None:
    run = mm.evaluate("stop", corpus, limit=3, out=tmp_path / "a", workers=1)
    assert "SR" in str(run.table())
    assert list(run.frame().episode_id) == [each.episode_id for each in run.results]
    assert run.plot().get_axes()[0].get_ylabel() == "success rate"
    again = mm.evaluate("stop", corpus, limit=3, out=tmp_path / "b", workers=1)
    comparison = mm.compare(run, again.folder)
    assert "B - A" in str(comparison.table())
    assert len(comparison.plot().get_axes()) >= 1


def test_frames_without_the_extra_for_tables_say_what_to_install(
    corpus: mm.Corpus, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = mm.evaluate("stop", corpus, limit=1, out=tmp_path / "run", workers=1)
    monkeypatch.setitem(sys.modules, "pandas", None)
    for frame in (run.frame, run.table().frame):
        with pytest.raises(SettingsError, match=r"data frames: .*pandas .*\[tables\]"):
            frame()


class Fails:
    """An agent that cannot go on."""

    name = "fails"

    def follow(self, *given: object) -> None:
        raise RuntimeError("lost my notes")


def test_a_run_shows_how_many_of_its_episodes_failed(
    corpus: mm.Corpus, tmp_path: Path
) -> None:
    run = mm.evaluate(Fails(), corpus, limit=2, out=tmp_path / "run", workers=1)
    assert "2 episodes, success 0.00, 2 crash)" in repr(run)


class HoldsLock(Fails):
    """An agent with something that no other process can have."""

    def __init__(self) -> None:
        self.lock = RLock()


def test_an_agent_that_cannot_be_sent_to_workers_is_refused_before_a_folder_is_made(
    corpus: mm.Corpus, tmp_path: Path
) -> None:
    said = "HoldsLock': expected one that can be sent to worker processes, .*RLock"
    with pytest.raises(SettingsError, match=said):
        mm.evaluate(HoldsLock(), corpus, limit=1, out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_comparing_takes_two_runs_that_are_there(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="expected two runs or more, got 1"):
        mm.compare(tmp_path)
    with pytest.raises(RunFolderError, match="expected a run folder"):
        mm.compare(tmp_path, tmp_path)


@pytest.mark.parametrize(
    ("use", "said"),
    [
        (lambda: mm.load_run(None), "folder: expected a run folder, got None"),
        (lambda: mm.compare(5, 6), "compare: expected runs or run folders, got 5"),
        (
            lambda: mm.evaluate(Fails(), 5),
            "corpus: expected instruction files, .* got 5",
        ),
        (lambda: mm.evaluate(Fails(), out=5), "out: expected a folder to make, got 5"),
    ],
)
def test_what_is_neither_a_run_nor_a_corpus_is_refused_by_its_name(
    use: Callable[[], object], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        use()


def test_frames_of_runs_stand_below_each_other_with_typed_columns(
    write: Callable[..., Path], result: Callable[..., EpisodeResult]
) -> None:
    folders = [
        write("first", [result("a-1"), result("b-1", success=False)]),
        write("second", [result("a-1", spd=7.5)]),
    ]
    frame = pandas.concat(mm.load_run(folder).frame() for folder in folders)
    assert frame["run"].tolist() == ["first", "first", "second"]
    assert frame.groupby("run")["success"].mean().to_dict() == {
        "first": 0.5,
        "second": 1.0,
    }
    assert frame["spd"].dtype.kind == "f"
    assert frame["success"].dtype.kind == "b"
    assert frame["model_calls"].dtype.kind == "i"
