"""How measures are spread over episodes, as numbers and as bars."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean

import numpy as np

from memorymaze.results.report.sources import ReportRun


@dataclass(frozen=True, slots=True)
class Measure:
    """Something measured of every episode."""

    field: str
    """Of `EpisodeResult`."""
    title: str
    unit: str
    """Empty where it has none."""
    digits: int


MEASURES = (
    Measure("spd", "SPD: shortest walk left to the goal", "m", 1),
    Measure("path_length", "Path length", "m", 1),
    Measure("cls", "CLS: coverage weighted by length", "", 2),
    Measure("duration_s", "Duration, simulated", "s", 0),
)
BARS = 20


@dataclass(frozen=True, slots=True)
class Spread:
    """A measure in one run and study."""

    run: ReportRun
    study: str
    episodes: int
    mean: float
    quantiles: tuple[float, ...]
    """Least, lower quartile, median, upper quartile, greatest."""
    edges: tuple[float, ...]
    """Of the bars; the same for every run and study of a measure."""
    counts: tuple[int, ...]
    """Episodes per bar."""
    highest: int
    """Greatest count of any bar of the measure, for a common scale."""


def spreads(runs: Sequence[ReportRun], measure: Measure) -> list[Spread]:
    """Return how a measure is spread: for every study, run by run."""
    cells: dict[tuple[str, int], list[float]] = {}
    for number, run in enumerate(runs):
        for result in run.measured.results:
            value = float(getattr(result, measure.field))
            cells.setdefault((result.study, number), []).append(value)
    values = [value for cell in cells.values() for value in cell]
    edges = _edges(min(values), max(values))
    counted = {key: np.histogram(cell, edges)[0] for key, cell in cells.items()}
    highest = max(int(count.max()) for count in counted.values())
    found: list[Spread] = []
    for (study, number), cell in sorted(cells.items()):
        found.append(
            Spread(
                run=runs[number],
                study=study,
                episodes=len(cell),
                mean=fmean(cell),
                quantiles=tuple(np.quantile(cell, [0, 0.25, 0.5, 0.75, 1]).tolist()),
                edges=tuple(edges),
                counts=tuple(map(int, counted[study, number])),
                highest=highest,
            )
        )
    return found


def _edges(low: float, high: float) -> list[float]:
    """Return edges at round numbers, about `BARS` of them, that hold low and high."""
    low = min(low, 0.0)
    rough = max(high - low, 1e-6) / BARS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(
        factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= rough
    )
    first, last = math.floor(low / step), max(math.ceil(high / step), 1)
    return [number * step for number in range(first, last + 1)]
