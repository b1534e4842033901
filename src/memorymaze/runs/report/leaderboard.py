"""A leaderboard: which runs of a folder can stand on it, and its pages."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, get_args

from memorymaze.basics.durable_files import new_folder
from memorymaze.basics.errors import MemoryMazeError, SettingsError
from memorymaze.basics.tables import Column, Table
from memorymaze.runs.episodes.settings import Track
from memorymaze.runs.episodes.shards import parts_in
from memorymaze.runs.report.overview import settings_table
from memorymaze.runs.report.pages import Pages, safe_name
from memorymaze.runs.submission import (
    Submission,
    check_submission,
)
from memorymaze.runs.tables import (
    PAPER_MEASURES,
    MeasuredRun,
    load_runs,
    paper_table,
    run_notes,
)
from memorymaze.runs.tables.measures import PAPER_QUANTITIES, mean_fields
from memorymaze.runs.tables.runs import place_of, study_title
from memorymaze.texts.corpus import Corpus, load_corpus
from memorymaze.texts.corpus.records import WRITTEN_BY

PUBLISHED = "published"
MARK = "leaderboard.csv"
"""All its rows; the file by which a folder is known to be a leaderboard."""
COLUMNS = (
    Column("track"),
    Column("study"),
    Column("place", "Place"),
    Column("method", "Method", "label"),
    Column("run", "Run", link=lambda row: row.get("page")),
    Column("begun", "Begun"),
    Column("episodes", "Episodes"),
    *PAPER_QUANTITIES,
    Column("remarks", "Remarks"),
)
TRACK_TITLES: dict[Track, str] = {
    "default": "Default track",
    "obstacles": "Track with obstacles and people",
    "people": "Track with people one can ask",
}


@dataclass(frozen=True, slots=True)
class _Standing:
    """A run that stands on a leaderboard."""

    submission: Submission
    measured: MeasuredRun

    @property
    def name(self) -> str:
        """Name of its folder."""
        return self.measured.folder.name

    @property
    def page(self) -> str:
        """Its page, from the root of the leaderboard."""
        return f"runs/{safe_name(self.name)}.html"


@dataclass(frozen=True, slots=True)
class Refused:
    """A run that does not, and why."""

    name: str
    reasons: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Leaderboard:
    """All runs of a folder, looked over."""

    standing: tuple[_Standing, ...]
    refused: tuple[Refused, ...]


def read_leaderboard(
    folder: str | Path,
    corpus: Corpus | None = None,
    *,
    progress: Callable[[str, int, int], None] | None = None,
) -> Leaderboard:
    """Look over every run folder in a folder; files beside them do not matter.

    A run that cannot be read is refused as one that breaks the rules; it does not
    touch the others.
    """
    corpus = corpus or load_corpus()
    standing: list[_Standing] = []
    refused: list[Refused] = []
    for run in _runs_in(Path(folder)):
        told = None if progress is None else partial(progress, run.name)
        try:
            found = check_submission(run, corpus, progress=told)
            measured = None if found.problems else load_runs([run])[0]
        except MemoryMazeError as error:
            refused.append(Refused(run.name, (str(error),)))
            continue
        if measured is None:
            refused.append(Refused(run.name, found.problems))
        else:
            standing.append(_Standing(found, measured))
    return Leaderboard(tuple(standing), tuple(refused))


def write_leaderboard(
    board: Leaderboard, folder: str | Path, *, overwrite: bool = False
) -> None:
    """Write a leaderboard as static pages; `index.html` is where it begins."""
    with new_folder(folder, replaces=MARK if overwrite else None) as unfinished:
        _write(board, Pages(unfinished))


def _write(board: Leaderboard, pages: Pages) -> None:
    pages.copy_static("report.css", "tables.js")
    everything = [r for each in board.standing for r in each.measured.results]
    written = [
        f"Instructions written by {WRITTEN_BY[source]}"
        for source in sorted({result.source for result in everything})
    ]
    shared = {"places": (), "written": written}
    tracks = [(TRACK_TITLES[t], _tables(board, t)) for t in get_args(Track)]
    rows = [row for _, tables in tracks for table in tables for row in table.rows]
    pages.write_text(MARK, Table("Leaderboard", COLUMNS, tuple(rows)).csv())
    view = {
        "tracks": [(title, tables) for title, tables in tracks if tables],
        "refused": board.refused,
    }
    pages.write("index.html", "leaderboard.html", shared | view, title="Leaderboard")
    for each in board.standing:
        pages.write(
            each.page,
            "leaderboard_run.html",
            shared
            | {
                "standing": each,
                "notes": run_notes(each.measured),
                "settings": settings_table(each.measured.record, each.name),
                "results": paper_table([each.measured], "II"),
            },
            title=f"Run {each.name}",
        )


def _runs_in(folder: Path) -> list[Path]:
    if (folder / "run.json").exists() or parts_in(folder):
        raise SettingsError(
            f"{folder}: expected a folder of run folders, got a run folder; name the "
            "folder that it lies in"
        )
    try:
        runs = sorted(each for each in folder.iterdir() if each.is_dir())
    except OSError as error:
        raise SettingsError(
            f"{folder}: expected a folder of run folders ({error.strerror})"
        ) from None
    if not runs:
        raise SettingsError(f"{folder}: expected a folder of run folders, got none")
    return runs


def _tables(board: Leaderboard, track: Track) -> list[Table]:
    """Return for every study the runs in order, and the paper's means."""
    chosen = [each for each in board.standing if each.submission.track == track]
    studies = {result.study for each in chosen for result in each.measured.results}
    return [_table(chosen, track, study) for study in sorted(studies)]


def _table(chosen: Sequence[_Standing], track: Track, study: str) -> Table:
    rows = [row for each in chosen for row in _standing(each, study)]
    rows.sort(key=lambda row: (-row["sr"], row["spd"], row["run"]))
    for number, row in enumerate(rows, start=1):
        before = rows[number - 2] if number > 1 else None
        is_equal = before and all(before[name] == row[name] for name in ("sr", "spd"))
        row["place"] = before["place"] if before and is_equal else number
    return Table(
        f"{TRACK_TITLES[track]}: {study_title(study)}, means over routes",
        COLUMNS,
        tuple(
            {"track": track, "study": study, **row}
            for row in (*rows, *_published(chosen[0], study))
        ),
        name=f"leaderboard-{track}-{study}",
        aside=lambda row: row["run"] == PUBLISHED,
    )


def _standing(standing: _Standing, study: str) -> Iterator[dict[str, Any]]:
    results = [each for each in standing.measured.results if each.study == study]
    if results:
        people = [each.participant for each in results]
        places = [place_of(each) for each in results]
        yield {
            "method": standing.measured.label,
            "run": standing.name,
            "page": standing.page,
            "begun": standing.measured.record.started[:10],
            "episodes": len(results),
            **mean_fields(PAPER_QUANTITIES, results, people, places),
            "remarks": " ".join(standing.submission.remarks),
        }


def _published(any_run: _Standing, study: str) -> Iterator[dict[str, Any]]:
    """Yield the paper's means over routes, where the study has several."""
    parsers = {None: "", True: ", with parser", False: ", without parser"}
    for row in paper_table([any_run.measured], "II").rows:
        if (row["figures"], row["site"], row["study"]) == (PUBLISHED, "mean", study):
            yield {
                "place": None,
                "method": row["method"] + parsers[row["parser"]],
                "run": PUBLISHED,
                "begun": None,
                "episodes": None,
                **{each.name: row[each.name] for each in PAPER_MEASURES},
                "remarks": "another experiment",
            }
