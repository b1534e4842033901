"""The two questions that tables answer: means of groups, and paired differences of groups.

A table is a question in data form: how it splits runs into groups, a row each, and of
which quantities it shows the means. What all tables have in common is here: intervals,
tests, and the notes on how runs came about.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Column, Row, Table
from memorymaze.runs.episodes.in_words import agent_version
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import differences
from memorymaze.runs.metrics.paired import sign_flip_test
from memorymaze.runs.tables.measures import (
    Fact,
    Pair,
    Pairs,
    Quantity,
    estimate_fields,
    mean_estimates,
    mean_fields,
    participant_of,
)
from memorymaze.runs.tables.runs import MeasuredRun, run_notes, studies_of

NO_INTERVAL = {
    "(too few)": "too few: fewer than two participants on the same routes (SAIL: fewer "
    "than two paragraphs), so no interval can be told and no test made.",
    "(no spread)": "no spread: on each route all participants have the same value, or "
    "there is one alone, so the bootstrap finds none; that does not make it certain.",
}
"""What stands in cells instead of an interval, and what it means."""
VERSIONS = frozenset({"agent file", "agent option"})
"""Kinds of differences that tell two versions of one agent apart."""
NOT_TOLD = VERSIONS | {
    *("agent", "needs", "isolate", "answers"),
    *("limit", "shard", "episodes", "told_once"),
}
"""Those that are the agent's own, or said by what is left out."""


@dataclass(frozen=True, slots=True)
class RowGroup:
    """A row: what it is about, and what its facts and means are worked out from."""

    about: Row
    seen: Sequence[Any] = ()
    """Of nothing, the row shows what it is about alone."""
    quantities: Sequence[Quantity] | None = None
    """What means are taken of; None for those among the columns."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Question:
    title: str
    """`{label}` stands for the method of the first run."""
    name: str
    columns: tuple[Column, ...]
    """What rows are about, their facts, and their means."""
    key: tuple[str, ...]
    """What the columns mean."""
    cell: Callable[[Any], Hashable] | None = None
    """What means are first taken in, such as a route; None for the mean of all."""

    def facts(self, seen: Sequence[Any]) -> Row:
        """Return the facts of a row."""
        facts = (each for each in self.columns if isinstance(each, Fact))
        return {each.name: each.of(seen) for each in facts}


@dataclass(frozen=True, slots=True, kw_only=True)
class TableQuestion(_Question):
    """A table of means: its rows are groups of what was seen."""

    shows: str
    """For those who choose a table."""
    groups: Callable[[Sequence[MeasuredRun]], Iterable[RowGroup]]
    """The rows, in their order; refuses runs that the table cannot show."""
    unit: Callable[[Any], str] = participant_of
    """Whom intervals draw."""
    remarks: Callable[[Sequence[MeasuredRun]], Iterable[str]] = lambda _: ()
    """What else there is to say of the runs."""
    is_of_one_run: bool = False
    """Whether each run has a table of its own."""
    aside: Callable[[Row], bool] | None = None
    """Which rows are there to compare with."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairedQuestion(_Question):
    """A table of differences: its rows are groups of episodes that two runs have both.

    The two means, their difference and its test stand after the columns; in the key
    `{first}` and `{second}` stand for what the runs are called.
    """

    groups: Callable[[Sequence[MeasuredRun], Pairs], Iterable[RowGroup]]
    """What rows are about, and their pairs, of the first run and another one."""
    quantities: Callable[[float], Sequence[Quantity]]
    """What is compared, a row each; by the success distance of a run."""
    letters: tuple[str, str] = ("A", "B")
    """What the runs are called."""


def means_table(runs: Sequence[MeasuredRun], question: TableQuestion) -> Table:
    """Return the means of quantities by groups, with intervals.

    Raises:
        MemoryMazeError: The question cannot be put to these runs.
    """
    shown = [each for each in question.columns if isinstance(each, Quantity)]
    rows: list[Row] = []
    for group in question.groups(runs):
        row = group.about
        if group.seen:
            quantities = shown if group.quantities is None else group.quantities
            people = [question.unit(each) for each in group.seen]
            cells = question.cell and [question.cell(each) for each in group.seen]
            means = mean_fields(quantities, group.seen, people, cells)
            row = {**question.facts(group.seen), **row, **means}
        rows.append(row)
    notes = ["\n".join(run_notes(run)) for run in runs]
    table = Table(
        question.title.replace("{label}", runs[0].label),
        question.columns,
        tuple(rows),
        (*notes, *question.remarks(runs), *question.key),
        question.name,
        question.aside,
    )
    return _with_interval_notes(table)


def paired_table(runs: Sequence[MeasuredRun], question: PairedQuestion) -> Table:
    """Return the differences of runs to the first one, over the episodes that both have.

    What is unfair about the comparison stands in the notes, and which run has no episode
    in common with the first.

    Raises:
        RunFolderError: None has an episode in common with the first one.
    """
    first, *others = runs
    letter_of_first, letter = question.letters
    rows: list[Row] = []
    notes = [_note(letter_of_first, first)]
    shared = [_paired_results(first, other) for other in others]
    if not any(shared):
        raise RunFolderError(
            f"{' and '.join(run.name for run in runs)}: expected runs over the same "
            "instructions, got no episode that the first has in common with another"
        )
    for other, pairs in zip(others, shared, strict=True):
        if not pairs:
            notes.append(
                f"{_note(letter, other)}\nNOTHING IN COMMON with {letter_of_first}, and so "
                "no row."
            )
            continue
        near = [run.record.settings.success_distance for run in (first, other)]
        quantities = list(zip(*map(question.quantities, near), strict=True))
        for group in question.groups((first, other), pairs):
            about = {**group.about, **question.facts(group.seen)}
            rows += [
                {**about, **row}
                for row in _paired_rows(quantities, group.seen, question.cell)
            ]
        notes += [
            _note(letter, other),
            *_warnings(first, other, len(pairs), question.letters),
        ]
    order = studies_of(first.results)
    if len(others) > 1:
        rows.sort(key=lambda row: order.index(row["study"]))
    key = [each.format(first=letter_of_first, second=letter) for each in question.key]
    table = Table(
        question.title.replace("{label}", first.label),
        (*question.columns, *_figure_columns(*question.letters)),
        tuple(rows),
        (*notes, *key),
        question.name,
    )
    return _with_interval_notes(table)


