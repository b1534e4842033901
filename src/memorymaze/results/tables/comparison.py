"""Two runs side by side on the same instructions, with a paired test."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.settings import agent_version, differences
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap
from memorymaze.metrics.paired import sign_flip_test
from memorymaze.results.tables.measures import (
    COMPARED_MEASURES,
    Measure,
    estimate_fields,
    values_of,
    with_interval_notes,
)
from memorymaze.results.tables.runs import (
    MeasuredRun,
    Place,
    groups_of_places,
    place_fields,
    place_of,
    place_title,
    places_of,
    run_notes,
    studies_of,
    study_title,
)
from memorymaze.tables import Column, Table

KEY = (
    "{second} - {first}: difference of the means over the same instructions, with the 95 % interval "
    "of a paired bootstrap over participants; p from flipping the signs of whole "
    "participants, two-sided, not corrected for the number of rows. The mean over "
    "routes is unweighted. Arrived: both / only {first} / only {second} / neither."
)

NOT_TOLD = (
    *("agent.", "needs:", "isolate:", "answers"),
    *("limit:", "shard", "episodes:"),
)
"""Beginnings of differences that are the agent's own, or said by what is left out."""

VERSIONS = ("agent.file ", "agent.options.")
"""Of those the ones that tell two versions of one agent apart."""


@dataclass(frozen=True, slots=True)
class Outcomes:
    """How often both, one or none of two agents arrived."""

    both: int
    only_first: int
    only_second: int
    neither: int


