"""Success on SAIL by map, beside that of the people who followed the same paragraphs."""

from collections.abc import Iterator, Sequence

import numpy as np

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.tables import Column, Row
from memorymaze.basics.wording import counted
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables.errors import TEXTS
from memorymaze.runs.tables.measures import Fact, Quantity
from memorymaze.runs.tables.questions import RowGroup, TableQuestion
from memorymaze.runs.tables.runs import MeasuredRun
from memorymaze.texts.corpus.sail import DEVELOPMENT, paragraph_of

STUDY = "sail"
KEY = (
    "success: stopped by itself at the goal's node, mean over start headings; "
    "[95 % interval], bootstrap over paragraphs. people: share of followers who reached "
    "the goal, all trials on the same paragraphs taken together. usable: the corpus "
    "knows a legal path. development half: paragraphs of the writers whose texts were "
    "read while the agents were developed."
)
Headings = Sequence[EpisodeResult]
"""What came of a paragraph, from each start heading that has been run."""


def is_sail(runs: Sequence[MeasuredRun]) -> bool:
    """Tell whether runs are on SAIL."""
    studies = {result.study == STUDY for run in runs for result in run.results}
    if len(studies) > 1:
        raise SettingsError(
            "table: expected runs on SAIL alone or none of them, got both; make a "
            "table of each"
        )
    return studies == {True}


def _people(row: Row) -> str:
    share = row["people"]
    trials = counted(row["followers"], "trial")
    return "-" if share is None else f"{share:.2f} ({trials})"


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup]:
    [run] = runs
    kinds = {
        "all": run.results,
        "usable": [r for r in run.results if r.followers and r.followers.usable],
        "development half": [r for r in run.results if r.split == DEVELOPMENT],
        "other half": [r for r in run.results if r.split != DEVELOPMENT],
    }
    for kind, results in kinds.items():
        maps = sorted({result.site for result in results})
        for site in [*maps, None] if len(maps) > 1 else maps:
            texts: dict[str, list[EpisodeResult]] = {}
            for each in results:
                if site in (None, each.site):
                    texts.setdefault(paragraph_of(each.episode_id), []).append(each)
            about = {
                "method": run.label,
                "paragraphs": kind,
                "map": "all" if site is None else site.removeprefix("sail_").title(),
            }
            yield RowGroup(about, [*texts.values()])


def _tried(texts: Sequence[Headings]) -> int:
    people = [told for each in texts if (told := each[-1].followers)]
    return sum(each.tried or 0 for each in people)


def _share_arrived(texts: Sequence[Headings]) -> float | None:
    people = [told for each in texts if (told := each[-1].followers)]
    tried = _tried(texts)
    return sum(each.arrived or 0 for each in people) / tried if tried else None


SAIL = TableQuestion(
    shows="success on SAIL by map, beside people who followed the same texts",
    title="SAIL, final position: {label}",
    name="sail",
    columns=(
        Column("method"),
        Column("paragraphs", "paragraphs", "label"),
        Column("map", "map", "label"),
        TEXTS,
        Fact("episodes", "episodes", of=lambda texts: sum(map(len, texts))),
        Quantity(
            "success",
            "success [95 %]",
            better=None,
            of=lambda each: float(np.mean([result.success for result in each])),
        ),
        Fact("followers", of=_tried),
        Fact("people", "people", show=_people, of=_share_arrived),
    ),
    groups=_groups,
    unit=lambda each: each[0].instruction_id,
    key=(KEY,),
    is_of_one_run=True,
)
