"""The statistics as tables of words, the same for a terminal and for a page."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby

from memorymaze.instructions.published import PublishedDescriptions, published_tables
from memorymaze.instructions.statistics import CellStatistics
from memorymaze.results.instruction_study.named_things import SORTS
from memorymaze.results.instruction_study.study import InstructionStudy
from memorymaze.results.instruction_study.study_table import StudyTable, place_title
from memorymaze.results.instruction_study.text_measures import MEASURES, GroupMeans
from memorymaze.results.instruction_study.word_tables import (
    rules_table,
    vocabulary_table,
)

STUDIES = {
    "online": "online (typed while watching)",
    "onsite": "onsite (spoken from memory)",
}
TABLE_ONE_KEY = (
    "RL length of the reference route; mean, median and SD of words per text; FR share of "
    "texts with a significant error; AR share that describes another way. Published "
    "figures in brackets; (-) where the paper has none."
)


def study_tables(study: InstructionStudy) -> list[StudyTable]:
    """Return all tables, in the order in which they are shown."""
    tables = _table_one(study)
    if study.vocabularies:
        tables.append(vocabulary_table(study))
    if any(each.published for each in study.vocabularies):
        tables.append(rules_table(study))
    tables += [_speech(study), _things(study)]
    if study.distances:
        tables.append(_distances(study))
    return tables


def _table_one(study: InstructionStudy) -> list[StudyTable]:
    published = {
        (row.study, row.site, row.route, row.iteration): row
        for row in published_tables().descriptions
    }
    tables: list[StudyTable] = []
    for name, cells in groupby(study.cells, lambda cell: cell.study):
        rows = [
            _cell(
                cell, published.get((cell.study, cell.site, cell.route, cell.iteration))
            )
            for cell in cells
        ]
        tables.append(
            StudyTable(
                f"table_1_{name}",
                f"Table I: {STUDIES.get(name, name)}",
                ("route", "iter.", "n", "RL m", "mean", "median", "SD", "FR %", "AR %"),
                tuple(rows),
                2,
            )
        )
    return [*tables[:-1], replace(tables[-1], notes=(TABLE_ONE_KEY,))]


def _cell(cell: CellStatistics, paper: PublishedDescriptions | None) -> tuple[str, ...]:
    def beside(value: float, name: str, digits: int = 1, scale: float = 1) -> str:
        shown = "-" if math.isnan(value) else f"{scale * value:.{digits}f}"
        if paper is None:
            return shown
        known = getattr(paper, name)
        return f"{shown} ({'-' if known is None else f'{scale * known:.{digits}f}'})"

    return (
        f"{place_title(cell.site)} {cell.route}",
        str(cell.iteration),
        str(cell.instructions),
        beside(cell.route_length, "route_length", 2),
        beside(cell.words_mean, "words_mean"),
        beside(cell.words_median, "words_median"),
        beside(cell.words_sd, "words_sd"),
        beside(cell.failure_rate, "failure_rate", scale=100),
        beside(cell.alternative_rate, "alternative_rate", scale=100),
    )


def _per_text(group: GroupMeans, names: Sequence[str]) -> list[str]:
    return [f"{group.means[name]:.2f}" for name in names]


def _speech(study: InstructionStudy) -> StudyTable:
    names = ("hedges", "fillers", "corrections")
    rows = [
        (
            *_who(group),
            *_per_text(group, names),
            *(f"{100 * group.means[name] / group.words:.2f}" for name in names),
            *(f"{100 * group.shares[name]:.0f}" for name in names),
        )
        for group in _shown(study)
    ]
    return StudyTable(
        "speech",
        "Hedges, fillers and corrections",
        (
            "study",
            "iter.",
            "n",
            *names,
            *(f"{name}/100 words" for name in ("hedges", "fillers", "corr.")),
            *(f"{name} %" for name in ("hedges", "fillers", "corr.")),
        ),
        tuple(rows),
        2,
        (
            "Per text, per 100 words, and share of texts with at least one. Counted by "
            "lists of English phrases (docs/statistics.md); corrections include words "
            "said twice over or broken off.",
        ),
    )


def _things(study: InstructionStudy) -> StudyTable:
    names = (
        "landmarks",
        "doors",
        "rooms",
        "ways",
        "floors",
        "unknown_things",
        "distances",
    )
    titles = {each.name: each.title for each in MEASURES}
    rows = [(*_who(group), *_per_text(group, names)) for group in _shown(study)]
    sorts = "; ".join(f"{sort}: {says}" for sort, says in SORTS.items())
    return StudyTable(
        "things",
        "Things named and distances stated, per text",
        ("study", "iter.", "n", *(titles[name] for name in names)),
        tuple(rows),
        2,
        (
            "Each phrase that the parser takes for a thing, once per text, by what of the "
            f"site plan it fits best ({sorts}). Words that the parser misreads end up as "
            "not in the plan.",
            "Distances: legs whose length is stated in metres, steps or time.",
        ),
    )


def _distances(study: InstructionStudy) -> StudyTable:
    rows = [
        (
            each.study,
            each.unit,
            str(each.legs),
            str(each.texts),
            f"{each.median:.2f}",
            f"{each.low:.2f} to {each.high:.2f}",
            f"{each.factor:.2f}",
        )
        for each in study.distances
    ]
    return StudyTable(
        "stated_distances",
        "Stated distances over true ones",
        ("study", "unit", "legs", "texts", "median", "quartiles", "spread factor"),
        tuple(rows),
        2,
        (
            "Legs of texts without errors whose turns, as parsed, are in order those of "
            "the route described. A step counts as 0.7 m, a second as 1 m. Vague: words "
            'such as "directly" or "a few metres", for which the parser takes a fixed '
            "length. Numbers: all but these. "
            "Spread: exponential of the standard deviation of the ratios' logarithms, "
            "lengths misread by the parser included.",
        ),
    )


def _who(group: GroupMeans) -> tuple[str, str, str]:
    return group.study, str(group.iteration or "both"), str(group.texts)


def _shown(study: InstructionStudy) -> list[GroupMeans]:
    return [group for group in study.groups if group.site is None]
