"""Writing files so that a kill at any moment leaves them whole."""

import fcntl
import os
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from memorymaze.errors import RunFolderError, SettingsError

UNFINISHED = ".unfinished"


def write_whole(path: Path, content: bytes) -> None:
    """Write a file so that it is there in full or, if we are killed, not at all."""
    unfinished = path.with_name(f"{path.name}.{os.getpid()}{UNFINISHED}")
    with unfinished.open("wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    unfinished.replace(path)
    _sync_folder(path.parent)


def write_new(path: str | Path, content: bytes) -> None:
    """Write a file that is not there yet.

    Raises:
        SettingsError: It is there, or cannot be written.
    """
    path = Path(path)
    if path.exists():
        raise SettingsError(
            f"--out {path}: exists already; choose another name, or delete it"
        )
    try:
        write_whole(path, content)
    except OSError as error:
        raise SettingsError(
            f"--out {path}: cannot be written ({error.strerror})"
        ) from None


def remove_leftovers(folder: Path) -> None:
    """Remove what killed processes left half written in a folder."""
    for path in folder.glob(f"*{UNFINISHED}"):
        path.unlink(missing_ok=True)


def append_line(path: Path, line: str) -> None:
    """Append a line; on return it is on the disk."""
    with path.open("ab") as file:
        file.write(line.encode() + b"\n")
        file.flush()
        os.fsync(file.fileno())


@contextmanager
def locked(path: Path) -> Generator[None]:
    """Hold a lock file, so that no other process writes beside us.

    The system lets go of the lock when the process ends, however it ends.

    Raises:
        RunFolderError: Another process holds it.
    """
    with path.open("a+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            holder = file.read().strip() or "unknown"
            raise RunFolderError(
                f"{path.parent}: another process (id {holder}) is writing this run; "
                "wait for it, or choose another folder with --out"
            ) from None
        file.truncate(0)
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def _sync_folder(folder: Path) -> None:
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
