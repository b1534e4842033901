import os
from collections.abc import Callable
from pathlib import Path

import av
import numpy as np
import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.video_file import (
    check_target,
    write_video,
)

Write = Callable[[], Path]
RED, BLUE = (200, 40, 30), (20, 60, 210)


def plain(colour: tuple[int, int, int]) -> np.ndarray:
    return np.full((48, 64, 3), colour, dtype=np.uint8)


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write three frames, red, red and blue, of a tenth of a second each."""

    def written() -> Path:
        path = tmp_path / "film.mp4"
        pictures = map(plain, (RED, RED, BLUE))
        write_video(path, pictures, (64, 48), 10, title="A film", total=3)
        return path

    return written


def test_players_read_what_was_written(write: Write) -> None:
    with av.open(str(write())) as film:
        (stream,) = film.streams.video
        frames = [each.to_ndarray(format="rgb24") for each in film.decode(video=0)]
        assert (stream.width, stream.height, stream.average_rate) == (64, 48, 10)
        assert stream.codec_context.name == "h264"
        assert float(stream.duration * stream.time_base) == pytest.approx(0.3)
        assert film.metadata["title"] == "A film"
    colours = np.array([frame.mean(axis=(0, 1)) for frame in frames])
    assert colours == pytest.approx(np.array([RED, RED, BLUE]), abs=8)


def test_a_file_of_this_name_is_replaced_when_all_is_there(write: Write) -> None:
    path = write()
    whole = path.read_bytes()
    path.write_bytes(b"as it was")
    assert write().read_bytes() == whole
    assert [each.name for each in path.parent.iterdir()] == ["film.mp4"]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("film", r"named \*\.mp4"),
        ("folder.mp4", "got the folder"),
    ],
)
def test_a_file_that_cannot_be_is_refused(tmp_path: Path, name: str, said: str) -> None:
    (tmp_path / "folder.mp4").mkdir()
    with pytest.raises(SettingsError, match=said):
        check_target(tmp_path / name, ".mp4", "video")


def test_a_folder_without_leave_to_write_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(SettingsError, match="leave to write"):
        check_target(tmp_path / "film.mp4", ".mp4", "video")
