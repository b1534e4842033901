"""Success on SAIL by map, beside that of the people who followed the same paragraphs."""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.errors import SettingsError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.sail import DEVELOPMENT, paragraph_of
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap
from memorymaze.results.tables.cells import estimate_cell
from memorymaze.results.tables.columns import markdown_columns, text_columns
from memorymaze.results.tables.rows import MeasuredRun
from memorymaze.results.tables.run_notes import run_notes

STUDY = "sail"
STYLES = ("text", "md", "csv")
HEADINGS = ("paragraphs", "map", "texts", "episodes", "success [95 %]", "people")
KEY = (
    "success: stopped by itself at the goal's node, mean over start headings; "
    "[95 % interval], bootstrap over paragraphs. people: share of followers who reached "
    "the goal, all trials on the same paragraphs taken together. usable: the corpus "
    "knows a legal path. development half: paragraphs of the writers whose texts were "
    "read while the rules agent was developed."
)


@dataclass(frozen=True, slots=True)
class SailRow:
    """One line of the table: some paragraphs of one map, or of all."""

    method: str
    paragraphs: str
    """Which: `all`, `usable`, `development half`, `other half`."""
    map: str
    """The map, or `all`."""
    texts: int
    episodes: int
    success: Estimate
    followers: int
    """People's trials on these paragraphs."""
    people: float | None
    """Share of the trials in which they arrived; None without trials."""


def is_sail(runs: Sequence[MeasuredRun]) -> bool:
    """Tell whether runs are on SAIL.

    Raises:
        SettingsError: Some are and some are not.
    """
    studies = {result.study == STUDY for run in runs for result in run.results}
    if len(studies) > 1:
        raise SettingsError(
            "table: expected runs on SAIL alone or none of them, got both; make a "
            "table of each"
        )
    return studies == {True}


def sail_rows(run: MeasuredRun) -> list[SailRow]:
    """Return the rows of a run: by kind of paragraph, then by map."""
    return [
        row
        for name, results in _kinds(run.results)
        for row in _by_map(run, name, results)
    ]


def sail_table(runs: Sequence[MeasuredRun], style: str) -> str:
    """Write the table of some runs.

    Args:
        runs: From `load_runs`; all on SAIL.
        style: `text` (aligned), `md`, or `csv` with unrounded numbers.

    Raises:
        SettingsError: There is no such style of this table.
    """
    if style not in STYLES:
        raise SettingsError(
            f"--format {style}: tables of SAIL are {', '.join(STYLES)}; choose one"
        )
    if style == "csv":
        return _csv(row for run in runs for row in sail_rows(run))
    parts: list[str] = []
    for run in runs:
        lines = [HEADINGS, *(_cells(row) for row in sail_rows(run))]
        write = text_columns if style == "text" else markdown_columns
        title = f"SAIL, final position: {run.label}"
        notes = "\n".join(f"- {note}" for note in [*run_notes(run), _range(run)])
        parts.append(f"{title}\n\n{write(lines)}\n\n{KEY}\n\n{notes}\n")
    return "\n".join(parts)


def _kinds(
    results: Sequence[EpisodeResult],
) -> Iterator[tuple[str, list[EpisodeResult]]]:
    kinds = {
        "all": list(results),
        "usable": [r for r in results if r.usable],
        "development half": [r for r in results if r.split == DEVELOPMENT],
        "other half": [r for r in results if r.split != DEVELOPMENT],
    }
    return ((name, kept) for name, kept in kinds.items() if kept)


def _by_map(
    run: MeasuredRun, name: str, results: Sequence[EpisodeResult]
) -> Iterator[SailRow]:
    maps = sorted({result.site for result in results})
    for site in [*maps, None] if len(maps) > 1 else maps:
        kept = [r for r in results if site is None or r.site == site]
        title = "all" if site is None else site.removeprefix("sail_").title()
        yield _row(run.label, name, title, kept)


def _row(
    method: str, name: str, title: str, results: Sequence[EpisodeResult]
) -> SailRow:
    texts = [paragraph_of(result.episode_id) for result in results]
    by_text = dict(zip(texts, results, strict=True))
    # Every paragraph counts the same, however many of its headings have been run.
    (success,) = participant_bootstrap(
        [
            [np.mean([r.success for r in results if r.instruction_id == text])]
            for text in by_text
        ],
        list(by_text),
        np.random.default_rng(0),
    )
    tried = sum(r.human_trials or 0 for r in by_text.values())
    arrived = sum(r.human_found or 0 for r in by_text.values())
    people = arrived / tried if tried else None
    return SailRow(
        method, name, title, len(by_text), len(results), success, tried, people
    )


def _range(run: MeasuredRun) -> str:
    metres = run.record.settings.simulation.detection_range
    return f"things are detected up to {metres:g} m away"


def _cells(row: SailRow) -> tuple[str, ...]:
    people = "-" if row.people is None else f"{row.people:.2f} ({row.followers} trials)"
    return (
        row.paragraphs,
        row.map,
        str(row.texts),
        str(row.episodes),
        estimate_cell(row.success),
        people,
    )


def _csv(rows: Iterable[SailRow]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([
        "method",
        "paragraphs",
        "map",
        "texts",
        "episodes",
        "success",
        "low",
        "high",
        "followers",
        "people",
    ])
    for row in rows:
        estimate = (row.success.mean, row.success.low, row.success.high)
        counts = (row.texts, row.episodes)
        head = (row.method, row.paragraphs, row.map)
        writer.writerow([*head, *counts, *estimate, row.followers, row.people])
    return out.getvalue()
