"""Tables as aligned text."""

import textwrap
from collections.abc import Sequence
from itertools import groupby

from memorymaze.results.tables.bootstrap import MEASURES
from memorymaze.results.tables.cells import (
    HEADINGS,
    KEY,
    STUDY_TITLES,
    TITLES,
    count_cell,
    estimate_cell,
    group_title,
    parser_cell,
)
from memorymaze.results.tables.inference_cost import (
    COST_COLUMNS,
    COST_KEY,
    any_inference,
    cost_cells,
)
from memorymaze.results.tables.rows import MeasuredRun, TableName, TableRow
from memorymaze.results.tables.run_notes import run_notes

TEXT_WIDTH = 118


def text_table(
    rows: Sequence[TableRow], runs: Sequence[MeasuredRun], table: TableName
) -> str:
    """Write a table as text of at most 118 columns."""
    lines = [TITLES[table], ""]
    for run in runs:
        first, *others = run_notes(run)
        for note in (first, *(f"  {note}" for note in others)):
            lines += textwrap.wrap(note, TEXT_WIDTH, subsequent_indent="  ")
    lines += ["", KEY]
    width = max(24, *(len(row.method) + 2 for row in rows))
    for study, of_study in groupby(rows, lambda row: row.study):
        heading = _line("", "parser", "n", [HEADINGS[name] for name in MEASURES], width)
        lines += ["", STUDY_TITLES[study], heading, "-" * len(heading)]
        for title, group in groupby(of_study, group_title):
            lines.append(title)
            lines += [
                _line(
                    "  " + row.method,
                    parser_cell(row),
                    count_cell(row),
                    [estimate_cell(row.values[name]) for name in MEASURES],
                    width,
                )
                for row in group
            ]
    if any_inference(runs):
        lines += _inference_text(rows, width)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _inference_text(rows: Sequence[TableRow], width: int) -> list[str]:
    """Return the lines on what inference cost; the columns above leave no room."""
    lines = ["", "What inference costs", *COST_KEY.split("\n")]
    widths = [17, *(max(8, len(name)) for name in COST_COLUMNS.values())]
    names = [HEADINGS["sr"], *COST_COLUMNS.values()]
    measured = [row for row in rows if row.run is not None]
    for study, of_study in groupby(measured, lambda row: row.study):
        heading = _line("", "parser", "n", names, width, widths)
        lines += ["", STUDY_TITLES[study], heading, "-" * len(heading)]
        for title, group in groupby(of_study, group_title):
            lines.append(title)
            lines += [
                _line(
                    "  " + row.method,
                    parser_cell(row),
                    count_cell(row),
                    [estimate_cell(row.values["sr"]), *cost_cells(row)],
                    width,
                    widths,
                )
                for row in group
            ]
    return lines


def _line(
    method: str,
    parser: str,
    count: str,
    values: Sequence[str],
    width: int,
    widths: Sequence[int] = (17, 17, 23, 17),
) -> str:
    columns = "".join(
        f"  {value:<{wide}}" for value, wide in zip(values, widths, strict=True)
    )
    return f"{method:<{width}} {parser:<6} {count:>4}{columns}"
