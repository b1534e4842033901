"""Runs as tables need them: their results, their names, and what must be said of them."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.collision_rates import collision_rates
from memorymaze.evaluation.eyes import eyes_notes
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import RunRecord, read_run
from memorymaze.evaluation.settings import agent_version, people_to_ask, told_twice
from memorymaze.instructions.published import PublishedResult, published_tables
from memorymaze.instructions.records import WRITTEN_BY
from memorymaze.perception.eyes import TRUTH
from memorymaze.simulation.obstacles import ObstacleSettings
from memorymaze.tables import Column, Row
from memorymaze.wording import counted

STUDY_TITLES = {
    "online": "Online instructions (thinking out loud)",
    "memory": "Typed instructions from memory",
    "onsite": "Onsite instructions (from memory)",
}
"""The paper's studies, in the order of its tables, and one more of typed texts."""

MOST_ROUTES = 24
"""Routes of a study that are shown one by one; of more, such as SAIL's, the mean alone."""

LOOKS = {
    "own": "things as memorymaze makes them itself",
    "models": "furniture models of Sweet Home 3D (docs/assets.md)",
    "mesh": "meshes beside the plans (docs/importing.md)",
}


class TablePlace(NamedTuple):
    """A route of a site."""

    site: str
    route: str


@dataclass(frozen=True, slots=True)
class MeasuredRun:
    """A run that a table shows."""

    name: str
    """Of its folder."""
    label: str
    """Its method in tables, unlike that of the other runs."""
    record: RunRecord
    results: tuple[EpisodeResult, ...]
    """Those shown, in the order of episode ids."""
    left_out: int
    """Results on development texts that are not shown."""
    missing: int
    """Episodes of the run that have no result yet."""

    @property
    def asked_a_model(self) -> bool:
        """Whether any episode asked a language model."""
        return any(result.model_calls for result in self.results)


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
                record=record,
                results=tuple(shown),
                left_out=len(results) - len(shown),
                missing=record.settings.episodes - len(results),
            )
        )
    return runs


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


BY_STUDY_AND_RUN = (
    STUDY,
    Column("method", "Method", "label"),
    Column("run"),
    Column("episodes", "n"),
)
"""What rows for each run in each study are about."""


def by_study_and_run(
    runs: Sequence[MeasuredRun],
) -> Iterator[tuple[Row, MeasuredRun, list[EpisodeResult]]]:
    """Yield, study by study, what the row of a run is about, the run and its results."""
    for study in studies_of(result for run in runs for result in run.results):
        for run in runs:
            own = [result for result in run.results if result.study == study]
            if own:
                about = {"study": study, "method": run.label, "run": run.name}
                yield {**about, "episodes": len(own)}, run, own


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
    return {"site": site, "route": route}


def run_notes(run: MeasuredRun) -> list[str]:
    """Say how a run came about: settings, budgets, who wrote the instructions."""
    settings = run.record.settings
    counts = Counter(result.source for result in run.results)
    written = "; ".join(
        f"{count} written by {WRITTEN_BY[source]}" for source, count in counts.items()
    )
    files = ", ".join(stamp.name for stamp in settings.instructions)
    notes = [
        f"{run.label}: run {run.name}, {counted(len(run.results), 'episode')}; instructions "
        f"({files}): {written}.",
        f"success distance {settings.success_distance:g} m, time budget "
        f"{settings.time_budget_told}, call budget "
        f"{settings.simulation.call_budget}, seed {settings.seed}, memorymaze "
        f"{_code(run)}",
    ]
    if settings.second_telling:
        notes.append(f"TOLD TWICE: {told_twice(settings)}.")
    if settings.simulation.turning_points == "lidar":
        notes.append(
            "TURNING POINTS BY LIDAR (scans and odometry), not from the site plan."
        )
    if settings.looks is not None:
        notes.append(f"cameras show {LOOKS[settings.looks]}")
    notes += eyes_notes(settings)
    asking = people_to_ask(settings)
    if asking is not None:
        notes.append(f"TRACK WITH PEOPLE ONE CAN ASK: {asking}.")
    if settings.obstacles is not None:
        notes += _obstacle_notes(settings.obstacles, run.results)
    version = agent_version(settings)
    if version is not None:
        notes.append(version)
    if settings.agent.language_model.model is not None:
        notes.append(f"language model {settings.agent.language_model.model}")
    if settings.answers is not None:
        known = any(result.inference_s for result in run.results)
        unknown = "; how long their model took is not known and counted as 0 s"
        notes.append(f"{settings.answers}{'' if known else unknown}")
    if run.asked_a_model:
        notes.append(settings.agent.language_model.inference_time.described)
        price = settings.agent.language_model.price
        if price is not None:
            notes.append(
                f"prices as given: {price.prompt:g} US$ per million tokens read, "
                f"{price.completion:g} written"
            )
    if run.left_out:
        notes.append(
            f"without {counted(run.left_out, 'episode')} on development texts "
            "(--exclude-dev)."
        )
    development = sum(each.split == "dev" for each in run.results)
    if development:
        notes.append(
            f"with {counted(development, 'episode')} on development texts (split dev); "
            "--exclude-dev leaves such out."
        )
    if settings.split is not None:
        notes.append(f"only instructions of the split {settings.split}.")
    if settings.limit is not None:
        notes.append(f"A SAMPLE of {counted(settings.episodes, 'episode')} (--limit).")
    if settings.shard is not None:
        notes.append(
            f"ONLY SHARD {settings.shard} of a run; the folder that it lies in is the whole."
        )
    if run.missing:
        notes.append(
            f"INCOMPLETE: {run.missing} of {counted(settings.episodes, 'episode')} "
            "missing; finish the run with --resume."
        )
    return notes


def _obstacle_notes(
    obstacles: ObstacleSettings, results: Sequence[EpisodeResult]
) -> list[str]:
    """Say that a run is of the obstacle track, and how safely the robot drove."""
    given = obstacles.people
    number = obstacles.people_per_100m2 if given is None else given
    crowd = f"{number:g} {'person' if number == 1 else 'people'}"
    crowd += " per 100 m2" if given is None else ""
    found = collision_rates(results)
    return [
        "TRACK WITH OBSTACLES AND PEOPLE, not comparable with runs without: "
        f"{obstacles.things_per_100m:g} things per 100 m, {crowd}, obstacle seed "
        f"{obstacles.seed}.",
        f"per 100 m driven: {found.collisions:.3f} collisions, "
        f"{found.person_collisions:.3f} of them with people, {found.near_misses:.2f} "
        f"near misses; waiting {found.waiting_s:.1f} s per episode.",
    ]


def _code(run: MeasuredRun) -> str:
    code = run.record.code
    if code.commit is None:
        return code.version
    edited = "+" if code.commit.endswith("+") else ""
    return f"{code.version} ({code.commit[:12]}{edited})"


def _label(record: RunRecord, results: Iterable[EpisodeResult]) -> str:
    names = {result.agent for result in results}
    name = ", ".join(sorted(names)) or record.settings.agent.name
    if record.settings.simulation.turning_points == "lidar":
        name += ", turning points by LiDAR"
    if record.settings.detector != TRUTH:
        name += f", {record.settings.detector.short_name}"
    if record.settings.signs != "truth":
        name += f", signs by {record.settings.signs.upper()}"
    if record.settings.second_telling:
        name += ", told twice"
    if record.settings.ask is not None:
        name += f", up to {counted(record.settings.ask, 'question')}"
        if record.settings.passers_by != "memory":
            name += f" ({record.settings.passers_by} answers)"
        return name
    return name if record.settings.obstacles is None else f"{name}, with obstacles"
