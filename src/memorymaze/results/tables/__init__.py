"""Runs as tables: the paper's Tables II and III, comparisons, SAIL, costs of errors.

What they show of a metric stands at its field of `EpisodeResult`. All of them are a
`memorymaze.tables.Table`, which knows the formats. Pages are in `results.report`,
statistics of instructions in `results.instruction_study`.

    runs = load_runs(["runs/rules", "runs/mine"])
    run_tables(runs, "II")[0].frame()
    comparison_table(*runs).text()
    success_figure(runs).savefig("success.png")  # from `figures`: it loads matplotlib

Episodes as a frame, a row each, are `evaluation.frames.episode_frame`.
"""

from collections.abc import Mapping, Sequence
from typing import Literal

from memorymaze.results.tables.asking import asking_table
from memorymaze.results.tables.comparison import comparison_overview, comparison_table
from memorymaze.results.tables.confidence import confidence_table
from memorymaze.results.tables.equal_metres import equal_metres_table
from memorymaze.results.tables.errors import error_table
from memorymaze.results.tables.measures import (
    COMPARED_MEASURES,
    PAPER_MEASURES,
    SPREAD_MEASURES,
    estimate_means,
)
from memorymaze.results.tables.paper_tables import (
    TableName,
    paper_table,
)
from memorymaze.results.tables.reach import reach_table
from memorymaze.results.tables.runs import (
    STUDY_TITLES,
    MeasuredRun,
    Place,
    load_runs,
    place_title,
    run_notes,
)
from memorymaze.results.tables.sail import is_sail, sail_table
from memorymaze.results.tables.second_tellings import second_tellings_table
from memorymaze.tables import Table

__all__ = [
    "COMPARED_MEASURES",
    "PAPER_MEASURES",
    "SPREAD_MEASURES",
    "STUDY_TITLES",
    "MeasuredRun",
    "Place",
    "TableChoice",
    "TableName",
    "comparison_overview",
    "comparison_table",
    "equal_metres_table",
    "estimate_means",
    "load_runs",
    "paper_table",
    "place_title",
    "run_notes",
    "run_tables",
]

TableChoice = Literal[
    "II", "III", "both", "errors", "reach", "confidence", "second_tellings", "asking"
]


def run_tables(
    runs: Sequence[MeasuredRun],
    choice: TableChoice = "II",
    absent: Mapping[str, str] | None = None,
) -> list[Table]:
    """Return tables of runs; all of the same fields.

    Args:
        runs: From `load_runs`; at least one.
        choice: Of the paper's tables; `errors`: success by kind of error in the texts;
            `reach`: by distance to the goal and length of the walk; `confidence`: what
            agents claimed, how sure they were, and what came of it; or `second_tellings`:
            of runs with both tellings and without, what the second is worth; or `asking`:
            of runs with `--ask`, what questions are worth beside the first run. Runs on SAIL
            are shown by map, whichever of the paper's is chosen.
        absent: Methods that have no run: rows of the paper's tables say so, and their
            notes how to get one.

    Raises:
        SettingsError: Some runs are on SAIL and some are not.
        RunFolderError: `second_tellings` where a run with both tellings lacks its
            counterpart, or `asking` of runs that cannot be set beside each other.
    """
    if choice == "errors":
        return [error_table(run) for run in runs]
    if choice == "reach":
        return [reach_table(runs)]
    if choice == "confidence":
        return [confidence_table(runs)]
    if choice == "second_tellings":
        return [second_tellings_table(runs)]
    if choice == "asking":
        return [asking_table(runs)]
    if is_sail(runs):
        return [sail_table(run) for run in runs]
    names: tuple[TableName, ...] = ("II", "III") if choice == "both" else (choice,)
    return [paper_table(runs, name, absent) for name in names]
