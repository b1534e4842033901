"""The numbers of a whole run, for `summary.json`, tables and what is said of it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from statistics import fmean
from typing import Any

from memorymaze.evaluation.results import MEASURES, EpisodeResult
from memorymaze.evaluation.settings import RunDefinition

PER_DISTANCE = ("collisions", "person_collisions", "near_misses")
"""Counts that are told per 100 m driven."""


@dataclass(frozen=True, slots=True)
class CollisionRates:
    """Rates over some episodes."""

    collisions: float
    """Per 100 m driven, with people as well."""
    person_collisions: float
    """Of those the ones with people, per 100 m driven."""
    near_misses: float
    """Per 100 m driven."""
    waiting_s: float
    """Simulated seconds of waiting for people, mean over episodes."""


def summarise(
    results: Sequence[EpisodeResult], settings: RunDefinition
) -> dict[str, Any]:
    """Return counts, means and sums over all results, and per study and route.

    The means are over episodes; the tables' means over routes are another thing.
    """
    cells: dict[tuple[str, str, str], list[EpisodeResult]] = {}
    for result in results:
        key = (result.study, result.site, result.route)
        cells.setdefault(key, []).append(result)
    return {
        "track": settings.track,
        "turning_points": settings.simulation.turning_points,
        "detector": str(settings.detector),
        "signs": settings.signs,
        "episodes": len(results),
        "episodes_missing": settings.episodes - len(results),
        "instructions_written_by": dict(Counter(r.source for r in results)),
        "stopped_by": dict(Counter(r.stopped_by for r in results)),
        "errors": dict(Counter(r.error for r in results if r.error).most_common()),
        "mean": _means(results),
        "safety": asdict(collision_rates(results)),
        "sum": {
            each.field: sum(getattr(r, each.field) for r in results)
            for each in MEASURES
            if each.is_amount
        },
        "by_study_and_route": [
            {
                "study": study,
                "site": site,
                "route": route,
                "episodes": len(cell),
                "mean": _means(cell),
            }
            for (study, site, route), cell in sorted(cells.items())
        ],
    }


def _means(results: Sequence[EpisodeResult]) -> dict[str, float | None]:
    """Return the mean of every measure; None for one that not all results have."""
    if not results:
        raise ValueError("expected at least one result")
    means: dict[str, float | None] = {}
    for measure in MEASURES:
        values = [getattr(result, measure.field) for result in results]
        means[measure.field] = None if None in values else fmean(values)
    return means


def collision_rates(results: Sequence[EpisodeResult]) -> CollisionRates:
    """Return how safe episodes were; rates are sums over sums, and 0 without driving."""
    if not results:
        raise ValueError("expected at least one result")
    driven = sum(each.path_length for each in results)
    rates = [
        100 * sum(getattr(each, name) for each in results) / driven if driven else 0.0
        for name in PER_DISTANCE
    ]
    return CollisionRates(*rates, waiting_s=fmean(each.waiting_s for each in results))
