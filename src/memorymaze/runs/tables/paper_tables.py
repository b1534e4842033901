"""The paper's Tables II and III, measured and published figures side by side."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from statistics import fmean
from typing import Any

from memorymaze.basics.tables import Column, Row, Table
from memorymaze.basics.wording import counted
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.summary import PER_DISTANCE, collision_rates
from memorymaze.runs.tables.measures import (
    COST_MEASURES,
    EPISODES,
    PAPER_MEASURES,
    PAPER_QUANTITIES,
    Fact,
)
from memorymaze.runs.tables.questions import RowGroup, TableQuestion, means_table
from memorymaze.runs.tables.runs import (
    METHOD,
    OF_ROUTE,
    RUN,
    STUDY,
    MeasuredRun,
    TablePlace,
    groups_of_places,
    place_fields,
    place_of,
    places_of,
    studies_of,
)
from memorymaze.texts.corpus.published import (
    PUBLISHED_MEASURES,
    PublishedResult,
    published_tables,
)

KEY = (
    ", ".join(f"{each.short} {each.meaning}" for each in PAPER_MEASURES)
    + "; [95 % interval], bootstrap over participants. The mean over routes is "
    'unweighted. Rows that begin with "paper" are published figures on human '
    "instructions."
)
COST_KEY = (
    "Means per episode: calls of the language model, tokens of requests and replies, US$ "
    "at the prices given (- where none were), seconds of inference, and simulated "
    "seconds that the user stands waiting for the model (they do not count against the "
    "time budget)."
)
PAPER_METHODS = {
    "proposed": "paper: proposed",
    "navgpt": "paper: NavGPT",
    "navid": "paper: NaVid",
}
UNKNOWN = dict.fromkeys(each.name for each in PAPER_MEASURES)
"""Of a row that has no means of its own."""
COST_COLUMNS = tuple(
    Column(f"{each.name}_per_episode", each.short, digits=each.digits)
    for each in COST_MEASURES
)
ONLY_DATA = (
    *("instructions_written_by", "episodes_missing", "seed"),
    *("success_distance_m", "time_budget_s", "call_budget"),
    *("turning_points", "noise", "motion", "detector", "signs", "track"),
    *("things_per_100m", "people_per_100m2", "people", "obstacle_seed"),
    *(f"{name}_per_100m" for name in PER_DISTANCE),
    *("waiting_s_per_episode", "ask", "passers_by"),
)
"""What only CSV and frames have; see `docs/runs.md`."""


def paper_table(
    runs: Sequence[MeasuredRun], name: str, absent: Mapping[str, str] | None = None
) -> Table:
    """Return Table II or III of runs, with the published figures beside them.

    Args:
        runs: What was measured.
        name: Which table.
        absent: Methods without a run, which get a row that says so, and how to get one.
    """
    question = PAPER_TABLES[name]
    if absent:
        question = replace(
            question,
            groups=partial(_groups, name, absent=absent),
            remarks=partial(_how_to_get, absent),
        )
    if any(run.asked_a_model for run in runs):
        columns = (*question.columns, *COST_COLUMNS)
        question = replace(question, columns=columns, key=(KEY, COST_KEY))
    return means_table(runs, question)


def _how_to_get(absent: Mapping[str, str], _: Sequence[MeasuredRun]) -> Iterator[str]:
    for method, how in absent.items():
        yield f"{method}: NOT RECORDED. {how}"


def _groups(
    table: str, runs: Sequence[MeasuredRun], absent: Iterable[str] = ()
) -> Iterator[RowGroup]:
    """Yield the rows of a table: by study, route, iteration, then measured and paper.

    After the routes of a study (in Table III: of an iteration) comes the mean over
    them. The paper's figures stand beside routes that the paper has.
    """
    results = [result for run in runs for result in run.results]
    for study in studies_of(results):
        for group in groups_of_places(places_of(results, study)):
            for iteration in (None,) if table == "II" else (1, 2):
                for run in runs:
                    yield from _measured(table, run, study, group, iteration)
                for method in absent if len(group) > 1 else ():
                    yield RowGroup({
                        **_about(table, study, group, group, iteration),
                        "method": f"{method} (not recorded)",
                        "parser": None,
                        "figures": "not recorded",
                        "episodes": None,
                        **UNKNOWN,
                    })
                for row in _published(table, study, group, iteration):
                    yield RowGroup(row)


def _about(
    table: str,
    study: str,
    group: Sequence[TablePlace],
    places: Sequence[TablePlace],
    iteration: int | None,
) -> dict[str, Any]:
    """Return what a row is about: a route, or the mean over those a method has."""
    is_mean = len(group) > 1
    fields = place_fields(places, is_mean=is_mean)
    if is_mean:
        fields["place"] = f"Mean over {counted(len(places), 'route')}"
    if iteration is not None:
        fields["place"] += f", iteration {iteration}"
    return {"table": table, "study": study, **fields, "iteration": iteration}


def _measured(
    table: str,
    run: MeasuredRun,
    study: str,
    group: Sequence[TablePlace],
    iteration: int | None,
) -> Iterator[RowGroup]:
    results = [
        result
        for place in group
        for result in run.results
        if result.study == study
        and place_of(result) == place
        and iteration in {None, result.iteration}
    ]
    if not results:
        return
    about = {
        **_about(
            table, study, group, list(dict.fromkeys(map(place_of, results))), iteration
        ),
        "method": run.label,
        "parser": _parses_first(run),
        "figures": "measured",
        **_run_fields(results, run),
        **_cost_fields(results, run),
    }
    yield RowGroup(about, results)


def _parses_first(run: MeasuredRun) -> bool | None:
    """Tell whether instructions were parsed first; None of agents without that option."""
    told = dict(run.record.settings.option_values).get("parser")
    return None if told is None else told == "true"


def _published(
    table: str, study: str, group: Sequence[TablePlace], iteration: int | None
) -> Iterator[Row]:
    tables = published_tables()
    methods: dict[tuple[str, bool], list[PublishedResult]] = {}
    for row in tables.models if table == "II" else tables.iterations:
        if (row.study, row.iteration) == (study, iteration) and place_of(row) in group:
            methods.setdefault((row.method, row.parser), []).append(row)
    for (method, parser), rows in methods.items():
        if len(rows) == len(group):
            yield {
                **_about(table, study, group, [place_of(r) for r in rows], iteration),
                "method": PAPER_METHODS[method],
                "parser": parser if method == "proposed" else None,
                "figures": "published",
                "instructions_written_by": "human",
                **UNKNOWN,
                **{
                    name: fmean(getattr(row, name) for row in rows)
                    for name in PUBLISHED_MEASURES
                },
            }


def _run_fields(results: Sequence[EpisodeResult], run: MeasuredRun) -> dict[str, Any]:
    settings, limits = run.record.settings, run.record.settings.simulation
    fields: dict[str, Any] = {
        "run": run.name,
        "instructions_written_by": "+".join(sorted({r.source for r in run.results})),
        "episodes_missing": run.missing,
        "seed": settings.seed,
        "success_distance_m": settings.success_distance,
        "time_budget_s": limits.time_budget,
        "call_budget": limits.call_budget,
        "turning_points": limits.turning_points,
        "noise": None if settings.noise is None else str(settings.noise),
        "motion": limits.motion,
        "detector": str(settings.detector),
        "signs": settings.signs,
        "track": settings.track,
    }
    if settings.obstacles is not None:
        found = collision_rates(results)
        fields |= {
            "things_per_100m": settings.obstacles.things_per_100m,
            "people_per_100m2": settings.obstacles.people_per_100m2,
            "people": settings.obstacles.people,
            "obstacle_seed": settings.obstacles.seed,
            "waiting_s_per_episode": found["waiting_s"],
        }
        fields |= {f"{name}_per_100m": found[name] for name in PER_DISTANCE}
    if settings.ask is not None:
        fields |= {"ask": settings.ask, "passers_by": settings.passers_by}
    return fields


def _cost_fields(
    results: Sequence[EpisodeResult], run: MeasuredRun
) -> dict[str, float | None]:
    """Return what inference cost per episode; the unweighted mean over routes."""
    cells: dict[TablePlace, list[EpisodeResult]] = {}
    for result in results:
        cells.setdefault(place_of(result), []).append(result)
    means: dict[str, float | None] = {
        f"{cost.name}_per_episode": fmean(
            fmean(getattr(each, cost.field) for each in cell) for cell in cells.values()
        )
        for cost in COST_MEASURES
    }
    has_price = run.record.settings.agent.language_model.price is not None
    was_charged = any(each.cost_usd for each in results)
    if run.asked_a_model and not (has_price or was_charged):
        means["cost_usd_per_episode"] = None
    return means


def _question(name: str, shows: str, title: str) -> TableQuestion:
    return TableQuestion(
        shows=shows,
        title=f"Table {name}: {title}",
        name=f"table-{name.lower()}",
        columns=(
            Column("table"),
            STUDY,
            *OF_ROUTE,
            Column("iteration"),
            METHOD,
            Column("parser", "Parser", "label"),
            Column("figures"),
            RUN,
            EPISODES,
            Fact("participants", of=lambda told: len({e.participant for e in told})),
            *(replace(each, plot=each.name == "sr") for each in PAPER_QUANTITIES),
            *map(Column, ONLY_DATA),
        ),
        groups=partial(_groups, name),
        cell=place_of,
        key=(KEY,),
        aside=lambda row: row["figures"] == "published",
    )


PAPER_TABLES = {
    "II": _question(
        "II",
        "methods, beside the published figures",
        "methods on every route, both iterations together",
    ),
    "III": _question(
        "III",
        "first and second iteration, beside the published figures",
        "first and second iteration on every route",
    ),
}
