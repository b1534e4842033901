"""Tables as Markdown."""

from collections.abc import Sequence

from memorymaze.results.tables.bootstrap import MEASURES
from memorymaze.results.tables.cells import (
    HEADINGS,
    KEY,
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


def markdown_table(
    rows: Sequence[TableRow], runs: Sequence[MeasuredRun], table: TableName
) -> str:
    """Write a table as Markdown."""
    lines = [f"### {TITLES[table]}", ""]
    for run in runs:
        first, *others = run_notes(run)
        lines += [f"- {_escaped(first)}", *(f"  {_escaped(note)}" for note in others)]
    costs = any_inference(runs)
    lines += ["", KEY.replace("\n", " ")]
    if costs:
        lines += ["", COST_KEY.replace("\n", " ")]
    columns = ["Study", "Route", "Method", "Parser", "n"]
    measured = [HEADINGS[name] for name in MEASURES]
    measured += COST_COLUMNS.values() if costs else ()
    lines += ["", "| " + " | ".join(columns + measured) + " |"]
    lines.append("|---|---|---|---|---:|" + "---:|" * len(measured))
    for row in rows:
        cells = [
            row.study,
            group_title(row),
            row.method,
            parser_cell(row),
            count_cell(row),
        ]
        cells += [estimate_cell(row.values[name]) for name in MEASURES]
        cells += cost_cells(row) if costs else ()
        lines.append("| " + " | ".join(_escaped(cell) for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _escaped(text: str) -> str:
    return text.replace("|", "\\|")
