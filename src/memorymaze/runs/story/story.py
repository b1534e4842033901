"""An episode's trace as a story: the walk, what was called and seen, what was understood.

What agents and models wrote is kept as text and never trusted.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.runs.episodes.trace_entries import (
    OpeningEntry,
    PeopleEntry,
    ThingsEntry,
    TraceEntry,
    TrajectoryEntry,
)
from memorymaze.runs.story.events import Event, events_of
from memorymaze.runs.story.understanding import Understanding, understood
from memorymaze.world.drawing.shapes import ThingInTheWay


@dataclass(frozen=True, slots=True, eq=False)
class Story:
    """What a reader sees of an episode of one run."""

    entries: tuple[TraceEntry, ...]
    """The trace, see `docs/formats.md`."""
    walk: Trajectory
    events: tuple[Event, ...]
    """In the order of the trace."""
    understanding: Understanding
    instruction: str | None
    """The text as the trace has it."""
    things: dict[str, ThingInTheWay]
    """Left in the way, by id; only in runs with obstacles."""
    people: dict[str, NDArray[np.float64]]
    """Who walked about: times, x and y, shape (3, N)."""


def story_of(entries: Iterable[TraceEntry], place: str) -> Story:
    """Read the entries of a trace.

    Args:
        entries: Of the trace, from the first to the last.
        place: Its file, for errors.

    Raises:
        RunFolderError: There is no trajectory among them.
    """
    listed = tuple(entries)
    walk = next((each for each in listed if isinstance(each, TrajectoryEntry)), None)
    if walk is None:
        raise RunFolderError(f"{place}: expected a trajectory, got none")
    opening = listed[0]
    things = (
        each
        for entry in listed
        if isinstance(entry, ThingsEntry)
        for each in entry.things
    )
    people = (entry.walks for entry in listed if isinstance(entry, PeopleEntry))
    return Story(
        entries=listed,
        walk=Trajectory(TimedPose(*pose) for pose in walk.poses),
        events=tuple(events_of(listed)),
        understanding=understood(listed),
        instruction=opening.instruction if isinstance(opening, OpeningEntry) else None,
        things={each.object_id: each.shape for each in things},
        people={
            name: np.array(walk, dtype=np.float64).T
            for walks in people
            for name, walk in walks.items()
        },
    )
