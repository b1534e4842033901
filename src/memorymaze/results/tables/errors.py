"""What each kind of error costs: success by kind, beside the same texts without it."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.error_kinds import ERROR_KINDS
from memorymaze.metrics.paired import sign_flip_test
from memorymaze.results.tables.comparison import p_cell
from memorymaze.results.tables.measures import (
    SUCCESS,
    EpisodeValue,
    ends,
    value_fields,
    with_interval_notes,
)
from memorymaze.results.tables.runs import MeasuredRun, run_notes
from memorymaze.tables import Column, Row, Table

NO_ERROR, ANY, SEVERAL = "none", "any", "several"
KEY = (
    "SR: stopped by itself at the goal. without it: the same texts without the error. "
    "difference: SR with the error minus SR without it, over pairs; [95 % interval], "
    "bootstrap over participants; p: two-sided sign-flip test over participants. none: "
    "texts without errors that have no counterpart."
)
COLUMNS = (
    Column("method"),
    Column("study", "study", "label"),
    Column("error", "error", "label", show=lambda row: row["error"].replace("_", " ")),
    Column("texts", "texts"),
    Column("sr", "SR [95 %]", digits=2, interval=ends("sr")),
    Column("pairs", "pairs", show=lambda row: str(row["pairs"] or "-")),
    Column("sr_right", "SR without it [95 %]", digits=2, interval=ends("sr_right")),
    Column(
        "difference",
        "difference [95 %]",
        digits=2,
        signed=True,
        interval=ends("difference"),
    ),
    Column("p", "p", show=lambda row: p_cell(row["p"]) if row["pairs"] else "-"),
)


def error_table(run: MeasuredRun) -> Table:
    """Return success by study and kind of error: a kind, `none`, `several` or `any`."""
    right: dict[str | None, EpisodeResult] = {
        r.pair: r for r in run.results if r.pair and not r.error_kinds
    }
    rows: list[Row] = []
    for study in dict.fromkeys(result.study for result in run.results):
        own = [result for result in run.results if result.study == study]
        groups = {NO_ERROR: [r for r in own if not r.error_kinds and r.pair is None]}
        about = {"method": run.label, "study": study}
        rows += [
            about | {"error": kind} | _figures(group, right)
            for kind, group in (groups | by_error_kind(own)).items()
            if group
        ]
    table = Table(
        f"Success by kind of error: {run.label}",
        COLUMNS,
        tuple(rows),
        ("\n".join(run_notes(run)), KEY),
        "errors",
    )
    return with_interval_notes(table)


def by_error_kind(results: Sequence[EpisodeResult]) -> dict[str, list[EpisodeResult]]:
    """Return results on texts with errors by kind, and under `any` all where there are several."""
    groups: dict[str, list[EpisodeResult]] = {}
    for result in results:
        kinds = set(result.error_kinds)
        if kinds:
            kind = kinds.pop() if len(kinds) == 1 else SEVERAL
            groups.setdefault(kind, []).append(result)
    last = [SEVERAL] if SEVERAL in groups else []
    known = [each.name for each in ERROR_KINDS if each.name in groups]
    order = [*known, *sorted({*groups} - {*known, *last}), *last]
    found = {kind: groups[kind] for kind in order}
    if len(found) > 1:
        found[ANY] = [result for result in results if result.error_kinds]
    return found


def _figures(
    results: Sequence[EpisodeResult], right: Mapping[str | None, EpisodeResult]
) -> dict[str, Any]:
    """Return what a row says of some results, and of their texts without errors."""
    own = [result for result in results if result.pair in right]
    about = {"texts": len(results), "pairs": len(own)}
    about |= value_fields(results, [SUCCESS])
    if not own:
        return about | dict.fromkeys(("sr_right", "difference", "p"))
    without = EpisodeValue("sr_right", "", lambda each: right[each.pair].success)
    apart = EpisodeValue("difference", "", lambda each: each.success - without.of(each))
    people = [each.participant for each in own]
    p = None
    if len(set(people)) > 1:
        differences = [[apart.of(each)] for each in own]
        (p,) = sign_flip_test(differences, people, np.random.default_rng(0))
    return about | value_fields(own, [without, apart]) | {"p": p}
