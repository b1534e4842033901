"""The numbers of a whole run, for `summary.json`, tables and what is said of it."""

from collections import Counter
from collections.abc import Sequence
from statistics import fmean
from typing import Any

from memorymaze.runs.episodes.results import MEASURES, EpisodeResult
from memorymaze.runs.episodes.settings import RunDefinition

PER_DISTANCE = ("collisions", "person_collisions", "near_misses")
"""Counts that are told per 100 m driven."""


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
        "noise": None if settings.noise is None else str(settings.noise),
        "detector": str(settings.detector),
        "signs": settings.signs,
        "episodes": len(results),
        "episodes_missing": settings.episodes - len(results),
        "instructions_written_by": dict(Counter(r.source for r in results)),
        "stopped_by": dict(Counter(r.stopped_by for r in results)),
        "errors": dict(Counter(r.error for r in results if r.error).most_common()),
        "mean": _means(results),
        "safety": collision_rates(results),
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


def collision_rates(results: Sequence[EpisodeResult]) -> dict[str, float]:
    """Return how safe episodes were: `PER_DISTANCE`, with people as well, and of those with.

    Rates are sums over sums, and 0 without driving; `waiting_s` for people is the mean over
    episodes.
    """
    if not results:
        raise ValueError("expected at least one result")
    driven = sum(each.path_length for each in results)
    rates = {
        name: 100 * sum(getattr(r, name) for r in results) / driven if driven else 0.0
        for name in PER_DISTANCE
    }
    return rates | {"waiting_s": fmean(each.waiting_s for each in results)}
