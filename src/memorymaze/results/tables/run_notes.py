"""What one must know of a run to read its figures."""

from collections import Counter
from collections.abc import Sequence

from memorymaze.evaluation.collision_rates import collision_rates
from memorymaze.evaluation.eyes_for_runs import eyes_notes
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.records import WRITTEN_BY
from memorymaze.results.tables.inference_cost import cost_notes
from memorymaze.results.tables.rows import MeasuredRun
from memorymaze.simulation.obstacles import ObstacleSettings

LOOKS = {
    "own": "things as memorymaze makes them itself",
    "sweethome3d": "furniture models of Sweet Home 3D (docs/assets.md)",
}


def run_notes(run: MeasuredRun) -> list[str]:
    """Say how a run came about: settings, budgets, who wrote the instructions."""
    settings = run.record.settings
    counts = Counter(result.source for result in run.results)
    written = "; ".join(
        f"{count} written by {WRITTEN_BY[source]}" for source, count in counts.items()
    )
    files = ", ".join(stamp.name for stamp in settings.instructions)
    notes = [
        f"{run.label}: run {run.name}, {len(run.results)} episodes; instructions "
        f"({files}): {written}.",
        f"success distance {settings.success_distance:g} m, time budget "
        f"{settings.simulation.time_budget:g} s, call budget "
        f"{settings.simulation.call_budget}, seed {settings.seed}, memorymaze "
        f"{_code(run)}",
    ]
    if settings.simulation.turning_points == "lidar":
        notes.append(
            "TURNING POINTS BY LIDAR (scans and odometry), not from the site plan."
        )
    if settings.looks is not None:
        notes.append(f"cameras show {LOOKS[settings.looks]}")
    notes += eyes_notes(settings)
    if settings.obstacles is not None:
        notes += _obstacle_notes(settings.obstacles, run.results)
    if settings.agent.model is not None:
        notes.append(f"language model {settings.agent.model}")
    if settings.programs is not None:
        known = any(result.inference_s for result in run.results)
        unknown = "; how long their model took is not known and counted as 0 s"
        notes.append(
            f"programs written before the run, from {settings.programs.name} "
            f"({settings.programs.sha256[:12]})" + ("" if known else unknown)
        )
    notes += cost_notes(run)
    if run.left_out:
        notes.append(f"{run.left_out} episodes on development texts are left out.")
    development = sum(each.split == "dev" for each in run.results)
    if development:
        notes.append(
            f"{development} episodes on development texts (split dev) are counted; "
            "--exclude-dev leaves them out."
        )
    if settings.split is not None:
        notes.append(f"only instructions of the split {settings.split}.")
    if settings.limit is not None:
        notes.append(f"A SAMPLE of {settings.episodes} episodes (--limit).")
    if run.missing:
        notes.append(
            f"INCOMPLETE: {run.missing} of {settings.episodes} episodes are missing; "
            "finish the run with --resume."
        )
    return notes


def _obstacle_notes(
    obstacles: ObstacleSettings, results: Sequence[EpisodeResult]
) -> list[str]:
    """Say that a run is of the obstacle track, and how safely the robot drove."""
    crowd = f"{obstacles.people_per_100m2:g} people per 100 m2"
    if obstacles.people is not None:
        crowd = f"{obstacles.people} people"
    found = collision_rates(results)
    return [
        "TRACK WITH OBSTACLES AND PEOPLE, not comparable with runs without: "
        f"{obstacles.things_per_100m:g} things per 100 m, {crowd}, obstacle seed "
        f"{obstacles.seed}.",
        f"per 100 m driven: {found.collisions:.3f} collisions, "
        f"{found.person_collisions:.3f} of them with people, {found.near_misses:.2f} "
        f"near misses; waiting {found.waiting_s:.1f} s per episode.",
    ]


def _code(run: MeasuredRun) -> str:
    code = run.record.code
    if code.commit is None:
        return code.version
    edited = "+" if code.commit.endswith("+") else ""
    return f"{code.version} ({code.commit[:12]}{edited})"
