"""Runs as tables need them: their results, their names, and what must be said of them."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, TypeVar

from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.basics.tables import Column, Row
from memorymaze.basics.wording import counted
from memorymaze.runs.episodes.in_words import (
    agent_version,
    budget_words,
    followed_words,
    method_label,
    model_notes,
    part_notes,
    safety_words,
    sense_notes,
    track_notes,
)
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables.measures import EPISODES
from memorymaze.runs.work.run_folder import RunRecord, read_run
from memorymaze.texts.corpus.published import PublishedResult, published_tables

STUDY_TITLES = {
    "online": "Online instructions (thinking out loud)",
    "memory": "Typed instructions from memory",
    "onsite": "Onsite instructions (from memory)",
}
"""The paper's studies, in the order of its tables, and one more of typed texts."""

MOST_ROUTES = 24
"""Routes of a study that are shown one by one; of more, such as SAIL's, the mean alone."""


class TablePlace(NamedTuple):
    """A route of a site."""

    site: str
    route: str


@dataclass(frozen=True, slots=True)
class MeasuredRun:
    """A run folder, read: its record, and the results that tables show."""

    folder: Path
    name: str
    """That of its folder; the path as it was given where another run's has the same."""
    label: str
    """Its method in tables, unlike that of the other runs."""
    record: RunRecord
    """What `run.json` says: settings, code, beginning."""
    results: tuple[EpisodeResult, ...]
    """Those shown, in the order of episode ids."""
    left_out: int
    """Results on development texts that are not shown."""

    @property
    def missing(self) -> int:
        """Episodes of the run that have no result yet."""
        return self.record.settings.episodes - len(self.results) - self.left_out

    @property
    def asked_a_model(self) -> bool:
        """Whether any episode asked a language model."""
        return any(result.model_calls for result in self.results)


SomeRun = TypeVar("SomeRun", bound=MeasuredRun)


def load_runs(
    folders: Sequence[str | Path],
    kind: Callable[..., SomeRun] = MeasuredRun,
    *,
    exclude_dev: bool = False,
) -> list[SomeRun]:
    """Read runs for a table.

    Args:
        folders: Run folders.
        kind: What is made of each.
        exclude_dev: Whether to leave out the instructions that prompts and examples
            may be built from.

    Raises:
        RunFolderError: A folder is no run, or has no result to show.
        SettingsError: A folder is named twice.
    """
    read = [(*read_run(folder), Path(folder)) for folder in folders]
    names = _names([folder for *_, folder in read])
    labels = [method_label(record.settings, results) for record, results, _ in read]
    runs: list[SomeRun] = []
    for name, label, (record, results, folder) in zip(names, labels, read, strict=True):
        shown = [r for r in results if not (exclude_dev and r.split == "dev")]
        if not shown:
            raise RunFolderError(f"{folder}: has no results to show yet")
        left_out = len(results) - len(shown)
        if labels.count(label) > 1:
            label += f" ({name})"
        runs.append(kind(folder, name, label, record, tuple(shown), left_out))
    return runs


def _names(folders: Sequence[Path]) -> list[str]:
    """Return the names of runs, each unlike the others."""
    places = [folder.resolve() for folder in folders]
    for place in places:
        if places.count(place) > 1:
            raise SettingsError(f"{place}: expected every run once, got it twice")
    bases = [place.name for place in places]
    return [
        base if bases.count(base) == 1 else str(folder)
        for base, folder in zip(bases, folders, strict=True)
    ]


def study_title(study: str) -> str:
    """Return how a study is headed; its name where it is none of the paper's."""
    return STUDY_TITLES.get(study, f"Study {study}")


ALL = "all"
"""Studies together."""
STUDY = Column("study", "Study", "group", show=lambda row: study_title(row["study"]))
"""Above the rows of a study."""
STUDY_OR_ALL = Column(
    "study",
    "Study",
    "group",
    show=lambda row: (
        "All studies" if row["study"] == ALL else study_title(row["study"])
    ),
)
"""Above those of a study, or of all together."""


