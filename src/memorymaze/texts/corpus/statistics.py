"""Words counted: Table I of the paper for any instructions, and distinct words.

Of distinct words the paper gives counts and no rule. Of the rules here none is chosen
to fit them.
"""

import re
import string
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import nan
from statistics import fmean, median, pstdev
from typing import Literal

import numpy as np

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus.records import Instruction, StudyName
from memorymaze.world.sites.records import Site

WORD = re.compile(r"[a-z']+")
LETTERS = re.compile(r"[a-z]+")
CLOUD_WORD = re.compile(r"\w[\w']+")
AROUND_WORDS = string.punctuation + "\u2018\u2019\u201c\u201d\u2013\u2014\u2026"
FUNCTION_WORDS = frozenset(
    word
    for line in (
        "a an the and or but if then than so as of at by for from in into on onto to",
        "with up down out off over under again is are was were be been being am it its",
        "it's this that these those there here i i'm i'll i've you you'll you're you've",
        "your yours we we'll our he she him her his they them their me my what which",
        "who whom when where why how all any both each few more most other some such no",
        "nor not only own same too very can could will would should shall may might",
        "must do does did doing have has had having don't just also",
    )
    for word in line.split()
)
"""Words that carry grammar rather than meaning, left out by one of the rules."""
SHUFFLES = 20
"""Orders of the texts over which a type-token curve is averaged."""
CURVE_POINTS = 40
LIST_MARKER = re.compile(r"\(?\d+[.):]|[-*\u2022\u2013\u2014]")


@dataclass(frozen=True, slots=True)
class CellStatistics:
    """How one route was described in one iteration of one study (Table I)."""

    study: StudyName
    site: str
    route: str
    iteration: Literal[1, 2]
    route_length: float
    """Of the reference route, metres; nan where the plan marks none."""
    instructions: int
    words_mean: float
    words_median: float
    words_sd: float
    """Standard deviation of the texts at hand (population, division by n)."""
    failure_rate: float
    """Share of texts with at least one significant error."""
    alternative_rate: float
    """Share of texts that describe another way than the reference route."""


def word_count(text: str) -> int:
    """Count the words of a text as it is written.

    Words are what spaces separate; the numbers and dashes of a list do not count.
    The paper gives no rule.

    >>> word_count("1. Turn left, then go 20 m.")
    6
    """
    return sum(not LIST_MARKER.fullmatch(word) for word in text.split())


