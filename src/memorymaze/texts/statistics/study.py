"""All that `memorymaze instructions stats` tells of instructions: one list of figures.

CSV writes the figures as they are, one number per row; tables and plots arrange them.
"""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from statistics import fmean
from typing import Any

import numpy as np
from tqdm import tqdm

from memorymaze.basics.tables import Row
from memorymaze.basics.wording import counted
from memorymaze.language.reading import parse_route_description
from memorymaze.texts.corpus.published import published_tables
from memorymaze.texts.corpus.records import WRITTEN_BY, Instruction
from memorymaze.texts.corpus.speech import spoken_marks
from memorymaze.texts.corpus.statistics import (
    COUNTING_RULES,
    TypeTokenCurve,
    describe_corpus,
    distinct_words,
    type_token_curve,
    word_count,
)
from memorymaze.texts.statistics.named_things import (
    SiteNames,
    Sort,
    named_things,
)
from memorymaze.texts.statistics.stated_distances import (
    VAGUE,
    StatedDistance,
    by_unit,
    stated_distances,
    summarise_distances,
)
from memorymaze.world.sites.records import Site

IN_PLAN: tuple[Sort, ...] = ("landmark", "door", "room", "way")
ALL_SITES, BOTH_ITERATIONS = "all", "both"


@dataclass(frozen=True, slots=True)
class Figure:
    """One number, and what it is about."""

    table: str
    study: str
    measure: str
    value: float
    place: str = ""
    """A site, a building of several, or `all`."""
    route: str = ""
    iteration: int | str = ""
    """1, 2 or `both`."""
    key: str | int = ""
    """What else it is about: a counting rule, a unit, a number of words."""
    published: float | None = None
    """In the paper, on texts by people."""


@dataclass(frozen=True, slots=True)
class TextMeasures:
    """What was counted in one text."""

    instruction: Instruction
    words: int
    counts: Mapping[str, int]
    """Marks of speech, things named, and legs whose length is stated in numbers."""
    distances: tuple[StatedDistance, ...]
    """Stated lengths of legs whose true length is known."""


@dataclass(frozen=True, slots=True)
class InstructionStudy:
    """Statistics of instructions."""

    instructions: tuple[Instruction, ...]
    written: tuple[str, ...]
    """Who wrote the texts, one sentence per source."""
    figures: tuple[Figure, ...]
    texts: tuple[TextMeasures, ...]
    curves: Mapping[tuple[str, str], TypeTokenCurve]
    """By study and place."""

    @property
    def equal_words(self) -> int:
        """The number of words that the smallest vocabulary's texts have, 0 for none."""
        words = (row["words"] for row in self.rows("distinct_words", "study", "place"))
        return int(min(words, default=0))

    def rows(self, table: str, *about: str, **only: str) -> list[Row]:
        """Arrange the figures of a table as rows, `only` those whose fields have values.

        What the rows are about stands in the fields of `about`. All other figures are
        values, named by measure and key: `words`, `hedges mean`. Published figures stand
        beside them: `words_mean published`.
        """
        rows: dict[tuple[Any, ...], dict[str, Any]] = {}
        for each in self.figures:
            if each.table != table:
                continue
            if any(getattr(each, field) != value for field, value in only.items()):
                continue
            labels = {field: getattr(each, field) for field in about}
            row = rows.setdefault(tuple(labels.values()), labels)
            key = "" if "key" in about else str(each.key)
            name = f"{each.measure} {key}".strip()
            row[name] = each.value
            row[f"{name} published"] = each.published
        return list(rows.values())


def study_instructions(
    instructions: Sequence[Instruction], sites: Mapping[str, Site], *, seed: int = 0
) -> InstructionStudy:
    """Compute all statistics, with a progress bar on a terminal's stderr.

    Args:
        instructions: Instructions whose sites and routes exist.
        sites: Sites by name.
        seed: Of the orders of texts behind type-token curves.

    Raises:
        InstructionFileError: There are no instructions.
    """
    cells = [*_cells(instructions, sites)]
    names = {each.site: SiteNames(sites[each.site]) for each in instructions}
    texts = tuple(
        measure_text(each, names[each.site])
        for each in tqdm(
            instructions, "reading", unit="text", disable=None, leave=False
        )
    )
    counts = Counter(each.source for each in instructions)
    vocabularies = _vocabularies(instructions)
    curves = {
        about: type_token_curve(told, np.random.default_rng(seed))
        for about, told in vocabularies.items()
    }
    return InstructionStudy(
        instructions=tuple(instructions),
        written=tuple(
            f"{counted(number, 'text')} written by {WRITTEN_BY[source]}."
            for source, number in sorted(counts.items())
        ),
        figures=(
            *cells,
            *_words(vocabularies, curves),
            *_per_text(texts),
            *_distances(leg for text in texts for leg in text.distances),
        ),
        texts=texts,
        curves=curves,
    )


