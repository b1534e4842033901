import errno
import os
import resource
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from memorymaze.basics.durable_files import append_line, write_new, write_whole
from memorymaze.basics.errors import SettingsError


@pytest.fixture
def full_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let nothing more be written to the disk, as if it were full."""

    def refuse(handle: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", refuse)


@pytest.fixture
def small_files() -> Iterator[None]:
    """Let files grow to 1 kB only."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
    signal.signal(signal.SIGXFSZ, handler)


def test_a_file_is_there_in_full_and_nothing_beside_it(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", b"first")
    write_whole(tmp_path / "a", b"second")
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert (tmp_path / "a").read_bytes() == b"second"


@pytest.mark.usefixtures("full_disk")
def test_a_full_disk_is_named_and_leaves_what_was_there(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"before")
    with pytest.raises(OSError, match="No space") as caught:
        write_whole(tmp_path / "a", b"after")
    assert caught.value.filename == str(tmp_path / "a")
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert (tmp_path / "a").read_bytes() == b"before"
    with pytest.raises(OSError, match="No space") as caught:
        append_line(tmp_path / "a", "line")
    assert caught.value.filename == str(tmp_path / "a")


@pytest.mark.usefixtures("small_files")
def test_a_file_that_grows_too_long_leaves_nothing_unfinished(tmp_path: Path) -> None:
    with pytest.raises(
        SettingsError, match=r"batch\.jsonl: cannot be written \(File too"
    ):
        write_new(tmp_path / "batch.jsonl", b"x" * 5000)
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_there_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"before")
    with pytest.raises(SettingsError, match="exists already"):
        write_new(tmp_path / "a", b"after")
