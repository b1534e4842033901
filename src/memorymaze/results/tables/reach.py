"""Success at several distances from the goal, and after several times the way described."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.metrics.aggregate import participant_bootstrap
from memorymaze.metrics.success import success_within, success_within_way
from memorymaze.results.tables.measures import (
    ends,
    estimate_fields,
    with_interval_notes,
)
from memorymaze.results.tables.runs import (
    MeasuredRun,
    place_of,
    places_of,
    run_notes,
    studies_of,
    study_title,
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

_Arrived = Callable[[EpisodeResult, float], float]


def reach_table(runs: Sequence[MeasuredRun]) -> Table:
    """Return success at 1.5, 3 and 5 m and within 1, 1.5, 2 and 3 times the way.

    Raises:
        RunFolderError: A run was made before results told how long the way is.
    """
    results = [result for run in runs for result in run.results]
    table = Table(
        "Success by distance to the goal and by length of the walk",
        (
            Column(
                "study", "Study", "group", show=lambda row: study_title(row["study"])
            ),
            Column("method", "Method", "label"),
            Column("run"),
            Column("episodes", "n"),
            *(_column(name, heading) for name, heading, _ in _levels(3.0)),
        ),
        tuple(
            _row(run, study)
            for study in studies_of(results)
            for run in runs
            if any(result.study == study for result in run.results)
        ),
        (*("\n".join(run_notes(run)) for run in runs), KEY),
        "reach",
    )
    return with_interval_notes(table)


def _levels(near: float) -> Iterator[tuple[str, str, Callable[[EpisodeResult], float]]]:
    """Yield field, heading and value of each column, for a success distance."""
    for metres in DISTANCES:
        yield (
            f"sr_at_{metres:g}_m",
            f"{metres:g} m",
            lambda each, metres=metres: success_within(
                each.spd, metres, is_stopped=each.stopped_by == "agent"
            ),
        )
    for times in WAYS:
        yield (
            f"sr_within_{times:g}_ways",
            f"{times:g}x",
            lambda each, times=times: success_within_way(
                each.path_length,
                each.way_m or 0.0,
                times,
                near,
                is_success=each.success,
            ),
        )


def _column(name: str, heading: str) -> Column:
    return Column(name, heading, digits=2, interval=ends(name), better="higher")


def _row(run: MeasuredRun, study: str) -> Row:
    chosen = [result for result in run.results if result.study == study]
    if any(result.way_m is None for result in chosen):
        raise RunFolderError(
            f"{run.name}: expected results that say how long the way described is, got "
            "those of an older version of memorymaze; run it again"
        )
    levels = list(_levels(run.record.settings.success_distance))
    places = places_of(chosen, study)
    estimates = participant_bootstrap(
        [[value(result) for _, _, value in levels] for result in chosen],
        [result.participant for result in chosen],
        np.random.default_rng(0),
        cells=[places.index(place_of(result)) for result in chosen],
    )
    row: dict[str, object] = {
        "study": study,
        "method": run.label,
        "run": run.name,
        "episodes": len(chosen),
    }
    for (name, _, _), found in zip(levels, estimates, strict=True):
        row |= estimate_fields(name, found)
    return row
