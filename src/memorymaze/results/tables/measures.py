"""What tables show of episodes: quantities, and their means with intervals."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from memorymaze.evaluation.measures import Measure
from memorymaze.evaluation.results import MEASURES, EpisodeResult
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap
from memorymaze.tables import Column, Row

Seen = TypeVar("Seen")
"""What is seen once: an episode, or several that belong together, such as a pair."""

PAPER_MEASURES = tuple(each for each in MEASURES if "paper" in each.shown)
COMPARED_MEASURES = tuple(each for each in MEASURES if "compared" in each.shown)
SPREAD_MEASURES = tuple(each for each in MEASURES if "spread" in each.shown)
EPISODE_MEASURES = tuple(each for each in MEASURES if "episode" in each.shown)
COST_MEASURES = tuple(each for each in MEASURES if "costs" in each.shown)


@dataclass(frozen=True, slots=True)
class Quantity(Generic[Seen]):
    """What the mean is taken of."""

    name: str
    heading: str
    of: Callable[[Seen], float]
    better: Literal["higher", "lower"] | None = "higher"
    digits: int = 2
    signed: bool = False
    """Whether it is shown with its sign, as differences are."""
    about: Row = field(default_factory=dict[str, Any])
    """What else rows say of it, where each quantity has a row."""

    @property
    def column(self) -> Column:
        """Its mean with an interval."""
        return Column(
            self.name,
            self.heading,
            digits=self.digits,
            signed=self.signed,
            interval=ends(self.name),
            better=self.better,
        )


def quantity_of(measure: Measure) -> Quantity[EpisodeResult]:
    """Return a measure of results as what means are taken of."""
    return Quantity(
        measure.name,
        measure.heading,
        lambda each: float(getattr(each, measure.field)),
        measure.better,
        measure.digits,
    )


PAPER_QUANTITIES = tuple(map(quantity_of, PAPER_MEASURES))
SUCCESS: Quantity[EpisodeResult] = Quantity(
    "sr", "SR", lambda each: float(each.success)
)


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
    quantities: Sequence[Quantity[Seen]],
    seen: Sequence[Seen],
    people: Sequence[str],
    cells: Sequence[Hashable] | None = None,
) -> dict[str, Any]:
    """Return the fields of means over cells, such as routes; else over all that was seen."""
    values = [[quantity.of(each) for quantity in quantities] for each in seen]
    found = zip(quantities, mean_estimates(values, people, cells), strict=True)
    fields: dict[str, Any] = {}
    for quantity, estimate in found:
        fields |= estimate_fields(quantity.name, estimate)
    return fields


def estimate_means(cells: Sequence[Sequence[EpisodeResult]]) -> dict[str, Estimate]:
    """Return the means of the paper's measures over cells, with participant-bootstrap intervals.

    The mean is the unweighted mean of the cells' means, as the paper averages over
    routes; for one cell it is the cell's mean. See
    `metrics.aggregate.participant_bootstrap`.

    Args:
        cells: Results that belong together, such as those of one route; none empty.

    Raises:
        ValueError: There is no cell, or one is empty.
    """
    if not cells or not all(cells):
        raise ValueError("expected at least one episode in every cell")
    rows = [(result, number) for number, cell in enumerate(cells) for result in cell]
    estimates = mean_estimates(
        [[each.of(result) for each in PAPER_QUANTITIES] for result, _ in rows],
        [result.participant for result, _ in rows],
        [number for _, number in rows],
    )
    return {
        each.name: found for each, found in zip(PAPER_MEASURES, estimates, strict=True)
    }


def mean_column(measure: Measure, *, plot: bool = False) -> Column:
    """Return a column of means with intervals, which pages may plot from 0 to 1."""
    return replace(quantity_of(measure).column, plot=plot)


def ends(name: str) -> tuple[str, str]:
    """Return the fields of the ends of a value's interval."""
    return f"{name}_low", f"{name}_high"


def estimate_fields(
    name: str, estimate: Estimate | None, interval: tuple[str, str] | None = None
) -> dict[str, Any]:
    """Return the fields of a mean with its interval; None where there is no mean."""
    low, high = interval or ends(name)
    if estimate is None:
        return {name: None}
    return {name: estimate.mean, low: estimate.low, high: estimate.high}
