"""What each kind of error costs: success by kind, beside the same texts without it."""

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.error_kinds import ERROR_KINDS
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap
from memorymaze.metrics.paired import sign_flip_test
from memorymaze.results.tables.cells import estimate_cell
from memorymaze.results.tables.columns import markdown_columns, text_columns
from memorymaze.results.tables.rows import MeasuredRun
from memorymaze.results.tables.run_notes import run_notes

STYLES = ("text", "md", "csv")
HEADINGS = (
    "study",
    "error",
    "texts",
    "SR [95 %]",
    "pairs",
    "SR without it [95 %]",
    "difference [95 %]",
    "p",
)
NO_ERROR, ANY, SEVERAL = "none", "any", "several"
KEY = (
    "SR: stopped by itself at the goal. without it: the same texts without the error. "
    "difference: SR with the error minus SR without it, over pairs; [95 % interval], "
    "bootstrap over participants; p: two-sided sign-flip test over participants. none: "
    "texts without errors that have no counterpart."
)


@dataclass(frozen=True, slots=True)
class ErrorRow:
    """One line of the table: the texts with one kind of error in one study."""

    method: str
    study: str
    kind: str
    """A kind, `none`, `several` (kinds in one text) or `any`."""
    texts: int
    sr: Estimate
    pairs: int
    sr_right: Estimate | None
    """Of the same texts without errors; None without pairs."""
    difference: Estimate | None
    p: float | None


def error_rows(run: MeasuredRun) -> list[ErrorRow]:
    """Return the rows of a run, by study and kind.

    Raises:
        RunFolderError: The run was made by a version that did not keep the kinds.
    """
    if any(result.error_kinds is None for result in run.results):
        raise RunFolderError(
            f"{run.name}: expected results that name the errors in their texts, got some "
            "of an older version, which did not keep them; run the instructions again"
        )
    right = {r.pair: r for r in run.results if r.pair and not r.error_kinds}
    rows: list[ErrorRow] = []
    for study in dict.fromkeys(result.study for result in run.results):
        own = [result for result in run.results if result.study == study]
        wrong = [result for result in own if result.error_kinds]
        groups = {NO_ERROR: [r for r in own if not r.error_kinds and r.pair is None]}
        for result in wrong:
            groups.setdefault(_kind(result), []).append(result)
        if len(groups) > 2:
            groups[ANY] = wrong
        order = [NO_ERROR, *(each.name for each in ERROR_KINDS)]
        last = [SEVERAL, ANY]
        known = [*order, *sorted({*groups} - {*order, *last}), *last]
        rows += [
            _row(run.label, study, kind, groups[kind], right)
            for kind in known
            if groups.get(kind)
        ]
    return rows


def error_table(runs: Sequence[MeasuredRun], style: str) -> str:
    """Write the table of some runs.

    Args:
        runs: From `load_runs`.
        style: `text` (aligned), `md`, or `csv` with unrounded numbers.

    Raises:
        SettingsError: There is no such style of this table.
    """
    if style not in STYLES:
        raise SettingsError(
            f"--format {style}: the table of errors is {', '.join(STYLES)}; choose one"
        )
    if style == "csv":
        return _csv(row for run in runs for row in error_rows(run))
    parts: list[str] = []
    for run in runs:
        lines = [HEADINGS, *(_cells(row) for row in error_rows(run))]
        write = text_columns if style == "text" else markdown_columns
        notes = "\n".join(f"- {note}" for note in run_notes(run))
        title = f"Success by kind of error: {run.label}"
        parts.append(f"{title}\n\n{write(lines)}\n\n{KEY}\n\n{notes}\n")
    return "\n".join(parts)


def _kind(result: EpisodeResult) -> str:
    kinds = set(result.error_kinds or ())
    return kinds.pop() if len(kinds) == 1 else SEVERAL


def _row(
    method: str,
    study: str,
    kind: str,
    results: Sequence[EpisodeResult],
    right: Mapping[str, EpisodeResult],
) -> ErrorRow:
    pairs = [(r, right[r.pair]) for r in results if r.pair and r.pair in right]
    sr = _estimate([float(r.success) for r in results], results)
    if not pairs:
        return ErrorRow(method, study, kind, len(results), sr, 0, None, None, None)
    own = [wrong for wrong, _ in pairs]
    differences = [float(a.success) - float(b.success) for a, b in pairs]
    (p,) = sign_flip_test(
        [[each] for each in differences],
        [each.participant for each in own],
        np.random.default_rng(0),
    )
    return ErrorRow(
        method,
        study,
        kind,
        len(results),
        sr,
        len(pairs),
        _estimate([float(b.success) for _, b in pairs], own),
        _estimate(differences, own),
        p,
    )


def _estimate(values: Sequence[float], of: Sequence[EpisodeResult]) -> Estimate:
    (estimate,) = participant_bootstrap(
        [[value] for value in values],
        [result.participant for result in of],
        np.random.default_rng(0),
    )
    return estimate


def _cells(row: ErrorRow) -> tuple[str, ...]:
    return (
        row.study,
        row.kind.replace("_", " "),
        str(row.texts),
        _shown(row.sr),
        str(row.pairs) if row.pairs else "-",
        _shown(row.sr_right),
        _shown(row.difference, sign="+"),
        "-" if row.p is None else f"{row.p:.4f}",
    )


def _shown(estimate: Estimate | None, sign: str = "") -> str:
    return "-" if estimate is None else estimate_cell(estimate, sign)


def _csv(rows: Iterable[ErrorRow]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([
        *("method", "study", "error", "texts", "sr", "sr_low", "sr_high", "pairs"),
        *("sr_right", "sr_right_low", "sr_right_high"),
        *("difference", "difference_low", "difference_high", "p"),
    ])
    nothing = Estimate(float("nan"))
    for row in rows:
        numbers: list[float | None] = []
        for estimate in (row.sr_right, row.difference):
            each = estimate or nothing
            known = estimate is not None
            numbers += [each.mean if known else None, each.low, each.high]
        writer.writerow([
            *(row.method, row.study, row.kind, row.texts),
            *(row.sr.mean, row.sr.low, row.sr.high, row.pairs, *numbers, row.p),
        ])
    return out.getvalue()
