"""The paper's Tables II and III, measured and published figures side by side."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Any, Literal

from memorymaze.evaluation.collision_rates import PER_DISTANCE, collision_rates
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.published import (
    PUBLISHED_MEASURES,
    PublishedResult,
    published_tables,
)
from memorymaze.metrics.aggregate import Estimate
from memorymaze.results.tables.measures import (
    COST_MEASURES,
    KEY,
    PAPER_MEASURES,
    estimate_means,
    mean_column,
    means_fields,
    with_interval_notes,
)
from memorymaze.results.tables.runs import (
    MeasuredRun,
    Place,
    groups_of_places,
    place_fields,
    place_of,
    place_title,
    places_of,
    run_notes,
    studies_of,
    study_title,
)
from memorymaze.tables import Column, Row, Table
from memorymaze.wording import counted

TableName = Literal["II", "III"]

TITLES: dict[TableName, str] = {
    "II": "Table II: methods on every route, both iterations together",
    "III": "Table III: first and second iteration on every route",
}
PAPER_METHODS = {
    "proposed": "paper: proposed",
    "navgpt": "paper: NavGPT",
    "navid": "paper: NaVid",
}

COST_KEY = (
    "Means per episode: calls of the language model, tokens of requests and replies, US$ "
    "at the prices given (- where none were), seconds of inference, and simulated "
    "seconds that the user stands waiting for the model (they do not count against the "
    "time budget)."
)


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
    """By the names of the paper's measures."""
    results: tuple[EpisodeResult, ...] = ()
    """The episodes shown here; none for the paper's figures."""


def paper_table(runs: Sequence[MeasuredRun], name: TableName) -> Table:
    """Return Table II or III of runs, with the published figures beside them."""
    costs = any(run.asked_a_model for run in runs)
    notes = ["\n".join(run_notes(run)) for run in runs]
    return with_interval_notes(
        Table(
            TITLES[name],
            _columns(costs=costs),
            tuple(_fields(row, name, costs=costs) for row in table_rows(runs, name)),
            (*notes, KEY, *([COST_KEY] if costs else [])),
            f"table-{name.lower()}",
            lambda row: row["figures"] == "published",
        )
    )


def table_rows(runs: Sequence[MeasuredRun], table: TableName) -> list[TableRow]:
    """Return the rows of a table: by study, route, iteration, then measured and paper.

    After the routes of a study (in Table III: of an iteration) comes the mean over
    them. The paper's figures stand beside routes that the paper has.
    """
    iterations = (None,) if table == "II" else (1, 2)
    rows: list[TableRow] = []
    results = [result for run in runs for result in run.results]
    for study in studies_of(results):
        places = places_of(results, study)
        for group in groups_of_places(places):
            for iteration in iterations:
                for run in runs:
                    rows += _measured(run, study, group, iteration)
                rows += _published(table, study, group, iteration)
    return rows


def group_title(row: TableRow) -> str:
    """Return the heading of the rows that belong together with this one."""
    title = place_title(row.places)
    if row.is_mean:
        title = f"Mean over {counted(len(row.places), 'route')}"
    return title if row.iteration is None else f"{title}, iteration {row.iteration}"


