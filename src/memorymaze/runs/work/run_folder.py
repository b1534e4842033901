"""A run on the disk: written so that a kill at any moment loses nothing finished.

plans/                   the plan of every site, before anything else
instructions.jsonl.gz    what is followed
run.json                 settings, code and number of episodes, when these are there
episodes.jsonl           one result per line, appended as each episode ends
traces/                  one file per episode, written before its line
summary.json             the numbers of the whole run, at the end

A run in parts is a folder of such folders, `part-1-of-8` and so on.
"""

import gzip
import json
import warnings
import zlib
from collections.abc import Generator, Iterable, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, cast
from urllib.parse import quote

from pydantic import TypeAdapter, ValidationError

from memorymaze.basics.durable_files import (
    append_line,
    locked,
    remove_leftovers,
    write_whole,
)
from memorymaze.basics.errors import RunFolderError, RunFolderWarning, SettingsError
from memorymaze.basics.input_files import LARGEST_FILE, parse_json
from memorymaze.basics.options import check_kind
from memorymaze.runs.episodes.provenance import CodeStamp
from memorymaze.runs.episodes.results import (
    EpisodeResult,
    result_from_line,
    result_to_line,
)
from memorymaze.runs.episodes.settings import RunDefinition, differences
from memorymaze.runs.episodes.shards import PartOfRun, parts_in, whole_settings
from memorymaze.runs.episodes.trace import keep_trace, trace_path
from memorymaze.texts.corpus.records import Instruction
from memorymaze.world.sites.loading import sound_site
from memorymaze.world.sites.plan import plan_bytes
from memorymaze.world.sites.reading import understand_plan
from memorymaze.world.sites.records import Site

FORMAT = 2
"""Of the run folder; others are refused, not guessed at."""


@dataclass(frozen=True, slots=True)
class RunRecord:
    """What `run.json` says."""

    settings: RunDefinition
    code: CodeStamp
    started: str
    """Date and time in UTC, ISO 8601."""
    format: int = FORMAT


_RECORD = TypeAdapter(RunRecord)
_INSTRUCTION = TypeAdapter(Instruction)

INSTRUCTIONS = "instructions.jsonl.gz"


class RunFolder:
    """A run folder that this process alone writes."""

    def __init__(self, path: Path, finished: dict[str, EpisodeResult]) -> None:
        """Stand for a folder that is locked and repaired; use `open_run_folder`."""
        self.path = path
        self.finished = finished

    def add(self, result: EpisodeResult, trace: bytes | None = None) -> None:
        """Write the trace of an episode, then its result; both are then on the disk."""
        if result.episode_id in self.finished:
            raise RunFolderError(
                f"{self.path}: episode {result.episode_id!r} has a result already"
            )
        with _telling_how_to_go_on(self.path):
            # In this order: an episode that counts as done has its trace.
            if trace is not None:
                keep_trace(self.path, result.episode_id, trace)
            append_line(self.path / "episodes.jsonl", result_to_line(result))
        self.finished[result.episode_id] = result

    def warn_of_lost_traces(self) -> None:
        """Say of how many results the traces are gone."""
        lost = [one for one in self.finished if not trace_path(self.path, one).exists()]
        if lost:
            told = (
                f"{self.path}: expected a trace of each result, got none of {len(lost)} of "
                f"{len(self.finished)}, such as {min(lost)!r}; bring them back, or delete "
                "their lines in episodes.jsonl, and --resume runs them again"
            )
            warnings.warn(told, RunFolderWarning, stacklevel=3)

    def write_summary(self, summary: Mapping[str, Any]) -> None:
        """Write `summary.json`."""
        with _telling_how_to_go_on(self.path):
            write_whole(self.path / "summary.json", _pretty(summary))


