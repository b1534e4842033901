"""Two runs on texts with errors, beside each other after equally many metres."""

from collections.abc import Iterator, Sequence

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.results.tables.comparison import (
    comparison_notes,
    figure_columns,
    paired_figures,
    paired_results,
)
from memorymaze.results.tables.errors import by_error_kind
from memorymaze.results.tables.measures import with_interval_notes
from memorymaze.results.tables.reach import WAYS, within_ways
from memorymaze.results.tables.runs import (
    MeasuredRun,
    studies_of,
    study_title,
)
from memorymaze.tables import Column, Row, Table

ALL = "all"
"""Studies together."""
KEY = (
    "Texts with errors only, by kind of error; several: with more than one kind; any: all "
    "of them. A, B: success that took no longer path than so many times the way described, "
    "and the success distance on top. B - A: mean difference over the same texts, each "
    "counting alike, with the 95 % interval of a paired bootstrap over participants; p from "
    "flipping the signs of whole participants, two-sided, not corrected for the number of "
    "rows."
)


def equal_metres_table(first: MeasuredRun, second: MeasuredRun) -> Table:
    """Compare success within 1, 1.5, 2 and 3 times the way on texts with errors.

    Args:
        first: The baseline, A, such as a run of `explorer`.
        second: What is compared with it, B.

    Raises:
        RunFolderError: No text with an error is in both runs.
    """
    pairs = paired_results(first, second)
    after = {one.episode_id: two for one, two in pairs}
    wrong = [one for one, _ in pairs if one.error_kinds]
    if not wrong:
        raise RunFolderError(
            f"{first.name} and {second.name}: expected texts whose errors are labelled, got "
            "none that both have"
        )
    studies = studies_of(wrong)
    groups = {study: [r for r in wrong if r.study == study] for study in studies}
    if len(studies) > 1:
        groups = {ALL: wrong} | groups
    near = (
        first.record.settings.success_distance,
        second.record.settings.success_distance,
    )
    table = Table(
        "Texts with errors: success after equally many metres",
        (
            Column("run"),
            Column("study", "Study", "group", show=lambda row: _title(row["study"])),
            Column(
                "error",
                "error",
                "group",
                show=lambda row: row["error"].replace("_", " "),
            ),
            Column("texts", "texts", "group"),
            Column("participants"),
            Column(
                "ways", "times the way", "label", show=lambda row: f"{row['ways']:g}x"
            ),
            *figure_columns("A", "B"),
        ),
        tuple(
            {"run": second.name, "study": study, "error": kind, **row}
            for study, results in groups.items()
            for kind, chosen in by_error_kind(results).items()
            for row in _rows(chosen, [after[r.episode_id] for r in chosen], near)
        ),
        (*comparison_notes(first, second, len(pairs)), KEY),
        "equal-metres",
    )
    return with_interval_notes(table)


def _title(study: str) -> str:
    return "All studies" if study == ALL else study_title(study)


def _rows(
    before: Sequence[EpisodeResult],
    after: Sequence[EpisodeResult],
    near: tuple[float, float],
) -> Iterator[Row]:
    """Yield a row for every number of ways."""
    participants = [each.participant for each in before]
    first, second = (
        [[value.of(result) for value in within_ways(metres)] for result in results]
        for results, metres in zip((before, after), near, strict=True)
    )
    figures = paired_figures(first, second, participants, [None] * len(before))
    for ways, found in zip(WAYS, figures, strict=True):
        about = {"texts": len(before), "participants": len(set(participants))}
        yield {**about, "ways": ways, **found}
