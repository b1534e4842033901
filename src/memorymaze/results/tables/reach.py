"""Success at several distances from the goal, and after several times the way described."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.metrics.success import (
    SUCCESS_DISTANCE,
    success_within,
    success_within_way,
)
from memorymaze.results.tables.measures import (
    EpisodeValue,
    value_fields,
    with_interval_notes,
)
from memorymaze.results.tables.runs import (
    STUDY,
    MeasuredRun,
    place_of,
    run_notes,
    studies_of,
)
from memorymaze.tables import Column, Row, Table

DISTANCES = (1.5, 3.0, 5.0)
"""Metres left to the goal."""
WAYS = (1.0, 1.5, 2.0, 3.0)
"""Times the way described."""
KEY = (
    "SR at a distance: stopped by itself, nearer to the goal than so many metres. SR "
    "within so many times the way: a success at the run's own distance that took no "
    "longer path than so many times the way described, and the success distance on top. "
    "All from one run: a search of the whole floor shows as a difference between 1x and "
    "3x. Unweighted mean over routes; [95 % interval], bootstrap over participants."
)


def reach_table(runs: Sequence[MeasuredRun]) -> Table:
    """Return success at 1.5, 3 and 5 m and within 1, 1.5, 2 and 3 times the way."""

    def fields(run: MeasuredRun, results: Sequence[EpisodeResult]) -> dict[str, Any]:
        values = _values(run.record.settings.success_distance)
        return value_fields(results, values, [place_of(result) for result in results])

    title = "Success by distance to the goal and by length of the walk"
    columns = [value.column for value in _values(SUCCESS_DISTANCE)]
    return study_table(runs, title, columns, fields, KEY, "reach")


def study_table(
    runs: Sequence[MeasuredRun],
    title: str,
    columns: Sequence[Column],
    fields: Callable[[MeasuredRun, Sequence[EpisodeResult]], Mapping[str, Any]],
    key: str,
    name: str,
) -> Table:
    """Return a table with a row for each run in each study, of whose results `fields` tells."""
    rows: list[Row] = []
    for study in studies_of(result for run in runs for result in run.results):
        for run in runs:
            own = [result for result in run.results if result.study == study]
            if own:
                about = {"study": study, "method": run.label, "run": run.name}
                rows.append({**about, "episodes": len(own), **fields(run, own)})
    table = Table(
        title,
        (
            STUDY,
            Column("method", "Method", "label"),
            Column("run"),
            Column("episodes", "n"),
            *columns,
        ),
        tuple(rows),
        (*("\n".join(run_notes(run)) for run in runs), key),
        name,
    )
    return with_interval_notes(table)


def within_ways(near: float) -> list[EpisodeValue]:
    """Return success within so many times the way, for a success distance."""
    return [
        EpisodeValue(
            f"sr_within_{times:g}_ways",
            f"{times:g}x",
            lambda each, times=times: success_within_way(
                each.path_length,
                each.way_m,
                times,
                near,
                is_success=each.success,
            ),
        )
        for times in WAYS
    ]


def _values(near: float) -> list[EpisodeValue]:
    at_distances = [
        EpisodeValue(
            f"sr_at_{metres:g}_m",
            f"{metres:g} m",
            lambda each, metres=metres: success_within(
                each.spd, metres, is_stopped=each.stopped_by == "agent"
            ),
        )
        for metres in DISTANCES
    ]
    return at_distances + within_ways(near)
