"""Runs as tables: the paper's Tables II and III, comparisons, SAIL, costs of errors.

Each is a question in data form (`questions`): how runs are split into rows, and of which
quantities the means, or the differences, are shown. What is shown of a metric stands at
its field of `EpisodeResult`. All of them are a `memorymaze.basics.tables.Table`, which knows the
formats. Pages are in `report`, statistics of instructions in
`texts.statistics`.

    runs = load_runs(["runs/guide", "runs/mine"])
    run_tables(runs, "II")[0].frame()
    paired_table(runs, COMPARISON).text()
    success_figure(runs).savefig("success.png")  # from `figures`: it loads matplotlib
"""

from collections.abc import Mapping, Sequence

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.tables import Table
from memorymaze.runs.tables.asking import ASKING
from memorymaze.runs.tables.comparison import COMPARISON, EQUAL_METRES, OVERVIEW
from memorymaze.runs.tables.confidence import CONFIDENCE
from memorymaze.runs.tables.errors import ERRORS
from memorymaze.runs.tables.measures import PAPER_MEASURES, SPREAD_MEASURES
from memorymaze.runs.tables.paper_tables import PAPER_TABLES, paper_table
from memorymaze.runs.tables.questions import (
    PairedQuestion,
    TableQuestion,
    means_table,
    paired_table,
)
from memorymaze.runs.tables.reach import REACH
from memorymaze.runs.tables.runs import (
    STUDY_TITLES,
    MeasuredRun,
    TablePlace,
    load_runs,
    place_title,
    run_notes,
)
from memorymaze.runs.tables.sail import SAIL, is_sail
from memorymaze.runs.tables.second_tellings import SECOND_TELLINGS

__all__ = [
    "COMPARISON",
    "EQUAL_METRES",
    "OVERVIEW",
    "PAPER_MEASURES",
    "SPREAD_MEASURES",
    "STUDY_TITLES",
    "TABLES",
    "MeasuredRun",
    "PairedQuestion",
    "TablePlace",
    "TableQuestion",
    "load_runs",
    "means_table",
    "paired_table",
    "paper_table",
    "place_title",
    "run_notes",
    "run_tables",
]

TABLES: dict[str, TableQuestion] = {
    **PAPER_TABLES,
    "errors": ERRORS,
    "reach": REACH,
    "confidence": CONFIDENCE,
    "second_tellings": SECOND_TELLINGS,
    "asking": ASKING,
}
"""What `memorymaze table --table` can show, besides `both` of the paper's."""


def run_tables(
    runs: Sequence[MeasuredRun],
    choice: str = "II",
    absent: Mapping[str, str] | None = None,
) -> list[Table]:
    """Return tables of runs; all of the same fields.

    Args:
        runs: From `load_runs`; at least one.
        choice: A name of `TABLES`, or `both` for the paper's two. Runs on SAIL are shown by
            map, whichever of the paper's is chosen.
        absent: Methods that have no run: rows of the paper's tables say so, and their
            notes how to get one.

    Raises:
        SettingsError: There is no such table, or some runs are on SAIL and some are not.
        RunFolderError: The table cannot show these runs, such as `second_tellings` where
            a run with both tellings lacks its counterpart.
    """
    known = ["both", *TABLES]
    if choice not in known:
        raise SettingsError(
            f"table: expected one of {', '.join(known)}; got {choice!r}"
            f"{did_you_mean(choice, known)}"
        )
    if choice == "both" or choice in PAPER_TABLES:
        if not is_sail(runs):
            names = PAPER_TABLES if choice == "both" else (choice,)
            return [paper_table(runs, name, absent) for name in names]
        question = SAIL
    else:
        question = TABLES[choice]
    shown = [[run] for run in runs] if question.is_of_one_run else [runs]
    return [means_table(each, question) for each in shown]
