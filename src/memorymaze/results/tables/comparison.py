"""Two runs side by side on the same instructions, with a paired test."""

from collections import Counter
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.measures import Measure
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.settings import agent_version, differences
from memorymaze.metrics.aggregate import participant_bootstrap
from memorymaze.metrics.paired import sign_flip_test
from memorymaze.results.tables.measures import (
    COMPARED_MEASURES,
    estimate_fields,
    values_of,
    with_interval_notes,
)
from memorymaze.results.tables.runs import (
    STUDY,
    MeasuredRun,
    Place,
    groups_of_places,
    place_fields,
    place_of,
    place_title,
    places_of,
    run_notes,
    studies_of,
)
from memorymaze.tables import Column, Row, Table

KEY = (
    "{second} - {first}: difference of the means over the same instructions, with the 95 % interval "
    "of a paired bootstrap over participants; p from flipping the signs of whole "
    "participants, two-sided, not corrected for the number of rows. The mean over "
    "routes is unweighted. Arrived: both / only {first} / only {second} / neither."
)

COUNTS = ("both", "only_a", "only_b", "neither")
"""Who arrived."""
VERSIONS = frozenset({"agent file", "agent option"})
"""Kinds of differences that tell two versions of one agent apart."""
NOT_TOLD = VERSIONS | {
    *("agent", "needs", "isolate", "answers"),
    *("limit", "shard", "episodes", "told_once"),
}
"""Those that are the agent's own, or said by what is left out."""


def comparison_table(
    first: MeasuredRun,
    second: MeasuredRun,
    *,
    title: str = "Comparison of two runs",
    letters: tuple[str, str] = ("A", "B"),
) -> Table:
    """Compare two runs on the episodes that both have, route by route.

    What is unfair about the comparison stands in the notes.

    Args:
        first: The baseline.
        second: What is compared with it.
        title: Of the table.
        letters: What the runs are called in it.

    Raises:
        RunFolderError: No episode is in both runs.
    """
    pairs = paired_results(first, second)
    before = [one for one, _ in pairs]
    table = Table(
        title,
        _columns(*letters),
        tuple(
            row
            for study in studies_of(before)
            for group in groups_of_places(places_of(before, study))
            for row in _rows(
                [
                    (one, two)
                    for one, two in pairs
                    if one.study == study and place_of(one) in group
                ],
                group,
                COMPARED_MEASURES,
            )
        ),
        (
            *comparison_notes(first, second, len(pairs), letters),
            KEY.format(first=letters[0], second=letters[1]),
        ),
        "comparison",
    )
    return with_interval_notes(table)


def comparison_overview(first: MeasuredRun, others: Sequence[MeasuredRun]) -> Table:
    """Compare the success of several runs with one, on the episodes each shares with it.

    Means over the routes of a study; route by route, and other measures, are in
    `comparison_table` of two runs.

    Args:
        first: The baseline, A.
        others: What is compared with it, each for itself.

    Raises:
        RunFolderError: A run has no episode in common with the first one.
    """
    rows: list[Row] = []
    notes = [_note("A", first)]
    success = [each for each in COMPARED_MEASURES if each.name == "sr"]
    for other in others:
        pairs = paired_results(first, other)
        for study in studies_of(one for one, _ in pairs):
            chosen = [pair for pair in pairs if pair[0].study == study]
            places = places_of((one for one, _ in chosen), study)
            [mean] = _rows(chosen, places, success)
            rows.append({"method": other.label, "run": other.name, **mean})
        unfair = _warnings(first, other, len(pairs), ("A", "B"))
        notes.append("\n".join([_note("B", other), *unfair]))
    studies = studies_of(first.results)
    shown = {column.name: column for column in _columns("A", "B")}
    return with_interval_notes(
        Table(
            f"Success of each run (B) beside {first.label} (A)",
            (
                shown["study"],
                Column("method", "B", "label"),
                Column("run"),
                replace(shown["episodes"], role="value"),
                replace(shown["arrived"], role="value"),
                *(shown[name] for name in ("a", "b", "difference", "p")),
            ),
            tuple(sorted(rows, key=lambda row: studies.index(row["study"]))),
            (*notes, KEY.format(first="A", second="B")),
            "comparison",
        )
    )


