"""What tables show of episodes: quantities, and their means with intervals."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.basics.tables import Column, Row
from memorymaze.runs.episodes.results import MEASURES, EpisodeResult, Measure
from memorymaze.runs.metrics.aggregate import Estimate, participant_bootstrap

Pair = tuple[EpisodeResult, EpisodeResult]
"""What came of an episode in two runs, or of two texts that belong together."""
Pairs = Sequence[Pair]

PAPER_MEASURES = tuple(each for each in MEASURES if "paper" in each.shown)
SPREAD_MEASURES = tuple(each for each in MEASURES if "spread" in each.shown)
EPISODE_MEASURES = tuple(each for each in MEASURES if "episode" in each.shown)
COST_MEASURES = tuple(each for each in MEASURES if "costs" in each.shown)


@dataclass(frozen=True, slots=True)
class Fact(Column):
    """A column that is worked out from all that a row is about."""

    of: Callable[[Sequence[Any]], Any] = field(kw_only=True)


@dataclass(frozen=True, slots=True)
class Quantity(Column):
    """A column of means with their intervals."""

    digits: int | None = 2
    better: Literal["higher", "lower"] | None = "higher"
    of: Callable[[Any], float] = field(kw_only=True)
    """What the mean is taken of: of an episode, or of several that belong together, such as
    a pair."""
    about: Row = field(default_factory=dict[str, Any], kw_only=True)
    """What else rows say of it, where each quantity has a row."""

    def __post_init__(self) -> None:
        """Name the fields of the interval's ends."""
        ends = (f"{self.name}_low", f"{self.name}_high")
        object.__setattr__(self, "interval", ends)


@dataclass(frozen=True, slots=True)
class Gain(Quantity):
    """A column of means of differences, which are shown with their sign."""

    better: Literal["higher", "lower"] | None = None
    signed: bool = True


def quantity_of(measure: Measure) -> Quantity:
    """Return a measure of results as what means are taken of."""
    return Quantity(
        measure.name,
        measure.heading,
        digits=measure.digits,
        better=measure.better,
        of=lambda each: float(getattr(each, measure.field)),
    )


PAPER_QUANTITIES = tuple(map(quantity_of, PAPER_MEASURES))
COMPARED_QUANTITIES = tuple(
    quantity_of(each) for each in MEASURES if "compared" in each.shown
)
SUCCESS = Quantity("sr", "SR", of=lambda each: float(each.success))
EPISODES = Fact("episodes", "n", of=len)


def participant_of(result: EpisodeResult) -> str:
    """Return who gave the instruction: the unit that intervals draw."""
    return result.participant


def mean_estimates(
    values: ArrayLike,
    people: Sequence[str],
    cells: Sequence[Hashable] | None = None,
    rng: np.random.Generator | None = None,
) -> list[Estimate]:
    """Return means with intervals, a column each; all that tables show are drawn here.

    They hold 95 % of 10,000 draws, from the same seed for every table.
    """
    rng = rng or np.random.default_rng(0)
    return participant_bootstrap(values, people, rng, cells=cells)


def mean_fields(
    quantities: Sequence[Quantity],
    seen: Sequence[Any],
    people: Sequence[str],
    cells: Sequence[Hashable] | None = None,
) -> dict[str, Any]:
    """Return the fields of means over cells, such as routes; else over all that was seen."""
    values = [[quantity.of(each) for quantity in quantities] for each in seen]
    found = zip(quantities, mean_estimates(values, people, cells), strict=True)
    fields: dict[str, Any] = {}
    for quantity, estimate in found:
        fields |= estimate_fields(estimate, *quantity.fields)
    return fields


def estimate_fields(
    estimate: Estimate, name: str, low: str, high: str
) -> dict[str, Any]:
    """Return the fields of a mean with the ends of its interval."""
    return {name: estimate.mean, low: estimate.low, high: estimate.high}
