"""What asking people is worth: policies and controls beside the first run, paired."""

from collections.abc import Iterator, Sequence

import numpy as np

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.metrics.aggregate import participant_bootstrap
from memorymaze.results.tables.measures import (
    ends,
    estimate_fields,
    with_interval_notes,
)
from memorymaze.results.tables.runs import STUDY, MeasuredRun, run_notes, studies_of
from memorymaze.tables import Column, Row, Table

NEARER = (20.0, 60.0, np.inf)
"""Metres left to the goal when the first answer came, below which rows are grouped."""
KEY = (
    "SR success; difference: to the first run, over the episodes that both have; SR per "
    "question: success over 1 + the questions asked; questions and seconds of strangers: "
    "mean of an episode; asked near, middle, far: SR of the episodes whose first answer "
    "came less than 20 m, less than 60 m, and farther from the goal, with how many (answers "
    "near the goal are easy). [95 % interval], bootstrap over participants. What people "
    "answer comes from a bank that a language model wrote in role."
)


def asking_table(runs: Sequence[MeasuredRun]) -> Table:
    """Return what each run of the track with people one can ask reaches, and at what cost.

    The first run is the one that the others are compared with.

    Raises:
        RunFolderError: A run is not of that track, or shares no episode with the first.
    """
    for run in runs:
        if run.record.settings.ask is None:
            raise RunFolderError(
                f"{run.name}: expected runs of the track with people one can ask "
                "(--ask N), got one of another track"
            )
    base = {each.episode_id: each for each in runs[0].results}
    rows: list[Row] = []
    for study in studies_of(runs[0].results):
        for run in runs:
            results = [
                each
                for each in run.results
                if each.study == study and each.episode_id in base
            ]
            if not results:
                raise RunFolderError(
                    f"{run.name} and {runs[0].name}: expected runs over the same episodes, "
                    f"got none of study {study} that both have"
                )
            rows.append({"study": study, **_figures(run, results, base)})
    table = Table(
        "Asking people on the way",
        (
            STUDY,
            Column("run", "Run", "label"),
            Column("n", "n"),
            Column("sr", "SR", digits=2, interval=ends("sr"), better="higher"),
            Column(
                "difference",
                "difference",
                digits=2,
                signed=True,
                interval=ends("difference"),
            ),
            Column("per_question", "SR per question", digits=2, better="higher"),
            Column("questions", "questions", digits=2),
            Column("strangers_s", "strangers (s)", digits=1, better="lower"),
            Column("near", "asked near", "label"),
            Column("middle", "middle", "label"),
            Column("far", "far", "label"),
        ),
        tuple(rows),
        (*("\n".join(run_notes(run)) for run in runs), KEY),
        "asking",
    )
    return with_interval_notes(table)


def _figures(
    run: MeasuredRun,
    results: Sequence[EpisodeResult],
    base: dict[str, EpisodeResult],
) -> Row:
    values = [
        (float(each.success), each.success - float(base[each.episode_id].success))
        for each in results
    ]
    people = [each.participant for each in results]
    found = participant_bootstrap(values, people, np.random.default_rng(0))
    return {
        "run": run.name,
        "n": len(results),
        **estimate_fields("sr", found[0]),
        **estimate_fields("difference", found[1]),
        "per_question": np.mean([e.success / (1 + e.questions) for e in results]),
        "questions": np.mean([each.questions for each in results]),
        "strangers_s": np.mean([each.strangers_s for each in results]),
        **dict(zip(("near", "middle", "far"), _by_metres_left(results), strict=True)),
    }


def _by_metres_left(results: Sequence[EpisodeResult]) -> Iterator[str]:
    """Yield the success of those whose first answer came so near, and how many."""
    least = 0.0
    for most in NEARER:
        group = [
            each.success
            for each in results
            if each.answers_left_m and least <= each.answers_left_m[0] < most
        ]
        yield f"{np.mean(group):.2f} ({len(group)})" if group else "-"
        least = most