@contextmanager
def open_run_folder(
    path: Path,
    record: RunRecord,
    *,
    resume: bool,
    sites: Iterable[Site] = (),
    instructions: Iterable[Instruction] = (),
) -> Generator[RunFolder]:
    """Begin a run, or take up one that was broken off."""
    with ExitStack() as stack:
        try:
            _check_place(path, record)
            (path / "traces").mkdir(parents=True, exist_ok=True)
            stack.enter_context(locked(path / "lock"))
            remove_leftovers(path)
            remove_leftovers(path / "traces")
            remove_leftovers(path / "plans")
            begun = _check_same_run(path, record, resume=resume)
            _keep_inputs(path, sites, instructions)
            if not begun:
                write_whole(path / "run.json", _pretty(asdict(record)))
            finished = _repaired_results(path)
        except OSError as error:
            raise _refused(path, error) from None
        yield RunFolder(path, finished)


def read_run(path: str | Path) -> tuple[RunRecord, list[EpisodeResult]]:
    """Read a run, also one that is still being written; one in parts is read as a whole."""
    check_kind("folder", path, str | Path, "a run folder")
    path = Path(path)
    parts = [] if (path / "run.json").is_file() else parts_in(path)
    if parts:
        return _read_parts(parts)
    if not (path / "run.json").is_file():
        there = "a file" if path.exists() else "no such folder"
        if path.is_dir():
            there = "a folder without run.json"
        raise RunFolderError(
            f"{path}: expected a run folder, as `memorymaze evaluate --out` makes "
            f"them, got {there}",
            is_missing=not path.exists(),
        )
    record = _read_record(path)
    results, _ = _read_results(path)
    return record, [results[key] for key in sorted(results)]


def _read_parts(parts: list[Path]) -> tuple[RunRecord, list[EpisodeResult]]:
    read = [read_run(part) for part in parts]
    settings = whole_settings([
        PartOfRun(part, record.settings, record.code)
        for part, (record, _) in zip(parts, read, strict=True)
    ])
    first = min((record for record, _ in read), key=lambda record: record.started)
    results = [result for _, part in read for result in part]
    return (
        replace(first, settings=settings),
        sorted(results, key=lambda result: result.episode_id),
    )


def read_plans(path: str | Path) -> dict[str, Site]:
    """Read the sites of a run from the plans that it keeps, by name."""
    parts = [] if Path(path, "plans").is_dir() else parts_in(Path(path))
    if parts:
        return {name: site for part in parts for name, site in read_plans(part).items()}
    files = sorted(Path(path, "plans").glob("*.geojson.gz"))
    if not files:
        raise RunFolderError(
            f"{path}: expected the plans of the run's sites, got none in plans/; bring "
            "them back, or run it again"
        )
    sites: dict[str, Site] = {}
    for file in files:
        try:
            document = parse_json(_unpacked(file))
        except ValueError as error:
            raise _damaged_input(file, error) from None
        if not isinstance(document, dict):
            raise _damaged_input(file, "it holds no plan")
        plan = understand_plan(cast(dict[str, object], document))
        site = sound_site(plan, str(file))
        sites[site.name] = site
    return sites


def read_instructions(path: str | Path) -> list[Instruction]:
    """Read what a run follows, each instruction once, in the order of their ids."""
    file = Path(path, INSTRUCTIONS)
    parts = [] if file.is_file() else parts_in(Path(path))
    if parts:
        told = {each.id: each for part in parts for each in read_instructions(part)}
        return sorted(told.values(), key=lambda each: each.id)
    if not file.is_file():
        if _read_record(Path(path)).settings.episodes == 0:
            return []
        raise RunFolderError(
            f"{path}: expected the instructions of the run, got no {INSTRUCTIONS}; bring "
            "it back, or run it again"
        )
    try:
        return [_INSTRUCTION.validate_json(line) for line in _lines(_unpacked(file))]
    except ValidationError as error:
        raise _damaged_input(file, error.errors()[0]["msg"]) from None