def _measured(
    run: MeasuredRun, study: str, group: Sequence[Place], iteration: int | None
) -> list[TableRow]:
    cells = {
        place: [
            result
            for result in run.results
            if (result.study, place_of(result)) == (study, place)
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
        if (row.study, row.iteration) == (study, iteration) and place_of(row) in group:
            methods.setdefault((row.method, row.parser), []).append(row)
    return [
        TableRow(
            study=study,
            places=tuple(place_of(row) for row in rows),
            is_mean=len(group) > 1,
            iteration=iteration,
            method=PAPER_METHODS[method],
            parser=parser if method == "proposed" else None,
            run=None,
            episodes=None,
            participants=None,
            values={
                name: Estimate(fmean(getattr(row, name) for row in rows))
                for name in PUBLISHED_MEASURES
            },
        )
        for (method, parser), rows in methods.items()
        if len(rows) == len(group)
    ]


def _columns(*, costs: bool) -> tuple[Column, ...]:
    """Return what a table tells of its rows; see `docs/results.md`."""
    settings = ["instructions_written_by", "episodes_missing", "seed"]
    settings += ["success_distance_m", "time_budget_s", "call_budget"]
    settings += ["turning_points", "detector", "signs", "track"]
    settings += ["things_per_100m", "people_per_100m2", "people", "obstacle_seed"]
    settings += [f"{name}_per_100m" for name in PER_DISTANCE]
    return (
        Column("table"),
        Column("study", "Study", "group", show=lambda row: study_title(row["study"])),
        Column("place", "Route", "group", is_data=False),
        Column("site"),
        Column("route"),
        Column("iteration"),
        Column("method", "Method", "label"),
        Column("parser", "Parser", "label"),
        Column("figures"),
        Column("run"),
        Column("episodes", "n"),
        Column("participants"),
        *map(mean_column, PAPER_MEASURES),
        *(Column(name) for name in settings),
        Column("waiting_s_per_episode"),
        *(
            Column(f"{each.name}_per_episode", each.short, digits=each.digits)
            for each in COST_MEASURES
            if costs
        ),
    )


def _fields(row: TableRow, table: TableName, *, costs: bool) -> Row:
    record: dict[str, Any] = {
        "table": table,
        "study": row.study,
        "place": group_title(row),
        **place_fields(row.places, is_mean=row.is_mean),
        "iteration": row.iteration,
        "method": row.method,
        "parser": row.parser,
        "figures": "published" if row.run is None else "measured",
        "instructions_written_by": "human",
    }
    if row.run is None:
        record |= {each.name: None for each in PAPER_MEASURES}
        record |= {name: each.mean for name, each in row.values.items()}
    else:
        record |= means_fields(row.values)
        record |= {"episodes": row.episodes, "participants": row.participants}
        record |= _run_fields(row, row.run)
        record |= _cost_fields(row, row.run) if costs else {}
    return record


def _run_fields(row: TableRow, run: MeasuredRun) -> dict[str, Any]:
    settings = run.record.settings
    record: dict[str, Any] = {
        "run": run.name,
        "instructions_written_by": "+".join(sorted({r.source for r in run.results})),
        "episodes_missing": run.missing,
        "seed": settings.seed,
        "success_distance_m": settings.success_distance,
        "time_budget_s": settings.simulation.time_budget,
        "call_budget": settings.simulation.call_budget,
        "turning_points": settings.simulation.turning_points,
        "detector": str(settings.detector),
        "signs": settings.signs,
        "track": "default" if settings.obstacles is None else "obstacles",
    }
    if settings.obstacles is not None:
        found = collision_rates(row.results)
        record |= {
            "things_per_100m": settings.obstacles.things_per_100m,
            "people_per_100m2": settings.obstacles.people_per_100m2,
            "people": settings.obstacles.people,
            "obstacle_seed": settings.obstacles.seed,
            "waiting_s_per_episode": found.waiting_s,
        }
        record |= {f"{name}_per_100m": getattr(found, name) for name in PER_DISTANCE}
    return record


def _cost_fields(row: TableRow, run: MeasuredRun) -> dict[str, float | None]:
    """Return what inference cost per episode; the unweighted mean over routes."""
    routes: dict[Place, list[EpisodeResult]] = {}
    for result in row.results:
        routes.setdefault(place_of(result), []).append(result)
    means: dict[str, float | None] = {
        f"{cost.name}_per_episode": fmean(
            fmean(getattr(each, cost.field) for each in cell)
            for cell in routes.values()
        )
        for cost in COST_MEASURES
    }
    is_free = not run.asked_a_model
    has_price = run.record.settings.agent.language_model.price is not None
    if not (is_free or has_price or any(result.cost_usd for result in run.results)):
        means["cost_usd_per_episode"] = None
    return means
