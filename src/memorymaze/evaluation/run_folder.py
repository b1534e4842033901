"""A run on the disk: written so that a kill at any moment loses nothing finished.

run.json          settings, code and number of episodes, before anything else
episodes.jsonl    one result per line, appended as each episode ends
traces/           one file per episode, written before its line
summary.json      the numbers of the whole run, at the end
"""

import json
from collections.abc import Generator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from memorymaze.durable_files import (
    append_line,
    locked,
    remove_leftovers,
    write_whole,
)
from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.evaluation.provenance import CodeStamp
from memorymaze.evaluation.results import (
    EpisodeResult,
    result_from_line,
    result_to_line,
)
from memorymaze.evaluation.settings import RunSettings, differences

FORMAT = 1
"""Of the run folder; older folders are refused, not guessed at."""


@dataclass(frozen=True, slots=True)
class RunRecord:
    """What `run.json` says."""

    settings: RunSettings
    code: CodeStamp
    started: str
    """Date and time in UTC, ISO 8601."""
    format: int = FORMAT


_RECORD = TypeAdapter(RunRecord)


class RunFolder:
    """A run folder that this process alone writes.

    Attributes:
        path: The folder.
        finished: Results by episode id.
    """

    def __init__(self, path: Path, finished: dict[str, EpisodeResult]) -> None:
        """Stand for a folder that is locked and repaired; use `open_run_folder`."""
        self.path = path
        self.finished = finished

    def add(self, result: EpisodeResult) -> None:
        """Append the result of an episode; on return it is on the disk.

        Raises:
            RunFolderError: The episode has a result already, or the disk refuses.
        """
        if result.episode_id in self.finished:
            raise RunFolderError(
                f"{self.path}: episode {result.episode_id!r} has a result already"
            )
        try:
            append_line(self.path / "episodes.jsonl", result_to_line(result))
        except OSError as error:
            raise _refused(self.path, error) from None
        self.finished[result.episode_id] = result

    def write_summary(self, summary: Mapping[str, Any]) -> None:
        """Write `summary.json`."""
        write_whole(self.path / "summary.json", _pretty(summary))


@contextmanager
def open_run_folder(
    path: Path, record: RunRecord, *, resume: bool
) -> Generator[RunFolder]:
    """Begin a run, or take up one that was broken off.

    Args:
        path: The folder; made where there is none.
        record: The run's settings and code.
        resume: Whether a run that is there already is taken up.

    Raises:
        RunFolderError: Another process writes the folder; or it holds a run and
            `resume` is False, or one with other settings or made by other code; or it
            is damaged, or cannot be written.
    """
    with ExitStack() as stack:
        try:
            (path / "traces").mkdir(parents=True, exist_ok=True)
            stack.enter_context(locked(path / "lock"))
            remove_leftovers(path)
            remove_leftovers(path / "traces")
            _begin(path, record, resume=resume)
            finished = _repaired_results(path)
        except OSError as error:
            raise _refused(path, error) from None
        yield RunFolder(path, finished)


def read_run(path: str | Path) -> tuple[RunRecord, list[EpisodeResult]]:
    """Read a run, also one that is still being written.

    Returns:
        What `run.json` says, and the results so far in the order of episode ids.

    Raises:
        RunFolderError: It is no run folder, or is damaged; names file and line.
    """
    path = Path(path)
    if not (path / "run.json").is_file():
        there = "a file" if path.exists() else "no such folder"
        if path.is_dir():
            there = "a folder without run.json"
        raise RunFolderError(
            f"{path}: expected a run folder, as `memorymaze evaluate --out` makes "
            f"them, got {there}"
        )
    record = _read_record(path)
    results, _ = _read_results(path)
    return record, [results[key] for key in sorted(results)]


def _begin(path: Path, record: RunRecord, *, resume: bool) -> None:
    if not (path / "run.json").exists():
        if (path / "episodes.jsonl").exists():
            raise RunFolderError(
                f"{path}: has results but no run.json that says how they came about; "
                "choose another folder with --out"
            )
        write_whole(path / "run.json", _pretty(asdict(record)))
        return
    if not resume:
        raise RunFolderError(
            f"{path}: holds a run already; add --resume to finish it, or choose "
            "another folder with --out"
        )
    old = _read_record(path)
    found = differences(old.settings, record.settings)
    found += old.code.differences(record.code)
    if found:
        raise RunFolderError(
            f"{path}: cannot resume, because the run there was made differently:\n  "
            + "\n  ".join(found)
            + "\nUse the same settings and code, choose another folder with --out, or delete "
            "this one"
        )


def _read_record(path: Path) -> RunRecord:
    place = path / "run.json"
    try:
        content = json.loads(place.read_text(encoding="utf-8"))
        if isinstance(content, dict) and content.get("format") != FORMAT:
            raise RunFolderError(
                f"{place}: expected format {FORMAT}, got {content.get('format')!r}; "
                "the run was made by another version of memorymaze"
            )
        return _RECORD.validate_python(content)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or "the whole"
        raise _damaged(place, f"{field} is wrong ({first['msg']})") from None
    except OSError as error:
        raise _refused(path, error) from None
    except (ValueError, RecursionError, SettingsError) as error:
        raise _damaged(place, f"it cannot be read ({error})") from None


def _repaired_results(path: Path) -> dict[str, EpisodeResult]:
    """Read the results; cut off a last line that a kill left unfinished."""
    results, whole = _read_results(path)
    file = path / "episodes.jsonl"
    if file.exists():
        content = file.read_bytes()
        end = b"\n" if whole and not whole.endswith(b"\n") else b""
        if whole + end != content:
            write_whole(file, whole + end)
    return results


def _read_results(path: Path) -> tuple[dict[str, EpisodeResult], bytes]:
    """Return results by id, and the part of the file that is sound."""
    file = path / "episodes.jsonl"
    try:
        content = file.read_bytes() if file.exists() else b""
    except OSError as error:
        raise _refused(path, error) from None
    results: dict[str, EpisodeResult] = {}
    sound = 0
    for number, line in enumerate(content.split(b"\n"), start=1):
        ends = content[sound + len(line) : sound + len(line) + 1]
        if line:
            place = f"{file}:{number}"
            try:
                result = result_from_line(line.decode("utf-8", "replace"), place)
            except RunFolderError:
                if ends:
                    raise
                break
            if result.episode_id in results:
                raise RunFolderError(
                    f"{place}: expected one result per episode, got a second one of "
                    f"{result.episode_id!r}; delete one of the two lines"
                )
            results[result.episode_id] = result
        sound += len(line) + len(ends)
    return results, content[:sound]


def _pretty(content: Mapping[str, Any]) -> bytes:
    return (json.dumps(content, indent=2, ensure_ascii=False) + "\n").encode()


def _damaged(place: Path, what: str) -> RunFolderError:
    return RunFolderError(
        f"{place}: expected the settings of a run, got a damaged file: {what}; bring it "
        "back, or run again into another folder"
    )


def _refused(path: Path, error: OSError) -> RunFolderError:
    reason = error.strerror or str(error)
    return RunFolderError(
        f"{error.filename or path}: cannot be read or written ({reason}); is {path} the "
        "right folder?"
    )
