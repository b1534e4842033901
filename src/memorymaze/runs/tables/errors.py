"""What each kind of error costs: success by kind, beside the same texts without it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from memorymaze.basics.tables import Column
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables.measures import (
    SUCCESS,
    Fact,
    Gain,
    Quantity,
    mean_fields,
)
from memorymaze.runs.tables.questions import (
    RowGroup,
    TableQuestion,
    p_cell,
    paired_fields,
)
from memorymaze.runs.tables.runs import MeasuredRun
from memorymaze.texts.corpus.error_kinds import ERROR_KINDS

NO_ERROR, ANY, SEVERAL = "none", "any", "several"
KEY = (
    "SR: stopped by itself at the goal. without it: the same texts without the error. "
    "difference: SR with the error minus SR without it, over pairs; [95 % interval], "
    "bootstrap over participants; p: two-sided sign-flip test over participants. none: "
    "texts without errors that have no counterpart."
)
ERROR = Column(
    "error", "error", "label", show=lambda row: row["error"].replace("_", " ")
)
TEXTS = Fact("texts", "texts", of=len)
WITHOUT = Quantity(
    "sr_right",
    "SR without it [95 %]",
    better=None,
    of=lambda each: SUCCESS.of(each[0]),
)
APART = Gain(
    "difference",
    "difference [95 %]",
    of=lambda each: SUCCESS.of(each[1]) - SUCCESS.of(each[0]),
)
"""Of pairs of a text without the error, and the same text with it."""


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


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup]:
    [run] = runs
    right: dict[str | None, EpisodeResult] = {
        r.pair: r for r in run.results if r.pair and not r.error_kinds
    }
    for study in dict.fromkeys(result.study for result in run.results):
        own = [result for result in run.results if result.study == study]
        groups = {NO_ERROR: [r for r in own if not r.error_kinds and r.pair is None]}
        for kind, group in (groups | by_error_kind(own)).items():
            if group:
                about = {"method": run.label, "study": study, "error": kind}
                yield RowGroup(about | _beside(group, right), group, (SUCCESS,))


def _beside(
    results: Sequence[EpisodeResult], right: Mapping[str | None, EpisodeResult]
) -> dict[str, Any]:
    """Return how many texts have a counterpart, and what they lose."""
    pairs = [(right[each.pair], each) for each in results if each.pair in right]
    about = {"pairs": len(pairs)}
    if not pairs:
        return about | dict.fromkeys(("sr_right", "difference", "p"))
    people = [each.participant for _, each in pairs]
    right_and_wrong = [
        [[SUCCESS.of(each)] for each in side] for side in zip(*pairs, strict=True)
    ]
    [tested] = paired_fields(right_and_wrong[0], right_and_wrong[1], people)
    return about | mean_fields((WITHOUT, APART), pairs, people) | {"p": tested["p"]}


ERRORS = TableQuestion(
    shows="success by kind of error in the texts, beside the same texts without it",
    title="Success by kind of error: {label}",
    name="errors",
    columns=(
        Column("method"),
        Column("study", "study", "label"),
        ERROR,
        TEXTS,
        replace(SUCCESS, heading="SR [95 %]", better=None),
        Column("pairs", "pairs", show=lambda row: str(row["pairs"] or "-")),
        WITHOUT,
        APART,
        Column("p", "p", show=lambda row: p_cell(row["p"]) if row["pairs"] else "-"),
    ),
    groups=_groups,
    key=(KEY,),
    is_of_one_run=True,
)
