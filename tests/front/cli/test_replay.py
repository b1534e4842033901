import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]
SMALL = ("--size", "320x240", "--fps", "1", "--speed", "20", "--no-camera")


@pytest.fixture(scope="session")
def run_folder(tmp_path_factory: pytest.TempPathFactory, tiny_files: list[str]) -> Path:
    """A run of one episode, made by the command line."""
    from memorymaze.front.cli.main import run_command_line

    folder = tmp_path_factory.mktemp("runs") / "one"
    options = [*tiny_files, "--limit", "1", "--workers", "1"]
    assert (
        run_command_line([
            "evaluate",
            "--agent",
            "guide",
            *options,
            "--out",
            str(folder),
        ])
        == 0
    )
    return folder


@pytest.fixture
def given(run_folder: Path, tmp_path: Path) -> list[str | Path]:
    """Run and episode; nothing else is in the folder that commands run in."""
    return [shutil.copytree(run_folder, tmp_path / "runs" / "one"), "p3-2"]


def test_a_video_is_kept_in_its_run(
    memorymaze: Memorymaze, given: list[str | Path]
) -> None:
    video = Path(given[0], "replays", "p3-2.mp4")
    said = memorymaze("replay", *given, *SMALL)
    assert said.code == 0, said.err
    assert said.out.startswith(f"{video}: ")
    assert b"ftyp" in video.read_bytes()[:16]


def test_a_recording_is_written_instead_of_the_video(
    memorymaze: Memorymaze,
    given: list[str | Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    said = memorymaze("replay", *given, *SMALL, "--rerun", "walk.rrd")
    assert (said.code, said.out) == (0, "walk.rrd\n"), said.err
    assert {each.name for each in tmp_path.iterdir()} == {"runs", "walk.rrd"}
    said = memorymaze("replay", *given, *SMALL, "--rerun")
    kept = Path(given[0], "replays")
    assert (said.code, said.out) == (0, f"{kept / 'p3-2.rrd'}\n"), said.err
    assert [each.name for each in kept.iterdir()] == ["p3-2.rrd"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        pytest.param(["--size", "big"], "WIDTHxHEIGHT", id="size"),
        pytest.param(["--size", "321x240"], "even", id="odd size"),
        pytest.param(["--fps", "nan"], "fps: expected a number from", id="nan"),
        pytest.param(["--speed", "0"], "speed: expected a number from", id="speed"),
        pytest.param(["--out", "a.avi"], "*.mp4", id="kind"),
        pytest.param(["--out", "x/a.mp4"], "make ", id="folder"),
        pytest.param(["--rerun", "a.mp4"], "*.rrd", id="recording"),
    ],
)
def test_wrong_input_gives_one_message_and_no_file(
    memorymaze: Memorymaze,
    given: list[str | Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = memorymaze("replay", *given, *arguments)
    assert (done.code, done.out) == (2, "")
    assert said in done.err
    assert "Traceback" not in done.err
    assert [each.name for each in tmp_path.iterdir()] == ["runs"]
    assert not Path(given[0], "replays").exists()


def test_a_wrong_episode_is_wrong_usage(
    memorymaze: Memorymaze,
    run_folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = memorymaze("replay", run_folder, "p3-3")
    assert done.code == 2
    assert "did you mean 'p3-2'?" in done.err


def test_a_place_that_takes_no_file_is_named_at_once(
    memorymaze: Memorymaze, given: list[str | Path]
) -> None:
    done = memorymaze("replay", *given, *SMALL, "--out", "/proc/walk.mp4")
    assert (done.code, done.out) == (2, "")
    assert "/proc/walk.mp4" in done.err


def test_without_the_extra_for_videos_there_are_still_recordings(
    memorymaze: Memorymaze,
    given: list[str | Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    done = memorymaze("replay", *given, *SMALL)
    assert (done.code, done.out) == (2, "")
    assert "videos: the package av is not installed; type: " in done.err
    assert "[video]" in done.err
    assert not Path(given[0], "replays").exists()
    done = memorymaze("replay", *given, *SMALL, "--rerun", tmp_path / "walk.rrd")
    assert done.code == 0, done.err
