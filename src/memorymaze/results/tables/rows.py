"""The rows of the paper's Tables II and III, measured and published side by side.

How rows become text, Markdown or CSV is told in `table_formats.py`.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean
from typing import Literal, NamedTuple

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import RunRecord, read_run
from memorymaze.instructions.published import PublishedResult, published_tables
from memorymaze.perception.eyes import TRUTH
from memorymaze.results.tables.bootstrap import MEASURES, Estimate, estimate_means

TableName = Literal["II", "III"]


class Place(NamedTuple):
    """A route of a site."""

    site: str
    route: str


STUDIES = ("online", "onsite")

PAPER_METHODS = {
    "proposed": "paper: proposed",
    "navgpt": "paper: NavGPT",
    "navid": "paper: NaVid",
}


@dataclass(frozen=True, slots=True)
class MeasuredRun:
    """A run that a table shows."""

    name: str
    """Of its folder."""
    label: str
    """Its method in tables, unlike that of the other runs."""
    parser: bool | None
    """Whether instructions were parsed first; None where the agent has no parser."""
    record: RunRecord
    results: tuple[EpisodeResult, ...]
    """Those shown, in the order of episode ids."""
    left_out: int
    """Results on development texts that are not shown."""
    missing: int
    """Episodes of the run that have no result yet."""


@dataclass(frozen=True, slots=True)
class TableRow:
    """One line of a table: a method on one route, or its mean over several."""

    study: str
    places: tuple[Place, ...]
    """The route, or the routes that the mean is over."""
    is_mean: bool
    """Whether it is the unweighted mean over routes."""
    iteration: int | None
    """None in Table II, which takes both together."""
    method: str
    parser: bool | None
    run: MeasuredRun | None
    """None for the paper's figures."""
    episodes: int | None
    """Shown here; None for the paper's figures."""
    participants: int | None
    values: dict[str, Estimate]
    """By the names in `MEASURES`."""
    results: tuple[EpisodeResult, ...] = ()
    """The episodes shown here; none for the paper's figures."""


def load_runs(
    folders: Sequence[str | Path], *, exclude_dev: bool = False
) -> list[MeasuredRun]:
    """Read runs for a table.

    Args:
        folders: Run folders.
        exclude_dev: Whether to leave out the instructions that prompts and examples
            may be built from.

    Raises:
        RunFolderError: A folder is no run, or has no result to show.
    """
    read = [(Path(folder), *read_run(folder)) for folder in folders]
    labels = Counter(_label(record, results) for _, record, results in read)
    runs: list[MeasuredRun] = []
    for folder, record, results in read:
        shown = [r for r in results if not (exclude_dev and r.split == "dev")]
        if not shown:
            raise RunFolderError(f"{folder}: has no results to show yet")
        label = _label(record, results)
        name = folder.resolve().name
        runs.append(
            MeasuredRun(
                name=name,
                label=f"{label} ({name})" if labels[label] > 1 else label,
                parser=record.settings.agent.parser,
                record=record,
                results=tuple(shown),
                left_out=len(results) - len(shown),
                missing=record.settings.episodes - len(results),
            )
        )
    return runs


def table_rows(runs: Sequence[MeasuredRun], table: TableName) -> list[TableRow]:
    """Return the rows of a table: by study, route, iteration, then measured and paper.

    After the routes of a study (in Table III: of an iteration) comes the mean over
    them. The paper's figures stand beside routes that the paper has.
    """
    iterations = (None,) if table == "II" else (1, 2)
    rows: list[TableRow] = []
    for study in STUDIES:
        places = places_of((r for run in runs for r in run.results), study)
        groups = [[place] for place in places]
        if len(places) > 1:
            groups.append(places)
        for group in groups:
            for iteration in iterations:
                for run in runs:
                    rows += _measured(run, study, group, iteration)
                rows += _published(table, study, group, iteration)
    return rows


def places_of(results: Iterable[EpisodeResult], study: str) -> list[Place]:
    """Return the routes of a study: the paper's in its order, then others by name."""
    found = {Place(r.site, r.route) for r in results if r.study == study}
    paper = list(dict.fromkeys(_place(row) for row in published_tables().models))
    known = [place for place in paper if place in found]
    return known + sorted(found.difference(paper))


def place_title(places: Sequence[Place]) -> str:
    """Return how a row is headed: `Museum 5F R1`, or `Mean over 6 routes`."""
    if len(places) > 1:
        return f"Mean over {len(places)} routes"
    site, route = places[0]
    return f"{site.replace('_', ' ').title()} {route}"


def _measured(
    run: MeasuredRun, study: str, group: Sequence[Place], iteration: int | None
) -> list[TableRow]:
    cells = {
        place: [
            result
            for result in run.results
            if (result.study, result.site, result.route) == (study, *place)
            and iteration in {None, result.iteration}
        ]
        for place in group
    }
    filled = {place: cell for place, cell in cells.items() if cell}
    if not filled:
        return []
    everyone = [result for cell in filled.values() for result in cell]
    return [
        TableRow(
            study=study,
            places=tuple(filled),
            is_mean=len(group) > 1,
            iteration=iteration,
            method=run.label,
            parser=run.parser,
            run=run,
            episodes=len(everyone),
            participants=len({result.participant for result in everyone}),
            values=estimate_means(list(filled.values())),
            results=tuple(everyone),
        )
    ]


def _published(
    table: TableName, study: str, group: Sequence[Place], iteration: int | None
) -> list[TableRow]:
    tables = published_tables()
    source = tables.models if table == "II" else tables.iterations
    methods: dict[tuple[str, bool], list[PublishedResult]] = {}
    for row in source:
        if (row.study, row.iteration) == (study, iteration) and _place(row) in group:
            methods.setdefault((row.method, row.parser), []).append(row)
    return [
        TableRow(
            study=study,
            places=tuple(_place(row) for row in rows),
            is_mean=len(group) > 1,
            iteration=iteration,
            method=PAPER_METHODS[method],
            parser=parser if method == "proposed" else None,
            run=None,
            episodes=None,
            participants=None,
            values={
                name: Estimate(fmean(getattr(row, name) for row in rows))
                for name in MEASURES
            },
        )
        for (method, parser), rows in methods.items()
        if len(rows) == len(group)
    ]


def _place(row: PublishedResult) -> Place:
    return Place(row.site, row.route)


def _label(record: RunRecord, results: Iterable[EpisodeResult]) -> str:
    names = {result.agent for result in results}
    name = ", ".join(sorted(names)) or record.settings.agent.name
    if record.settings.simulation.turning_points == "lidar":
        name += ", turning points by LiDAR"
    if record.settings.detector != TRUTH:
        name += f", {record.settings.detector.short_name}"
    if record.settings.signs != "truth":
        name += f", signs by {record.settings.signs.upper()}"
    return name if record.settings.obstacles is None else f"{name}, with obstacles"
