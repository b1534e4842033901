"""How tables show the measures of results, and their means with intervals."""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from memorymaze.evaluation.measures import Measure
from memorymaze.evaluation.results import MEASURES, EpisodeResult
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap
from memorymaze.tables import Column, Table

PAPER_MEASURES = tuple(each for each in MEASURES if "paper" in each.shown)
COMPARED_MEASURES = tuple(each for each in MEASURES if "compared" in each.shown)
SPREAD_MEASURES = tuple(each for each in MEASURES if "spread" in each.shown)
EPISODE_MEASURES = tuple(each for each in MEASURES if "episode" in each.shown)
COST_MEASURES = tuple(each for each in MEASURES if "costs" in each.shown)

KEY = (
    ", ".join(f"{each.short} {each.meaning}" for each in PAPER_MEASURES)
    + "; [95 % interval], bootstrap over participants. The mean over routes is "
    'unweighted. Rows that begin with "paper" are published figures on human '
    "instructions."
)

NO_INTERVAL = {
    "(too few)": "too few: fewer than two participants on the same routes (SAIL: fewer "
    "than two paragraphs), so no interval can be told and no test made.",
    "(all equal)": "all equal: every value is the same, so the bootstrap finds no "
    "spread; that does not make it certain.",
}
"""What stands in cells instead of an interval, and what it means."""


@dataclass(frozen=True, slots=True)
class EpisodeValue:
    """What a column shows the mean of, where that is no measure of results."""

    name: str
    heading: str
    of: Callable[[EpisodeResult], float]
    better: Literal["higher", "lower"] | None = "higher"

    @property
    def column(self) -> Column:
        """Its mean with an interval."""
        return Column(
            self.name,
            self.heading,
            digits=2,
            interval=ends(self.name),
            better=self.better,
        )


SUCCESS = EpisodeValue("sr", "SR", lambda each: float(each.success))


def with_interval_notes(table: Table) -> Table:
    """Return a table that explains what stands in its cells instead of intervals."""
    cells = [column.cell(row) for column in table.columns for row in table.rows]
    found = [
        note
        for words, note in NO_INTERVAL.items()
        if any(cell.endswith(words) for cell in cells)
    ]
    return replace(table, notes=(*table.notes, *found))


def estimate_means(cells: Sequence[Sequence[EpisodeResult]]) -> dict[str, Estimate]:
    """Return the means of the paper's measures over cells, with participant-bootstrap intervals.

    The mean is the unweighted mean of the cells' means, as the paper averages over
    routes; for one cell it is the cell's mean. The intervals hold 95 % of 10,000 draws;
    see `metrics.aggregate.participant_bootstrap`.

    Args:
        cells: Results that belong together, such as those of one route; none empty.

    Raises:
        ValueError: There is no cell, or one is empty.
    """
    if not cells or not all(cells):
        raise ValueError("expected at least one episode in every cell")
    rows = [(result, number) for number, cell in enumerate(cells) for result in cell]
    estimates = participant_bootstrap(
        [values_of(result, PAPER_MEASURES) for result, _ in rows],
        [result.participant for result, _ in rows],
        np.random.default_rng(0),
        cells=[number for _, number in rows],
    )
    return {
        each.name: found for each, found in zip(PAPER_MEASURES, estimates, strict=True)
    }


def value_fields(
    results: Sequence[EpisodeResult],
    values: Sequence[EpisodeValue],
    cells: Sequence[Hashable] | None = None,
) -> dict[str, Any]:
    """Return the fields of means over cells, such as routes; without them over episodes."""
    estimates = participant_bootstrap(
        [[value.of(result) for value in values] for result in results],
        [result.participant for result in results],
        np.random.default_rng(0),
        cells=cells,
    )
    fields: dict[str, Any] = {}
    for value, found in zip(values, estimates, strict=True):
        fields |= estimate_fields(value.name, found)
    return fields


def values_of(result: EpisodeResult, measures: Sequence[Measure]) -> list[float]:
    """Return what measures are worth for an episode."""
    return [float(getattr(result, each.field)) for each in measures]


def mean_column(measure: Measure, *, plot: bool = False) -> Column:
    """Return a column of means with intervals, which pages may plot from 0 to 1."""
    return Column(
        measure.name,
        measure.heading,
        digits=measure.digits,
        interval=ends(measure.name),
        better=measure.better,
        plot=plot,
    )


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


def means_fields(means: Mapping[str, Estimate]) -> dict[str, Any]:
    """Return the fields of means by the names of their measures."""
    fields: dict[str, Any] = {}
    for measure in PAPER_MEASURES:
        fields |= estimate_fields(measure.name, means[measure.name])
    return fields