def _keep_inputs(
    path: Path, sites: Iterable[Site], instructions: Iterable[Instruction]
) -> None:
    """Write plans and instructions where they are not there; check them where they are."""
    ordered = sorted(instructions, key=lambda each: each.id)
    lines = [_INSTRUCTION.dump_json(each, exclude={"origin"}) for each in ordered]
    files = {
        path / "plans" / f"{quote(site.name, safe='')}.geojson.gz": plan_bytes(site)
        for site in sites
    }
    if lines:
        files[path / INSTRUCTIONS] = b"".join(line + b"\n" for line in lines)
    for file, content in files.items():
        if not file.exists():
            file.parent.mkdir(exist_ok=True)
            # Without the time, so that equal runs are equal files.
            write_whole(file, gzip.compress(content, mtime=0))
        elif _unpacked(file) != content:
            raise RunFolderError(
                f"{file}: expected what the run was begun with, got another content; "
                "bring it back, or delete it and --resume writes it again"
            )


def _unpacked(file: Path) -> bytes:
    try:
        with gzip.open(file, "rb") as packed:
            content = packed.read(LARGEST_FILE + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise _damaged_input(file, error) from None
    if not content:
        raise _damaged_input(file, "it is empty")
    if len(content) > LARGEST_FILE:
        raise _damaged_input(
            file, f"unpacked it has more than {LARGEST_FILE // 2**20} MiB"
        )
    return content


def _damaged_input(file: Path, what: object) -> RunFolderError:
    return RunFolderError(f"{file}: the file is damaged ({what})")


def _lines(content: bytes) -> list[bytes]:
    return [line for line in content.split(b"\n") if line]


def _check_place(path: Path, record: RunRecord) -> None:
    """Refuse the folder of parts for a whole run, and that of a whole run for parts."""
    if parts_in(path):
        raise RunFolderError(
            f"{path}: holds parts of a run; choose another folder with --out"
        )
    if record.settings.shard is not None and (path.parent / "run.json").exists():
        raise RunFolderError(
            f"{path.parent}: holds a whole run; choose another folder for parts with --out"
        )


def _check_same_run(path: Path, record: RunRecord, *, resume: bool) -> bool:
    """Refuse a folder with another run; tell whether this one was begun there."""
    if not (path / "run.json").exists():
        if (path / "episodes.jsonl").exists():
            raise RunFolderError(
                f"{path}: has results but no run.json that says how they came about; "
                "choose another folder with --out"
            )
        return False
    if not resume:
        raise RunFolderError(
            f"{path}: holds a run already; add --resume to finish it, or choose "
            "another folder with --out"
        )
    old = _read_record(path)
    found = [*map(str, differences(old.settings, record.settings))]
    found += old.code.differences(record.code)
    if found:
        raise RunFolderError(
            f"{path}: cannot resume, because the run there was made differently:\n  "
            + "\n  ".join(found)
            + "\nUse the same settings and code, choose another folder with --out, or delete "
            "this one"
        )
    return True


def _read_record(path: Path) -> RunRecord:
    place = path / "run.json"
    try:
        content = json.loads(place.read_text(encoding="utf-8"))
        if isinstance(content, dict) and content.get("format") != FORMAT:
            raise RunFolderError(
                f"{place}: expected format {FORMAT}, got {content.get('format')!r}; "
                "the run was made by another version of memorymaze; run it again"
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


@contextmanager
def _telling_how_to_go_on(path: Path) -> Generator[None]:
    try:
        yield
    except OSError as error:
        raise RunFolderError(
            f"{error.filename or path}: cannot be written ({error.strerror or error}); "
            f"what is finished is kept in {path}. Make room, and add --resume to the "
            "command to go on"
        ) from None


def _refused(path: Path, error: OSError) -> RunFolderError:
    reason = error.strerror or str(error)
    return RunFolderError(
        f"{error.filename or path}: cannot be read or written ({reason}); is {path} the "
        "right folder?"
    )
