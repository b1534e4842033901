"""What there is to see of an episode that is going on."""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from memorymaze.geometry.pose import Pose
from memorymaze.results.replay.current_step import CurrentStep, step_of
from memorymaze.results.replay.moments import news
from memorymaze.results.report.event_words import Event
from memorymaze.results.report.story import story_of
from memorymaze.results.report.understanding import understood

KEPT = 60
"""Events that are kept to be shown."""
STANDING_STILL = {"kind": "trajectory", "poses": [[0.0, 0.0, 0.0, 0.0]]}
"""In place of the walk, which a trace has only at its end."""


@dataclass(frozen=True, slots=True, eq=False)
class Present:
    """An episode at this moment."""

    time: float
    """Simulated seconds."""
    pose: Pose
    path: Sequence[tuple[float, float]]
    """Where the robot has been, metres; it grows."""
    distance: float
    """Metres driven."""
    step: CurrentStep
    """What the agent works on."""
    events: Sequence[Event]
    """What happened last, the latest one last."""
    fresh: Sequence[Event]
    """Those of them, or more, that happened since it was shown last."""
    people: Mapping[str, Pose]
    things: Mapping[str, Pose]


class Reporter:
    """Turns a trace that grows into events, each told once."""

    def __init__(self) -> None:
        """Begin before the first entry."""
        self._seen = 0
        self._told: dict[str, str] = {}
        self._latest: deque[Event] = deque(maxlen=KEPT)

    @property
    def latest(self) -> tuple[Event, ...]:
        """What happened last, the latest one last."""
        return tuple(self._latest)

    def catch_up(self, trace: Sequence[Mapping[str, Any]]) -> list[Event]:
        """Return what happened since the last time."""
        entries, self._seen = [*trace[self._seen :], STANDING_STILL], len(trace)
        fresh = news(story_of(entries, "the episode").events, self._told)
        self._latest.extend(fresh)
        return fresh


def present_step(
    trace: Sequence[Mapping[str, Any]], events: Sequence[Event]
) -> CurrentStep:
    """Return what an agent works on, from a trace that still grows."""
    return step_of(understood(trace), len(trace) - 1, events)
