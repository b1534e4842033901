"""The numbers of a whole run, for `summary.json` and the end of `evaluate`."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from statistics import fmean
from typing import Any

from memorymaze.evaluation.collision_rates import collision_rates
from memorymaze.evaluation.results import MEASURES, EpisodeResult
from memorymaze.evaluation.settings import RunDefinition
from memorymaze.instructions.records import WRITTEN_BY
from memorymaze.wording import counted


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


def summary_lines(summary: dict[str, Any]) -> list[str]:
    """Say the main numbers of a summary in a few lines."""
    mean, total = summary["mean"], summary["sum"]
    written = ", ".join(
        f"{count if index else counted(count, 'instruction')} written by "
        f"{WRITTEN_BY[source]}"
        for index, (source, count) in enumerate(
            summary["instructions_written_by"].items()
        )
    )
    ends = ", ".join(f"{how} {n}" for how, n in summary["stopped_by"].items())
    lines = [
        f"{counted(summary['episodes'], 'episode')}; {written}",
        f"success {mean['success']:.3f}, oracle success {mean['oracle_success']:.3f}, "
        f"SPD {mean['spd']:.2f} m, CLS {mean['cls']:.3f} (means over episodes)",
        f"stopped by: {ends}; collisions: {total['collisions']}",
    ]
    if total["refused_turns"]:
        lines.append(
            f"{counted(total['refused_turns'], 'turn')} refused: no way lay in that "
            "direction, or it was none (calls of turn with turned false, in the traces)"
        )
    if summary["errors"]:
        error, count = next(iter(summary["errors"].items()))
        failed = sum(summary["errors"].values())
        lines.append(f"{failed} ended with an error, {count} of them with: {error}")
    if summary["turning_points"] == "lidar":
        lines.append("turning points by LiDAR, not from the site plan")
    if summary["detector"] != "truth":
        lines.append(
            f"detector {summary['detector']}, not the one that knows the truth"
        )
    if summary["signs"] != "truth":
        lines.append(f"signs read by {summary['signs'].upper()} from pictures")
    if summary["track"] != "default":
        rates = summary["safety"]
        lines.append(
            f"with obstacles, per 100 m driven: {rates['collisions']:.3f} collisions, "
            f"{rates['person_collisions']:.3f} of them with people, "
            f"{rates['near_misses']:.2f} near misses; waiting "
            f"{rates['waiting_s']:.1f} s per episode"
        )
    if summary["track"] == "people":
        lines.append(
            f"passers-by: {counted(total['questions'], 'question')} answered, "
            f"{total['wrong_answers']} of them wrongly, {total['asked_in_vain']} put to "
            f"nobody; strangers stand {mean['strangers_s']:.1f} s per episode"
        )
    if total["strangers_tokens"]:
        lines.append(
            "passers-by's words by a language model: "
            f"{counted(total['strangers_tokens'], 'token')}, "
            f"{total['strangers_cost_usd']:.4f} USD, apart from the agent's"
        )
    if total["model_calls"]:
        lines.append(
            f"language model: {counted(total['model_calls'], 'call')}, "
            f"{counted(total['tokens'], 'token')}, "
            f"{total['cost_usd']:.4f} USD, {total['inference_s']:.1f} s of inference; the "
            f"user stands waiting {mean['standing_s']:.1f} s per episode"
        )
    return lines


def _means(results: Sequence[EpisodeResult]) -> dict[str, float | None]:
    """Return the mean of every measure; None for one that not all results have."""
    if not results:
        raise ValueError("expected at least one result")
    means: dict[str, float | None] = {}
    for measure in MEASURES:
        values = [getattr(result, measure.field) for result in results]
        means[measure.field] = None if None in values else fmean(values)
    return means
