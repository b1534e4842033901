"""What is counted in each text, and its means over groups of texts."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean

from memorymaze.instructions.records import Instruction
from memorymaze.instructions.speech import spoken_marks
from memorymaze.instructions.statistics import word_count
from memorymaze.results.instruction_study.named_things import SiteNames, named_things
from memorymaze.results.instruction_study.stated_distances import (
    VAGUE,
    StatedDistance,
    stated_distances,
)
from memorymaze.understanding import parse_route_description

IN_PLAN = ("landmark", "door", "room", "way")


@dataclass(frozen=True)
class TextMeasures:
    """What was counted in one text."""

    instruction: Instruction
    words: int
    marks: Mapping[str, int]
    """Number of hedges, fillers and corrections, by kind."""
    named: Mapping[str, int]
    """Number of things named, by what of the building they are."""
    lengths: int
    """Legs whose length is stated in numbers."""
    distances: tuple[StatedDistance, ...]
    """Those of them whose true length is known."""


@dataclass(frozen=True, slots=True)
class Measure:
    """Something counted per text."""

    name: str
    title: str
    of: Callable[[TextMeasures], int]


MEASURES = (
    Measure("hedges", "hedges", lambda text: text.marks["hedge"]),
    Measure("fillers", "fillers", lambda text: text.marks["filler"]),
    Measure("corrections", "corrections", lambda text: text.marks["correction"]),
    Measure(
        "things_in_plan",
        "things in the plan",
        lambda text: sum(text.named[sort] for sort in IN_PLAN),
    ),
    Measure("landmarks", "landmarks", lambda text: text.named["landmark"]),
    Measure("doors", "doors", lambda text: text.named["door"]),
    Measure("rooms", "rooms", lambda text: text.named["room"]),
    Measure("ways", "hallways", lambda text: text.named["way"]),
    Measure("floors", "floors", lambda text: text.named["floor"]),
    Measure("unknown_things", "not in the plan", lambda text: text.named["unknown"]),
    Measure("distances", "distances", lambda text: text.lengths),
)


@dataclass(frozen=True, slots=True)
class GroupMeans:
    """Means per text over a group of texts."""

    study: str
    site: str | None
    """None for all sites together."""
    iteration: int | None
    """None for both together."""
    texts: int
    words: float
    """Mean per text."""
    means: Mapping[str, float]
    """By the names of `MEASURES`."""
    shares: Mapping[str, float]
    """Share of the texts that have at least one."""


def measure_text(instruction: Instruction, names: SiteNames) -> TextMeasures:
    """Count in one text."""
    plan = parse_route_description(instruction.text)
    lengths = [each.length for each in (*plan.legs, plan.arrival)]
    return TextMeasures(
        instruction,
        word_count(instruction.text),
        Counter(mark.kind for mark in spoken_marks(instruction.text)),
        Counter(thing.sort for thing in named_things(plan, names)),
        sum(length is not None and length.unit != VAGUE for length in lengths),
        tuple(stated_distances(instruction, plan, names.site)),
    )


def group_means(texts: Iterable[TextMeasures]) -> list[GroupMeans]:
    """Return means per study, iteration and site; first over all sites."""
    groups: dict[tuple[str, str, int], list[TextMeasures]] = {}
    for each in texts:
        told = each.instruction
        for site in ("", told.site):
            for iteration in (0, told.iteration):
                groups.setdefault((told.study, site, iteration), []).append(each)
    return [_means(*key, groups[key]) for key in sorted(groups)]


def _means(
    study: str, site: str, iteration: int, texts: Sequence[TextMeasures]
) -> GroupMeans:
    counts = {each.name: [each.of(text) for text in texts] for each in MEASURES}
    return GroupMeans(
        study=study,
        site=site or None,
        iteration=iteration or None,
        texts=len(texts),
        words=fmean(text.words for text in texts),
        means={name: fmean(found) for name, found in counts.items()},
        shares={name: fmean(n > 0 for n in found) for name, found in counts.items()},
    )