def describe_corpus(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[CellStatistics]:
    """Return the statistics per study, site, route and iteration, in that order.

    Args:
        instructions: Instructions whose sites and routes exist.
        sites: Sites by name; they say which routes are alternatives.

    Raises:
        InstructionFileError: There are no instructions.
    """
    cells: dict[tuple[str, str, str, int], list[Instruction]] = {}
    for one in instructions:
        key = (one.study, one.site, one.route, one.iteration)
        cells.setdefault(key, []).append(one)
    if not cells:
        raise InstructionFileError("no instructions to describe")
    return [_describe(cells[key], sites) for key in sorted(cells)]


def _describe(cell: list[Instruction], sites: Mapping[str, Site]) -> CellStatistics:
    one = cell[0]
    words = [word_count(instruction.text) for instruction in cell]
    site = sites[one.site]
    alternative = [
        site.find_route(instruction.reference_route).role == "alternative"
        for instruction in cell
    ]
    return CellStatistics(
        study=one.study,
        site=one.site,
        route=one.route,
        iteration=one.iteration,
        route_length=_route_length(site, one.route),
        instructions=len(cell),
        words_mean=fmean(words),
        words_median=median(words),
        words_sd=pstdev(words),
        failure_rate=fmean(bool(instruction.failures) for instruction in cell),
        alternative_rate=fmean(alternative),
    )


def _route_length(site: Site, name: str) -> float:
    references = [
        route
        for route in site.routes
        if route.route == name and route.role == "reference"
    ]
    return references[0].length if references else nan


@dataclass(frozen=True, slots=True)
class CountingRule:
    """A rule by which distinct words are counted."""

    name: str
    says: str
    """The rule in a sentence."""
    tokens: Callable[[str], Sequence[str]]
    """Words of a text, in order."""
    least: int = 1
    """How often a word must occur, over all texts, to count."""


def tokens(text: str) -> list[str]:
    """Return the words of a text: runs of letters and apostrophes, in small letters.

    >>> tokens("It's 20 m, then LEFT.")
    ["it's", 'm', 'then', 'left']
    """
    return WORD.findall(_plain(text))


def _plain(text: str) -> str:
    return text.lower().replace("\u2019", "'")


def _bare(text: str) -> list[str]:
    bare = (word.strip(AROUND_WORDS) for word in _plain(text).split())
    return [word for word in bare if word]


def _meaning(words: Iterable[str]) -> list[str]:
    return [word for word in words if word not in FUNCTION_WORDS]


def _cloud(text: str) -> list[str]:
    words = CLOUD_WORD.findall(_plain(text))
    return _meaning(word.removesuffix("'s") for word in words if not word.isdigit())


COUNTING_RULES = (
    CountingRule(
        "letters",
        "runs of letters and apostrophes, in small letters",
        tokens,
    ),
    CountingRule(
        "as written",
        "what spaces separate, with capitals and punctuation as written",
        str.split,
    ),
    CountingRule(
        "bare",
        "what spaces separate, in small letters, without punctuation around it; "
        "numbers count",
        _bare,
    ),
    CountingRule(
        "only letters",
        "runs of letters, in small letters",
        lambda text: LETTERS.findall(_plain(text)),
    ),
    CountingRule(
        "content",
        'as "letters", without function words (a, the, you, then)',
        lambda text: _meaning(tokens(text)),
    ),
    CountingRule(
        "cloud",
        "as word clouds count: two characters or more, no numbers, no function words",
        _cloud,
    ),
    CountingRule("twice", 'as "letters", words that occur at least twice', tokens, 2),
    CountingRule(
        "three times", 'as "letters", words that occur at least three times', tokens, 3
    ),
)
"""The first is the one that all other figures use."""


def distinct_words(texts: Iterable[str], rule: CountingRule = COUNTING_RULES[0]) -> int:
    """Count the different words in texts.

    >>> distinct_words(["Turn left.", "turn LEFT at the lift"])
    5
    """
    counts = Counter(word for text in texts for word in rule.tokens(text))
    return sum(count >= rule.least for count in counts.values())


@dataclass(frozen=True, slots=True)
class TypeTokenCurve:
    """How many different words the first N words of a corpus hold."""

    tokens: tuple[int, ...]
    """N, rising; the last one is all there are."""
    types: tuple[float, ...]
    """Different words among them, mean over orders of the texts."""

    def at(self, count: int) -> float:
        """Return the different words among the first `count` words, interpolated."""
        return float(np.interp(count, (0, *self.tokens), (0.0, *self.types)))


def type_token_curve(texts: Iterable[str], rng: np.random.Generator) -> TypeTokenCurve:
    """Return the type-token curve of texts, averaged over 20 orders of them.

    Whole texts are put in another order; the words inside stay where they are.

    Args:
        texts: In any order, which changes nothing but the draws.
        rng: Draws the orders.

    Raises:
        ValueError: There is no word.
    """
    words = [tokens(text) for text in texts]
    total = sum(map(len, words))
    if not total:
        raise ValueError("expected texts with at least one word")
    grid = np.unique(
        np.linspace(1, total, min(CURVE_POINTS, total)).round().astype(int)
    )
    types = np.zeros(len(grid))
    for _ in range(SHUFFLES):
        order = rng.permutation(len(words))
        seen: set[str] = set()
        growth: list[int] = []
        for text in order:
            for word in words[text]:
                seen.add(word)
                growth.append(len(seen))
        types += np.array(growth)[grid - 1]
    return TypeTokenCurve(
        tuple(int(n) for n in grid), tuple(float(t) for t in types / SHUFFLES)
    )