def paired_fields(
    first: ArrayLike,
    second: ArrayLike,
    people: Sequence[str],
    cells: Sequence[Hashable] | None = None,
) -> Iterator[dict[str, Any]]:
    """Yield, for each column of values, both means, their difference and its test."""
    before, after = np.asarray(first, float), np.asarray(second, float)
    rng = np.random.default_rng(0)
    estimates = mean_estimates(after - before, people, cells, rng)
    p_values: Sequence[float | None] = [None] * len(estimates)
    if estimates[0].low is not None:
        p_values = sign_flip_test(after - before, people, rng, cells=cells)
    means = zip(_means(before, cells), _means(after, cells), strict=True)
    for (a, b), difference, p in zip(means, estimates, p_values, strict=True):
        fields = estimate_fields(difference, "difference", "low", "high")
        yield {"a": a, "b": b, **fields, "p": p}


def p_cell(p: float | None) -> str:
    """Write the probability of a test; `- (too few)` where one person allows none.

    >>> p_cell(0.25), p_cell(0.0002)
    ('0.250', '< 0.001')
    """
    if p is None:
        return "- (too few)"
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def _paired_rows(
    quantities: Sequence[tuple[Quantity, Quantity]],
    pairs: Pairs,
    cell: Callable[[EpisodeResult], Hashable] | None,
) -> Iterator[Row]:
    """Yield a row for every quantity, as it is of the first run and of the second."""
    found = paired_fields(
        [[of_first.of(one) for of_first, _ in quantities] for one, _ in pairs],
        [[of_second.of(two) for _, of_second in quantities] for _, two in pairs],
        [one.participant for one, _ in pairs],
        None if cell is None else [cell(one) for one, _ in pairs],
    )
    for (quantity, _), fields in zip(quantities, found, strict=True):
        about = {"measure": quantity.name, "heading": quantity.heading}
        yield {**about, **quantity.about, **fields}


def _figure_columns(first: str, second: str) -> tuple[Column, ...]:
    return (
        Column("a", first, digits=2),
        Column("b", second, digits=2),
        Column(
            "difference",
            f"{second} - {first}",
            digits=2,
            signed=True,
            interval=("low", "high"),
        ),
        Column("p", "p", show=lambda row: p_cell(row["p"])),
    )


def _means(values: np.ndarray, cells: Sequence[Hashable] | None) -> list[float]:
    """Return the unweighted mean over cells of the means within them."""
    labels = [None] * len(values) if cells is None else cells
    by_cell = [
        values[[index for index, each in enumerate(labels) if each == cell]].mean(
            axis=0
        )
        for cell in dict.fromkeys(labels)
    ]
    return np.mean(by_cell, axis=0).tolist()


def _with_interval_notes(table: Table) -> Table:
    """Return a table that explains what stands in its cells instead of intervals."""
    cells = [column.cell(row) for column in table.columns for row in table.rows]
    found = [
        note
        for words, note in NO_INTERVAL.items()
        if any(cell.endswith(words) for cell in cells)
    ]
    return replace(table, notes=(*table.notes, *found))


def _paired_results(first: MeasuredRun, second: MeasuredRun) -> list[Pair]:
    """Return the results of the episodes that both runs have."""
    there = {result.episode_id: result for result in first.results}
    here = {result.episode_id: result for result in second.results}
    return [(there[key], here[key]) for key in sorted(there.keys() & here.keys())]


def _note(letter: str, run: MeasuredRun) -> str:
    version = agent_version(run.record.settings)
    return f"{letter}: " + "\n".join([
        run_notes(run)[0],
        *([version] if version else []),
    ])


def _warnings(
    first: MeasuredRun,
    second: MeasuredRun,
    shared: int,
    letters: tuple[str, str],
) -> Iterator[str]:
    """Say what is unfair about a comparison."""
    told = [
        f"{len(run.results) - shared} only in {letter}"
        for letter, run in zip(letters, (first, second), strict=True)
        if len(run.results) > shared
    ]
    if told:
        yield f"LEFT OUT, as only one run has them: {', '.join(told)}."
    settings = (first.record.settings, second.record.settings)
    same_agent = settings[0].agent.name == settings[1].agent.name
    # Looks are None where an agent asks for no pictures.
    no_pictures = None in (settings[0].looks, settings[1].looks)
    unfair = [
        str(each)
        for each in differences(*settings)
        if (same_agent and each.kind in VERSIONS)
        or not (
            each.kind in NOT_TOLD
            or (each.kind == "looks" and no_pictures)
            # Its episodes are left out.
            or (each.kind == "site" and None in (each.there, each.here))
        )
    ]
    if unfair:
        yield (
            f"NOT ONLY THE AGENT DIFFERS ({letters[0]} there, {letters[1]} here): "
            + "; ".join(unfair)
            + "."
        )