def measure_text(instruction: Instruction, names: SiteNames) -> TextMeasures:
    """Count in one text."""
    plan = parse_route_description(instruction.text)
    marks = Counter(mark.kind for mark in spoken_marks(instruction.text))
    named = named_things(plan, names)
    lengths = [each.length for each in (*plan.legs, plan.arrival)]
    stated = sum(each is not None and each.unit != VAGUE for each in lengths)
    return TextMeasures(
        instruction,
        word_count(instruction.text),
        {
            "hedges": marks["hedge"],
            "fillers": marks["filler"],
            "corrections": marks["correction"],
            "things_in_plan": sum(named[sort] for sort in IN_PLAN),
            "landmarks": named["landmark"],
            "doors": named["door"],
            "rooms": named["room"],
            "ways": named["way"],
            "floors": named["floor"],
            "unknown_things": named["unknown"],
            "distances": stated,
        },
        tuple(stated_distances(instruction, plan, names.site)),
    )


def _cells(
    instructions: Sequence[Instruction], sites: Mapping[str, Site]
) -> Iterator[Figure]:
    """Yield the figures of Table I."""
    published = {
        (row.study, row.site, row.route, row.iteration): row
        for row in published_tables().descriptions
    }
    for cell in describe_corpus(instructions, sites):
        about = (cell.study, cell.site, cell.route, cell.iteration)
        paper = published.get(about)
        for name, value in asdict(cell).items():
            if name in {"study", "site", "route", "iteration"} or math.isnan(value):
                continue
            yield Figure(
                "table_1",
                cell.study,
                name,
                value,
                cell.site,
                cell.route,
                cell.iteration,
                published=getattr(paper, name, None),
            )


def _vocabularies(
    instructions: Sequence[Instruction],
) -> dict[tuple[str, str], list[str]]:
    """Return texts by study and site, and by building where the paper takes several."""
    groups: dict[tuple[str, str], list[str]] = {}
    for each in instructions:
        groups.setdefault((each.study, each.site), []).append(each.text)
    for building, study in published_tables().distinct_words:
        parts = [
            site
            for kind, site in groups
            if kind == study and site.startswith(f"{building}_")
        ]
        if len(parts) > 1:
            groups[study, building] = [
                each.text
                for each in instructions
                if each.study == study and each.site in parts
            ]
    return {
        about: texts
        for about, texts in sorted(groups.items())
        if any(COUNTING_RULES[0].tokens(text) for text in texts)
    }


def _words(
    vocabularies: Mapping[tuple[str, str], Sequence[str]],
    curves: Mapping[tuple[str, str], TypeTokenCurve],
) -> Iterator[Figure]:
    published = published_tables().distinct_words
    words = {
        about: sum(len(COUNTING_RULES[0].tokens(text)) for text in texts)
        for about, texts in vocabularies.items()
    }
    for (study, place), texts in vocabularies.items():
        about, curve = (study, place), curves[study, place]
        table = "distinct_words"
        yield Figure(table, study, "texts", len(texts), place)
        yield Figure(table, study, "words", words[about], place)
        for rule in COUNTING_RULES:
            count = distinct_words(texts, rule)
            paper = published.get((place, study))
            yield Figure(
                table, study, table, count, place, key=rule.name, published=paper
            )
        equal = curve.at(min(words.values()))
        yield Figure(table, study, table, equal, place, key="among equally many words")
        for tokens, types in zip(curve.tokens, curve.types, strict=True):
            yield Figure("type_token_curve", study, table, types, place, key=tokens)


def _per_text(texts: Iterable[TextMeasures]) -> Iterator[Figure]:
    """Yield means per study, site and iteration; first over all sites."""
    groups: dict[tuple[str, str, int], list[TextMeasures]] = {}
    for each in texts:
        told = each.instruction
        for site in ("", told.site):
            for iteration in (0, told.iteration):
                groups.setdefault((told.study, site, iteration), []).append(each)
    for study, site, iteration in sorted(groups):
        group = groups[study, site, iteration]
        words = fmean(text.words for text in group)
        figure = partial(
            Figure,
            "per_text",
            study,
            place=site or ALL_SITES,
            iteration=iteration or BOTH_ITERATIONS,
        )
        yield figure("texts", len(group))
        yield figure("words", words, key="mean")
        for name in group[0].counts:
            found = [text.counts[name] for text in group]
            share = fmean(number > 0 for number in found)
            rate = 100 * fmean(found) / max(words, 1)
            yield figure(name, fmean(found), key="mean")
            yield figure(name, share, key="share of texts")
            yield figure(name, rate, key="per 100 words")


def _distances(legs: Iterable[StatedDistance]) -> Iterator[Figure]:
    for (study, unit), told in by_unit(legs).items():
        for name, value in summarise_distances(told).items():
            yield Figure("stated_distances", study, name, value, key=unit)
