"""Writing files so that a kill at any moment leaves them whole."""

import fcntl
import json
import os
import shutil
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import contextmanager
from pathlib import Path

from memorymaze.basics.errors import RunFolderError, SettingsError

UNFINISHED = ".unfinished"


def write_whole(path: Path, content: bytes) -> None:
    """Write a file so that it is there in full or, if we are killed, not at all."""
    unfinished = path.with_name(f"{path.name}.{os.getpid()}{UNFINISHED}")
    try:
        with _naming(path), unfinished.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(path)
    except BaseException:
        unfinished.unlink(missing_ok=True)
        raise
    _sync_folder(path.parent)


@contextmanager
def replaced_when_whole(target: Path) -> Generator[Path]:
    """Give a file to write; it takes the place of another when all went well."""
    unfinished = target.with_name(f"{target.name}.{os.getpid()}{UNFINISHED}")
    try:
        yield unfinished
        unfinished.replace(target)
    finally:
        unfinished.unlink(missing_ok=True)


def check_new_file(path: Path) -> None:
    """Refuse a place for a new file before anything is done for it."""
    if path.exists():
        raise SettingsError(
            f"--out {path}: exists already; choose another name, or delete it"
        )


def check_no_input(out: str | Path, inputs: Iterable[str | Path]) -> None:
    """Refuse to write over what is read."""
    place = Path(out).resolve()
    if any(Path(each).resolve() == place for each in inputs):
        raise SettingsError(
            f"--out {out}: is read here, and would be lost; choose another name"
        )


def write_new(path: str | Path, content: bytes) -> None:
    """Write a file that is not there yet."""
    path = Path(path)
    check_new_file(path)
    try:
        write_whole(path, content)
    except OSError as error:
        raise SettingsError(
            f"--out {path}: cannot be written ({error.strerror})"
        ) from None


@contextmanager
def new_folder(path: str | Path, *, replaces: str | None = None) -> Generator[Path]:
    """Give a folder to fill; it takes its name when it is full, or is never there.

    A folder that has the file `replaces` inside may be replaced.
    """
    path = Path(path)
    check_new_folder(path, replaces=replaces)
    unfinished = path.with_name(f".{path.name}.{os.getpid()}{UNFINISHED}")
    try:
        unfinished.mkdir(parents=True)
    except OSError as error:
        raise SettingsError(
            f"--out {path}: cannot be made ({error.strerror})"
        ) from None
    try:
        yield unfinished
        if replaces is not None and path.exists():
            shutil.rmtree(path)
        unfinished.replace(path)
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)


def write_new_folder(path: Path, contents: Mapping[str, bytes]) -> list[Path]:
    """Write a new folder of files, given by their paths in it; return where they are."""
    with new_folder(path) as folder:
        for name, content in contents.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)
    return [path / name for name in contents]


def as_json(content: object) -> bytes:
    """Return the content of a JSON file that people may read."""
    return json.dumps(content, ensure_ascii=False, indent=1).encode()


def check_new_folder(path: str | Path, *, replaces: str | None = None) -> None:
    """Refuse a place for a new folder before anything is done for it."""
    path = Path(path)
    if not path.name:
        raise SettingsError(f"--out {path}: expected a folder to make, got {path}")
    try:
        is_free = not path.exists() or (path.is_dir() and not any(path.iterdir()))
    except OSError as error:
        raise SettingsError(
            f"--out {path}: cannot be looked into ({error.strerror})"
        ) from None
    if is_free or (replaces is not None and (path / replaces).is_file()):
        return
    what = "" if replaces is None else f" and is no folder with {replaces}"
    raise SettingsError(
        f"--out {path}: exists already{what}; choose another name, or delete it"
    )


def remove_leftovers(folder: Path) -> None:
    """Remove what killed processes left half written in a folder."""
    for path in folder.glob(f"*{UNFINISHED}"):
        path.unlink(missing_ok=True)


def append_line(path: Path, line: str) -> None:
    """Append a line; on return it is on the disk."""
    with _naming(path), path.open("ab") as file:
        file.write(line.encode() + b"\n")
        file.flush()
        os.fsync(file.fileno())


def append_lines(path: Path, lines: bytes, opening: bytes) -> None:
    """Add lines to a file that other processes add to; they are on the disk then.

    A last line that is broken off is cut away first.
    """
    handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX)
        last = _last_line(handle)
        if is_broken_off(last, opening):
            os.ftruncate(handle, os.fstat(handle).st_size - len(last))
        elif last:
            lines = b"\n" + lines
        while lines:
            lines = lines[os.write(handle, lines) :]
        os.fsync(handle)
    finally:
        os.close(handle)


def is_broken_off(last: bytes, opening: bytes) -> bool:
    """Tell whether a line without an end is the beginning of a record that we wrote.

    All that we wrote begin with the opening; people may leave out the last line end.
    """
    if not last or not opening.startswith(last[: len(opening)]):
        return False
    try:
        json.loads(last)
    except ValueError:
        return True
    return False


def _last_line(handle: int) -> bytes:
    """Return what follows the last line end of a file."""
    found, begin = b"", os.fstat(handle).st_size
    while begin and b"\n" not in found:
        step = min(begin, 2**16)
        begin -= step
        found = os.pread(handle, step, begin) + found
    return found.rpartition(b"\n")[2]


@contextmanager
def _naming(path: Path) -> Generator[None]:
    """Say which file a refusal is about: a full disk does not tell."""
    try:
        yield
    except OSError as error:
        error.filename = str(path)
        raise


def _other_run(folder: Path, holder: str) -> RunFolderError:
    return RunFolderError(
        f"{folder}: another process (id {holder}) is writing this run; wait for it, or "
        "choose another folder with --out"
    )


@contextmanager
def locked(
    path: Path, refusal: Callable[[Path, str], Exception] = _other_run
) -> Generator[None]:
    """Hold a lock file, so that no other process writes beside us.

    The system lets go of the lock when the process ends, however it ends. `refusal` makes
    the error of a folder that the process with an id holds.
    """
    with path.open("a+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            holder = file.read().strip() or "unknown"
            raise refusal(path.parent, holder) from None
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
