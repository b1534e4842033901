"""All that `memorymaze instructions stats` tells of instructions, in one record."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from tqdm import tqdm

from memorymaze.instructions.published import published_tables
from memorymaze.instructions.records import WRITTEN_BY, Instruction
from memorymaze.instructions.statistics import (
    COUNTING_RULES,
    CellStatistics,
    TypeTokenCurve,
    describe_corpus,
    distinct_words,
    type_token_curve,
)
from memorymaze.results.instruction_study.named_things import SiteNames
from memorymaze.results.instruction_study.stated_distances import (
    DistanceSummary,
    summarise_distances,
)
from memorymaze.results.instruction_study.text_measures import (
    GroupMeans,
    TextMeasures,
    group_means,
    measure_text,
)
from memorymaze.sites.records import Site


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """The words of one study about one site, or one building of several sites."""

    study: str
    place: str
    """Name of a site, or of a building that the paper counts as one."""
    texts: int
    words: int
    """By the first counting rule."""
    distinct: Mapping[str, int]
    """Distinct words by the names of the counting rules."""
    published: int | None
    """Distinct words in the paper, which gives no rule."""
    curve: TypeTokenCurve


@dataclass(frozen=True, slots=True)
class InstructionStudy:
    """Statistics of instructions."""

    instructions: tuple[Instruction, ...]
    written: tuple[str, ...]
    """Who wrote the texts, one sentence per source."""
    cells: tuple[CellStatistics, ...]
    """Table I."""
    vocabularies: tuple[Vocabulary, ...]
    texts: tuple[TextMeasures, ...]
    groups: tuple[GroupMeans, ...]
    distances: tuple[DistanceSummary, ...]

    @property
    def equal_words(self) -> int:
        """The number of words that the smallest vocabulary's texts have, 0 for none."""
        return min((each.words for each in self.vocabularies), default=0)

    def rule_misses(self) -> dict[str, float | None]:
        """Return for each counting rule how far it is from the published counts.

        The mean over studies and buildings of |counted / published - 1|; None where
        there is nothing to compare.
        """
        compared = [each for each in self.vocabularies if each.published]
        misses: dict[str, float | None] = {}
        for rule in COUNTING_RULES:
            off = [
                abs(each.distinct[rule.name] / each.published - 1)
                for each in compared
                if each.published
            ]
            misses[rule.name] = sum(off) / len(off) if off else None
        return misses


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
    cells = describe_corpus(instructions, sites)
    names = {each.site: SiteNames(sites[each.site]) for each in instructions}
    texts = tuple(
        measure_text(each, names[each.site])
        for each in tqdm(
            instructions, "reading", unit="text", disable=None, leave=False
        )
    )
    counts = Counter(each.source for each in instructions)
    return InstructionStudy(
        instructions=tuple(instructions),
        written=tuple(
            f"{number} {'text' if number == 1 else 'texts'} written by "
            f"{WRITTEN_BY[source]}."
            for source, number in sorted(counts.items())
        ),
        cells=tuple(cells),
        vocabularies=tuple(_vocabularies(instructions, seed)),
        texts=texts,
        groups=tuple(group_means(texts)),
        distances=tuple(
            summarise_distances(leg for text in texts for leg in text.distances)
        ),
    )


def _vocabularies(
    instructions: Iterable[Instruction], seed: int
) -> Iterator[Vocabulary]:
    groups: dict[tuple[str, str], list[str]] = {}
    told = list(instructions)
    published = published_tables().distinct_words
    for each in told:
        groups.setdefault((each.study, each.site), []).append(each.text)
    for building, study in published:
        sites = {site for kind, site in groups if kind == study}
        if (
            len(parts := [site for site in sites if site.startswith(f"{building}_")])
            > 1
        ):
            groups[study, building] = [
                each.text for each in told if each.study == study and each.site in parts
            ]
    rule = COUNTING_RULES[0]
    for (study, place), texts in sorted(groups.items()):
        words = sum(len(rule.tokens(text)) for text in texts)
        if words == 0:
            continue
        yield Vocabulary(
            study=study,
            place=place,
            texts=len(texts),
            words=words,
            distinct={
                each.name: distinct_words(texts, each) for each in COUNTING_RULES
            },
            published=published.get((place, study)),
            curve=type_token_curve(texts, np.random.default_rng(seed)),
        )
