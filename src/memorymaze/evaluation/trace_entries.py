"""What an episode writes into its trace, entry by entry; see `docs/data_formats.md`."""

from collections.abc import Sequence
from typing import Any

from memorymaze.evaluation.settings import RunDefinition
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.instructions.records import Episode
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.steering.calls import TraceEvent


def opening_entry(
    name: str, episode: Episode, settings: RunDefinition, destination: str | None
) -> dict[str, Any]:
    """Say what is followed, from where, by whom; and where to, if the agent is told."""
    told = episode.instruction
    named = {} if destination is None else {"destination": destination}
    return {
        "kind": "episode",
        "episode_id": episode.id,
        "agent": name,
        "site": told.site,
        "route": told.route,
        "reference_route": told.reference_route,
        "instruction": told.text,
        "instruction_source": told.source,
        "start": episode.start,
        "goal": episode.goal,
        "seed": settings.seed,
        **named,
    }


def call_entry(event: TraceEvent) -> dict[str, Any]:
    """Say what was called, where, and what came of it."""
    return {
        "kind": "call",
        "time": round(event.time, 3),
        "pose": _rounded(event.pose),
        "call": event.call,
        "arguments": event.arguments,
        "result": event.result,
    }


def note_entry(now: float, entry: dict[str, Any]) -> dict[str, Any]:
    """Say what the agent wrote down, and when."""
    details = {name: part for name, part in entry.items() if name != "kind"}
    return {"kind": "note", "time": round(now, 3), "about": entry["kind"], **details}


def surroundings_entries(robot: SimulatedRobot) -> list[dict[str, Any]]:
    """Say what stood in the way and who came close; nothing in the default track."""
    if robot.surroundings is None:
        return []
    things = [
        {
            "object_id": each.record.id,
            "category": each.record.category,
            "size": list(each.record.size),
            "pose": _rounded(each.pose),
        }
        for each in robot.surroundings.things
    ]
    near = [
        {
            "kind": "near_miss",
            "time": round(each.time, 3),
            "pose": _rounded(each.pose),
            "object_id": each.person,
            "gap": round(each.gap, 3),
        }
        for each in robot.near_misses
    ]
    walks: dict[str, list[list[float]]] = {}
    for time_, person, x, y in robot.surroundings.walked:
        walks.setdefault(person, []).append(_rounded((time_, x, y)))
    people = {"kind": "people", "columns": ["time", "x", "y"], "walks": walks}
    return [{"kind": "things", "things": things}, *([people] if walks else []), *near]


def closing_entries(
    robot: SimulatedRobot, walk: Trajectory, ended: str, error: str | None
) -> list[dict[str, Any]]:
    """Say what was touched, where the robot went, and why it ended."""
    collisions = [
        {
            "kind": "collision",
            "time": round(touch.time, 3),
            "pose": _rounded(touch.pose),
            "with": touch.kind,
            "object_id": touch.object_id,
        }
        for touch in robot.collisions
    ]
    poses = [_rounded(pose) for pose in walk.poses]
    return [
        *collisions,
        {
            "kind": "trajectory",
            "columns": ["time", "x", "y", "heading"],
            "poses": poses,
        },
        {"kind": "end", "time": robot.time, "stopped_by": ended, "error": error},
    ]


def _rounded(numbers: Sequence[float]) -> list[float]:
    """Return a pose to the millimetre, which is finer than anything depends on."""
    return [round(number, 3) for number in numbers]
