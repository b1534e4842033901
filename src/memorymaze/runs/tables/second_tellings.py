"""What a second telling is worth: agents on the first, the second, and both together."""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.input_files import stamp_file
from memorymaze.basics.tables import Column
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import differences
from memorymaze.runs.tables.measures import Fact, Gain, Quantity
from memorymaze.runs.tables.questions import RowGroup, TableQuestion
from memorymaze.runs.tables.runs import (
    ALL,
    METHOD,
    STUDY_OR_ALL,
    MeasuredRun,
    studies_of,
)
from memorymaze.texts.corpus.files import BUILTIN_CORPUS
from memorymaze.texts.corpus.records import was_developed_on

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


class _Told(NamedTuple):
    """What came of a person's first telling, of the second, and of both."""

    first: EpisodeResult
    second: EpisodeResult
    both: EpisodeResult


def _success_of(which: str) -> Quantity:
    return Quantity(which, which, of=lambda told: float(getattr(told, which).success))


def _gain_over(which: str) -> Gain:
    return Gain(
        f"both_{which}",
        f"both - {which}",
        of=lambda told: told.both.success - float(getattr(told, which).success),
    )


def _groups(runs: Sequence[MeasuredRun]) -> list[RowGroup]:
    found = [
        group
        for single, both in _pairs_of_runs(runs)
        for group in _groups_of_pair(both, _told(single, both))
    ]
    order = list(HALVES)
    return sorted(
        found,
        key=lambda each: (order.index(each.about["half"]), each.about["study"] == ALL),
    )


def _pairs_of_runs(
    runs: Sequence[MeasuredRun],
) -> Iterator[tuple[MeasuredRun, MeasuredRun]]:
    """Yield each run on both tellings behind its counterpart on single texts."""
    both_tellings = [run for run in runs if run.record.settings.second_telling]
    if not both_tellings:
        raise RunFolderError(
            f"{', '.join(run.name for run in runs)}: expected a run with second_telling=true "
            "and one without it of each agent, got none with it"
        )
    for both in both_tellings:
        yield _single_of(both, runs), both


def _single_of(both: MeasuredRun, runs: Sequence[MeasuredRun]) -> MeasuredRun:
    """Return the run on single texts that was made as one with both tellings."""
    settings = both.record.settings
    others = [run for run in runs if not run.record.settings.second_telling]
    found = [
        [
            str(each)
            for each in differences(run.record.settings, settings)
            if each.kind not in FREE
            and not (each.kind == "site" and None in (each.there, each.here))
        ]
        for run in others
    ]
    alike = [run for run, why in zip(others, found, strict=True) if not why]
    if len(alike) != 1:
        unlike = [
            f"{run.name}: {'; '.join(why)}"
            for run, why in zip(others, found, strict=True)
            if why
        ]
        raise RunFolderError(
            f"{both.name}: expected beside it one run without second_telling that was "
            f"made otherwise alike, got {len(alike)}"
            + "".join(f"\n  {u}" for u in unlike)
        )
    return alike[0]


def _told(single: MeasuredRun, both: MeasuredRun) -> list[_Told]:
    """Return what came of the pairs that both runs have."""
    by_episode = {each.episode_id: each for each in single.results}
    by_text = {each.instruction_id: each for each in single.results}
    told: list[_Told] = []
    for result in both.results:
        second = by_episode.get(result.episode_id)
        if second is None:
            continue
        first_id = result.instruction_id.removesuffix(f"+{second.instruction_id}")
        if first_id in by_text:
            told.append(_Told(by_text[first_id], second, result))
    if not told:
        raise RunFolderError(
            f"{single.name} and {both.name}: expected runs over the same people, got no "
            "pair of tellings that both have"
        )
    return told


def _groups_of_pair(both: MeasuredRun, told: Sequence[_Told]) -> Iterator[RowGroup]:
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
                    if errors in (ALL, sum(map(bool, each.both.errors_of_tellings)))
                ]
                if chosen:
                    method = both.label.removesuffix(", told twice")
                    about = {"half": half, "study": study, "method": method}
                    yield RowGroup({**about, "errors": errors}, chosen)


def _left_out(runs: Sequence[MeasuredRun]) -> Iterable[str]:
    for single, both in _pairs_of_runs(runs):
        number = len(both.results) - len(_told(single, both))
        if number:
            yield f"LEFT OUT, as {single.name} lacks one of their tellings: {number}."


SECOND_TELLINGS = TableQuestion(
    shows="of runs with second_telling and without, success on the first, the second "
    "and both",
    title="Second tellings: first, second, and both together",
    name="second-tellings",
    columns=(
        Column("half", "People", "group", show=lambda row: HALVES[row["half"]]),
        STUDY_OR_ALL,
        METHOD,
        Column("errors", "errors", "label", show=lambda row: ERRORS[row["errors"]]),
        Fact("pairs", "pairs", of=len),
        Fact("participants", of=lambda told: len({e.both.participant for e in told})),
        *map(_success_of, _Told._fields),
        *map(_gain_over, ("first", "second")),
    ),
    groups=_groups,
    unit=lambda told: told.both.participant,
    key=(KEY,),
    remarks=_left_out,
)
