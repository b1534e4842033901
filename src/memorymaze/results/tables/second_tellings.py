"""What a second telling is worth: agents on the first, the second, and both together."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.settings import differences
from memorymaze.input_files import stamp_file
from memorymaze.instructions.files import BUILTIN_CORPUS
from memorymaze.instructions.records import was_developed_on
from memorymaze.metrics.aggregate import participant_bootstrap
from memorymaze.results.tables.measures import (
    ends,
    estimate_fields,
    with_interval_notes,
)
from memorymaze.results.tables.runs import (
    MeasuredRun,
    run_notes,
    studies_of,
    study_title,
)
from memorymaze.tables import Column, Row, Table

ALL = "all"
"""Studies together, halves together, or pairs whatever their errors."""
HALVES = {
    "held_out": "Half of the people not read while developing",
    ALL: "All people",
}
ERRORS = {ALL: "all", 0: "none", 1: "one", 2: "both"}
"""How many of the two tellings have an error."""
FREE = {
    *("second_telling", "told_once", "limit", "split", "shard", "episodes", "answers"),
}
"""Settings in which the runs of an agent on single texts and on both may differ."""
KEY = (
    "SR of the same people's first telling, second telling, and both handed over as one "
    "text, each pair counting alike. errors: how many of the two tellings have a "
    "significant error. Differences over the same pairs; [95 % interval], paired bootstrap "
    "over participants."
)
SUCCESSES = ("first", "second", "both")
DIFFERENCES = ("both_first", "both_second")


class Told(NamedTuple):
    """What came of a person's first telling, of the second, and of both."""

    first: EpisodeResult
    second: EpisodeResult
    both: EpisodeResult


def second_tellings_table(runs: Sequence[MeasuredRun]) -> Table:
    """Return success on first, second and both tellings, by agent, study and errors.

    Of each agent there is a run with `second_telling` and one without, made otherwise
    alike; `RunFolderError` says which is missing.
    """
    rows: list[Row] = []
    notes: list[str] = []
    for both in (run for run in runs if run.record.settings.second_telling):
        single = _single_of(both, runs)
        told, left_out = _told(single, both)
        rows += _rows(both, told)
        notes.append("\n".join([*run_notes(single), *run_notes(both)]))
        if left_out:
            notes.append(
                f"LEFT OUT, as {single.name} lacks one of their tellings: {left_out}."
            )
    if not rows:
        raise RunFolderError(
            f"{', '.join(run.name for run in runs)}: expected a run with second_telling=true "
            "and one without it of each agent, got none with it"
        )
    order = list(HALVES)
    rows.sort(key=lambda row: (order.index(row["half"]), row["study"] == ALL))
    table = Table(
        "Second tellings: first, second, and both together",
        (
            Column("half", "People", "group", show=lambda row: HALVES[row["half"]]),
            Column("study", "Study", "group", show=lambda row: _title(row["study"])),
            Column("method", "Method", "label"),
            Column("errors", "errors", "label", show=lambda row: ERRORS[row["errors"]]),
            Column("pairs", "pairs"),
            Column("participants"),
            *(
                Column(name, name, digits=2, interval=ends(name), better="higher")
                for name in SUCCESSES
            ),
            *(
                Column(
                    name,
                    name.replace("_", " - "),
                    digits=2,
                    signed=True,
                    interval=ends(name),
                )
                for name in DIFFERENCES
            ),
        ),
        tuple(rows),
        (*notes, KEY),
        "second-tellings",
    )
    return with_interval_notes(table)


def _title(study: str) -> str:
    return "All studies" if study == ALL else study_title(study)


def _single_of(both: MeasuredRun, runs: Sequence[MeasuredRun]) -> MeasuredRun:
    """Return the run on single texts that was made as one with both tellings."""
    settings = both.record.settings
    others = [run for run in runs if not run.record.settings.second_telling]
    found = {
        run.name: [
            str(each)
            for each in differences(run.record.settings, settings)
            if each.kind not in FREE
            and not (each.kind == "site" and None in (each.there, each.here))
        ]
        for run in others
    }
    alike = [run for run in others if not found[run.name]]
    if len(alike) != 1:
        unlike = [f"{name}: {'; '.join(why)}" for name, why in found.items() if why]
        raise RunFolderError(
            f"{both.name}: expected beside it one run without second_telling that was "
            f"made otherwise alike, got {len(alike)}"
            + "".join(f"\n  {u}" for u in unlike)
        )
    return alike[0]


def _told(single: MeasuredRun, both: MeasuredRun) -> tuple[list[Told], int]:
    """Return what came of the pairs that both runs have, and how many one lacks."""
    by_episode = {each.episode_id: each for each in single.results}
    by_text = {each.instruction_id: each for each in single.results}
    told: list[Told] = []
    for result in both.results:
        second = by_episode.get(result.episode_id)
        if second is None:
            continue
        first_id = result.instruction_id.removesuffix(f"+{second.instruction_id}")
        if first_id in by_text:
            told.append(Told(by_text[first_id], second, result))
    if not told:
        raise RunFolderError(
            f"{single.name} and {both.name}: expected runs over the same people, got no "
            "pair of tellings that both have"
        )
    return told, len(both.results) - len(told)


def _rows(both: MeasuredRun, told: Sequence[Told]) -> Iterator[Row]:
    """Yield a row for every half, study and number of tellings with errors."""
    was_half_read = stamp_file(BUILTIN_CORPUS) in both.record.settings.instructions
    studies = studies_of(each.both for each in told)
    for half in HALVES if was_half_read else (ALL,):
        for study in (*studies, *([ALL] if len(studies) > 1 else [])):
            group = [
                each
                for each in told
                if study in (ALL, each.both.study)
                and not (half != ALL and was_developed_on(each.both.participant))
            ]
            for errors in ERRORS:
                chosen = [
                    each
                    for each in group
                    if errors in (ALL, _tellings_with_errors(each))
                ]
                if chosen:
                    about = {"half": half, "study": study, "method": _method(both)}
                    yield {**about, "errors": errors, **_figures(chosen)}


def _method(run: MeasuredRun) -> str:
    return run.label.removesuffix(", told twice")


def _tellings_with_errors(told: Told) -> int:
    return sum(map(bool, told.both.errors_of_tellings))


def _figures(told: Sequence[Told]) -> Row:
    people = [each.both.participant for each in told]
    values = [
        (first, second, both, both - first, both - second)
        for first, second, both in (
            [float(result.success) for result in each] for each in told
        )
    ]
    estimates = participant_bootstrap(values, people, np.random.default_rng(0))
    row: dict[str, object] = {"pairs": len(told), "participants": len(set(people))}
    for name, found in zip((*SUCCESSES, *DIFFERENCES), estimates, strict=True):
        row |= estimate_fields(name, found)
    return row
