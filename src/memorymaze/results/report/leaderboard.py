"""A leaderboard: which runs of a folder can stand on it, and its pages."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.records import WRITTEN_BY
from memorymaze.metrics.aggregate import Estimate
from memorymaze.results.report.overview import TableGroup, settings_rows, table_groups
from memorymaze.results.report.pages import Pages, safe_name
from memorymaze.results.submission import Submission, Track, check_submission
from memorymaze.results.tables import (
    MeasuredRun,
    estimate_means,
    load_runs,
    run_notes,
)

TRACK_TITLES: dict[Track, str] = {
    "default": "Default track",
    "obstacles": "Track with obstacles and people",
}


@dataclass(frozen=True, slots=True)
class Standing:
    """A run that stands on a leaderboard."""

    submission: Submission
    measured: MeasuredRun

    @property
    def name(self) -> str:
        """Name of its folder."""
        return self.submission.folder.name

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

    standing: tuple[Standing, ...]
    refused: tuple[Refused, ...]


@dataclass(frozen=True, slots=True)
class Ranked:
    """A run's place in a study."""

    place: int
    """From 1; equal success rates and SPDs share one."""
    standing: Standing
    episodes: int
    values: dict[str, Estimate]
    """Unweighted means over routes, by the names in `MEASURES`."""


def read_leaderboard(
    folder: str | Path,
    *,
    instruction_files: Sequence[str | Path] | None = None,
    sites_folder: str | Path | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> Leaderboard:
    """Look over every run folder in a folder; files beside them do not matter.

    Args:
        folder: Holds run folders.
        instruction_files: The leaderboard's corpus; None for the shipped one.
        sites_folder: The leaderboard's site plans; None for the shipped ones.
        progress: Told the run's name, and how many of its traces of how many are done.

    Raises:
        SettingsError: The folder does not hold folders, or is a run itself.
        MemoryMazeError: Corpus or plans cannot be read.
    """
    standing: list[Standing] = []
    refused: list[Refused] = []
    for run in _runs_in(Path(folder)):

        def told(done: int, total: int, name: str = run.name) -> None:
            if progress is not None:
                progress(name, done, total)

        try:
            found = check_submission(
                run,
                instruction_files=instruction_files,
                sites_folder=sites_folder,
                progress=told,
            )
            measured = load_runs([run])[0] if not found.problems else None
        except RunFolderError as error:
            refused.append(Refused(run.name, (str(error),)))
            continue
        if measured is None:
            refused.append(Refused(run.name, found.problems))
        else:
            standing.append(Standing(found, measured))
    return Leaderboard(tuple(standing), tuple(refused))


def write_leaderboard(board: Leaderboard, folder: str | Path) -> None:
    """Write a leaderboard as static pages; `index.html` is where it begins.

    Raises:
        SettingsError: The folder is not empty, or cannot be made.
    """
    pages = Pages(folder)
    pages.copy_static("report.css", "tables.js")
    everything = [r for each in board.standing for r in each.submission.results]
    written = [
        f"Instructions written by {WRITTEN_BY[source]}"
        for source in sorted({result.source for result in everything})
    ]
    shared = {"places": (), "written": written}
    pages.write(
        "index.html",
        "leaderboard.html",
        shared
        | {
            "tracks": [
                (TRACK_TITLES[track], _studies(board, track))
                for track in get_args(Track)
                if any(each.submission.track == track for each in board.standing)
            ],
            "refused": board.refused,
        },
        title="Leaderboard",
    )
    for each in board.standing:
        pages.write(
            each.page,
            "leaderboard_run.html",
            shared
            | {
                "standing": each,
                "notes": run_notes(each.measured),
                "settings": settings_rows(each.submission.record),
                "groups": table_groups([each.measured], "II"),
            },
            title=f"Run {each.name}",
        )


def _runs_in(folder: Path) -> list[Path]:
    if (folder / "run.json").exists():
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


def _studies(
    board: Leaderboard, track: Track
) -> list[tuple[str, list[Ranked], list[TableGroup]]]:
    """Return for every study the runs in order, and the paper's means."""
    chosen = [each for each in board.standing if each.submission.track == track]
    studies = dict.fromkeys(
        result.study for each in chosen for result in each.submission.results
    )
    published = table_groups([chosen[0].measured], "II") if chosen else []
    return [
        (
            study,
            _ranked(chosen, study),
            [each for each in published if each.is_mean and each.study == study],
        )
        for study in sorted(studies)
    ]


def _ranked(chosen: Sequence[Standing], study: str) -> list[Ranked]:
    found: list[tuple[Standing, int, dict[str, Estimate]]] = []
    for each in chosen:
        cells: dict[tuple[str, str], list[EpisodeResult]] = {}
        for result in each.submission.results:
            if result.study == study:
                cells.setdefault((result.site, result.route), []).append(result)
        if cells:
            count = sum(map(len, cells.values()))
            found.append((each, count, estimate_means(list(cells.values()))))
    found.sort(key=lambda e: (-e[2]["sr"].mean, e[2]["spd"].mean, e[0].name))
    ranked: list[Ranked] = []
    for number, (each, count, values) in enumerate(found, start=1):
        before = ranked[-1] if ranked else None
        is_equal = before is not None and all(
            before.values[name].mean == values[name].mean for name in ("sr", "spd")
        )
        place = before.place if before is not None and is_equal else number
        ranked.append(Ranked(place, each, count, values))
    return ranked
