"""What asking people is worth: policies and controls beside the first run, paired."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.results.tables.measures import Quantity
from memorymaze.results.tables.questions import RowGroup, TableQuestion
from memorymaze.results.tables.runs import STUDY, MeasuredRun, studies_of
from memorymaze.tables import Column

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
_Beside = tuple[EpisodeResult, EpisodeResult]
"""What came of an episode in the first run, and in another one."""
SR: Quantity[_Beside] = Quantity("sr", "SR", lambda each: float(each[1].success))
DIFFERENCE: Quantity[_Beside] = Quantity(
    "difference",
    "difference",
    lambda each: each[1].success - float(each[0].success),
    None,
    signed=True,
)


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup[_Beside]]:
    for run in runs:
        if run.record.settings.ask is None:
            raise RunFolderError(
                f"{run.name}: expected runs of the track with people one can ask "
                "(--ask N), got one of another track"
            )
    base = {each.episode_id: each for each in runs[0].results}
    for study in studies_of(runs[0].results):
        for run in runs:
            pairs = [
                (base[each.episode_id], each)
                for each in run.results
                if each.study == study and each.episode_id in base
            ]
            if not pairs:
                raise RunFolderError(
                    f"{run.name} and {runs[0].name}: expected runs over the same episodes, "
                    f"got none of study {study} that both have"
                )
            about = {"study": study, "run": run.name}
            facts = _facts([each for _, each in pairs])
            yield RowGroup(about | facts, (SR, DIFFERENCE), pairs)


def _facts(results: Sequence[EpisodeResult]) -> dict[str, Any]:
    return {
        "n": len(results),
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


ASKING = TableQuestion(
    shows="of runs with --ask, what questions are worth beside the first run",
    title="Asking people on the way",
    name="asking",
    columns=(
        STUDY,
        Column("run", "Run", "label"),
        Column("n", "n"),
        SR.column,
        DIFFERENCE.column,
        Column("per_question", "SR per question", digits=2, better="higher"),
        Column("questions", "questions", digits=2),
        Column("strangers_s", "strangers (s)", digits=1, better="lower"),
        Column("near", "asked near", "label"),
        Column("middle", "middle", "label"),
        Column("far", "far", "label"),
    ),
    groups=_groups,
    unit=lambda each: each[0].participant,
    key=(KEY,),
)