@dataclass(frozen=True, slots=True)
class ComparisonRow:
    """Two agents on a route, or on the mean over the routes of a study."""

    study: str
    places: tuple[Place, ...]
    episodes: int
    participants: int
    outcomes: Outcomes
    first: dict[str, float]
    """Means of the first run, by the names of measures."""
    second: dict[str, float]
    """Means of the second run."""
    difference: dict[str, Estimate]
    """Second minus first, with 95 % intervals of a paired bootstrap."""
    p_value: dict[str, float | None]
    """Two-sided, by flipping the signs of whole participants; None for one alone."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """All there is to say of two runs."""

    first: MeasuredRun
    second: MeasuredRun
    rows: tuple[ComparisonRow, ...]
    only_in_first: int
    """Episodes that the second run lacks; left out."""
    only_in_second: int
    settings: tuple[str, ...]
    """In what the runs differ besides the agent; empty for a fair comparison."""


def compare_runs(first: MeasuredRun, second: MeasuredRun, seed: int = 0) -> Comparison:
    """Compare two runs on the episodes that both have.

    Raises:
        RunFolderError: No episode is in both runs.
    """
    there = {result.episode_id: result for result in first.results}
    here = {result.episode_id: result for result in second.results}
    shared = sorted(there.keys() & here.keys())
    if not shared:
        raise RunFolderError(
            f"{first.name} and {second.name}: expected runs over the same instructions, "
            "got no episode that both have"
        )
    pairs = [(there[key], here[key]) for key in shared]
    # Looks are None where an agent asks for no pictures.
    looks = (first.record.settings.looks, second.record.settings.looks)
    names = {each.record.settings.agent.name for each in (first, second)}
    same_agent = len(names) == 1
    return Comparison(
        first=first,
        second=second,
        rows=tuple(
            _row(pairs, study, group, seed)
            for study in studies_of(one for one, _ in pairs)
            for group in groups_of_places(places_of((one for one, _ in pairs), study))
        ),
        only_in_first=len(there) - len(shared),
        only_in_second=len(here) - len(shared),
        settings=tuple(
            line
            for line in differences(first.record.settings, second.record.settings)
            if (same_agent and line.startswith(VERSIONS))
            or not (
                line.startswith(NOT_TOLD)
                or (line.startswith("looks:") and None in looks)
            )
        ),
    )


def comparison_table(
    found: Comparison,
    *,
    title: str = "Comparison of two runs",
    letters: tuple[str, str] = ("A", "B"),
) -> Table:
    """Return a comparison as a table, with what is unfair about it in the notes.

    Args:
        found: The comparison.
        title: Of the table.
        letters: What the runs are called in it.
    """
    first, second = letters
    table = Table(
        title,
        (
            Column("study", "Study", "group", show=lambda r: study_title(r["study"])),
            Column("place", "Route", "group", is_data=False),
            Column("site"),
            Column("route"),
            Column("episodes", "n", "group"),
            Column("participants"),
            *(Column(name) for name in ("both", "only_a", "only_b", "neither")),
            Column("arrived", "arrived:", "group", is_data=False),
            Column("measure", "Measure", "label", show=lambda row: row["heading"]),
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
        ),
        tuple(
            _fields(row, measure) for row in found.rows for measure in COMPARED_MEASURES
        ),
        tuple(_notes(found, letters)),
        "comparison",
    )
    return with_interval_notes(table)


def p_cell(p: float | None) -> str:
    """Write the probability of a test; `- (too few)` where one person allows none.

    >>> p_cell(0.25), p_cell(0.0002)
    ('0.250', '< 0.001')
    """
    if p is None:
        return "- (too few)"
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def _row(
    pairs: Sequence[tuple[EpisodeResult, EpisodeResult]],
    study: str,
    places: Sequence[Place],
    seed: int,
) -> ComparisonRow:
    chosen = [
        (one, two)
        for one, two in pairs
        if one.study == study and place_of(one) in places
    ]
    cells = [place_of(one) for one, _ in chosen]
    participants = [one.participant for one, _ in chosen]
    before = np.array([values_of(one, COMPARED_MEASURES) for one, _ in chosen])
    after = np.array([values_of(two, COMPARED_MEASURES) for _, two in chosen])
    rng = np.random.default_rng(seed)
    estimates = participant_bootstrap(after - before, participants, rng, cells=cells)
    p_values: Sequence[float | None] = [None] * len(COMPARED_MEASURES)
    if len(set(participants)) > 1:
        p_values = sign_flip_test(after - before, participants, rng, cells=cells)
    counts = Counter((one.success, two.success) for one, two in chosen)
    names = [each.name for each in COMPARED_MEASURES]
    return ComparisonRow(
        study=study,
        places=tuple(places),
        episodes=len(chosen),
        participants=len(set(participants)),
        outcomes=Outcomes(
            both=counts[True, True],
            only_first=counts[True, False],
            only_second=counts[False, True],
            neither=counts[False, False],
        ),
        first=dict(zip(names, _means(before, cells), strict=True)),
        second=dict(zip(names, _means(after, cells), strict=True)),
        difference=dict(zip(names, estimates, strict=True)),
        p_value=dict(zip(names, p_values, strict=True)),
    )


def _means(values: np.ndarray, cells: Sequence[Place]) -> list[float]:
    """Return the unweighted mean over cells of the means within them."""
    by_cell = [
        values[[index for index, each in enumerate(cells) if each == cell]].mean(axis=0)
        for cell in dict.fromkeys(cells)
    ]
    return np.mean(by_cell, axis=0).tolist()


def _fields(row: ComparisonRow, measure: Measure) -> dict[str, Any]:
    found, difference = row.outcomes, row.difference[measure.name]
    counts = (found.both, found.only_first, found.only_second, found.neither)
    return {
        "study": row.study,
        "place": place_title(row.places),
        **place_fields(row.places, is_mean=len(row.places) > 1),
        "episodes": row.episodes,
        "participants": row.participants,
        **dict(zip(("both", "only_a", "only_b", "neither"), counts, strict=True)),
        "arrived": " / ".join(map(str, counts)),
        "measure": measure.name,
        "heading": measure.heading,
        "a": row.first[measure.name],
        "b": row.second[measure.name],
        **estimate_fields("difference", difference, ("low", "high")),
        "p": row.p_value[measure.name],
    }


def _notes(comparison: Comparison, letters: tuple[str, str]) -> list[str]:
    """Say what was compared, and what is unfair about it."""
    notes: list[str] = []
    first, second = letters
    for letter, run in ((first, comparison.first), (second, comparison.second)):
        version = agent_version(run.record.settings)
        lines = [run_notes(run)[0], *([version] if version else [])]
        notes.append(f"{letter}: " + "\n".join(lines))
    left_out = [
        f"{count} only in {name}"
        for name, count in (
            (first, comparison.only_in_first),
            (second, comparison.only_in_second),
        )
        if count
    ]
    if left_out:
        notes.append(f"LEFT OUT, as only one run has them: {', '.join(left_out)}.")
    if comparison.settings:
        notes.append(
            f"NOT ONLY THE AGENT DIFFERS ({first} there, {second} here): "
            + "; ".join(comparison.settings)
            + "."
        )
    return [*notes, KEY.format(first=first, second=second)]
