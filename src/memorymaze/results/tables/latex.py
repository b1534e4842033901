"""Tables as LaTeX, for papers; needs the package booktabs there."""

from collections.abc import Sequence
from itertools import groupby

from memorymaze.results.tables.bootstrap import MEASURES, Estimate
from memorymaze.results.tables.cells import (
    KEY,
    STUDY_TITLES,
    TITLES,
    count_cell,
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

HEADINGS = ("SR $\\uparrow$", "OSR $\\uparrow$", "SPD (m) $\\downarrow$")
SPECIAL = str.maketrans({
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
})


def latex_table(
    rows: Sequence[TableRow], runs: Sequence[MeasuredRun], table: TableName
) -> str:
    """Write a table as a LaTeX `table*`; the best measured value of a group is bold.

    What one must know to read it stands in the caption.
    """
    costs = any_inference(runs)
    names = ["Method", "Parser", "n", *HEADINGS, "CLS $\\uparrow$"]
    names += [_escaped(name) for name in COST_COLUMNS.values()] if costs else []
    lines = [
        r"\begin{table*}",
        r"\centering",
        r"\begin{tabular}{ll" + "r" * (len(names) - 2) + "}",
        r"\toprule",
        " & ".join(names) + r" \\",
    ]
    for study, of_study in groupby(rows, lambda row: row.study):
        lines += [r"\midrule", _across(names, rf"\textit{{{STUDY_TITLES[study]}}}")]
        for title, members in groupby(of_study, group_title):
            group = list(members)
            lines += [r"\addlinespace", _across(names, _escaped(title))]
            best = _best(group)
            lines += [_line(row, best, costs=costs) for row in group]
    caption = [TITLES[table] + ".", KEY.replace("\n", " ")]
    caption += [COST_KEY.replace("\n", " ")] if costs else []
    caption += [note for run in runs for note in run_notes(run)]
    lines += [
        r"\bottomrule",
        r"\end{tabular}",
        rf"\caption{{{_escaped(' '.join(caption))}}}",
        rf"\label{{tab:memorymaze-{table.lower()}}}",
        r"\end{table*}",
    ]
    return "\n".join(lines) + "\n"


def _across(names: Sequence[str], text: str) -> str:
    return rf"\multicolumn{{{len(names)}}}{{l}}{{{text}}} \\"


def _best(group: Sequence[TableRow]) -> dict[str, float]:
    """Return the best measured mean of every measure, where there is a choice."""
    measured = [row for row in group if row.run is not None]
    if len(measured) < 2:
        return {}
    return {
        name: (min if name == "spd" else max)(row.values[name].mean for row in measured)
        for name in MEASURES
    }


def _line(row: TableRow, best: dict[str, float], *, costs: bool) -> str:
    cells = [rf"\quad {_escaped(row.method)}", parser_cell(row), count_cell(row)]
    for name in MEASURES:
        is_best = row.run is not None and row.values[name].mean == best.get(name)
        cells.append(_number(row.values[name], bold=is_best))
    if costs:
        cells += [_escaped(cell) for cell in cost_cells(row)]
    return " & ".join(cells) + r" \\"


def _number(estimate: Estimate, *, bold: bool) -> str:
    mean = f"{estimate.mean:.2f}"
    shown = rf"\textbf{{{mean}}}" if bold else mean
    if estimate.low is None or estimate.high is None:
        return shown
    return rf"{shown} {{\scriptsize [{estimate.low:.2f}, {estimate.high:.2f}]}}"


def _escaped(text: str) -> str:
    return text.translate(SPECIAL)