def paired_results(
    first: MeasuredRun, second: MeasuredRun
) -> list[tuple[EpisodeResult, EpisodeResult]]:
    """Return the results of the episodes that both runs have."""
    there = {result.episode_id: result for result in first.results}
    here = {result.episode_id: result for result in second.results}
    shared = sorted(there.keys() & here.keys())
    if not shared:
        raise RunFolderError(
            f"{first.name} and {second.name}: expected runs over the same instructions, "
            "got no episode that both have"
        )
    return [(there[key], here[key]) for key in shared]


def figure_columns(first: str, second: str) -> tuple[Column, ...]:
    """Return what is shown of a row of `paired_figures`."""
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


def _columns(first: str, second: str) -> tuple[Column, ...]:
    return (
        STUDY,
        Column("place", "Route", "group", is_data=False),
        Column("site"),
        Column("route"),
        Column("episodes", "n", "group"),
        Column("participants"),
        *(Column(name) for name in COUNTS),
        Column("arrived", "arrived:", "group", is_data=False),
        Column("measure", "Measure", "label", show=lambda row: row["heading"]),
        *figure_columns(first, second),
    )


def p_cell(p: float | None) -> str:
    """Write the probability of a test; `- (too few)` where one person allows none.

    >>> p_cell(0.25), p_cell(0.0002)
    ('0.250', '< 0.001')
    """
    if p is None:
        return "- (too few)"
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def _rows(
    pairs: Sequence[tuple[EpisodeResult, EpisodeResult]],
    places: Sequence[Place],
    measures: Sequence[Measure],
) -> list[Row]:
    """Return a row for every measure."""
    participants = [one.participant for one, _ in pairs]
    figures = paired_figures(
        [values_of(one, measures) for one, _ in pairs],
        [values_of(two, measures) for _, two in pairs],
        participants,
        [place_of(one) for one, _ in pairs],
    )
    outcomes = Counter((one.success, two.success) for one, two in pairs)
    counts = [outcomes[one, two] for one in (True, False) for two in (True, False)]
    about = {
        "study": pairs[0][0].study,
        "place": place_title(places),
        **place_fields(places, is_mean=len(places) > 1),
        "episodes": len(pairs),
        "participants": len(set(participants)),
        **dict(zip(COUNTS, counts, strict=True)),
        "arrived": " / ".join(map(str, counts)),
    }
    return [
        about | {"measure": measure.name, "heading": measure.heading} | found
        for measure, found in zip(measures, figures, strict=True)
    ]


def paired_figures(
    first: ArrayLike,
    second: ArrayLike,
    participants: Sequence[str],
    cells: Sequence[Hashable],
) -> Iterator[dict[str, Any]]:
    """Yield, for each column of values, both means, their difference and its test."""
    before, after = np.asarray(first, float), np.asarray(second, float)
    rng = np.random.default_rng(0)
    estimates = participant_bootstrap(after - before, participants, rng, cells=cells)
    p_values: Sequence[float | None] = [None] * len(estimates)
    if estimates[0].low is not None:
        p_values = sign_flip_test(after - before, participants, rng, cells=cells)
    means = zip(_means(before, cells), _means(after, cells), strict=True)
    for (a, b), difference, p in zip(means, estimates, p_values, strict=True):
        fields = estimate_fields("difference", difference, ("low", "high"))
        yield {"a": a, "b": b, **fields, "p": p}


def _means(values: np.ndarray, cells: Sequence[Hashable]) -> list[float]:
    """Return the unweighted mean over cells of the means within them."""
    by_cell = [
        values[[index for index, each in enumerate(cells) if each == cell]].mean(axis=0)
        for cell in dict.fromkeys(cells)
    ]
    return np.mean(by_cell, axis=0).tolist()


def _note(letter: str, run: MeasuredRun) -> str:
    version = agent_version(run.record.settings)
    return f"{letter}: " + "\n".join([
        run_notes(run)[0],
        *([version] if version else []),
    ])


def comparison_notes(
    first: MeasuredRun,
    second: MeasuredRun,
    shared: int,
    letters: tuple[str, str] = ("A", "B"),
) -> Iterator[str]:
    """Say which runs are compared, and what is unfair about it."""
    for each in zip(letters, (first, second), strict=True):
        yield _note(*each)
    yield from _warnings(first, second, shared, letters)


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
