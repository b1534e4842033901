"""The numbers of a whole run, for `summary.json` and the end of `evaluate`."""

from collections import Counter
from collections.abc import Sequence
from statistics import fmean
from typing import Any

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.settings import RunSettings

__all__ = ["summarise"]

MEANS = (
    "success",
    "oracle_success",
    "spd",
    "cls",
    "spl",
    "ndtw",
    "sdtw",
    "path_length",
    "collisions",
    "turns_in_order",
    "duration_s",
    "wall_s",
)
SUMS = ("collisions", "model_calls", "tokens", "cost_usd", "duration_s", "wall_s")


def summarise(
    results: Sequence[EpisodeResult], settings: RunSettings
) -> dict[str, Any]:
    """Return counts, means and sums over all results, and per study and route.

    The means are over episodes; the tables' means over routes are another thing.

    Args:
        results: At least one.
        settings: Of the run.

    Raises:
        ValueError: There are no results.
    """
    cells: dict[tuple[str, str, str], list[EpisodeResult]] = {}
    for result in results:
        key = (result.study, result.site, result.route)
        cells.setdefault(key, []).append(result)
    return {
        "episodes": len(results),
        "episodes_missing": settings.episodes - len(results),
        "instructions_written_by": dict(Counter(r.source for r in results)),
        "stopped_by": dict(Counter(r.stopped_by for r in results)),
        "mean": _means(results),
        "sum": {name: sum(getattr(r, name) for r in results) for name in SUMS},
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


def _means(results: Sequence[EpisodeResult]) -> dict[str, float]:
    if not results:
        raise ValueError("expected at least one result")
    return {name: fmean(getattr(r, name) for r in results) for name in MEANS}