METHOD = Column("method", "Method", "label")
RUN = Column("run")
BY_STUDY_AND_RUN = (STUDY, METHOD, RUN, EPISODES)
"""What rows for each run in each study are about."""
OF_ROUTE = (
    Column("place", "Route", "group", is_data=False),
    Column("site"),
    Column("route"),
)
"""Above the rows of a route, or of several; see `place_fields`."""


def by_study_and_run(
    runs: Sequence[MeasuredRun],
) -> Iterator[tuple[Row, MeasuredRun, list[EpisodeResult]]]:
    """Yield, study by study, what the row of a run is about, the run and its results."""
    for study in studies_of(result for run in runs for result in run.results):
        for run in runs:
            own = [result for result in run.results if result.study == study]
            if own:
                about = {"study": study, "method": run.label, "run": run.name}
                yield about, run, own


def studies_of(results: Iterable[EpisodeResult]) -> list[str]:
    """Return the studies of results: the paper's in its order, then others by name."""
    found = {result.study for result in results}
    known = [study for study in STUDY_TITLES if study in found]
    return known + sorted(found.difference(known))


def places_of(results: Iterable[EpisodeResult], study: str) -> list[TablePlace]:
    """Return the routes of a study: the paper's in its order, then others by name."""
    found = {TablePlace(r.site, r.route) for r in results if r.study == study}
    paper = list(dict.fromkeys(place_of(row) for row in published_tables().models))
    known = [place for place in paper if place in found]
    return known + sorted(found.difference(paper))


def place_of(what: EpisodeResult | PublishedResult) -> TablePlace:
    """Return the route that a result is about."""
    return TablePlace(what.site, what.route)


def place_title(places: Sequence[TablePlace]) -> str:
    """Return how a row is headed: `Museum 5F R1`, or `Mean over 6 routes`."""
    if len(places) > 1:
        return f"Mean over {len(places)} routes"
    site, route = places[0]
    return f"{site.replace('_', ' ').title()} {route}"


def groups_of_places(places: Sequence[TablePlace]) -> list[list[TablePlace]]:
    """Return each route alone, unless they are too many to look at, and all together."""
    alone = [[place] for place in places] if len(places) <= MOST_ROUTES else []
    return alone + ([list(places)] if len(places) > 1 else [])


def place_fields(places: Sequence[TablePlace], *, is_mean: bool) -> dict[str, str]:
    """Return the fields of tables that say which routes a row is about."""
    site, route = ("mean", "mean") if is_mean else places[0]
    return {"place": place_title(places), "site": site, "route": route}


def run_notes(run: MeasuredRun) -> list[str]:
    """Say how a run came about: settings, budgets, who wrote the instructions."""
    settings, results = run.record.settings, run.results
    version = agent_version(settings)
    development = sum(each.split == "dev" for each in results)
    notes = [
        f"{run.label}: run {run.name}, {followed_words(settings, results)}.",
        f"success distance {settings.success_distance:g} m, {budget_words(settings)}, seed "
        f"{settings.seed}, memorymaze {_code(run)}",
        *track_notes(settings),
        *sense_notes(settings, results),
        *([safety_words(results)] if settings.obstacles is not None else []),
        *([version] if version is not None else []),
        *model_notes(settings, results),
    ]
    if run.left_out:
        notes.append(
            f"without {counted(run.left_out, 'episode')} on development texts "
            "(--exclude-dev)."
        )
    if development:
        notes.append(
            f"with {counted(development, 'episode')} on development texts (split dev); "
            "--exclude-dev leaves such out."
        )
    notes += part_notes(settings)
    if run.missing:
        notes.append(
            f"INCOMPLETE: {run.missing} of {counted(settings.episodes, 'episode')} "
            "missing; finish the run with --resume."
        )
    return notes


def _code(run: MeasuredRun) -> str:
    code = run.record.code
    if code.commit is None:
        return code.version
    edited = "+" if code.commit.endswith("+") else ""
    return f"{code.version} ({code.commit[:12]}{edited})"
