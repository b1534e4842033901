"""What asking people is worth: policies and controls beside the first run, paired."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Column
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables.measures import (
    EPISODES,
    Fact,
    Gain,
    Pairs,
    Quantity,
)
from memorymaze.runs.tables.questions import RowGroup, TableQuestion
from memorymaze.runs.tables.runs import STUDY, MeasuredRun, studies_of

NEARER = (
    ("near", "asked near", 0.0, 20.0),
    ("middle", "middle", 20.0, 60.0),
    ("far", "far", 60.0, np.inf),
)
"""Groups of episodes, by metres left to the goal when the first answer came."""
KEY = (
    "SR success; difference: to the first run, over the episodes that both have; SR per "
    "question: success over 1 + the questions asked; questions and seconds of strangers: "
    "mean of an episode; asked near, middle, far: SR of the episodes whose first answer "
    "came less than 20 m, less than 60 m, and farther from the goal, with how many (answers "
    "near the goal are easy). [95 % interval], bootstrap over participants. What people "
    "answer comes from a bank that a language model wrote in role."
)


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup]:
    """Yield the rows: what came of each episode in the first run, and in another one."""
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
            yield RowGroup({"study": study, "run": run.name}, pairs)


def _mean(of: Callable[[EpisodeResult], float]) -> Callable[[Pairs], Any]:
    return lambda pairs: np.mean([of(each) for _, each in pairs])


def _success_from(least: float, most: float, pairs: Pairs) -> str:
    """Return the success of those whose first answer came so near, and how many."""
    group = [
        each.success
        for _, each in pairs
        if each.answers_left_m and least <= each.answers_left_m[0] < most
    ]
    return f"{np.mean(group):.2f} ({len(group)})" if group else "-"


ASKING = TableQuestion(
    shows="of runs with --ask, what questions are worth beside the first run",
    title="Asking people on the way",
    name="asking",
    columns=(
        STUDY,
        Column("run", "Run", "label"),
        replace(EPISODES, name="n"),
        Quantity("sr", "SR", of=lambda each: float(each[1].success)),
        Gain(
            "difference",
            "difference",
            of=lambda each: each[1].success - float(each[0].success),
        ),
        Fact(
            "per_question",
            "SR per question",
            digits=2,
            better="higher",
            of=_mean(lambda each: each.success / (1 + each.questions)),
        ),
        Fact("questions", "questions", digits=2, of=_mean(lambda e: e.questions)),
        Fact(
            "strangers_s",
            "strangers (s)",
            digits=1,
            better="lower",
            of=_mean(lambda each: each.strangers_s),
        ),
        *(
            Fact(name, heading, "label", of=partial(_success_from, least, most))
            for name, heading, least, most in NEARER
        ),
    ),
    groups=_groups,
    unit=lambda each: each[0].participant,
    key=(KEY,),
)
