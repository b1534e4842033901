"""Table I of the paper for any instructions: lengths, failures, alternative ways."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import nan
from statistics import fmean, median, pstdev
from typing import Literal

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.records import Instruction
from memorymaze.sites.records import Site

LIST_MARKER = re.compile(r"\(?\d+[.):]|[-*\u2022\u2013\u2014]")


@dataclass(frozen=True, slots=True)
class CellStatistics:
    """How one route was described in one iteration of one study (Table I)."""

    study: Literal["online", "onsite", "sail"]
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
        site.route(instruction.reference_route).role == "alternative"
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
