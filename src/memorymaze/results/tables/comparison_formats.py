"""A comparison of two runs as aligned text, Markdown and CSV."""

import csv
import io
import textwrap
from typing import Literal

from memorymaze.results.tables.cells import STUDY_TITLES, estimate_cell
from memorymaze.results.tables.comparison import (
    COMPARED,
    Comparison,
    ComparisonRow,
)
from memorymaze.results.tables.rows import place_title
from memorymaze.results.tables.run_notes import run_notes
from memorymaze.results.tables.text import TEXT_WIDTH

ComparisonFormat = Literal["text", "md", "csv"]

HEADINGS = {
    "sr": "SR",
    "osr": "OSR",
    "spd": "SPD (m)",
    "cls": "CLS",
    "ndtw": "nDTW",
}

KEY = (
    "B - A: difference of the means over the same instructions, with the 95 % interval "
    "of a paired bootstrap over participants; p from flipping the signs of whole "
    "participants, two-sided, not corrected for the number of rows. The mean over "
    "routes is unweighted. Arrived: both / only A / only B / neither."
)


def format_comparison(comparison: Comparison, style: ComparisonFormat) -> str:
    """Write a comparison with all that one must know to read it.

    Args:
        comparison: From `compare_runs`.
        style: Text of at most 118 columns, Markdown, or CSV with unrounded numbers.
    """
    if style == "csv":
        return _csv(comparison)
    return _markdown(comparison) if style == "md" else _text(comparison)


def _notes(comparison: Comparison) -> list[str]:
    """Say what was compared, and what is unfair about it."""
    notes = [f"A: {run_notes(comparison.first)[0]}"]
    notes.append(f"B: {run_notes(comparison.second)[0]}")
    left_out = [
        f"{count} only in {name}"
        for name, count in (
            ("A", comparison.only_in_first),
            ("B", comparison.only_in_second),
        )
        if count
    ]
    if left_out:
        notes.append(f"LEFT OUT, as only one run has them: {', '.join(left_out)}.")
    if comparison.settings:
        notes.append(
            "NOT ONLY THE AGENT DIFFERS (A there, B here): "
            + "; ".join(comparison.settings)
            + "."
        )
    return [*notes, KEY]


def _text(comparison: Comparison) -> str:
    lines = ["Comparison of two runs", ""]
    for note in _notes(comparison):
        lines += textwrap.wrap(note, TEXT_WIDTH, subsequent_indent="  ")
    study = ""
    for row in comparison.rows:
        if row.study != study:
            study = row.study
            lines += ["", STUDY_TITLES[study]]
        lines.append(f"{place_title(row.places)}  (n {row.episodes})")
        lines.append(f"  arrived: {_outcomes(row)}")
        for name in COMPARED:
            lines.append(
                f"  {HEADINGS[name]:<8} A {row.first[name]:6.2f}  B "
                f"{row.second[name]:6.2f}  B - A {_difference(row, name):<24} p "
                f"{_p(row.p_value[name])}"
            )
    return "\n".join(lines) + "\n"


def _markdown(comparison: Comparison) -> str:
    lines = ["### Comparison of two runs", ""]
    lines += [f"- {note}".replace("|", "\\|") for note in _notes(comparison)]
    lines += [
        "",
        "| Study | Route | n | Arrived | Measure | A | B | B - A | p |",
        "|---|---|---:|---|---|---:|---:|---:|---:|",
    ]
    for row in comparison.rows:
        for name in COMPARED:
            cells = [row.study, place_title(row.places), str(row.episodes)]
            cells += [_outcomes(row), HEADINGS[name], f"{row.first[name]:.2f}"]
            cells += [f"{row.second[name]:.2f}", _difference(row, name)]
            cells.append(_p(row.p_value[name]))
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _csv(comparison: Comparison) -> str:
    out = io.StringIO()
    columns = ["study", "site", "route", "episodes", "participants", "both", "only_a"]
    columns += ["only_b", "neither", "measure", "a", "b", "difference", "low", "high"]
    writer = csv.DictWriter(out, [*columns, "p"], lineterminator="\n")
    writer.writeheader()
    for row in comparison.rows:
        is_mean = len(row.places) > 1
        for name in COMPARED:
            difference = row.difference[name]
            writer.writerow({
                "study": row.study,
                "site": "mean" if is_mean else row.places[0].site,
                "route": "mean" if is_mean else row.places[0].route,
                "episodes": row.episodes,
                "participants": row.participants,
                "both": row.outcomes.both,
                "only_a": row.outcomes.only_first,
                "only_b": row.outcomes.only_second,
                "neither": row.outcomes.neither,
                "measure": name,
                "a": row.first[name],
                "b": row.second[name],
                "difference": difference.mean,
                "low": difference.low,
                "high": difference.high,
                "p": row.p_value[name],
            })
    return out.getvalue()


def _outcomes(row: ComparisonRow) -> str:
    found = row.outcomes
    return f"{found.both} / {found.only_first} / {found.only_second} / {found.neither}"


def _difference(row: ComparisonRow, name: str) -> str:
    return estimate_cell(row.difference[name], "+")


def _p(value: float) -> str:
    return "< 0.001" if value < 0.001 else f"{value:.3f}"
